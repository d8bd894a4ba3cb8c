#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"
#include "parallel/workers.hpp"
#include "scene/scene.hpp"
#include "simulation/element_sweep.hpp"
#include "simulation/material_batches.hpp"
#include "simulation/velocity_update.hpp"

#include <array>
#include <span>
#include <vector>

namespace talus {

/// Stress of the elements. Empty, and free of cost, where nothing deforms.
class Deformation {
 public:
  Deformation(const Scene& scene, const Model& model, Workers& workers);

  struct Energy {
    double stored = 0;        ///< J/m
    double dissipated = 0;    ///< J/m since t_{n-1}
    bool inside_out = false;  ///< the area of an element became negative; looked for where stress is kept
  };
  /// f_int (Eq. 18): adds −A P ∇w to the forces of the patches, −A P to the moments of affine blocks. Own
  /// patches of bodies of many elements (see Partition) catch up with MotionState::own_behind; their forces
  /// are set, not added to, for nothing else acts on them. `keep`: the step is looked at, so stresses of
  /// materials with a memory are kept, and whether anything is inside out is found.
  Energy apply(const Model& model, MotionState& motion, double dt, bool keep = true);

  /// The same, and patches of bodies without supports go on to v₊ at once, so all other forces must be there;
  /// accelerate() then does the rest of them (see updated()). Their velocity at t_n is left in `at_step`
  /// where it is kept.
  Energy apply_and_update(const Model& model, const PatchMass& mass, std::span<const Support> supports,
                          const StepConditions& conditions, double dt, bool keep, MotionState& motion,
                          std::vector<Vec2>& at_step);

  /// [body] whether it stands and needs no forces, not 0; empty: none.
  void set_asleep(const Model& model, std::span<const std::uint32_t> asleep);
  /// From now on what each block stores is kept.
  void keep_energies(const Model& model) { energies_.resize(model.element_body.size()); }
  /// J/m, in a body that moves as a whole, where energies are kept.
  double stored_in(const Model& model, std::uint32_t body) const;

  /// [body] what the last call did to patches; empty where no body has any.
  const std::vector<UpdatedPatches>& updated() const { return updated_; }

  /// Cauchy stress xx, yy, xy, Pa, of an element; of materials with a memory, when stresses were last kept.
  std::array<double, 3> cauchy_of_element(const Model& model, const MotionState& motion,
                                          std::uint32_t element) const {
    std::array<double, 3> stress;
    const Matrix2 h = gradient_of_element(model, motion, element);
    materials_.cauchy(element, {&h, 1}, &stress);
    return stress;
  }
  /// Mean over the area of a body, as it moves; zero for a body that does not deform.
  std::array<double, 3> cauchy(const Model& model, const MotionState& motion, std::size_t body) const;

  void exchange(Archive& archive) {
    materials_.exchange(archive);
    archive.of_known_size(energies_);
  }

  /// What the materials remember, to go on from elsewhere: their own states, and deformation at t_n where
  /// they ask for it.
  std::vector<double> memory() const { return materials_.memory(); }
  void set_memory(const std::vector<double>& memory) { materials_.set_memory(memory); }

 private:
  /// Elements of affine blocks that lie side by side and have one material.
  struct Blocks {
    std::uint32_t batch, element, count;
  };
  void divide_sweeps(const Model& model);
  void lay_out_blocks(const Model& model, std::span<const std::uint32_t> asleep);
  Energy apply_to_blocks(const Model& model, double dt, bool keep, MotionState& motion);
  Energy apply_to(const Model& model, const Blocks& blocks, double dt, bool keep, ElementBuffer& buffer,
                  MotionState& motion);
  /// Of all bodies of many elements at once; those that are `free_` are updated, if any are to be.
  void sweep(const Model& model, const SweepStep& given, MotionState& motion);
  Energy energy_of_sweeps(const Model& model) const;

  MaterialBatches materials_;
  ElementSweep sweep_;
  Workers& workers_;
  std::vector<ElementSweep::Workspace> workspaces_;  ///< [thread]
  std::vector<SweepSums> sums_;                      ///< [subdomain]
  std::vector<std::uint32_t> subdomain_body_;        ///< [subdomain]
  /// Common patches of a body, counted from its first.
  struct CommonPatches {
    std::uint32_t body, begin, end;
  };
  std::vector<CommonPatches> common_;  ///< of all, in chunks
  struct Range {
    std::uint32_t begin, end;
  };
  std::vector<Range> sweeps_, gathers_;  ///< subdomains, entries of common_ that a thread takes at once
  std::vector<kernels::VelocitySums> common_sums_;  ///< [entry of common_]
  std::vector<char> free_;                          ///< [body] it has no supports
  std::vector<UpdatedPatches> updated_;

  std::vector<Blocks> blocks_;
  std::vector<Energy> block_energies_;  ///< [entry of blocks_]
  std::vector<double> energies_;        ///< [element] J/m stored in a block; empty where they are not kept
};

}  // namespace talus
