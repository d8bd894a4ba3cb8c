#pragma once

#include "geometry/vec2.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace talus {

/// A place of something of a size, m, in figures that tell it to as many digits of that, wherever it lies; a
/// double has 15 of them.
inline std::string place_text(Vec2 at, double size, int digits = 10) {
  const double farthest = std::max({std::abs(at.x), std::abs(at.y), size});
  const auto before_point = [](double number) {
    return static_cast<int>(std::floor(std::log10(number))) + 1;
  };
  const int decimals = std::max(0, std::min(digits - before_point(size), 15 - before_point(farthest)));
  const auto number = [decimals](double value) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals > 0) text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? std::string("0") : text;
  };
  return fmt::format("({}, {})", number(at.x), number(at.y));
}

/// A place that is known from an origin, m, to six digits of its distance from there.
inline std::string place_from(Vec2 origin, Vec2 at) {
  const double distance = std::max({std::abs(at.x), std::abs(at.y), 1e-9});
  return place_text(origin + at, distance, 6);
}

}  // namespace talus
