#include "simulation/state.hpp"

namespace talus {

PartPoint Simulation::State::point(const MaterialPoint& at, Vec2 as_drawn) const {
  const bool whole = at.carrier.patch[0] == no_patch;
  const Vec2 now = motion.displacement(at),
             before = whole ? since_start.displacement_at_start(at.body, at.reference)
                            : since_start.displacement_at_start(at.carrier),
             speed = !whole            ? carried(at.carrier, patch_velocity_at_step)
                     : velocities_left ? velocity(motion.velocity_at_step(at.body), at.reference)
                                       : velocity(motion.bodies[at.body], at.reference);
  return {as_drawn + now, now - before, speed};
}

Motion Simulation::State::motion_of(std::uint32_t body) const {
  const Body& b = model.bodies[body];
  if (!model.covered(body)) return motion_of(body, 0, b.centre);
  Vec2 now, before, speed;
  const CoverRanges& ranges = model.ranges(b);
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    const double share = model.patch_mass[p] / b.mass;
    const auto add = [&](Vec2& sum, Vec2 value) { sum += share * value; };
    add(now, motion.patch_displacement[p]);
    add(before, since_start.displacement_at_start(p));
    add(speed, patch_velocity_at_step[p]);
  }
  return {b.centre + now, now - before, speed, since_start.rotation(body)};
}

Motion Simulation::State::motion_of(std::uint32_t body, std::uint32_t element, Vec2 as_drawn) const {
  const Vec2 centre = model.bodies[body].centre;
  MaterialPoint at{body, as_drawn - centre, {}};
  if (model.covered(body)) at.carrier = model.carrier(model.elements[element], at.reference);
  const PartPoint seen = point(at, as_drawn);
  return {seen.position, seen.displacement, seen.velocity, since_start.rotation(body)};
}

std::uint32_t Simulation::State::element_at(std::uint32_t body, Vec2 as_drawn) const {
  const Vec2 centre = model.bodies[body].centre;
  return model.covered(body) ? model.element_at(body, as_drawn - centre) : 0;
}

std::array<double, 3> Simulation::State::stress_of(std::uint32_t body, std::uint32_t element) const {
  return model.covered(body) ? deformation.cauchy_of_element(model, motion, element)
                             : deformation.cauchy(model, motion, body);
}

/// Looked for once: it takes a look at all elements of a body.
std::vector<std::uint32_t> Simulation::State::elements_of_monitors() const {
  std::vector<std::uint32_t> elements;
  for (const Monitor& monitor : scene.monitors)
    elements.push_back(monitor.point ? element_at(monitor.body, *monitor.point) : 0);
  return elements;
}

}  // namespace talus
