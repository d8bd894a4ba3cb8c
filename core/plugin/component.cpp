#include "plugin/refusal.hpp"

#include "text/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>

namespace talus {
namespace {

bool empty(const char* text) {
  return text == nullptr || *text == '\0';
}

/// Names stand in JSON pointers and in comma-separated lists of the command line.
bool well_formed(std::string_view name) {
  return std::ranges::all_of(name,
                             [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}

using Reserved = std::span<const std::string_view>;

// Keys that a scene writes beside the names and parameters of a component.
constexpr std::string_view beside_laws[] = {"model", "roles"};
constexpr std::string_view beside_material_parameters[] = {"density", "model"};
constexpr std::string_view beside_cover_parameters[] = {"model"};
constexpr std::string_view beside_interface_parameters[] = {"between"};

constexpr const char* unfit_text =
    "found text with control characters, or that is no UTF-8, which goes into lists and JSON; wanted one "
    "line of UTF-8; "
    "correct it and rebuild the library";

bool contains(Reserved words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

std::optional<std::string> reason_in_name(std::string_view name, Reserved reserved) {
  if (!well_formed(name)) {
    return "found a name with other characters, wanted letters, digits, '_' and '-' only; rename it and "
           "rebuild "
           "the library";
  }
  if (contains(reserved, name)) {
    return fmt::format(
        "found the name '{}', which scenes use themselves beside it; wanted another; rename it "
        "and rebuild the library",
        name);
  }
  return std::nullopt;
}

std::optional<std::string> reason_in_choices(const Parameter& parameter) {
  if (empty(parameter.choices)) {
    return "found a choice without choices, wanted 'first|second|...'; list them and rebuild the library";
  }
  if (!printable(parameter.choices)) return unfit_text;
  std::set<std::string_view> seen;
  std::string_view rest = parameter.choices;
  while (true) {
    const std::size_t bar = rest.find('|');
    const std::string_view word = rest.substr(0, bar);
    if (word.empty() || !seen.insert(word).second) {
      return fmt::format(
          "found the choices '{}', wanted words that differ and are not empty; correct them and "
          "rebuild the library",
          parameter.choices);
    }
    if (bar == std::string_view::npos) break;
    rest.remove_prefix(bar + 1);
  }
  const double position = parameter.default_value;
  const auto count = static_cast<double>(seen.size());
  const bool stands = position >= 0 && position < count && position == std::floor(position);
  if (!std::isnan(position) && !stands) {
    return fmt::format(
        "found the default position {}, wanted 0 to {} (or `required`), one of '{}'; correct it "
        "and rebuild the library",
        position, count - 1, parameter.choices);
  }
  return std::nullopt;
}

std::optional<std::string> reason_in_range(const Parameter& parameter) {
  const double value = parameter.default_value;
  if (!(parameter.minimum <= parameter.maximum)) {
    return fmt::format(
        "found the range [{}, {}], wanted a minimum that is not above the maximum; correct it and "
        "rebuild the library",
        parameter.minimum, parameter.maximum);
  }
  if (value == -unbounded)
    return "found the default -inf, wanted a number, `required`, or `unbounded` for what may be left out; "
           "correct it and rebuild the library";
  const bool is_flag = parameter.kind == ParameterKind::flag;
  const bool inside = value >= parameter.minimum && value <= parameter.maximum;
  if (!std::isnan(value) && (!inside || (is_flag && value != 0 && value != 1))) {
    return fmt::format(
        "found the default {} outside its range [{}, {}], wanted one within (or `required`); "
        "correct it and rebuild the library",
        value, parameter.minimum, parameter.maximum);
  }
  return std::nullopt;
}

std::optional<std::string> reason_in_parameter(const Parameter& parameter, Reserved reserved) {
  if (auto reason = reason_in_name(parameter.key, reserved)) return reason;
  if (empty(parameter.unit) || empty(parameter.sentence)) {
    return "found no unit or no sentence, wanted both ('-' is the unit of a pure number); set them and "
           "rebuild "
           "the library";
  }
  if (!printable(parameter.unit) || !printable(parameter.sentence)) return unfit_text;
  switch (parameter.kind) {
    case ParameterKind::choice:
      return reason_in_choices(parameter);
    case ParameterKind::number:
    case ParameterKind::flag:
      return reason_in_range(parameter);
  }
  return fmt::format("found the kind {}, wanted number, flag or choice; correct it and rebuild the library",
                     static_cast<std::uint32_t>(parameter.kind));
}

std::optional<std::string> reason_in_table(std::string_view table, const Parameter* parameters,
                                           std::uint32_t count, Reserved reserved) {
  if (count > 0 && parameters == nullptr) {
    return fmt::format("found {} {}s at a null pointer, wanted a table; set it and rebuild the library",
                       count, table);
  }
  std::set<std::string_view> keys;
  for (const Parameter& parameter : std::span(parameters, count)) {
    if (empty(parameter.key)) {
      return fmt::format("found a {} without a key, wanted one; set it and rebuild the library", table);
    }
    if (const auto reason = reason_in_parameter(parameter, reserved)) {
      return fmt::format("{} '{}': {}", table, parameter.key, *reason);
    }
    if (!keys.insert(parameter.key).second) {
      return fmt::format(
          "found two {}s called '{}', wanted keys that differ; rename one and rebuild the library", table,
          parameter.key);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> reason_to_refuse(const Component& component) {
  Reserved names_beside, keys_beside;
  switch (component.kind) {
    case ComponentKind::contact_model:  // its parameters stand in a section of their own, called after the
                                        // law
      names_beside = beside_laws;
      break;
    case ComponentKind::material:
      keys_beside = beside_material_parameters;
      break;
    case ComponentKind::cover_builder:
      keys_beside = beside_cover_parameters;
      break;
    default:
      return fmt::format(
          "found the kind {}, wanted contact_model, material or cover_builder; correct it and "
          "rebuild the library",
          static_cast<std::uint32_t>(component.kind));
  }
  if (empty(component.name)) {
    return "found no name, wanted what a scene writes as \"model\"; set it and rebuild the library";
  }
  if (auto reason = reason_in_name(component.name, names_beside)) return reason;
  if (empty(component.sentence)) {
    return "found no sentence that says what it is, wanted one; set it and rebuild the library";
  }
  if (!printable(component.sentence)) return unfit_text;
  if (component.create == nullptr || component.destroy == nullptr) {
    return fmt::format(
        "found no `{}`, wanted both functions; use talus::create_component and "
        "talus::destroy_component and rebuild the library",
        component.create == nullptr ? "create" : "destroy");
  }
  constexpr std::uint32_t known = trait::has_potential | trait::pulls | trait::spread_springs;
  if ((component.traits & ~known) != 0) {
    return fmt::format(
        "found the traits {:#x}, wanted a sum of those of talus::trait; correct it and rebuild the library",
        component.traits);
  }
  if (component.kind != ComponentKind::contact_model && component.interface_parameter_count != 0) {
    return fmt::format(
        "found interface parameters in a {}, wanted them in contact laws only; remove them and "
        "rebuild the library",
        kind_in_words(component.kind));
  }
  if (auto reason =
          reason_in_table("parameter", component.parameters, component.parameter_count, keys_beside)) {
    return reason;
  }
  return reason_in_table("interface parameter", component.interface_parameters,
                         component.interface_parameter_count, beside_interface_parameters);
}

std::string words_of_plugin(std::string_view said) {
  std::string words(said.size() + 1 == room_for_words ? without_cut_letter(said) : said);
  for (char& c : words) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  if (!printable(words)) {
    for (char& c : words) {
      if (static_cast<unsigned char>(c) >= 0x80) c = '?';
    }
  }
  return words.find_first_not_of(' ') == std::string::npos ? "it does not say why" : words;
}

}  // namespace talus
