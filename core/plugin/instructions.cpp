#include "plugin/instructions.hpp"

#include <talus/instructions.hpp>

#include <fmt/format.h>

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace talus {

#if defined(__x86_64__)
namespace {

enum Register { eax, ebx, ecx, edx };

/// A bit that CPUID reports, for sets whose names not every compiler knows. Whether the system keeps the
/// registers is told by avx and avx512f, without which none of these is in use.
bool reported(unsigned leaf, unsigned subleaf, Register in, unsigned bit) {
  unsigned values[4] = {};
  if (__get_cpuid_count(leaf, subleaf, &values[0], &values[1], &values[2], &values[3]) == 0) return false;
  return (values[in] >> bit & 1U) != 0;
}

}  // namespace
#endif

std::string instructions_lacking(std::uint64_t needed) {
  std::string lacking;
  const auto need = [&](InstructionSet set, const char* name, bool present) {
    if ((needed & bit_of(set)) == 0) return;
    needed &= ~bit_of(set);
    if (!present) lacking += (lacking.empty() ? "" : ", ") + std::string(name);
  };
#if defined(__x86_64__)
  __builtin_cpu_init();
  need(InstructionSet::sse3, "sse3", __builtin_cpu_supports("sse3") != 0);
  need(InstructionSet::ssse3, "ssse3", __builtin_cpu_supports("ssse3") != 0);
  need(InstructionSet::sse4_1, "sse4.1", __builtin_cpu_supports("sse4.1") != 0);
  need(InstructionSet::sse4_2, "sse4.2", __builtin_cpu_supports("sse4.2") != 0);
  need(InstructionSet::popcnt, "popcnt", __builtin_cpu_supports("popcnt") != 0);
  need(InstructionSet::movbe, "movbe", reported(1, 0, ecx, 22));
  need(InstructionSet::lzcnt, "lzcnt", reported(0x80000001, 0, ecx, 5));
  need(InstructionSet::bmi, "bmi", __builtin_cpu_supports("bmi") != 0);
  need(InstructionSet::bmi2, "bmi2", __builtin_cpu_supports("bmi2") != 0);
  need(InstructionSet::f16c, "f16c", reported(1, 0, ecx, 29));
  need(InstructionSet::fma, "fma", __builtin_cpu_supports("fma") != 0);
  need(InstructionSet::fma4, "fma4", __builtin_cpu_supports("fma4") != 0);
  need(InstructionSet::xop, "xop", __builtin_cpu_supports("xop") != 0);
  need(InstructionSet::avx, "avx", __builtin_cpu_supports("avx") != 0);
  need(InstructionSet::avx2, "avx2", __builtin_cpu_supports("avx2") != 0);
  need(InstructionSet::avxvnni, "avxvnni", reported(7, 1, eax, 4));
  need(InstructionSet::avx512f, "avx512f", __builtin_cpu_supports("avx512f") != 0);
  need(InstructionSet::avx512cd, "avx512cd", __builtin_cpu_supports("avx512cd") != 0);
  need(InstructionSet::avx512bw, "avx512bw", __builtin_cpu_supports("avx512bw") != 0);
  need(InstructionSet::avx512dq, "avx512dq", __builtin_cpu_supports("avx512dq") != 0);
  need(InstructionSet::avx512vl, "avx512vl", __builtin_cpu_supports("avx512vl") != 0);
  need(InstructionSet::avx512ifma, "avx512ifma", __builtin_cpu_supports("avx512ifma") != 0);
  need(InstructionSet::avx512vbmi, "avx512vbmi", __builtin_cpu_supports("avx512vbmi") != 0);
  need(InstructionSet::avx512vbmi2, "avx512vbmi2", __builtin_cpu_supports("avx512vbmi2") != 0);
  need(InstructionSet::avx512vnni, "avx512vnni", __builtin_cpu_supports("avx512vnni") != 0);
  need(InstructionSet::avx512bitalg, "avx512bitalg", __builtin_cpu_supports("avx512bitalg") != 0);
  need(InstructionSet::avx512vpopcntdq, "avx512vpopcntdq", __builtin_cpu_supports("avx512vpopcntdq") != 0);
  need(InstructionSet::avx512bf16, "avx512bf16", __builtin_cpu_supports("avx512bf16") != 0);
  need(InstructionSet::avx512fp16, "avx512fp16", reported(7, 0, edx, 23));
  need(InstructionSet::gfni, "gfni", __builtin_cpu_supports("gfni") != 0);
#endif
  if (needed != 0)
    lacking +=
        fmt::format("{}sets of bits {:#x}, unknown to this program", lacking.empty() ? "" : ", ", needed);
  return lacking;
}

}  // namespace talus
