#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"
#include "plugin/registry.hpp"
#include "scene/scene.hpp"

#include <talus/material.hpp>

#include <optional>
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
  /// f_int (Eq. 18): adds −A P to the moments of the bodies' forces.
  Energy apply(const Model& model, MotionState& motion, double dt);

  /// Cauchy stress xx, yy, xy of a body, Pa; zero for a body that does not deform.
  std::array<double, 3> cauchy(std::size_t body) const;

 private:
  struct Batch {
    Made<Material> material;
    std::uint32_t begin, end;  ///< elements
    std::vector<double> state, next_state;
  };

  std::vector<Batch> batches_;
  std::vector<double> deformation_[4], previous_[4], stress_[4], energy_, dissipated_;
  std::vector<std::int64_t> element_of_;  ///< [body] or -1
};

}  // namespace talus
