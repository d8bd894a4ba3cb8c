#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"
#include "plugin/registry.hpp"
#include "scene/scene.hpp"

#include <talus/material.hpp>

#include <array>
#include <vector>

namespace talus {

/// Stress of the elements: one batch per material. Empty, and free of cost, where nothing deforms.
class Deformation {
 public:
  Deformation(const Scene& scene, const Model& model);

  struct Energy {
    double stored = 0;      ///< J/m
    double dissipated = 0;  ///< J/m since t_{n-1}
  };
  /// f_int (Eq. 18): adds −A P ∇w to the forces of the patches, −A P to the moments of affine blocks.
  Energy apply(const Model& model, MotionState& motion, double dt);

  /// Cauchy stress xx, yy, xy, Pa, of an element.
  std::array<double, 3> cauchy_of_element(std::size_t element) const;
  /// Mean over the area of a body; zero for a body that does not deform.
  std::array<double, 3> cauchy(const Model& model, std::size_t body) const;

  /// What a material remembers: deformation at t_n and its own state, to go on from elsewhere.
  std::vector<double> memory() const;
  void set_memory(const std::vector<double>& memory);

 private:
  struct Batch {
    Made<Material> material;
    std::uint32_t begin, end;  ///< elements
    std::vector<double> state, next_state;
  };

  std::vector<Batch> batches_;
  std::vector<double> deformation_[4], previous_[4], stress_[4], energy_, dissipated_;
};

}  // namespace talus
