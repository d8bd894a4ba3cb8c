#include "stiffest_mode.hpp"
#include "parallel/alone.hpp"

#include "contact/contact_stage.hpp"
#include "model/whole_motion.hpp"
#include "simulation/deformation.hpp"
#include "simulation/integrator.hpp"
#include "simulation/loads.hpp"
#include "simulation/strain_mass.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// A small motion or acceleration of one body: u, and H or (in xx) a rotation.
struct Small {
  Vec2 u;
  Matrix2 h;
};
using Mode = std::vector<Small>;

class Oscillator {
 public:
  Oscillator(const Scene& scene, const std::vector<Vec2>& shift)
      : scene_(scene), model_(build_model(scene)), shift_(shift), rest_(forces({}, 0)) {}

  Mode start() const {
    Mode mode(model_.bodies.size());
    double value = 0.3;
    const auto next = [&] { return value = 3.9 * value * (1 - value); };  // anything without symmetry
    for (Small& small : mode) small = {{next() - 0.5, next() - 0.5}, {next(), -next(), next(), -next()}};
    return mode;
  }

  /// M⁻¹K mode.
  Mode apply(const Mode& mode, double amplitude) const {
    const double scale = amplitude / largest(mode);
    const std::vector<BodyForce> moved = forces(mode, scale);
    Mode result(mode.size());
    for (std::size_t i = 0; i < mode.size(); ++i) {
      const Body& body = model_.bodies[i];
      if (body.kinematics == Kinematics::fixed) continue;
      const BodyForce &f = moved[i], &f0 = rest_[i];
      result[i].u = {(f0.force.x - f.force.x) / (scale * body.mass),
                     (f0.force.y - f.force.y) / (scale * body.mass)};
      if (body.kinematics == Kinematics::rigid) {
        const double turning = torque({}, f0) - torque({}, f);
        result[i].h.xx = turning / (scale * body.inertia());
        continue;
      }
      const Matrix2 q{f0.moment.xx - f.moment.xx, f0.moment.xy - f.moment.xy, f0.moment.yx - f.moment.yx,
                      f0.moment.yy - f.moment.yy};
      const Matrix2 inverse = body.inverse_moment();
      result[i].h = {
          (q.xx * inverse.xx + q.xy * inverse.yx) / scale, (q.xx * inverse.xy + q.xy * inverse.yy) / scale,
          (q.yx * inverse.xx + q.yy * inverse.yx) / scale, (q.yx * inverse.xy + q.yy * inverse.yy) / scale};
      if (body.strain_mass_scale == 1) continue;
      result[i].h = StrainMass(body, body.mass / body.moments.area, {}).acceleration(result[i].h);
    }
    return result;
  }

  double largest(const Mode& mode) const {
    double size = 0;
    for (std::size_t i = 0; i < mode.size(); ++i) {
      if (!model_.moves(static_cast<std::uint32_t>(i))) continue;
      const Matrix2& h = mode[i].h;
      const double width = model_.bodies[i].width;
      for (const double value :
           {mode[i].u.x, mode[i].u.y, h.xx * width, h.xy * width, h.yx * width, h.yy * width}) {
        size = std::max(size, std::abs(value));
      }
    }
    return size;
  }

 private:
  std::vector<BodyForce> forces(const Mode& mode, double scale) const {
    MotionState motion(model_);
    for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
      BodyMotion& body = motion.bodies[i];
      body.u = shift_[i];
      if (mode.empty() || !model_.moves(static_cast<std::uint32_t>(i))) continue;
      const Vec2 u{scale * mode[i].u.x, scale * mode[i].u.y};
      Matrix2 h = mode[i].h;
      if (model_.bodies[i].kinematics == Kinematics::rigid) h = {0, -h.xx, h.xx, 0};
      h = {scale * h.xx, scale * h.xy, scale * h.yx, scale * h.yy};
      body.u = {body.u.x + u.x, body.u.y + u.y};
      body.h = h;
      body.velocity = u;  // over a step of 1 s: the slip that loads the tangential springs
      body.rate = h;
    }
    move_boundary(model_, motion);
    ContactStage contacts(scene_, model_, alone(), true);
    contacts.find_pairs(model_, motion, 0, {});
    contacts.evaluate(model_, motion, {1, true, false});
    Deformation(scene_, model_, alone()).apply(model_, motion, 1);
    Loads(scene_, settings_of(scene_), model_).apply(motion, {0, 0, 0}, 0);
    return motion.forces;
  }

  const Scene& scene_;
  Model model_;
  std::vector<Vec2> shift_;
  std::vector<BodyForce> rest_;
};

}  // namespace

double stiffest_mode(const Scene& scene, const std::vector<Vec2>& shift, double amplitude) {
  const Oscillator oscillator(scene, shift);
  Mode mode = oscillator.start();
  double lambda = 0;
  for (int i = 0; i < 400; ++i) {
    Mode next = oscillator.apply(mode, amplitude);
    const double growth = oscillator.largest(next);
    lambda = growth / oscillator.largest(mode);
    for (Small& small : next) {
      small.u = {small.u.x / growth, small.u.y / growth};
      small.h = {small.h.xx / growth, small.h.xy / growth, small.h.yx / growth, small.h.yy / growth};
    }
    mode = std::move(next);
  }
  return lambda;
}

}  // namespace talus
