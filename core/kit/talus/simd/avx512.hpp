#pragma once

// Packs of eight doubles. Included by pack.hpp alone.

#include <immintrin.h>

#include <cmath>
#include <cstdint>

namespace talus::simd {
inline namespace avx512 {

inline constexpr int lanes = 8;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(32)]] = std::uint32_t;

struct Mask {
  __mmask8 bits;
};
struct Pack {
  __m512d value;
  Pack() = default;
  Pack(__m512d v) : value(v) {}
  Pack(double v) : value(_mm512_set1_pd(v)) {}
};
/// A point or vector in each lane.
struct Packs2 {
  Pack x, y;
};

/// As many bytes, widened.
inline Numbers numbers(const std::uint8_t* from) {
  return (Numbers)_mm256_cvtepu8_epi32(_mm_loadu_si64(from));
}
/// Of numbers below 2³¹.
inline Pack doubles(Numbers n) {
  return _mm512_maskz_cvtepu32_pd(0xFF, (__m256i)n);
}
/// The numbers that are the bits of floats.
inline Pack floats(Numbers n) {
  return _mm512_maskz_cvtps_pd(0xFF, _mm256_castsi256_ps((__m256i)n));
}
/// The two numbers in each lane, of which lower bits come first.
inline void split(Pack p, Numbers& low, Numbers& high) {
  const __m512i both = _mm512_castpd_si512(p.value);
  low = (Numbers)_mm512_maskz_cvtepi64_epi32(0xFF, both);
  high = (Numbers)_mm512_maskz_cvtepi64_epi32(0xFF, _mm512_maskz_srli_epi64(0xFF, both, 32));
}
inline Pack load(const double* from) {
  return _mm512_loadu_pd(from);
}
inline Pack load(const float* from) {
  return _mm512_maskz_cvtps_pd(0xFF, _mm256_loadu_ps(from));
}
inline void store(Pack p, double* to) {
  _mm512_storeu_pd(to, p.value);
}
/// The first `count` of a row, at most all; the other lanes are 0, and nothing beyond is read.
inline Pack load_first(const double* from, unsigned count) {
  return _mm512_maskz_loadu_pd(static_cast<__mmask8>((1u << count) - 1), from);
}
inline void store_first(Pack p, double* to, unsigned count) {
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>((1u << count) - 1), p.value);
}
/// Each lane takes from the one before it, the first from the last of `before`.
inline Pack shifted(Pack before, Pack p) {
  return _mm512_castsi512_pd(
      _mm512_maskz_alignr_epi64(0xFF, _mm512_castpd_si512(p.value), _mm512_castpd_si512(before.value), 7));
}
/// p₀ q₀ p₁ q₁ …
inline void interleave(Pack p, Pack q, Pack* to) {
  const __m512i low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11),
                high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
  to[0] = _mm512_permutex2var_pd(p.value, low, q.value);
  to[1] = _mm512_permutex2var_pd(p.value, high, q.value);
}
/// The way back.
inline void separate(const Pack* from, Pack& p, Pack& q) {
  const __m512i even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14),
                odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
  p = _mm512_permutex2var_pd(from[0].value, even, from[1].value);
  q = _mm512_permutex2var_pd(from[0].value, odd, from[1].value);
}
/// Two doubles in a row from a place of each lane.
[[gnu::always_inline]] inline Packs2 gather_points(const double* const* from) {
  const auto four = [&](int lane) {  // of this lane and each second one after it
    const __m256d low = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from[lane])),
                                             _mm_loadu_pd(from[lane + 2]), 1),
                  high = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from[lane + 4])),
                                              _mm_loadu_pd(from[lane + 6]), 1);
    return _mm512_maskz_insertf64x4(0xFF, _mm512_castpd256_pd512(low), high, 1);
  };
  const __m512d even = four(0), odd = four(1);
  return {_mm512_maskz_unpacklo_pd(0xFF, even, odd), _mm512_maskz_unpackhi_pd(0xFF, even, odd)};
}
/// The way back: a point to a place of each lane.
[[gnu::always_inline]] inline void scatter_points(Packs2 p, double* const* to) {
  const auto put = [&](int lane, __m512d four) {  // of this lane and each second one after it
    _mm_storeu_pd(to[lane], _mm512_maskz_extractf64x2_pd(0xFF, four, 0));
    _mm_storeu_pd(to[lane + 2], _mm512_maskz_extractf64x2_pd(0xFF, four, 1));
    _mm_storeu_pd(to[lane + 4], _mm512_maskz_extractf64x2_pd(0xFF, four, 2));
    _mm_storeu_pd(to[lane + 6], _mm512_maskz_extractf64x2_pd(0xFF, four, 3));
  };
  put(0, _mm512_maskz_unpacklo_pd(0xFF, p.x.value, p.y.value));
  put(1, _mm512_maskz_unpackhi_pd(0xFF, p.x.value, p.y.value));
}
/// Four doubles in a row from a place of each lane: to[i] gets from[lane][skip + i].
[[gnu::always_inline]] inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
  const auto two = [&](int lane) {  // of this lane and the one four further on
    return _mm512_maskz_insertf64x4(0xFF, _mm512_castpd256_pd512(_mm256_loadu_pd(from[lane] + skip)),
                                    _mm256_loadu_pd(from[lane + 4] + skip), 1);
  };
  const __m512d p = two(0), q = two(1), r = two(2), s = two(3);
  const __m512d even = _mm512_maskz_unpacklo_pd(0xFF, p, q), odd = _mm512_maskz_unpackhi_pd(0xFF, p, q);
  const __m512d more_even = _mm512_maskz_unpacklo_pd(0xFF, r, s),
                more_odd = _mm512_maskz_unpackhi_pd(0xFF, r, s);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  to[0] = _mm512_permutex2var_pd(even, low, more_even);
  to[1] = _mm512_permutex2var_pd(odd, low, more_odd);
  to[2] = _mm512_permutex2var_pd(even, high, more_even);
  to[3] = _mm512_permutex2var_pd(odd, high, more_odd);
}
/// Calls visit(lane, from[0…3] of that lane).
template <class Visit>
[[gnu::always_inline]] inline void each_row(const Pack* from, const Visit& visit) {
  const __m512d even = _mm512_maskz_unpacklo_pd(0xFF, from[0].value, from[1].value),
                odd = _mm512_maskz_unpackhi_pd(0xFF, from[0].value, from[1].value),
                more_even = _mm512_maskz_unpacklo_pd(0xFF, from[2].value, from[3].value),
                more_odd = _mm512_maskz_unpackhi_pd(0xFF, from[2].value, from[3].value);
  const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  const auto two = [&](int lane, __m512d rows) {  // of this lane and the one four further on
    visit(lane, _mm512_maskz_extractf64x4_pd(0xFF, rows, 0));
    visit(lane + 4, _mm512_maskz_extractf64x4_pd(0xFF, rows, 1));
  };
  two(0, _mm512_permutex2var_pd(even, low, more_even));
  two(1, _mm512_permutex2var_pd(odd, low, more_odd));
  two(2, _mm512_permutex2var_pd(even, high, more_even));
  two(3, _mm512_permutex2var_pd(odd, high, more_odd));
}
inline Pack operator+(Pack p, Pack q) {
  return _mm512_add_pd(p.value, q.value);
}
inline Pack operator-(Pack p, Pack q) {
  return _mm512_sub_pd(p.value, q.value);
}
inline Pack operator*(Pack p, Pack q) {
  return _mm512_mul_pd(p.value, q.value);
}
inline Pack operator/(Pack p, Pack q) {
  return _mm512_div_pd(p.value, q.value);
}
inline Pack operator-(Pack p) {
  return _mm512_xor_pd(p.value, _mm512_set1_pd(-0.0));
}
inline Pack sqrt(Pack p) {
  return _mm512_maskz_sqrt_pd(0xFF, p.value);
}
inline Pack abs(Pack p) {
  return _mm512_abs_pd(p.value);
}
inline Pack min(Pack p, Pack q) {
  return _mm512_maskz_min_pd(0xFF, p.value, q.value);
}
inline Pack max(Pack p, Pack q) {
  return _mm512_maskz_max_pd(0xFF, p.value, q.value);
}
inline Mask operator<(Pack p, Pack q) {
  return {_mm512_cmp_pd_mask(p.value, q.value, _CMP_LT_OQ)};
}
inline Mask operator<=(Pack p, Pack q) {
  return {_mm512_cmp_pd_mask(p.value, q.value, _CMP_LE_OQ)};
}
inline Mask operator==(Pack p, Pack q) {
  return {_mm512_cmp_pd_mask(p.value, q.value, _CMP_EQ_OQ)};
}
inline Mask operator&(Mask p, Mask q) {
  return {static_cast<__mmask8>(p.bits & q.bits)};
}
inline Mask operator|(Mask p, Mask q) {
  return {static_cast<__mmask8>(p.bits | q.bits)};
}
inline Mask operator!(Mask p) {
  return {static_cast<__mmask8>(~p.bits)};
}
inline Pack select(Mask m, Pack yes, Pack no) {
  return _mm512_mask_blend_pd(m.bits, no.value, yes.value);
}
/// Bit i says lane i.
inline unsigned bits(Mask m) {
  return m.bits;
}
inline Mask mask_of(unsigned bits) {
  return {static_cast<__mmask8>(bits)};
}

}  // namespace avx512
}  // namespace talus::simd
