#pragma once

#include <cstdint>

namespace talus {

/// Instruction sets beyond the baseline of x86-64 that compilers use of their own accord where they are
/// allowed to (-march=…). The bits of `Library::instructions`.
enum class InstructionSet : std::uint32_t {
  sse3,
  ssse3,
  sse4_1,
  sse4_2,
  popcnt,
  movbe,
  lzcnt,
  bmi,
  bmi2,
  f16c,
  fma,
  fma4,
  xop,
  avx,
  avx2,
  avxvnni,
  avx512f,
  avx512cd,
  avx512bw,
  avx512dq,
  avx512vl,
  avx512ifma,
  avx512vbmi,
  avx512vbmi2,
  avx512vnni,
  avx512bitalg,
  avx512vpopcntdq,
  avx512bf16,
  avx512fp16,
  gfni
};

constexpr std::uint64_t bit_of(InstructionSet set) {
  return std::uint64_t{1} << static_cast<std::uint32_t>(set);
}

/// What the compiler may use where this is included, as its flags say.
constexpr std::uint64_t instructions_in_use() {
  std::uint64_t sets = 0;
#ifdef __SSE3__
  sets |= bit_of(InstructionSet::sse3);
#endif
#ifdef __SSSE3__
  sets |= bit_of(InstructionSet::ssse3);
#endif
#ifdef __SSE4_1__
  sets |= bit_of(InstructionSet::sse4_1);
#endif
#ifdef __SSE4_2__
  sets |= bit_of(InstructionSet::sse4_2);
#endif
#ifdef __POPCNT__
  sets |= bit_of(InstructionSet::popcnt);
#endif
#ifdef __MOVBE__
  sets |= bit_of(InstructionSet::movbe);
#endif
#ifdef __LZCNT__
  sets |= bit_of(InstructionSet::lzcnt);
#endif
#ifdef __BMI__
  sets |= bit_of(InstructionSet::bmi);
#endif
#ifdef __BMI2__
  sets |= bit_of(InstructionSet::bmi2);
#endif
#ifdef __F16C__
  sets |= bit_of(InstructionSet::f16c);
#endif
#ifdef __FMA__
  sets |= bit_of(InstructionSet::fma);
#endif
#ifdef __FMA4__
  sets |= bit_of(InstructionSet::fma4);
#endif
#ifdef __XOP__
  sets |= bit_of(InstructionSet::xop);
#endif
#ifdef __AVX__
  sets |= bit_of(InstructionSet::avx);
#endif
#ifdef __AVX2__
  sets |= bit_of(InstructionSet::avx2);
#endif
#ifdef __AVXVNNI__
  sets |= bit_of(InstructionSet::avxvnni);
#endif
#ifdef __AVX512F__
  sets |= bit_of(InstructionSet::avx512f);
#endif
#ifdef __AVX512CD__
  sets |= bit_of(InstructionSet::avx512cd);
#endif
#ifdef __AVX512BW__
  sets |= bit_of(InstructionSet::avx512bw);
#endif
#ifdef __AVX512DQ__
  sets |= bit_of(InstructionSet::avx512dq);
#endif
#ifdef __AVX512VL__
  sets |= bit_of(InstructionSet::avx512vl);
#endif
#ifdef __AVX512IFMA__
  sets |= bit_of(InstructionSet::avx512ifma);
#endif
#ifdef __AVX512VBMI__
  sets |= bit_of(InstructionSet::avx512vbmi);
#endif
#ifdef __AVX512VBMI2__
  sets |= bit_of(InstructionSet::avx512vbmi2);
#endif
#ifdef __AVX512VNNI__
  sets |= bit_of(InstructionSet::avx512vnni);
#endif
#ifdef __AVX512BITALG__
  sets |= bit_of(InstructionSet::avx512bitalg);
#endif
#ifdef __AVX512VPOPCNTDQ__
  sets |= bit_of(InstructionSet::avx512vpopcntdq);
#endif
#ifdef __AVX512BF16__
  sets |= bit_of(InstructionSet::avx512bf16);
#endif
#ifdef __AVX512FP16__
  sets |= bit_of(InstructionSet::avx512fp16);
#endif
#ifdef __GFNI__
  sets |= bit_of(InstructionSet::gfni);
#endif
  return sets;
}

}  // namespace talus
