#include "scene/section.hpp"

#include "scene/parameter_text.hpp"
#include "text/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace talus {
namespace {

std::string range_of(const Parameter& parameter) {
  const bool below_bounded = std::isfinite(parameter.minimum),
             above_bounded = std::isfinite(parameter.maximum);
  if (is_above_zero(parameter)) {
    return above_bounded ? fmt::format(" greater than 0 and at most {}", parameter.maximum)
                         : " greater than 0";
  }
  if (below_bounded && above_bounded)
    return fmt::format(" from {} to {}", parameter.minimum, parameter.maximum);
  if (below_bounded) return fmt::format(" of at least {}", parameter.minimum);
  if (above_bounded) return fmt::format(" of at most {}", parameter.maximum);
  return {};
}

/// What the user writes to what the components take.
double to_si(const Parameter& parameter, double written) {
  const std::string_view unit = parameter.unit;
  return unit == "deg" || unit == "deg/s" ? written * (std::numbers::pi / 180) : written;
}

bool in_range(const Parameter& parameter, double number) {
  return number >= parameter.minimum && number <= parameter.maximum;
}

std::optional<double> refuse(const Parameter& parameter, const Json& value, const std::string& pointer,
                             Mistakes& mistakes) {
  const bool too_far = parameter.kind == ParameterKind::number && value.is_number();
  std::string guess;
  if (parameter.kind == ParameterKind::choice && value.is_string()) {
    guess = did_you_mean(value.get<std::string>(), choices_of(parameter));
  }
  mistakes.add(pointer, fmt::format("{} is {}{}{} expected {}", shown(value),
                                    too_far ? "out of range" : "not allowed here", guess.empty() ? ":" : ";",
                                    guess, expectation(parameter)));
  return std::nullopt;
}

}  // namespace

std::string expectation(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::flag) return "true or false";
  if (parameter.kind == ParameterKind::choice) {
    std::string all;
    for (const std::string& one : choices_of(parameter))
      all += fmt::format("{}\"{}\"", all.empty() ? "" : " or ", one);
    return all;
  }
  return fmt::format("a number [{}]{}", parameter.unit, range_of(parameter));
}

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() <= 60) return text;
  if (value.is_object()) return fmt::format("an object of {} keys", value.size());
  if (value.is_array()) return fmt::format("a list of {} entries", value.size());
  return clipped(text, 57);
}

OrderedJson plain(double value) {
  const bool whole =
      value == std::floor(value) && std::abs(value) < 1e15 && !(value == 0 && std::signbit(value));
  return whole ? OrderedJson(static_cast<std::int64_t>(value)) : OrderedJson(value);
}

