#pragma once

#include <cstdint>
#include <limits>

namespace talus {

enum class ParameterKind : std::uint32_t {
  number,  ///< a real number within [minimum, maximum]
  flag,    ///< true or false; arrives as 1.0 or 0.0
  choice,  ///< one of `choices`; arrives as its position, 0.0 for the first
};

/// Default value of a parameter that a scene must state.
inline constexpr double required = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

/// One thing a user can set, declared once. The table validates the scene, feeds the component, and is the
/// text of `talus describe`. Values arrive in declared order as doubles, as the user wrote them, so units are
/// those of SI, without prefixes; "deg" alone is converted: written in degrees, it arrives in radians.
struct Parameter {
  const char* key;
  const char* unit;  ///< "Pa/m", "deg", "-" for a pure number
  ParameterKind kind;
  double default_value;  ///< in the user's unit; `required` when a scene must state it; `unbounded`, or 1e300
                         ///< and more, is told as "not set"
  double minimum;        ///< in the user's unit, inclusive
  double maximum;
  const char* choices;   ///< "first|second|third" for a choice, nullptr otherwise
  const char* sentence;  ///< what it means, one sentence
};

constexpr Parameter number(const char* key, const char* unit, double default_value, double minimum,
                           double maximum, const char* sentence) {
  return {key, unit, ParameterKind::number, default_value, minimum, maximum, nullptr, sentence};
}

constexpr Parameter choice(const char* key, const char* choices, double default_position,
                           const char* sentence) {
  return {key, "-", ParameterKind::choice, default_position, 0, unbounded, choices, sentence};
}

constexpr Parameter flag(const char* key, bool default_value, const char* sentence) {
  return {key, "-", ParameterKind::flag, default_value ? 1.0 : 0.0, 0, 1, nullptr, sentence};
}

}  // namespace talus
