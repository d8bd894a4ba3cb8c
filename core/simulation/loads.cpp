#include "simulation/loads.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// ū(t) along an axis, m.
double prescribed_value(const PrescribedSurface& prescribed, int axis, double time) {
  const double ramp = prescribed.ramp > 0 ? std::clamp(time / prescribed.ramp, 0.0, 1.0) : 1.0;
  return prescribed.displacement[axis].value_or(0) * ramp + prescribed.velocity[axis].value_or(0) * time;
}

}  // namespace

Loads::Loads(const Scene& scene, const Model& model) {
  for (const PointLoad& load : scene.loads) {
    const Vec2 centre = model.bodies[load.body].centre;
    points_.push_back({load.body, {load.point.x - centre.x, load.point.y - centre.y}, load.force});
  }
  for (const PrescribedSurface& prescribed : scene.prescribed) {
    const Body& body = model.bodies[prescribed.body];
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece) {
      for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c) {
        if (model.surface[c] != prescribed.surface_class) continue;
        const std::uint32_t next = c + 1 == model.piece_start[piece + 1] ? model.piece_start[piece] : c + 1;
        edges_.push_back({prescribed.body,
                          {model.reference_x[c], model.reference_y[c]},
                          {model.reference_x[next], model.reference_y[next]},
                          &prescribed,
                          {0, 0}});
      }
    }
  }
}

void Loads::apply(MotionState& motion, double time, double dt) {
  for (const Point& point : points_) {
    motion.forces[point.body].add(point.reference, point.force);
    const Vec2 speed = velocity(motion.bodies[point.body], point.reference);
    work_ += (point.force.x * speed.x + point.force.y * speed.y) * dt;
  }
  stored_ = 0;
  for (Edge& edge : edges_) apply_edge(edge, motion, time, dt);
}

/// λ∫(u − ū) along an edge; u is affine along it, so the end loads l/6 (2e₁ + e₂) and l/6 (e₁ + 2e₂) are
/// exact.
void Loads::apply_edge(Edge& edge, MotionState& motion, double time, double dt) {
  const double dx = edge.end.x - edge.start.x, dy = edge.end.y - edge.start.y;
  const double length = std::sqrt(dx * dx + dy * dy), stiffness = edge.prescribed->stiffness;
  const Vec2 at_start = displacement(motion.bodies[edge.body], edge.start);
  const Vec2 at_end = displacement(motion.bodies[edge.body], edge.end);
  double start_load[2] = {0, 0}, end_load[2] = {0, 0};
  for (int axis = 0; axis < 2; ++axis) {
    if (!edge.prescribed->displacement[axis] && !edge.prescribed->velocity[axis]) continue;
    const double wanted = prescribed_value(*edge.prescribed, axis, time);
    const double first = (axis == 0 ? at_start.x : at_start.y) - wanted;
    const double last = (axis == 0 ? at_end.x : at_end.y) - wanted;
    start_load[axis] = -stiffness * length * (2 * first + last) / 6;
    end_load[axis] = -stiffness * length * (first + 2 * last) / 6;
    stored_ += stiffness * length * (first * first + first * last + last * last) / 6;
    const double resultant = start_load[axis] + end_load[axis];
    const double moved = wanted - prescribed_value(*edge.prescribed, axis, time - dt);
    work_ += moved * (resultant + edge.last_force[axis]) / 2;
    edge.last_force[axis] = resultant;
  }
  motion.forces[edge.body].add(edge.start, {start_load[0], start_load[1]});
  motion.forces[edge.body].add(edge.end, {end_load[0], end_load[1]});
}

}  // namespace talus
