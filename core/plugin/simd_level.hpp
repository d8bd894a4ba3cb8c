#pragma once

#include <optional>
#include <string_view>

namespace talus {

/// Instruction sets that plugins are built for beside the baseline of the machine's kind (`scalar`).
enum class SimdLevel { scalar, avx2, avx512 };

/// The best level of this machine.
SimdLevel best_simd_level();

/// "scalar", "avx2", "avx512".
std::string_view name_of(SimdLevel level);
std::optional<SimdLevel> simd_level_named(std::string_view name);

}  // namespace talus
