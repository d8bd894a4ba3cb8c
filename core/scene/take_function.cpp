#include "scene/take_function.hpp"

#include "scene/columns.hpp"
#include "scene/files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace talus {
namespace {

constexpr std::size_t most_points_of_scene = 10 * most_points;

constexpr const char* table_expected = "a table [[at, value], ...] or the path of a file \"file.csv\"";

/// What is read of one value, and how.
struct Taking {
  Reading& reading;
  const Parameter& parameter;
  Varies varies;
};

std::string what_is_allowed(const Parameter& parameter) {
  return fmt::format(
      "{}, {{\"scale\": ..., \"time\": ..., \"x\": ..., \"y\": ...}}, or a list of such to be summed",
      expectation(parameter));
}

/// Whether `count` points more are too many for one scene.
bool too_many(Reading& reading, std::size_t count, const std::string& pointer) {
  reading.table_points += count;
  if (reading.table_points <= most_points_of_scene) return false;
  reading.mistakes.add(pointer,
                       fmt::format("the tables of the scene hold more than {} points, the most that are read",
                                   most_points_of_scene));
  return true;
}

std::optional<Table> take_points(Reading& reading, const Json& written, const std::string& pointer) {
  Mistakes& mistakes = reading.mistakes;
  const std::size_t mistakes_before = mistakes.count();
  if (written.size() < 2)
    mistakes.add(pointer,
                 fmt::format("{} is no table: expected at least two points [at, value]", shown(written)));
  std::vector<double> at, value;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Json& point = written[i];
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number()) {
      mistakes.add(below(pointer, i),
                   fmt::format("{} is no point of a table: expected two numbers [at, value]", shown(point)));
      continue;
    }
    const double where = point[0].get<double>();
    if (!at.empty() && !(where > at.back())) {
      mistakes.add(below(below(pointer, i), 0),
                   fmt::format("{} does not come after {}: the first numbers of a table must rise strictly",
                               shown(point[0]), at.back()));
    }
    at.push_back(where);
    value.push_back(point[1].get<double>());
  }
  if (mistakes.count() != mistakes_before || too_many(reading, at.size(), pointer)) return std::nullopt;
  return Table(std::move(at), std::move(value));
}

/// "file.csv" or "file.csv:column".
std::optional<Table> take_file(Reading& reading, const std::string& written, const std::string& pointer,
                               OrderedJson& resolved) {
  const NamedFile named = named_file(reading.folder, written);
  resolved = named.resolved;
  std::string problem;
  std::optional<Columns> columns = read_columns(named.file, named.part, problem);
  if (!columns) {
    reading.mistakes.add(pointer, problem);
    return std::nullopt;
  }
  note_file(reading.scene.files, named.file);
  if (too_many(reading, columns->at.size(), pointer)) return std::nullopt;
  return Table(std::move(columns->at), std::move(columns->value));
}

std::optional<Table> take_table(const Taking& taking, Section& section, const std::string& key) {
  const Json* written = section.child(key);
  if (written == nullptr) return std::nullopt;
  const std::string pointer = section.pointer_to(key);
  section.resolved[key] = *written;
  if (key != "time" && taking.varies == Varies::in_time) {
    section.mistakes().add_at_key(
        pointer, fmt::format("\"{}\" is not allowed here: the value may depend on \"time\" alone", key));
    return std::nullopt;
  }
  if (written->is_array()) return take_points(taking.reading, *written, pointer);
  if (written->is_string() && !written->get<std::string>().empty())
    return take_file(taking.reading, written->get<std::string>(), pointer, section.resolved[key]);
  section.mistakes().add(pointer,
                         fmt::format("{} is not allowed here: expected {}", shown(*written), table_expected));
  return std::nullopt;
}

