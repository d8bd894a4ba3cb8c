#pragma once

#include "kernels/blocks.hpp"
#include "kernels/contacts.hpp"
#include "kernels/elements.hpp"
#include "plugin/simd_level.hpp"

namespace talus::kernels {

/// The loops compiled for a level, or for the best one below it that this program was built for.
const BlockKernels& block_kernels(SimdLevel level);
const ContactKernels& contact_kernels(SimdLevel level);
const ElementKernels& element_kernels(SimdLevel level);

}  // namespace talus::kernels
