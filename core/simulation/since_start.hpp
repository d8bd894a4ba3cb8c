#pragma once

#include "archive/archive.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"

#include <cstdint>
#include <vector>

namespace talus {

/// What bodies have moved and turned since t = 0. Where a scene settles first that is less than since they
/// were drawn.
class SinceStart {
 public:
  SinceStart(const Model& model, bool settles);

  /// t = 0 is now.
  void begin(const Model& model, MotionState& motion);

  /// That no body has turned by more than `most`, rad, since the last time: angles are followed in time.
  void follow(double most, const Model& model, MotionState& motion);
  /// Follows each body through full turns: the angle since the last time is less than half of one.
  void follow(const Model& model, MotionState& motion);

  double rotation(std::uint32_t body) const {  ///< rad
    return rotation_[body] - (rotation_at_start_.empty() ? 0 : rotation_at_start_[body]);
  }
  /// m, at t = 0: of a place of a body, of one that patches carry, and of a patch.
  Vec2 displacement_at_start(std::uint32_t body, Vec2 reference) const;
  Vec2 displacement_at_start(const Carrier& carrier) const;
  Vec2 displacement_at_start(std::uint32_t patch) const { return settles_ ? patches_[patch] : Vec2{}; }

  void exchange(Archive& archive);

 private:
  bool settles_;
  std::vector<BodyMotion> bodies_;         ///< at t = 0; empty where nothing settles
  std::vector<Vec2> patches_;              ///< m, displacements, so too
  std::vector<double> rotation_;           ///< [body] rad from the shape it is drawn in
  std::vector<double> rotation_at_start_;  ///< [body] rad; empty where bodies start as they are drawn
  double turned_ = 0;                      ///< rad, bound of what any body has turned since it was followed
};

}  // namespace talus
