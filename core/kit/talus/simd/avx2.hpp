#pragma once

// Packs of four doubles. Included by pack.hpp alone.

#include <immintrin.h>

#include <cmath>
#include <cstdint>

namespace talus::simd {
inline namespace avx2 {

inline constexpr int lanes = 4;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(16)]] = std::uint32_t;

struct Mask {
  __m256d value;
};
struct Pack {
  __m256d value;
  Pack() = default;
  Pack(__m256d v) : value(v) {}
  Pack(double v) : value(_mm256_set1_pd(v)) {}
};
/// A point or vector in each lane.
struct Packs2 {
  Pack x, y;
};

/// As many bytes, widened.
inline Numbers numbers(const std::uint8_t* from) {
  return (Numbers)_mm_cvtepu8_epi32(_mm_loadu_si32(from));
}
/// Of numbers below 2³¹.
inline Pack doubles(Numbers n) {
  return _mm256_cvtepi32_pd((__m128i)n);
}
/// The numbers that are the bits of floats.
inline Pack floats(Numbers n) {
  return _mm256_cvtps_pd(_mm_castsi128_ps((__m128i)n));
}
/// The two numbers in each lane, of which lower bits come first.
inline void split(Pack p, Numbers& low, Numbers& high) {
  const __m256i apart =
      _mm256_permutevar8x32_epi32(_mm256_castpd_si256(p.value), _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
  low = (Numbers)_mm256_castsi256_si128(apart);
  high = (Numbers)_mm256_extracti128_si256(apart, 1);
}
inline Pack load(const double* from) {
  return _mm256_loadu_pd(from);
}
inline Pack load(const float* from) {
  return _mm256_cvtps_pd(_mm_loadu_ps(from));
}
inline void store(Pack p, double* to) {
  _mm256_storeu_pd(to, p.value);
}
inline __m256i first_lanes(unsigned count) {
  return _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_setr_epi64x(0, 1, 2, 3));
}
/// The first `count` of a row, at most all; the other lanes are 0, and nothing beyond is read.
inline Pack load_first(const double* from, unsigned count) {
  return _mm256_maskload_pd(from, first_lanes(count));
}
inline void store_first(Pack p, double* to, unsigned count) {
  _mm256_maskstore_pd(to, first_lanes(count), p.value);
}
/// Each lane takes from the one before it, the first from the last of `before`.
inline Pack shifted(Pack before, Pack p) {
  return _mm256_shuffle_pd(_mm256_permute2f128_pd(before.value, p.value, 0x21), p.value, 0x5);
}
/// p₀ q₀ p₁ q₁ …
inline void interleave(Pack p, Pack q, Pack* to) {
  const __m256d even = _mm256_unpacklo_pd(p.value, q.value), odd = _mm256_unpackhi_pd(p.value, q.value);
  to[0] = _mm256_permute2f128_pd(even, odd, 0x20);
  to[1] = _mm256_permute2f128_pd(even, odd, 0x31);
}
/// The way back.
inline void separate(const Pack* from, Pack& p, Pack& q) {
  const __m256d low = _mm256_permute2f128_pd(from[0].value, from[1].value, 0x20),
                high = _mm256_permute2f128_pd(from[0].value, from[1].value, 0x31);
  p = _mm256_unpacklo_pd(low, high);
  q = _mm256_unpackhi_pd(low, high);
}
/// Two doubles in a row from a place of each lane.
[[gnu::always_inline]] inline Packs2 gather_points(const double* const* from) {
  const auto two = [&](int lane) {  // of this lane and the second after it
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from[lane])),
                                _mm_loadu_pd(from[lane + 2]), 1);
  };
  const __m256d even = two(0), odd = two(1);
  return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
}
/// The way back: a point to a place of each lane.
[[gnu::always_inline]] inline void scatter_points(Packs2 p, double* const* to) {
  const auto put = [&](int lane, __m256d two) {  // of this lane and the second after it
    _mm_storeu_pd(to[lane], _mm256_castpd256_pd128(two));
    _mm_storeu_pd(to[lane + 2], _mm256_extractf128_pd(two, 1));
  };
  put(0, _mm256_unpacklo_pd(p.x.value, p.y.value));
  put(1, _mm256_unpackhi_pd(p.x.value, p.y.value));
}
/// Four doubles in a row from a place of each lane: to[i] gets from[lane][skip + i].
[[gnu::always_inline]] inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
  const __m256d p = _mm256_loadu_pd(from[0] + skip), q = _mm256_loadu_pd(from[1] + skip),
                r = _mm256_loadu_pd(from[2] + skip), s = _mm256_loadu_pd(from[3] + skip);
  const __m256d even = _mm256_unpacklo_pd(p, q), odd = _mm256_unpackhi_pd(p, q);
  const __m256d more_even = _mm256_unpacklo_pd(r, s), more_odd = _mm256_unpackhi_pd(r, s);
  to[0] = _mm256_permute2f128_pd(even, more_even, 0x20);
  to[1] = _mm256_permute2f128_pd(odd, more_odd, 0x20);
  to[2] = _mm256_permute2f128_pd(even, more_even, 0x31);
  to[3] = _mm256_permute2f128_pd(odd, more_odd, 0x31);
}
/// Calls visit(lane, from[0…3] of that lane).
template <class Visit>
[[gnu::always_inline]] inline void each_row(const Pack* from, const Visit& visit) {
  const __m256d even = _mm256_unpacklo_pd(from[0].value, from[1].value),
                odd = _mm256_unpackhi_pd(from[0].value, from[1].value),
                more_even = _mm256_unpacklo_pd(from[2].value, from[3].value),
                more_odd = _mm256_unpackhi_pd(from[2].value, from[3].value);
  visit(0, _mm256_permute2f128_pd(even, more_even, 0x20));
  visit(1, _mm256_permute2f128_pd(odd, more_odd, 0x20));
  visit(2, _mm256_permute2f128_pd(even, more_even, 0x31));
  visit(3, _mm256_permute2f128_pd(odd, more_odd, 0x31));
}
inline Pack operator+(Pack p, Pack q) {
  return _mm256_add_pd(p.value, q.value);
}
inline Pack operator-(Pack p, Pack q) {
  return _mm256_sub_pd(p.value, q.value);
}
inline Pack operator*(Pack p, Pack q) {
  return _mm256_mul_pd(p.value, q.value);
}
inline Pack operator/(Pack p, Pack q) {
  return _mm256_div_pd(p.value, q.value);
}
inline Pack operator-(Pack p) {
  return _mm256_xor_pd(p.value, _mm256_set1_pd(-0.0));
}
inline Pack sqrt(Pack p) {
  return _mm256_sqrt_pd(p.value);
}
inline Pack abs(Pack p) {
  return _mm256_andnot_pd(_mm256_set1_pd(-0.0), p.value);
}
inline Pack min(Pack p, Pack q) {
  return _mm256_min_pd(p.value, q.value);
}
inline Pack max(Pack p, Pack q) {
  return _mm256_max_pd(p.value, q.value);
}
inline Mask operator<(Pack p, Pack q) {
  return {_mm256_cmp_pd(p.value, q.value, _CMP_LT_OQ)};
}
inline Mask operator<=(Pack p, Pack q) {
  return {_mm256_cmp_pd(p.value, q.value, _CMP_LE_OQ)};
}
inline Mask operator==(Pack p, Pack q) {
  return {_mm256_cmp_pd(p.value, q.value, _CMP_EQ_OQ)};
}
inline Mask operator&(Mask p, Mask q) {
  return {_mm256_and_pd(p.value, q.value)};
}
inline Mask operator|(Mask p, Mask q) {
  return {_mm256_or_pd(p.value, q.value)};
}
inline Mask operator!(Mask p) {
  return {_mm256_xor_pd(p.value, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)))};
}
inline Pack select(Mask m, Pack yes, Pack no) {
  return _mm256_blendv_pd(no.value, yes.value, m.value);
}
/// Bit i says lane i.
inline unsigned bits(Mask m) {
  return static_cast<unsigned>(_mm256_movemask_pd(m.value));
}
inline Mask mask_of(unsigned bits) {
  const __m256i bit = _mm256_setr_epi64x(1, 2, 4, 8);
  return {_mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(bits), bit), bit))};
}

}  // namespace avx2
}  // namespace talus::simd
