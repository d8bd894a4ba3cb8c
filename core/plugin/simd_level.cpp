#include "plugin/simd_level.hpp"

#include <array>

namespace talus {
namespace {

constexpr std::array<std::string_view, 3> names{"scalar", "avx2", "avx512"};

}  // namespace

SimdLevel best_simd_level() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                  __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                  __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                  __builtin_cpu_supports("avx512vl") != 0;
  return v4 ? SimdLevel::avx512 : v3 ? SimdLevel::avx2 : SimdLevel::scalar;
#else
  return SimdLevel::scalar;
#endif
}

std::string_view name_of(SimdLevel level) {
  return names[static_cast<std::size_t>(level)];
}

std::optional<SimdLevel> simd_level_named(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) return static_cast<SimdLevel>(i);
  }
  return std::nullopt;
}

}  // namespace talus
