#pragma once

#include "model/model.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace talus {

/// A vector of each patch from one on, looked up by the number that the patch has among those of all bodies.
template <class Vector>
class PatchValuesOf {
 public:
  PatchValuesOf(std::span<Vector> values, std::uint32_t first) : values_(values.data()), first_(first) {}

  Vector& operator[](std::uint32_t patch) const { return values_[patch - first_]; }

 private:
  Vector* values_;
  std::uint32_t first_;
};
using PatchValues = PatchValuesOf<Vec2>;
using ConstPatchValues = PatchValuesOf<const Vec2>;

/// Σ w_i d_i (Eq. 11).
template <class Values>
Vec2 carried(const Carrier& carrier, const Values& patch_values) {
  Vec2 sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.x += carrier.weight[i] * patch_values[carrier.patch[i]].x;
    sum.y += carrier.weight[i] * patch_values[carrier.patch[i]].y;
  }
  return sum;
}

/// Displacement gradient of an element of many, or of its rate: Σ d_i ⊗ ∇w_i.
template <class Values>
Matrix2 gradient(const Element& element, const Values& patch_values) {
  Matrix2 h;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 d = patch_values[element.patch[i]], g = element.gradient[i];
    h.xx += d.x * g.x;
    h.xy += d.x * g.y;
    h.yx += d.y * g.x;
    h.yy += d.y * g.y;
  }
  return h;
}

}  // namespace talus
