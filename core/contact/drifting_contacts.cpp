#include "contact/contact_stage.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// For so many steps a drift is counted on: what pulls all bodies makes little of it meanwhile.
constexpr std::uint32_t steps_of_drift = 32;
constexpr std::size_t bodies_at_once = 256, pairs_at_once = 1024;

}  // namespace

/// What every corner does is told from how it moves now, from now on.
void ContactStage::take_drift(const Model& model, const MotionState& motion) {
  workers_.over(model.moving_bodies.size(), bodies_at_once,
                [&](std::size_t, std::size_t begin, std::size_t end) {
                  for (std::size_t i = begin; i < end; ++i) {
                    const std::uint32_t b = model.moving_bodies[i];
                    drift_[b] = drift_of(model, model.bodies[b], motion);
                  }
                });
  way_ = {};
  steps_adrift_ = 0;
}

kernels::Drift ContactStage::drift_of(const Model& model, const Body& body, const MotionState& motion) {
  double x = 0, y = 0, count = 0;
  model.visit_boundary(body, [&](std::uint32_t c) {
    const BoundaryCorner& corner = motion.corners[c];
    corner_drift_[c] = {static_cast<float>(corner.vx), static_cast<float>(corner.vy)};
    x += corner_drift_[c].x, y += corner_drift_[c].y;
    ++count;
  });
  kernels::Drift all{static_cast<float>(x / count), static_cast<float>(y / count)};
  double squared = 0;
  model.visit_boundary(body, [&](std::uint32_t c) {
    const double dx = double{corner_drift_[c].x} - all.x, dy = double{corner_drift_[c].y} - all.y;
    squared = std::max(squared, dx * dx + dy * dy);
  });
  all.spread = kernels::at_least(std::sqrt(squared));
  return all;
}

/// Once in a while the drift is taken anew, and as much is left of the way to a pair as was before. When that
/// is, no checkpoint says: nothing of a result depends on who is asked about and is apart.
void ContactStage::drift_on(const Model& model, const MotionState& motion) {
  if (++steps_adrift_ < steps_of_drift) return;
  const kernels::Way gone = way_;
  take_drift(model, motion);
  workers_.over(pairs_.size(), pairs_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      ask_again_[i] = kernels::at_most(std::max(0.0, ask_again_[i] - gone.of(approach_[i])));
      approach_[i] = kernels::at_least(drift_[pairs_[i].a].approach(drift_[pairs_[i].b]));
    }
  });
}

}  // namespace talus
