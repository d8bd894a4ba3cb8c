#pragma once

#include <cmath>

namespace talus {

struct Vec2 {
  double x = 0, y = 0;
};

inline Vec2 minus(Vec2 p, Vec2 q) {
  return {p.x - q.x, p.y - q.y};
}

inline double dot(Vec2 p, Vec2 q) {
  return p.x * q.x + p.y * q.y;
}

inline double cross(Vec2 p, Vec2 q) {
  return p.x * q.y - p.y * q.x;
}

inline double size_of(Vec2 p) {
  return std::sqrt(dot(p, p));
}

}  // namespace talus
