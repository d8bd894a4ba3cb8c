#pragma once

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define TALUS_SIMD_LEVEL avx512
#include <talus/simd/avx512.hpp>
#elif defined(__AVX2__)
#define TALUS_SIMD_LEVEL avx2
#include <talus/simd/avx2.hpp>
#else
#define TALUS_SIMD_LEVEL scalar
#include <talus/simd/scalar.hpp>
#endif

#include <cstdint>
#include <cstring>

/// Doubles side by side, as many as the instruction set of the compilation holds: 8, 4 or 1. Every operation
/// is that of IEEE 754 in each lane, so a program gives the same bits at each level. The inline namespace
/// keeps code compiled for different levels apart within one program.
namespace talus::simd {
inline namespace TALUS_SIMD_LEVEL {

#if defined(__AVX2__)
/// The way back: to[lane][i] gets from[i] of that lane.
[[gnu::always_inline]] inline void scatter_rows(const Pack* from, double* const* to) {
  each_row(from, [&](int lane, __m256d row) { _mm256_storeu_pd(to[lane], row); });
}
#endif

inline Mask operator>(Pack p, Pack q) {
  return q < p;
}
inline Mask operator>=(Pack p, Pack q) {
  return q <= p;
}
inline bool any(Mask m) {
  return bits(m) != 0;
}
inline Mask nowhere() {
  return Pack(0.0) < Pack(0.0);
}
inline Pack only_where(Mask m, Pack p) {
  return select(m, p, 0.0);
}
inline Pack clamp(Pack p, Pack low, Pack high) {
  return min(max(p, low), high);
}

inline Packs2 operator+(Packs2 p, Packs2 q) {
  return {p.x + q.x, p.y + q.y};
}
inline Packs2 operator-(Packs2 p, Packs2 q) {
  return {p.x - q.x, p.y - q.y};
}
inline Packs2 operator-(Packs2 p) {
  return {-p.x, -p.y};
}
inline Packs2 operator*(Pack s, Packs2 p) {
  return {s * p.x, s * p.y};
}
inline Pack dot(Packs2 p, Packs2 q) {
  return p.x * q.x + p.y * q.y;
}
inline Pack cross(Packs2 p, Packs2 q) {
  return p.x * q.y - p.y * q.x;
}
inline Packs2 select(Mask m, Packs2 yes, Packs2 no) {
  return {select(m, yes.x, no.x), select(m, yes.y, no.y)};
}

}  // namespace TALUS_SIMD_LEVEL
}  // namespace talus::simd
