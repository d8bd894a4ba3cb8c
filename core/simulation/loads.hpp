#pragma once

#include "model/model.hpp"
#include "model/motion.hpp"
#include "scene/scene.hpp"

namespace talus {

/// Point loads and penalty supports of a scene: f_ext and f_λ (Eqs. 18–20). Gravity enters as an
/// acceleration.
class Loads {
 public:
  Loads(const Scene& scene, const Model& model);

  /// Adds the loads at time t. `previous` and `velocity` of the bodies serve the work they have done since t
  /// − dt.
  void apply(MotionState& motion, double time, double dt);

  double work() const { return work_; }      ///< J/m since the last reset, by point loads and moving supports
  double stored() const { return stored_; }  ///< J/m in the penalty supports
  void reset_work() { work_ = 0; }

 private:
  struct Point {
    std::uint32_t body;
    Vec2 reference, force;
  };
  struct Edge {
    std::uint32_t body;
    Vec2 start, end;
    const PrescribedSurface* prescribed;
    double last_force[2];  ///< N/m, resultant on the body at the last step, for the work of a moving support
  };

  void apply_edge(Edge& edge, MotionState& motion, double time, double dt);

  std::vector<Point> points_;
  std::vector<Edge> edges_;
  double work_ = 0, stored_ = 0;
};

}  // namespace talus
