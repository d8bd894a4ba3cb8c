#include "simulation/loads.hpp"

#include "plugin/registry.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// ū along an axis, m.
double target_of(const PrescribedSurface& prescribed, std::size_t axis, double time, Vec2 at) {
  const SupportPast& past = prescribed.past[axis];
  const double share = prescribed.ramp_share(axis, time);
  double target = past.former(time, at) * (1 - share);
  if (prescribed.displacement[axis]) target += (*prescribed.displacement[axis])(time, at) * share;
  if (prescribed.velocity[axis]) target += prescribed.velocity[axis]->integral(time, at);
  return target + past.travelled(time, at);
}

Vec2 between(Vec2 p, Vec2 q, double lever) {
  return p + lever * (q - p);
}

}  // namespace

/// Calls visit with each Gauss point of the sides of a body's surface, between the kinks of some functions.
template <class Visit>
void Loads::visit_sides(const Scene& scene, const Model& model, std::uint32_t body,
                        std::uint32_t surface_class, const Functions& functions, const Visit& visit) {
  const double outer = std::sqrt(0.15);
  const std::array<double, gauss_points> lever{0.5 - outer, 0.5, 0.5 + outer};
  const std::array<double, gauss_points> share{5.0 / 18, 8.0 / 18, 5.0 / 18};
  const Vec2 centre = model.bodies[body].centre;
  const auto in_scene = [&](Vec2 reference) { return centre + reference; };
  for (const BoundarySide& side : boundary_of(scene, model, body)) {
    if (side.surface != surface_class) continue;
    const auto index = static_cast<std::uint32_t>(sides_.size());
    sides_.push_back(side);
    std::vector<double> ends{0, 1};
    for (const Function* function : functions)
      function->add_kinks(in_scene(side.start.reference), in_scene(side.end.reference), ends);
    std::sort(ends.begin(), ends.end());
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double length = ends[k + 1] - ends[k];
      if (!(length > 0)) continue;
      for (std::size_t g = 0; g < gauss_points; ++g) {
        const double at = ends[k] + length * lever[g];
        visit(SideShare{index, at, length * share[g],
                        in_scene(between(side.start.reference, side.end.reference, at))});
      }
    }
  }
}

Loads::Loads(const Scene& scene, const StageSettings& settings, const Model& model)
    : surface_loads_(settings.surface_loads), prescribed_(settings.prescribed) {
  for (const PointLoad& load : settings.loads) {
    const Vec2 centre = model.bodies[load.body].centre;
    const Vec2 reference = load.point - centre;
    points_.push_back({model.point(load.body, reference), load.point, load.force, {}});
  }
  for (std::uint32_t i = 0; i < surface_loads_.size(); ++i) {
    const SurfaceLoad& load = surface_loads_[i];
    visit_sides(scene, model, load.body, load.surface_class,
                {load.traction.data(), &load.traction[1], &load.pressure}, [&](const SideShare& at) {
                  surface_points_.push_back({at, i, {}});
                });
  }
  for (std::uint32_t i = 0; i < prescribed_.size(); ++i) {
    Functions functions;
    for (const auto* either : {&prescribed_[i].displacement, &prescribed_[i].velocity}) {
      for (const auto& along : *either) {
        if (along) functions.push_back(&*along);
      }
    }
    for (const SupportPast& past : prescribed_[i].past) {
      functions.push_back(&past.former);
      functions.push_back(&past.travelled);
    }
    visit_sides(scene, model, prescribed_[i].body, prescribed_[i].surface_class, functions,
                [&](const SideShare& at) {
                  support_points_.push_back({at, i});
                });
  }
  for (const AbsorbingSurface& absorbing : settings.absorbing) {
    const SceneMaterial& material = scene.materials[scene.bodies[absorbing.body].material];
    double tangent[9] = {};
    make<Material>(*material.model.component, material.model.values)->stiffest_tangent(tangent);
    const double pressure = std::sqrt(material.density * tangent[0]);
    const double shear = std::sqrt(material.density * tangent[8]);
    visit_sides(scene, model, absorbing.body, absorbing.surface_class, {}, [&](const SideShare& at) {
      absorbing_points_.push_back({at, pressure, shear, {}});
    });
  }
}

void Loads::apply(MotionState& motion, const StepSpan& span, double dt) {
  stored_ = applied_ = reactions_ = 0;
  apply_points(motion, span, dt);
  apply_surface_loads(motion, span, dt);
  apply_supports(motion, span.time);
  apply_absorbing(motion, dt);
}

void Loads::exchange(Archive& archive) {
  for (Point& point : points_) archive(point.worker);
  for (SurfacePoint& point : surface_points_) archive(point.worker);
  for (SupportPoint& point : support_points_) {
    archive(point.last_force);
    archive(point.last_target);
    archive(point.fresh);
  }
  for (AbsorbingPoint& point : absorbing_points_) archive(point.worker);
  archive(work_);
  archive(stored_);
  archive(applied_);
  archive(reactions_);
}