Product take_product(const Taking& taking, const Json& value, const std::string& pointer,
                     OrderedJson& resolved) {
  Section section(&value, pointer, taking.reading.mistakes);
  Parameter scale = taking.parameter;
  scale.key = "scale";
  scale.default_value = 1;
  Product product;
  if (value.empty())
    section.mistakes().add(pointer,
                           fmt::format("{{}} says nothing: expected {}", what_is_allowed(taking.parameter)));
  product.scale = section.value(scale);
  product.time = take_table(taking, section, "time");
  product.x = take_table(taking, section, "x");
  product.y = take_table(taking, section, "y");
  section.finish();
  resolved = section.resolved;
  return product;
}

void take_term(const Taking& taking, const Json& value, const std::string& pointer, Function& function,
               OrderedJson& resolved) {
  resolved = value;
  Product product;
  if (value.is_number()) {
    product.scale = take_value(taking.parameter, value, pointer, taking.reading.mistakes);
  } else if (value.is_object()) {
    product = take_product(taking, value, pointer, resolved);
  } else {
    taking.reading.mistakes.add(pointer, fmt::format("{} is not allowed here: expected {}", shown(value),
                                                     what_is_allowed(taking.parameter)));
  }
  if (product.scale != 0 && !std::isnan(product.scale)) function.terms.push_back(std::move(product));
}

/// The two entries of a list; null counts as free where `free` says so, else as a mistake.
std::array<std::optional<Function>, 2> take_axes(const Taking& taking, Section& section, const Json& written,
                                                 bool free) {
  std::array<std::optional<Function>, 2> axes;
  const std::string pointer = section.pointer_to(taking.parameter.key);
  OrderedJson& resolved = section.resolved[taking.parameter.key] = written;
  if (!written.is_array() || written.size() != 2) {
    section.mistakes().add(pointer, fmt::format("{} is not allowed here: expected [x, y], each {}{}",
                                                shown(written), what_is_allowed(taking.parameter),
                                                free ? ", or null for an axis that is free" : ""));
    return axes;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    if (free && written[i].is_null()) continue;
    axes[i] = take_function(taking.reading, taking.parameter, written[i], below(pointer, i), taking.varies,
                            resolved[i]);
  }
  return axes;
}

}  // namespace

Function take_function(Reading& reading, const Parameter& parameter, const Json& value,
                       const std::string& pointer, Varies varies, OrderedJson& resolved) {
  const Taking taking{reading, parameter, varies};
  Function function;
  resolved = value;
  if (!value.is_array()) {
    take_term(taking, value, pointer, function, resolved);
    return function;
  }
  if (value.empty())
    reading.mistakes.add(pointer, fmt::format("[] sums up nothing: expected {}", what_is_allowed(parameter)));
  for (std::size_t i = 0; i < value.size(); ++i)
    take_term(taking, value[i], below(pointer, i), function, resolved[i]);
  return function;
}

std::optional<Function> optional_function(Reading& reading, Section& section, const Parameter& parameter) {
  const Json* written = section.child(parameter.key);
  if (written == nullptr) return std::nullopt;
  return take_function(reading, parameter, *written, section.pointer_to(parameter.key),
                       Varies::in_time_and_place, section.resolved[parameter.key]);
}

VectorFunction vector_function(Reading& reading, Section& section, const Parameter& parameter,
                               Varies varies) {
  const bool is_required = std::isnan(parameter.default_value);
  const Json* written =
      is_required
          ? section.required_child(parameter.key, fmt::format("[x, y], each {}", expectation(parameter)))
          : section.child(parameter.key);
  if (written == nullptr) {
    if (!is_required) section.resolved[parameter.key] = OrderedJson::array({0, 0});
    return {};
  }
  auto axes = take_axes({reading, parameter, varies}, section, *written, false);
  return {std::move(axes[0]).value_or(Function{}), std::move(axes[1]).value_or(Function{})};
}

std::array<std::optional<Function>, 2> free_vector_function(Reading& reading, Section& section,
                                                            const Parameter& parameter) {
  const Json* written = section.child(parameter.key);
  if (written != nullptr)
    return take_axes({reading, parameter, Varies::in_time_and_place}, section, *written, true);
  section.resolved[parameter.key] = OrderedJson::array({nullptr, nullptr});
  return {};
}

}  // namespace talus
