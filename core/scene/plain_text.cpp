#include "scene/blocks.hpp"
#include "scene/overrides.hpp"
#include "scene/read.hpp"

#include <fmt/format.h>

namespace talus {
namespace {

/// `value` with its keys in the order that `written` has them in; new ones come after.
OrderedJson in_order(const Json& value, const OrderedJson& written) {
  if (value.is_object()) {
    OrderedJson ordered = OrderedJson::object();
    if (written.is_object()) {
      for (const auto& [key, old] : written.items()) {
        if (const auto found = value.find(key); found != value.end()) ordered[key] = in_order(*found, old);
      }
    }
    for (const auto& [key, inner] : value.items()) {
      if (!ordered.contains(key)) ordered[key] = in_order(inner, {});
    }
    return ordered;
  }
  if (value.is_array()) {
    OrderedJson ordered = OrderedJson::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      const bool old = written.is_array() && i < written.size();
      ordered.push_back(in_order(value[i], old ? written[i] : OrderedJson()));
    }
    return ordered;
  }
  return OrderedJson(value);
}

std::string one_line(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

/// A line per key, and one per entry of a list of objects.
std::string laid_out(const OrderedJson& scene) {
  std::string text = "{";
  for (const auto& [key, value] : scene.items()) {
    text += fmt::format("{}\n  {}: ", text.size() > 1 ? "," : "", one_line(key));
    if (!value.is_array() || value.empty() || !value[0].is_object()) {
      text += one_line(value);
      continue;
    }
    text += '[';
    for (std::size_t i = 0; i < value.size(); ++i)
      text += fmt::format("{}\n    {}", i > 0 ? "," : "", one_line(value[i]));
    text += "\n  ]";
  }
  return text + "\n}\n";
}

/// What stands before the scene's first brace.
std::string head_of(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size() && text[at] != '{') {
    if (text.compare(at, 2, "//") == 0) {
      at = text.find('\n', at);
    } else if (text.compare(at, 2, "/*") == 0) {
      at = text.find("*/", at);
    }
    if (at != std::string::npos) ++at;
  }
  return text.substr(0, at);
}

}  // namespace

std::string plain_scene_text(const std::string& text, const std::string& name, Registry& registry,
                             const ReadOptions& options) {
  read_scene_text(text, name, registry, options);
  Mistakes none;
  Json scene = parse_json(text, name).value;
  apply_overrides(scene, options.overrides, none);
  expand_blocks(scene, std::filesystem::path(name).parent_path(), options.most_blocks, none);
  const OrderedJson written = OrderedJson::parse(text, nullptr, true, true);
  return head_of(text) + laid_out(in_order(scene, written));
}

}  // namespace talus
