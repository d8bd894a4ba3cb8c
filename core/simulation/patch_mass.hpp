#pragma once

#include "model/model.hpp"
#include "model/patch_values.hpp"

#include <span>
#include <vector>

namespace talus {

/// The mass of bodies of many elements: row sums of Eq. 17 on the diagonal; patches that are tied to others
/// have none of their own; those with added inertia I bring I r rᵀ, r the deviation from the affine
/// continuation. The inverse of the sum is D⁻¹ − D⁻¹R (I⁻¹ + RᵀD⁻¹R)⁻¹ RᵀD⁻¹ (Woodbury), of the size of the
/// number of such patches.
class PatchMass {
 public:
  explicit PatchMass(const Model& model);

  /// Turns the forces on the patches of a body, from `first` on, into accelerations, in place. `first` is not
  /// beyond Body::free_end, from which on they have to do with slivers.
  void accelerations(const Model& model, std::uint32_t body, std::uint32_t first, PatchValues patches) const;
  void accelerations(const Model& model, std::uint32_t body, PatchValues patches) const {
    accelerations(model, body, model.ranges(model.bodies[body]).patch_begin, patches);
  }

  /// Tied patches take over the values of those they follow.
  static void tie(const Model& model, std::uint32_t body, PatchValues patches);

  /// pᵀ M q of two velocity fields on the patches of a body, J/m twice over. They hold that body's patches
  /// alone, from `first` on, which is not beyond Body::free_end.
  double product(const Model& model, std::uint32_t body, std::uint32_t first, std::span<const Vec2> p,
                 std::span<const Vec2> q) const;
  double product(const Model& model, std::uint32_t body, std::span<const Vec2> p,
                 std::span<const Vec2> q) const {
    return product(model, body, model.ranges(model.bodies[body]).patch_begin, p, q);
  }

  const std::vector<double>& inverse() const { return inverse_; }

 private:
  /// (I⁻¹ + RᵀD⁻¹R)⁻¹ of a body, row by row; empty for most.
  std::span<const double> core_inverse(std::size_t body) const {
    if (core_inverse_.empty()) return {};
    return core_inverse_[body];
  }

  std::vector<double> inverse_;                    ///< [patch] 1/m; 0 where there is none
  std::vector<std::vector<double>> core_inverse_;  ///< [body]; empty where no patch is steadied
};

}  // namespace talus
