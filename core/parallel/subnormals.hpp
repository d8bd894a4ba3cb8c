#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace talus {

/// While it lives, its thread takes numbers below 2.2e-308 for 0. Ahead of a wave in a large body, and where
/// motion dies away, they carry nothing, and cost a processor more than others. Every thread of a step does,
/// so that results do not depend on who computed what; where a processor has no such mode, they are kept.
class [[maybe_unused]] NoSubnormals {
 public:
#if defined(__x86_64__)
  NoSubnormals() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | results_are_zero | operands_are_zero);
  }
  ~NoSubnormals() {
    _mm_setcsr(before_);
  }
#else
  NoSubnormals() = default;
  ~NoSubnormals() = default;
#endif
  NoSubnormals(const NoSubnormals&) = delete;
  NoSubnormals& operator=(const NoSubnormals&) = delete;

#if defined(__x86_64__)
 private:
  static constexpr unsigned results_are_zero = 0x8000, operands_are_zero = 0x0040;  ///< bits of MXCSR
  unsigned before_;
#endif
};

}  // namespace talus
