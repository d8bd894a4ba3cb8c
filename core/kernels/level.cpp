#include "kernels/level.hpp"

namespace talus::kernels {

namespace scalar {
extern const BlockKernels block_kernels;
extern const ContactKernels contact_kernels;
extern const ElementKernels element_kernels;
}  // namespace scalar
#ifdef TALUS_KERNEL_LEVELS
namespace avx2 {
extern const BlockKernels block_kernels;
extern const ContactKernels contact_kernels;
extern const ElementKernels element_kernels;
}  // namespace avx2
namespace avx512 {
extern const BlockKernels block_kernels;
extern const ContactKernels contact_kernels;
extern const ElementKernels element_kernels;
}  // namespace avx512
#else
namespace avx2 = scalar;
namespace avx512 = scalar;
#endif

namespace {

template <class Kernels>
const Kernels& pick(SimdLevel level, const Kernels& scalar, const Kernels& avx2, const Kernels& avx512) {
  if (level == SimdLevel::avx512) return avx512;
  return level == SimdLevel::avx2 ? avx2 : scalar;
}

}  // namespace

const BlockKernels& block_kernels(SimdLevel level) {
  return pick(level, scalar::block_kernels, avx2::block_kernels, avx512::block_kernels);
}

const ContactKernels& contact_kernels(SimdLevel level) {
  return pick(level, scalar::contact_kernels, avx2::contact_kernels, avx512::contact_kernels);
}

const ElementKernels& element_kernels(SimdLevel level) {
  return pick(level, scalar::element_kernels, avx2::element_kernels, avx512::element_kernels);
}

void SpeedExtremes::add(const SpeedExtremes& other) {
  if (!other.any) return;
  if (!any) {
    *this = other;
    return;
  }
  squared = squared > other.squared ? squared : other.squared;
  sum += other.sum;
  stray_squared = stray_squared > other.stray_squared ? stray_squared : other.stray_squared;
  low_x = low_x < other.low_x ? low_x : other.low_x;
  high_x = high_x > other.high_x ? high_x : other.high_x;
  low_y = low_y < other.low_y ? low_y : other.low_y;
  high_y = high_y > other.high_y ? high_y : other.high_y;
}

}  // namespace talus::kernels
