#include "schema/reference.hpp"

#include "files/marked_tables.hpp"
#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string_view>

namespace talus {
namespace {

std::string replaced(std::string text, std::string_view old, std::string_view now) {
  for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size()))
    text.replace(at, old.size(), now);
  return text;
}

/// What is written in a scene stands as code; numbers and words do not.
std::string in_markdown(const std::string& text) {
  const OrderedJson written = OrderedJson::parse(text, nullptr, false);
  if (!written.is_discarded() && !written.is_number()) return '`' + text + '`';
  if (text.find('"') != std::string::npos && text.front() == '{') return '`' + text + '`';
  std::string quoted;  // each word of a choice is code
  bool within = false;
  for (const char letter : text) {
    if (letter == '"' && !within) quoted += '`';
    quoted += letter;
    if (letter == '"' && within) quoted += '`';
    if (letter == '"') within = !within;
  }
  return replaced(replaced(quoted, ">= ", "≥ "), "<= ", "≤ ");
}

std::string default_in_markdown(const std::string& text) {
  return text.starts_with("required") ? "–" + text.substr(8) : in_markdown(text);
}

std::string unit_in_markdown(const std::string& unit) {
  return unit == "-" ? "–" : replaced(replaced(unit, "2", "²"), "3", "³");
}

std::string quantity_table() {
  std::string text = "| quantity | unit | meaning |\n|---|---|---|\n";
  for (const Quantity& quantity : quantities())
    text += fmt::format("| `{}` | {} | {} |\n", quantity.name, quantity.unit, quantity.sentence);
  return text;
}

std::map<std::string, std::optional<std::string>> tables_of(const Registry& registry) {
  std::map<std::string, std::optional<std::string>> tables{{"quantities", quantity_table()}};
  for (const Part& part : parts_of_scene()) tables[part.pointer] = reference_table(part.keys);
  for (const RegisteredComponent& entry : registry.components()) {
    const Component& component = *entry.component;
    tables[component.name] = reference_table(keys_of(component));
    if (component.kind == ComponentKind::contact_model)
      tables[fmt::format("{} of an interface", component.name)] =
          reference_table(interface_keys_of(component));
  }
  return tables;
}

}  // namespace

std::string reference_table(const std::vector<Key>& keys) {
  std::string text = "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : keys) {
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, unit_in_markdown(key.unit),
                        default_in_markdown(key.default_text), in_markdown(key.range),
                        replaced(key.sentence, "|", "\\|"));
  }
  return text;
}

std::string with_reference(const std::string& markdown, const Registry& registry) {
  return with_marked_tables(markdown, "reference", tables_of(registry));
}

}  // namespace talus
