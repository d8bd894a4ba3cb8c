#include "files/hash.hpp"
#include "parallel/subnormals.hpp"
#include "simulation/state.hpp"

namespace talus {

std::string Simulation::model_hash() const {
  const State& s = *state_;
  std::vector<double> shape(s.model.reference_x);
  shape.insert(shape.end(), s.model.reference_y.begin(), s.model.reference_y.end());
  for (const Body& body : s.model.bodies)
    shape.insert(shape.end(), {body.centre.x, body.centre.y, body.mass});
  for (const Vec2 star : s.model.patch_star) shape.insert(shape.end(), {star.x, star.y});
  return hash_of_bytes({reinterpret_cast<const char*>(shape.data()), shape.size() * sizeof(double)});
}

std::string Simulation::take_geometry(const Geometry& geometry) {
  const NoSubnormals as_in_steps;
  State& s = *state_;
  const Geometry mine = this->geometry();
  if (geometry.unknowns.size() != mine.unknowns.size() || geometry.stars != mine.stars)
    return "its bodies or patches are not those of the other";
  if (may_bond(s.scene)) return "bonds may form, and do so where bodies are drawn";
  const double* from = geometry.unknowns.data();
  for (std::size_t i = 0; i < s.motion.bodies.size(); ++i, from += 6) {
    const std::uint32_t index = s.numbering.inside(i);
    BodyMotion& body = s.motion.bodies[index];
    body.u = {from[0], from[1]};
    body.h = {from[2], from[3], from[4], from[5]};
    if (s.model.bodies[index].kinematics == Kinematics::rigid) body.h = rotation_of(body.h);
  }
  for (std::size_t i = 0; i < s.model.bodies.size(); ++i) {
    const Body& body = s.model.bodies[s.numbering.inside(i)];
    const CoverRanges& ranges = s.model.ranges(body);
    for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p, from += 2)
      s.motion.patch_displacement[p] = {from[0], from[1]};
  }
  if (geometry.memory.size() == mine.memory.size() && geometry.own_end == mine.own_end &&
      geometry.numbering == mine.numbering)
    s.deformation.set_memory(geometry.memory);
  return {};
}

Geometry Simulation::geometry() const {
  const State& s = *state_;
  Geometry geometry;
  for (std::size_t i = 0; i < s.motion.bodies.size(); ++i) {
    const BodyMotion& body = s.motion.bodies[s.numbering.inside(i)];
    for (const double value : {body.u.x, body.u.y, body.h.xx, body.h.xy, body.h.yx, body.h.yy}) {
      geometry.unknowns.push_back(value);
    }
  }
  for (std::size_t i = 0; i < s.model.bodies.size(); ++i) {
    const Body& body = s.model.bodies[s.numbering.inside(i)];
    const CoverRanges& ranges = s.model.ranges(body);
    for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
      const Vec2 displacement = s.motion.patch_displacement[p];
      geometry.unknowns.insert(geometry.unknowns.end(), {displacement.x, displacement.y});
      const Vec2 star = s.model.patch_star[p];
      geometry.stars.insert(geometry.stars.end(), {star.x, star.y});
    }
    geometry.own_end.push_back(ranges.own_end - ranges.patch_begin);
  }
  geometry.memory = s.deformation.memory();
  geometry.numbering = s.numbering.inner;
  return geometry;
}

void Simulation::exchange(Archive& archive) {
  State& s = *state_;
  archive(s.settling);
  archive(s.settle_over);
  archive(s.stages_begun);
  if (archive.reading()) {
    if (s.stages_begun > s.scene.stages.size()) Archive::refuse();
    if (s.stages_begun > 0) s.enter_stage(s.scene.stages[s.stages_begun - 1].settings);
    s.contacts.set_supports(s.model, s.stage.supports);
  }
  s.motion.exchange(archive);
  s.contacts.exchange(archive, s.model);
  s.deformation.exchange(archive);
  s.loads.exchange(archive);
  s.relaxation.exchange(archive);
  if (s.sleep) s.sleep->exchange(archive, s.sleeping_parts());
  s.exchange_clock(archive);
  s.exchange_books(archive);
}

void Simulation::State::exchange_clock(Archive& archive) {
  archive(time);
  archive(dt_behind);
  archive(fresh);
  archive(velocities_left);
  archive(started);
  archive(output);
  archive(plan);
  archive(beside_stage);
  archive(was_beside_stage);
  archive(limit);
  archive(planned_with);
  archive(critical);
  archive(last_gravity);
  archive(unbalanced_share);
  archive(speeds);
}

void Simulation::State::exchange_books(Archive& archive) {
  since_start.exchange(archive);
  archive.of_known_size(motion.forces);  // velocities at t_n
  archive.of_known_size(patch_velocity_at_step);
  archive(ledger);
  archive(contact_totals);
  archive(strain_energy.stored);
  archive(strain_energy.dissipated);
  archive(deepest_pair.first);
  archive(deepest_pair.second);
  archive(summary.steps);
  archive(summary.settle_steps);
  archive(summary.dt);
  archive(summary.critical_dt);
  archive(summary.largest_penetration);
  archive(summary.largest_residual_share);
  archive(summary.warnings);
  archive(told_of_thin_ground);
  const std::size_t bodies = model.bodies.size();
  if (deepest_pair.first >= bodies || deepest_pair.second >= bodies || contact_totals.deepest_a >= bodies ||
      contact_totals.deepest_b >= bodies || critical.body >= bodies || critical.spring_body >= bodies)
    Archive::refuse();
}

}  // namespace talus
