#include "verification/patch_test.hpp"

#include "parallel/workers.hpp"
#include "simulation/deformation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

using Stress = std::array<double, 3>;

/// D : ε in plane strain.
Stress stress_of(const Matrix2& h, double modulus, double ratio) {
  const double lame = modulus * ratio / ((1 + ratio) * (1 - 2 * ratio)), shear = modulus / (2 * (1 + ratio));
  return {lame * (h.xx + h.yy) + 2 * shear * h.xx, lame * (h.xx + h.yy) + 2 * shear * h.yy,
          shear * (h.xy + h.yx)};
}

void impose(const Model& model, const Matrix2& h, MotionState& motion) {
  const auto displaced = [&](Vec2 at) { return Vec2{h.xx * at.x + h.xy * at.y, h.yx * at.x + h.yy * at.y}; };
  for (std::size_t p = 0; p < model.patch_star.size(); ++p)
    motion.patch_displacement[p] = displaced(model.patch_star[p]);
  for (BodyMotion& body : motion.bodies) body.h = h;
}

}  // namespace

PatchTest patch_test(const Scene& scene, double modulus, double ratio) {
  const Matrix2 h{2e-2, -1.3e-2, -1.3e-2, -0.7e-2};
  const Model model = build_model(scene);
  MotionState motion(model);
  Workers alone(1);
  Deformation deformation(scene, model, alone);
  impose(model, h, motion);
  deformation.apply(model, motion, 0);

  PatchTest result;
  const Stress p = stress_of(h, modulus, ratio);  // no rotation: P is D : ε, and Cauchy's stress P Fᵀ / det F
  const double volume = (1 + h.xx) * (1 + h.yy) - h.xy * h.yx;
  const Stress cauchy{(p[0] * (1 + h.xx) + p[2] * h.xy) / volume, (p[2] * h.yx + p[1] * (1 + h.yy)) / volume,
                      (p[0] * h.yx + p[2] * (1 + h.yy) + p[2] * (1 + h.xx) + p[1] * h.xy) / 2 / volume};
  for (std::uint32_t e = 0; e < model.element_body.size(); ++e) {
    const Stress found = deformation.cauchy_of_element(model, motion, e);
    for (std::size_t k = 0; k < 3; ++k)
      result.stress = std::max(result.stress, std::abs(found[k] - cauchy[k]) / std::abs(cauchy[0]));
  }

  MotionState loads(model);
  for (const BoundarySide& side : boundary_of(scene, model, 0)) {
    const Vec2 from = side.start.reference, to = side.end.reference;
    const Vec2 outward{to.y - from.y, from.x - to.x};  // times the length of the side
    const Vec2 half{(p[0] * outward.x + p[2] * outward.y) / 2, (p[2] * outward.x + p[1] * outward.y) / 2};
    loads.add_force(side.start, half);
    loads.add_force(side.end, half);
  }
  const auto size = [](Vec2 f) { return std::hypot(f.x, f.y); };
  if (!model.covered(0)) {
    const Matrix2 &in = motion.forces[0].moment, &out = loads.forces[0].moment;
    const double scale = std::abs(out.xx);
    for (const double left : {in.xx + out.xx, in.xy + out.xy, in.yx + out.yx, in.yy + out.yy})
      result.force = std::max(result.force, std::abs(left) / scale);
    return result;
  }
  double largest = 0;
  for (std::size_t i = 0; i < motion.patch_force.size(); ++i) {
    largest = std::max(largest, size(loads.patch_force[i]));
    motion.patch_force[i].x += loads.patch_force[i].x;
    motion.patch_force[i].y += loads.patch_force[i].y;
  }
  for (const SteadyPatch& tied : model.steady) {
    Vec2& own = motion.patch_force[tied.patch];
    for (std::size_t i = 0; i < 3; ++i) {
      motion.patch_force[tied.to.patch[i]].x += tied.to.weight[i] * own.x;
      motion.patch_force[tied.to.patch[i]].y += tied.to.weight[i] * own.y;
    }
    own = {};
  }
  for (const Vec2 left : motion.patch_force) result.force = std::max(result.force, size(left) / largest);
  return result;
}

double strain_of_turns(const Scene& scene, double modulus) {
  constexpr int turns = 100, steps = 90;
  const Model model = build_model(scene);
  MotionState motion(model);
  Workers alone(1);
  Deformation deformation(scene, model, alone);
  double largest = 0;
  for (int i = 0; i <= turns * steps; ++i) {
    const double angle = 2 * std::numbers::pi * (i % steps) / steps;
    impose(model, {std::cos(angle) - 1, -std::sin(angle), std::sin(angle), std::cos(angle) - 1}, motion);
    deformation.apply(model, motion, i == 0 ? 0 : 1e-3);
    for (std::uint32_t e = 0; e < model.element_body.size(); ++e) {
      for (const double stress : deformation.cauchy_of_element(model, motion, e))
        largest = std::max(largest, std::abs(stress));
    }
  }
  return largest / modulus;
}

}  // namespace talus::verification
