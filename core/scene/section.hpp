#pragma once

#include "scene/mistakes.hpp"
#include "scene/positions.hpp"

#include <talus/parameter.hpp>

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace talus {

/// Keeps the order in which keys are written.
using OrderedJson = nlohmann::ordered_json;

/// Smallest value of a parameter that must be greater than zero.
inline constexpr double above_zero = std::numeric_limits<double>::min();

/// Default value of a parameter of the core's own sections that may be left out and then does nothing.
inline constexpr double not_set = unbounded;

/// Default value of a parameter that the program chooses by itself unless a number is written: "auto".
inline constexpr double automatic = -unbounded;

/// "a number [deg] from 0 to 89.9"
std::string expectation(const Parameter& parameter);

/// A value as it is shown in a message, cut short.
std::string shown(const Json& value);

/// A value of the scene in SI, as the components take it; NaN after a mistake.
double take_value(const Parameter& parameter, const Json& value, const std::string& pointer,
                  Mistakes& mistakes);

/// A list of two numbers; an entry may be null where `free` says so and is then NaN. Empty after a mistake.
std::optional<std::array<double, 2>> take_pair(const Parameter& parameter, const Json& value,
                                               const std::string& pointer, Mistakes& mistakes,
                                               bool free = false);

/// A number as JSON, whole ones without a decimal point.
OrderedJson plain(double value);

/// One JSON object of the scene. Its keys are taken one by one; each is thereby allowed, checked and written
/// to `resolved`. finish() reports the keys nobody took. Mistakes are noted and never end the reading.
class Section {
 public:
  /// `object` is nullptr where the scene has no such object: everything then has its default.
  Section(const Json* object, std::string pointer, Mistakes& mistakes);

  const std::string& pointer() const { return pointer_; }
  std::string pointer_to(const std::string& key) const { return below(pointer_, key); }
  Mistakes& mistakes() { return mistakes_; }
  bool has(const std::string& key) const { return object_ != nullptr && object_->contains(key); }
  bool knows(const std::string& key) const;
  std::vector<std::string> keys() const;

  /// Number, flag or choice in SI; its default if the key is absent; NaN after a mistake.
  double value(const Parameter& parameter);
  std::vector<double> values(std::span<const Parameter> parameters);
  std::optional<double> optional_value(const Parameter& parameter);

  /// A list of two numbers of the kind of `parameter`.
  Vec2 pair(const Parameter& parameter);
  std::optional<Vec2> optional_pair(const Parameter& parameter);

  /// A text. "" after a mistake.
  std::string text(const std::string& key, const std::string& what);
  std::string text(const std::string& key, const std::string& what, const std::string& default_value);

  /// A value of another shape; nullptr if absent. What was read of it belongs to `resolved[key]`.
  const Json* child(const std::string& key);
  const Json* required_child(const std::string& key, const std::string& what);

  /// Calls `each` for every entry of a list.
  using Entry = std::function<void(const Json& entry, const std::string& pointer)>;
  void list(const std::string& key, const std::string& what, const Entry& each);
  /// Calls `each` for every member of an object of named things.
  using Member = std::function<void(const std::string& name, const Json& value, const std::string& pointer)>;
  void members(const std::string& key, const std::string& what, const Member& each);

  /// Reports unknown keys.
  void finish();

  OrderedJson resolved = OrderedJson::object();

 private:
  void missing(const std::string& key, const std::string& what);

  const Json* object_;
  std::string pointer_;
  Mistakes& mistakes_;
  bool broken_ = false;  ///< was no object: said once, its keys are not asked for
  std::vector<std::string> allowed_;
};

}  // namespace talus
