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
/// The first `count`, 3 or 4, of each row, turned: to[lane][(start[lane] + i) % count] gets from[i] of that
/// lane.
template <int count>
[[gnu::always_inline]] inline void scatter_turned_rows(const Pack* from, const Numbers& start,
                                                       double* const* to) {
  alignas(32) static constexpr std::int32_t halves[2][4][8] = {
      {{0, 1, 2, 3, 4, 5}, {4, 5, 0, 1, 2, 3}, {2, 3, 4, 5, 0, 1}, {}},
      {{0, 1, 2, 3, 4, 5, 6, 7},
       {6, 7, 0, 1, 2, 3, 4, 5},
       {4, 5, 6, 7, 0, 1, 2, 3},
       {2, 3, 4, 5, 6, 7, 0, 1}}};
  each_row(from, [&](int lane, __m256d row) {
    const std::int32_t* turn = halves[count - 3][start[lane]];
    const __m256d turned = _mm256_castps_pd(_mm256_permutevar8x32_ps(
        _mm256_castpd_ps(row), _mm256_load_si256(reinterpret_cast<const __m256i*>(turn))));
    if constexpr (count == 4) {
      _mm256_storeu_pd(to[lane], turned);
    } else {
      _mm_storeu_pd(to[lane], _mm256_castpd256_pd128(turned));
      _mm_store_sd(to[lane] + 2, _mm256_extractf128_pd(turned, 1));
    }
  });
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
