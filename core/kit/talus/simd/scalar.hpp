#pragma once

// Packs of one double, for the rest of machines, and what the others are held against. Included by pack.hpp
// alone.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace talus::simd {
inline namespace scalar {

inline constexpr int lanes = 1;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(4)]] = std::uint32_t;

struct Mask {
  bool value;
};
struct Pack {
  double value;
  Pack() = default;
  Pack(double v) : value(v) {}
};
/// A point or vector in each lane.
struct Packs2 {
  Pack x, y;
};

/// As many bytes, widened.
inline Numbers numbers(const std::uint8_t* from) {
  return Numbers{*from};
}
/// Of numbers below 2³¹.
inline Pack doubles(Numbers n) {
  return static_cast<double>(n[0]);
}
/// The numbers that are the bits of floats.
inline Pack floats(Numbers n) {
  return double{std::bit_cast<float>(std::uint32_t{n[0]})};
}
/// The two numbers in each lane, of which lower bits come first.
inline void split(Pack p, Numbers& low, Numbers& high) {
  const auto both = std::bit_cast<std::uint64_t>(p.value);
  low = Numbers{static_cast<std::uint32_t>(both)};
  high = Numbers{static_cast<std::uint32_t>(both >> 32)};
}
inline Pack load(const double* from) {
  return *from;
}
inline Pack load(const float* from) {
  return double{*from};
}
inline void store(Pack p, double* to) {
  *to = p.value;
}
/// The first `count` of a row, at most all; the other lanes are 0, and nothing beyond is read.
inline Pack load_first(const double* from, unsigned count) {
  return count != 0 ? *from : 0.0;
}
inline void store_first(Pack p, double* to, unsigned count) {
  if (count != 0) *to = p.value;
}
/// Each lane takes from the one before it, the first from the last of `before`.
inline Pack shifted(Pack before, Pack /*p*/) {
  return before;
}
/// p₀ q₀ p₁ q₁ …
inline void interleave(Pack p, Pack q, Pack* to) {
  to[0] = p;
  to[1] = q;
}
/// The way back.
inline void separate(const Pack* from, Pack& p, Pack& q) {
  p = from[0];
  q = from[1];
}
/// Two doubles in a row from a place of each lane.
inline Packs2 gather_points(const double* const* from) {
  return {from[0][0], from[0][1]};
}
/// The way back: a point to a place of each lane.
inline void scatter_points(Packs2 p, double* const* to) {
  to[0][0] = p.x.value;
  to[0][1] = p.y.value;
}
/// Four doubles in a row from a place of each lane, or what else has their size: to[i] gets
/// from[lane][skip + i].
inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
  std::memcpy(to, from[0] + skip, 4 * sizeof *to);
}
/// The way back: to[lane][i] gets from[i] of that lane.
inline void scatter_rows(const Pack* from, double* const* to) {
  for (int i = 0; i < 4; ++i) to[0][i] = from[i].value;
}
inline Pack operator+(Pack p, Pack q) {
  return p.value + q.value;
}
inline Pack operator-(Pack p, Pack q) {
  return p.value - q.value;
}
inline Pack operator*(Pack p, Pack q) {
  return p.value * q.value;
}
inline Pack operator/(Pack p, Pack q) {
  return p.value / q.value;
}
inline Pack operator-(Pack p) {
  return -p.value;
}
inline Pack sqrt(Pack p) {
  return std::sqrt(p.value);
}
inline Pack abs(Pack p) {
  return std::fabs(p.value);
}
inline Pack min(Pack p, Pack q) {
  return p.value < q.value ? p.value : q.value;
}
inline Pack max(Pack p, Pack q) {
  return p.value > q.value ? p.value : q.value;
}
inline Mask operator<(Pack p, Pack q) {
  return {p.value < q.value};
}
inline Mask operator<=(Pack p, Pack q) {
  return {p.value <= q.value};
}
inline Mask operator==(Pack p, Pack q) {
  return {p.value == q.value};
}
inline Mask operator&(Mask p, Mask q) {
  return {p.value && q.value};
}
inline Mask operator|(Mask p, Mask q) {
  return {p.value || q.value};
}
inline Mask operator!(Mask p) {
  return {!p.value};
}
inline Pack select(Mask m, Pack yes, Pack no) {
  return m.value ? yes : no;
}
/// Bit i says lane i.
inline unsigned bits(Mask m) {
  return m.value ? 1 : 0;
}
inline Mask mask_of(unsigned bits) {
  return {bits != 0};
}

}  // namespace scalar
}  // namespace talus::simd