/// Trapezoidal rule, which is exact for the leapfrog: f_n works over half of the step behind and half of the
/// step ahead.
void Loads::work_through(Worker& worker, Vec2 force, Vec2 moved) {
  work_ += ((force.x + worker.last_force.x) * moved.x + (force.y + worker.last_force.y) * moved.y) / 2;
  worker.last_force = force;
}

void Loads::apply_points(MotionState& motion, const StepSpan& span, double dt) {
  for (Point& point : points_) {
    const Vec2 force{point.force[0].over(span, point.scene_point),
                     point.force[1].over(span, point.scene_point)};
    const Vec2 speed = motion.velocity(point.at);
    work_through(point.worker, force, dt * speed);
    motion.add_force(point.at, force);
    applied_ += size_of(force);
  }
}

void Loads::apply_surface_loads(MotionState& motion, const StepSpan& span, double dt) {
  for (SurfacePoint& point : surface_points_) {
    const SurfaceLoad& load = surface_loads_[point.load];
    const BoundarySide& side = sides_[point.at.side];
    const Vec2 start = side.start.reference, end = side.end.reference;
    const double length = point.at.share * size_of(end - start);
    Vec2 force{length * load.traction[0].over(span, point.at.scene_point),
               length * load.traction[1].over(span, point.at.scene_point)};
    if (!load.pressure.zero()) {
      // Towards the body on the present side: the side turned by 90° to the left.
      const double pressure = point.at.share * load.pressure.over(span, point.at.scene_point);
      const Vec2 from = motion.displacement(side.start), to = motion.displacement(side.end);
      force.x -= pressure * (end.y + to.y - start.y - from.y);
      force.y += pressure * (end.x + to.x - start.x - from.x);
    }
    const Vec2 speed = velocity_at(motion, point.at);
    work_through(point.worker, force, dt * speed);
    add_on_side(motion, point.at, force);
    applied_ += size_of(force);
  }
}

/// λ∫(u − ū). The work is that of the moving support; what the springs hold is stored.
void Loads::apply_supports(MotionState& motion, double time) {
  for (SupportPoint& point : support_points_) {
    const PrescribedSurface& prescribed = prescribed_[point.prescribed];
    const BoundarySide& side = sides_[point.at.side];
    const double length = size_of(side.end.reference - side.start.reference);
    const double stiffness = prescribed.stiffness * length * point.at.share;
    const Vec2 moved = displacement_at(motion, point.at);
    std::array<double, 2> force{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      if (!prescribed.holds(axis)) continue;
      const double target = target_of(prescribed, axis, time, point.at.scene_point);
      const double error = (axis == 0 ? moved.x : moved.y) - target;
      stored_ += stiffness * error * error / 2;
      force[axis] = -stiffness * error;
      if (!point.fresh)
        work_ += (target - point.last_target[axis]) * (force[axis] + point.last_force[axis]) / 2;
      point.last_force[axis] = force[axis];
      point.last_target[axis] = target;
    }
    point.fresh = false;
    add_on_side(motion, point.at, {force[0], force[1]});
    reactions_ += size_of({force[0], force[1]});
  }
}

void Loads::apply_absorbing(MotionState& motion, double dt) {
  for (AbsorbingPoint& point : absorbing_points_) {
    const BoundarySide& side = sides_[point.at.side];
    const Vec2 from = motion.displacement(side.start), to = motion.displacement(side.end);
    const Vec2 span = side.end.reference + to - side.start.reference - from;
    const double length = size_of(span);
    const Vec2 tangent = span / length, speed = velocity_at(motion, point.at);
    const double outward = speed.x * tangent.y - speed.y * tangent.x;
    const double along = speed.x * tangent.x + speed.y * tangent.y;
    const double normal = -point.pressure_impedance * outward * length * point.at.share;
    const double shear = -point.shear_impedance * along * length * point.at.share;
    const Vec2 force{normal * tangent.y + shear * tangent.x, -normal * tangent.x + shear * tangent.y};
    work_through(point.worker, force, dt * speed);
    add_on_side(motion, point.at, force);
  }
}

/// By the lever rule: exact, for displacement is affine along the side.
void Loads::add_on_side(MotionState& motion, const SideShare& at, Vec2 force) {
  const BoundarySide& side = sides_[at.side];
  motion.add_force(side.start, (1 - at.lever) * force);
  motion.add_force(side.end, at.lever * force);
}

Vec2 Loads::displacement_at(const MotionState& motion, const SideShare& at) const {
  return between(motion.displacement(sides_[at.side].start), motion.displacement(sides_[at.side].end),
                 at.lever);
}

Vec2 Loads::velocity_at(const MotionState& motion, const SideShare& at) const {
  return between(motion.velocity(sides_[at.side].start), motion.velocity(sides_[at.side].end), at.lever);
}

}  // namespace talus
