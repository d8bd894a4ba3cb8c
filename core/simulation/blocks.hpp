#pragma once

#include "kernels/level.hpp"
#include "parallel/workers.hpp"
#include "simulation/integrator.hpp"

namespace talus {

/// The bodies that move as a whole, as the loops of the step read them: their motion, and the boundary that
/// follows it. Everything else about a body is in the Model.
class Blocks {
 public:
  /// `boundary_seen`: whether anybody asks where boundaries are, or only how fast.
  Blocks(const Model& model, SimdLevel level, Workers& workers, bool boundary_seen);

  /// From now on these supports hold; bodies with any are left to the caller.
  void set_supports(std::span<const Support> supports);
  /// The moving bodies that accelerate() and over_scaled() do not take: of many elements, or with a support.
  std::span<const std::uint32_t> left_to_others() const { return left_to_others_; }
  /// [body] whether it stands, not 0; empty: none. All are awake when supports change.
  void set_asleep(std::span<const std::uint32_t> asleep);
  bool is_asleep(std::uint32_t body) const { return !asleep_.empty() && asleep_[body] != 0; }

  void move(double dt, MotionState& motion);  ///< Eq. 22
  /// Boundaries of all bodies follow (Eq. 11), and no force is on any of them; returns how fast they are.
  /// `drift`: ContactStage::drift().
  MotionState::Speeds follow(const Model& model, std::span<const kernels::CornerDrift> drift,
                             MotionState& motion);
  /// Eqs. 23–24 of the free ones. `observed`: velocities at t_n are left in place of forces. Adds to `work`.
  void accelerate(const StepConditions& conditions, bool observed, MotionState& motion,
                  AccelerationWork& work);
  /// Calls each(body, work) for the free ones with scaled strain that are awake, on all threads, and adds to
  /// `work` in their order.
  template <class Each>
  void over_scaled(AccelerationWork& work, const Each& each);

 private:
  static constexpr std::size_t chunk = 64;  ///< bodies; sums are kept apart by chunks

  /// Bodies side by side within a chunk that the kernels have to do with: what is fixed costs nothing.
  struct Stretch {
    std::size_t begin, end;
  };
  void find_stretches();
  /// A body whose boundary the kernels do not know, or some of the sides of one of many elements.
  struct Other {
    std::uint32_t body, side_begin, side_end;
  };
  void list_others(const Model& model);
  kernels::SpeedExtremes follow_other(const Model& model, std::span<const kernels::CornerDrift> drift,
                                      const Other& other, MotionState& motion) const;
  void accelerate_and_keep(std::size_t begin, std::size_t end, const kernels::BlockUpdate& update,
                           MotionState& motion, kernels::BlockSums& sums) const;
  /// Calls `each` with the index of an entry of chunks_ and its stretches, in their order.
  template <class Each>
  void over_chunks(const Each& each);

  const kernels::BlockKernels& kernels_;
  Workers& workers_;
  std::vector<kernels::Block> blocks_;
  std::vector<kernels::Block> awake_;  ///< blocks_ as they are awake; empty while all are
  std::vector<std::uint32_t> asleep_;
  std::span<const std::uint32_t> moving_;          ///< bodies that are not fixed
  std::vector<Other> others_;                      ///< of moving bodies
  std::vector<std::uint32_t> left_to_others_;      ///< all, before supports are told
  std::vector<std::uint32_t> with_scaled_strain_;  ///< see StrainMass
  std::vector<std::uint32_t> scaled_;              ///< the free ones of them
  std::vector<AccelerationWork> scaled_work_;      ///< [chunk of scaled_]
  /// A chunk with any.
  struct Chunk {
    std::size_t begin, end;  ///< its entries of stretches_
  };
  std::vector<Stretch> stretches_;
  std::vector<Chunk> chunks_;
  bool boundary_seen_;
  bool some_fixed_ = false;
  std::vector<kernels::SpeedExtremes> speeds_;        ///< [chunk]
  std::vector<kernels::SpeedExtremes> other_speeds_;  ///< [entry of others_]
  std::vector<kernels::BlockSums> sums_;
};

template <class Each>
void Blocks::over_scaled(AccelerationWork& work, const Each& each) {
  if (scaled_.empty()) return;
  workers_.over(scaled_.size(), chunk, [&](std::size_t number, std::size_t begin, std::size_t end) {
    AccelerationWork here;
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_asleep(scaled_[i])) each(scaled_[i], here);
    }
    scaled_work_[number] = here;
  });
  for (const AccelerationWork& part : scaled_work_) {
    work.kinetic += part.kinetic;
    work.damping_loss += part.damping_loss;
    work.damping_loss_ahead += part.damping_loss_ahead;
    work.external_work += part.external_work;
  }
}

}  // namespace talus
