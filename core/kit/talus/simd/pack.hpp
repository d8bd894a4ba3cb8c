#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#include <immintrin.h>
#define TALUS_SIMD_LEVEL avx512
#elif defined(__AVX2__)
#include <immintrin.h>
#define TALUS_SIMD_LEVEL avx2
#else
#define TALUS_SIMD_LEVEL scalar
#endif

/// Doubles side by side, as many as the instruction set of the compilation holds: 8, 4 or 1. Every operation
/// is that of IEEE 754 in each lane, so a program gives the same bits at each level. The inline namespace
/// keeps code compiled for different levels apart within one program.
namespace talus::simd {
inline namespace TALUS_SIMD_LEVEL {

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)

inline constexpr int lanes = 8;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(64)]] = std::uint64_t;

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

inline Pack load(const double* from) {
  return _mm512_loadu_pd(from);
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
inline Packs2 gather_points(const double* const* from) {
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
/// Four doubles in a row from a place of each lane: to[i] gets from[lane][skip + i].
inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
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
inline void each_row(const Pack* from, const Visit& visit) {
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
inline Mask nonzero(const Numbers& n) {
  return {_mm512_test_epi64_mask(reinterpret_cast<const __m512i&>(n), reinterpret_cast<const __m512i&>(n))};
}

#elif defined(__AVX2__)

inline constexpr int lanes = 4;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(32)]] = std::uint64_t;

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

inline Pack load(const double* from) {
  return _mm256_loadu_pd(from);
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
inline Packs2 gather_points(const double* const* from) {
  const auto two = [&](int lane) {  // of this lane and the second after it
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(from[lane])),
                                _mm_loadu_pd(from[lane + 2]), 1);
  };
  const __m256d even = two(0), odd = two(1);
  return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
}
/// Four doubles in a row from a place of each lane: to[i] gets from[lane][skip + i].
inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
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
inline void each_row(const Pack* from, const Visit& visit) {
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
inline Mask nonzero(const Numbers& n) {
  return {reinterpret_cast<__m256d>(n != 0)};
}
inline Mask mask_of(unsigned bits) {
  const __m256i bit = _mm256_setr_epi64x(1, 2, 4, 8);
  return {_mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(_mm256_set1_epi64x(bits), bit), bit))};
}

#else

inline constexpr int lanes = 1;
/// An unsigned number in each lane, with the operators of numbers.
using Numbers [[gnu::vector_size(8)]] = std::uint64_t;

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

inline Pack load(const double* from) {
  return *from;
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
/// Four doubles in a row from a place of each lane: to[i] gets from[lane][skip + i].
inline void gather_rows(const double* const* from, Pack* to, int skip = 0) {
  for (int i = 0; i < 4; ++i) to[i] = from[0][skip + i];
}
/// The way back: to[lane][i] gets from[i] of that lane.
inline void scatter_rows(const Pack* from, double* const* to) {
  for (int i = 0; i < 4; ++i) to[0][i] = from[i].value;
}
/// The first `count`, 3 or 4, of each row, turned: to[lane][(start[lane] + i) % count] gets from[i] of that
/// lane.
template <int count>
inline void scatter_turned_rows(const Pack* from, const Numbers& start, double* const* to) {
  for (unsigned i = 0; i < count; ++i) to[0][(start[0] + i) % count] = from[i].value;
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
inline Mask nonzero(const Numbers& n) {
  return {n[0] != 0};
}

#endif

#if defined(__AVX2__)
/// The way back: to[lane][i] gets from[i] of that lane.
inline void scatter_rows(const Pack* from, double* const* to) {
  each_row(from, [&](int lane, __m256d row) { _mm256_storeu_pd(to[lane], row); });
}
/// The first `count`, 3 or 4, of each row, turned: to[lane][(start[lane] + i) % count] gets from[i] of that
/// lane.
template <int count>
inline void scatter_turned_rows(const Pack* from, const Numbers& start, double* const* to) {
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

/// Numbers below 2⁵² as doubles.
inline Pack as_pack(const Numbers& n) {
  constexpr double unit = 0x1p52;  // in doubles from there on the last bit counts one
  std::uint64_t bits_of_unit;
  std::memcpy(&bits_of_unit, &unit, sizeof unit);
  const Numbers bits = n | bits_of_unit;
  Pack shifted_up;
  std::memcpy(&shifted_up, &bits, sizeof bits);
  return shifted_up - unit;
}

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
