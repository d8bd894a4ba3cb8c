#pragma once

#include <cstring>

namespace talus::kernels::TALUS_KERNEL_LEVEL {

/// Four doubles that the compiler keeps side by side where the instruction set can, with the operators of
/// numbers. By reference, since how it is passed depends on the instruction set.
using Quad [[gnu::vector_size(32)]] = double;

using Pair [[gnu::vector_size(16)]] = double;
using Floats [[gnu::vector_size(32)]] = float;

template <class Number, class Vector>
inline void load(const Number* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
template <class Vector>
inline void store(const Vector& from, double* to) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace talus::kernels::TALUS_KERNEL_LEVEL
