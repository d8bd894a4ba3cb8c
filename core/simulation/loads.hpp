#pragma once

#include "archive/archive.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "scene/scene.hpp"

#include <array>
#include <vector>

namespace talus {

/// Point loads, loads on surfaces, penalty supports and absorbing boundaries of a scene: f_ext and f_λ
/// (Eqs. 18–20). Gravity enters as an acceleration.
class Loads {
 public:
  Loads(const Scene& scene, const StageSettings& settings, const Model& model);

  /// Adds the loads of a step. Velocities serve the work they have done in the step behind, of length dt.
  void apply(MotionState& motion, const StepSpan& span, double dt);

  void exchange(Archive& archive);  ///< between steps

  double work() const { return work_; }      ///< J/m since the last reset, by loads and moving supports
  double stored() const { return stored_; }  ///< J/m in the penalty supports
  /// N/m, sums of the magnitudes at the last apply(): of loads, and of what penalty supports hold against.
  double applied() const { return applied_; }
  double reactions() const { return reactions_; }
  void reset_work() { work_ = 0; }

 private:
  /// A force at a point that works on the body's motion.
  struct Worker {
    Vec2 last_force;  ///< N/m at the last step
  };
  struct Point {
    MaterialPoint at;
    Vec2 scene_point;  ///< m, where functions are read
    VectorFunction force;
    Worker worker;
  };
  /// Of each stretch of a side on which all functions are smooth: exact for tractions up to degree 4 along
  /// it.
  static constexpr std::size_t gauss_points = 3;
  /// A part of a side around a Gauss point.
  struct SideShare {
    std::uint32_t side;  ///< index into sides_
    double lever;        ///< 0 at the start of the side, 1 at its end
    double share;        ///< of the length of the side
    Vec2 scene_point;
  };
  struct SurfacePoint {
    SideShare at;
    std::uint32_t load;  ///< index into surface_loads_
    Worker worker;
  };
  struct SupportPoint {
    SideShare at;
    std::uint32_t prescribed;             ///< index into prescribed_
    std::array<double, 2> last_force{};   ///< N/m on the body
    std::array<double, 2> last_target{};  ///< m, ū
    bool fresh = true;
  };
  struct AbsorbingPoint {
    SideShare at;
    double pressure_impedance, shear_impedance;  ///< ρ c_p and ρ c_s, Pa s/m
    Worker worker;
  };

  using Functions = std::vector<const Function*>;
  template <class Visit>
  void visit_sides(const Scene& scene, const Model& model, std::uint32_t body, std::uint32_t surface_class,
                   const Functions& functions, const Visit& visit);
  void work_through(Worker& worker, Vec2 force, Vec2 moved);
  void apply_points(MotionState& motion, const StepSpan& span, double dt);
  void apply_surface_loads(MotionState& motion, const StepSpan& span, double dt);
  void apply_supports(MotionState& motion, double time);
  void apply_absorbing(MotionState& motion, double dt);
  void add_on_side(MotionState& motion, const SideShare& at, Vec2 force);
  Vec2 displacement_at(const MotionState& motion, const SideShare& at) const;
  Vec2 velocity_at(const MotionState& motion, const SideShare& at) const;

  std::vector<SurfaceLoad> surface_loads_;
  std::vector<PrescribedSurface> prescribed_;
  std::vector<BoundarySide> sides_;  ///< that something acts on
  std::vector<Point> points_;
  std::vector<SurfacePoint> surface_points_;
  std::vector<SupportPoint> support_points_;
  std::vector<AbsorbingPoint> absorbing_points_;
  double work_ = 0, stored_ = 0, applied_ = 0, reactions_ = 0;
};

}  // namespace talus
