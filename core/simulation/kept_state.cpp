#include "files/hash.hpp"
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
  archive.of_known_size(start);
  archive.of_known_size(start_displacement);
  archive.of_known_size(rotation);
  archive(rotation_at_start);
  if (!rotation_at_start.empty() && rotation_at_start.size() != rotation.size()) Archive::refuse();
  archive(turned);
  archive.of_known_size(motion.forces);  // velocities at t_n
  archive.of_known_size(patch_velocity_at_step);
  archive(ledger);
  archive(contact_totals);
  archive(strain_energy.stored);
  archive(strain_energy.dissipated);
  archive(strain_energy.viscous);
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
