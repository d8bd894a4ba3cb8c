#pragma once

#include <algorithm>
#include <cmath>

namespace talus {

struct Vec2 {
  double x = 0, y = 0;
};

inline Vec2 operator+(Vec2 p, Vec2 q) {
  return {p.x + q.x, p.y + q.y};
}
inline Vec2 operator-(Vec2 p, Vec2 q) {
  return {p.x - q.x, p.y - q.y};
}
inline Vec2& operator+=(Vec2& p, Vec2 q) {
  return p = p + q;
}
inline Vec2 operator*(double factor, Vec2 p) {
  return {factor * p.x, factor * p.y};
}
inline Vec2 operator/(Vec2 p, double divisor) {
  return {p.x / divisor, p.y / divisor};
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

inline bool same(Vec2 p, Vec2 q) {
  return p.x == q.x && p.y == q.y;
}

/// Of a point from a segment, which may be a point.
inline double distance_from(Vec2 point, Vec2 from, Vec2 to) {
  const Vec2 span = to - from, way = point - from;
  const double square = dot(span, span);
  const double share = square > 0 ? std::clamp(dot(way, span) / square, 0.0, 1.0) : 0.0;
  const Vec2 apart = way - share * span;
  return std::hypot(apart.x, apart.y);
}

}  // namespace talus
