#pragma once

#include "kernels/level.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "simulation/material_batches.hpp"

#include <vector>

namespace talus {

/// What a pass over subdomains does besides forces.
struct SweepStep {
  double dt = 0;      ///< s, t_n − t_{n−1}
  bool keep = false;  ///< velocity at t_n, for output, stress of materials with a memory, and `inside_out`

  /// The velocity update of free patches, where nothing has to be known of the whole body first.
  bool update = false;
  kernels::VelocityUpdate velocity{};
  const double* inverse_mass = nullptr;  ///< [patch] m/kg
  double share = 0;                      ///< of v₊ in the velocity at t_n
  Vec2* middle = nullptr;                ///< [patch] takes that velocity, where it is kept
};

/// Energies of the elements, J/m, and sums over the own patches where they were updated.
struct SweepSums {
  double stored = 0, dissipated = 0;
  bool inside_out = false;  ///< an element is, seen where SweepStep::keep
  kernels::VelocitySums own{};
};

/// Forces of the elements of bodies of many elements (Eq. 18), subdomain by subdomain: own patches catch up
/// with the move that the step began, elements strain, stresses become forces, and own patches may go on to
/// their next velocity. What stays in memory between steps is displacement and velocity of the patches, and
/// what the material asks for.
class ElementSweep {
 public:
  ElementSweep(const Model& model, SimdLevel level);

  /// What one thread needs.
  struct Workspace {
    std::vector<double> displacement, force;  ///< [2 · patch of the subdomain, and some] m, N/m
    ElementBuffer elements;
  };
  Workspace workspace() const;

  /// Subdomains [begin, end) of a body; results go to `sums` [subdomain]. Any division into ranges gives the
  /// same bits; ranges may be worked on at once, each with a workspace of its own.
  void run(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
           const SweepStep& step, MaterialBatches& materials, MotionState& motion, Workspace& workspace,
           std::vector<SweepSums>& sums);

  /// Adds what subdomains left for common patches [begin, end) of a body, from its first.
  void gather(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
              MotionState& motion) const;
  /// The velocity update of these, when all forces on them are there. Adds to `sums`.
  void update_common(const Model& model, const Body& body, std::uint32_t begin, std::uint32_t end,
                     const SweepStep& step, MotionState& motion, kernels::VelocitySums& sums) const;

 private:
  const kernels::ElementKernels& kernels_;
  std::vector<Vec2> slot_;  ///< [slot] N/m
  std::size_t most_patches_ = 0;
};

}  // namespace talus