double take_value(const Parameter& parameter, const Json& value, const std::string& pointer,
                  Mistakes& mistakes) {
  std::optional<double> taken;
  switch (parameter.kind) {
    case ParameterKind::number:
      if (value.is_number() && in_range(parameter, value.get<double>())) {
        taken = to_si(parameter, value.get<double>());
      }
      break;
    case ParameterKind::flag:
      if (value.is_boolean()) taken = value.get<bool>() ? 1.0 : 0.0;
      break;
    case ParameterKind::choice: {
      const std::vector<std::string> choices = choices_of(parameter);
      const auto at = value.is_string() ? std::find(choices.begin(), choices.end(), value.get<std::string>())
                                        : choices.end();
      if (at != choices.end()) taken = static_cast<double>(at - choices.begin());
      break;
    }
  }
  if (!taken) taken = refuse(parameter, value, pointer, mistakes);
  return taken.value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<std::array<double, 2>> take_pair(const Parameter& parameter, const Json& value,
                                               const std::string& pointer, Mistakes& mistakes, bool free) {
  if (!value.is_array() || value.size() != 2) {
    mistakes.add(pointer, fmt::format("{} is not allowed here: expected [x, y], each {}{}", shown(value),
                                      expectation(parameter), free ? " or null" : ""));
    return std::nullopt;
  }
  std::array<double, 2> taken{};
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    if (free && value[i].is_null()) {
      taken[i] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    taken[i] = take_value(parameter, value[i], below(pointer, i), mistakes);
    if (std::isnan(taken[i])) good = false;
  }
  return good ? std::optional(taken) : std::nullopt;
}

Section::Section(const Json* object, std::string pointer, Mistakes& mistakes)
    : object_(object), pointer_(std::move(pointer)), mistakes_(mistakes) {
  if (object_ == nullptr || object_->is_object()) return;
  mistakes_.add(pointer_, fmt::format("{} is not allowed here: expected an object {{...}}", shown(*object_)));
  object_ = nullptr;
  broken_ = true;
}

bool Section::knows(const std::string& key) const {
  return std::find(allowed_.begin(), allowed_.end(), key) != allowed_.end();
}

std::vector<std::string> Section::keys() const {
  std::vector<std::string> all;
  if (object_ == nullptr) return all;
  for (const auto& [key, value] : object_->items()) all.push_back(key);
  return all;
}

const Json* Section::child(const std::string& key) {
  if (!knows(key)) allowed_.push_back(key);
  return has(key) ? &object_->at(key) : nullptr;
}

const Json* Section::required_child(const std::string& key, const std::string& what) {
  const Json* value = child(key);
  if (value == nullptr) missing(key, what);
  return value;
}

void Section::missing(const std::string& key, const std::string& what) {
  if (!broken_) mistakes_.add(pointer_, fmt::format("required key \"{}\" is missing: {}", key, what));
}

double Section::value(const Parameter& parameter) {
  if (const Json* written = child(parameter.key)) {
    resolved[parameter.key] = *written;
    return take_value(parameter, *written, pointer_to(parameter.key), mistakes_);
  }
  if (std::isnan(parameter.default_value)) {
    missing(parameter.key, fmt::format("{} ({})", expectation(parameter), parameter.sentence));
    return parameter.default_value;
  }
  switch (parameter.kind) {
    case ParameterKind::number:
      // Without bounds is what no scene can write.
      if (std::isfinite(parameter.default_value)) resolved[parameter.key] = plain(parameter.default_value);
      return to_si(parameter, parameter.default_value);
    case ParameterKind::flag:
      resolved[parameter.key] = parameter.default_value != 0;
      break;
    case ParameterKind::choice:
      resolved[parameter.key] = choices_of(parameter).at(static_cast<std::size_t>(parameter.default_value));
      break;
  }
  return parameter.default_value;
}

std::vector<double> Section::values(std::span<const Parameter> parameters) {
  std::vector<double> all;
  for (const Parameter& parameter : parameters) all.push_back(value(parameter));
  return all;
}

std::optional<double> Section::optional_value(const Parameter& parameter) {
  if (child(parameter.key) == nullptr) return std::nullopt;
  return value(parameter);
}

Vec2 Section::pair(const Parameter& parameter) {
  if (has(parameter.key) || std::isnan(parameter.default_value)) {
    if (const auto taken = optional_pair(parameter)) return *taken;
    if (!has(parameter.key)) missing(parameter.key, fmt::format("[x, y], each {}", expectation(parameter)));
    return {};
  }
  child(parameter.key);
  const double both = parameter.default_value;
  resolved[parameter.key] = OrderedJson::array({plain(both), plain(both)});
  return {both, both};
}

std::optional<Vec2> Section::optional_pair(const Parameter& parameter) {
  const Json* written = child(parameter.key);
  if (written == nullptr) return std::nullopt;
  resolved[parameter.key] = *written;
  const auto taken = take_pair(parameter, *written, pointer_to(parameter.key), mistakes_);
  if (!taken) return std::nullopt;
  return Vec2{(*taken)[0], (*taken)[1]};
}

std::string Section::text(const std::string& key, const std::string& what) {
  const Json* written = required_child(key, what);
  if (written == nullptr) return {};
  resolved[key] = *written;
  if (written->is_string()) return written->get<std::string>();
  mistakes_.add(pointer_to(key), fmt::format("{} is not allowed here: expected {}", shown(*written), what));
  return {};
}

std::string Section::text(const std::string& key, const std::string& what, const std::string& default_value) {
  if (child(key) != nullptr) return text(key, what);
  resolved[key] = default_value;
  return default_value;
}

void Section::list(const std::string& key, const std::string& what, const Entry& each) {
  const Json* written = child(key);
  if (written == nullptr) return;
  if (!written->is_array()) {
    mistakes_.add(pointer_to(key), fmt::format("{} is not allowed here: expected {}", shown(*written), what));
    return;
  }
  for (std::size_t i = 0; i < written->size(); ++i) each((*written)[i], below(pointer_to(key), i));
}

void Section::members(const std::string& key, const std::string& what, const Member& each) {
  const Json* written = child(key);
  if (written == nullptr) return;
  if (!written->is_object()) {
    mistakes_.add(pointer_to(key), fmt::format("{} is not allowed here: expected {}", shown(*written), what));
    return;
  }
  for (const auto& [name, value] : written->items()) each(name, value, below(pointer_to(key), name));
}

void Section::finish() {
  for (const std::string& key : keys()) {
    if (knows(key)) continue;
    mistakes_.add_at_key(pointer_to(key), fmt::format("unknown key;{} allowed here: {}",
                                                      did_you_mean(key, allowed_), listed(allowed_)));
  }
}

}  // namespace talus
