#include "simulation/state.hpp"

#include <algorithm>
#include <utility>

namespace talus {

void Simulation::State::set_initial_velocities() {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (model.covered(static_cast<std::uint32_t>(i))) motion.average(model, static_cast<std::uint32_t>(i));
    const SceneBody& given = scene.bodies[i];
    if (model.moves(static_cast<std::uint32_t>(i))) {
      set_rigid_motion(
          i, {given.support.x.value_or(given.velocity.x), given.support.y.value_or(given.velocity.y)},
          given.support.rotation.value_or(given.angular_velocity));
    } else {
      set_rigid_motion(i, {}, 0);
    }
  }
}

/// Of a body whose mean motion is that of its patches now.
void Simulation::State::set_rigid_motion(std::size_t index, Vec2 velocity, double spin) {
  BodyMotion& body = motion.bodies[index];
  body.velocity = velocity;
  body.spin = spin;
  body.rate = spin_rate(body);
  const CoverRanges& ranges = model.ranges(model.bodies[index]);
  for (std::uint32_t p = ranges.patch_begin; p < ranges.patch_end; ++p) {
    const Vec2 at = model.patch_star[p] + motion.patch_displacement[p] - body.u;
    motion.patch_velocity[p] = {velocity.x - spin * at.y, velocity.y + spin * at.x};
  }
  if (model.bodies[index].kinematics != Kinematics::rigid) body.spin = 0;
}

/// Takes all velocities at t_n but those that supports drive. Forces are found once more, for no dashpot
/// pushes what rests, and bodies start as at the begin of a run.
void Simulation::State::go_on_from_rest() {
  motion.stop();
  if (!settling) impose_at_once(model, mass, stage.supports, motion);
  const double behind = std::exchange(dt_behind, 0);
  from_rest = true;
  forces();
  from_rest = false;
  dt_behind = behind;
}

/// What acted until a stage begins takes bodies to their velocities at t_n, and is booked. Then all is found
/// once more with what is new, which has no part in the step behind; laws see that step as it was.
void Simulation::State::begin_due_stages() {
  if (settling) return;
  std::size_t begun = stages_begun;
  while (begun < scene.stages.size() && scene.stages[begun].from <= time * (1 + rounding)) ++begun;
  if (begun == stages_begun) return;
  const StageSettings& next = scene.stages[begun - 1].settings;
  if (sleep) sleep->begin_stage(next, time, sleeping_parts());
  Archive memory;
  exchange_memory(memory);
  velocities_at_stage = {motion.bodies, motion.patch_velocity};
  const double ahead = std::exchange(plan.dt, 0);
  forces();
  plan.dt = ahead;
  stages_begun = begun;
  springs_changed = enter_stage(next);
  impose_at_once(model, mass, stage.supports, motion);
  speeds = blocks.follow(model, contacts.drift(), motion);  // the first step is bounded by them, too
  take_velocities_at_stage();
  Archive former(memory.bytes());
  exchange_memory(former);
  contacts.set_supports(model, stage.supports);
  relaxation.forget();
  critical = votes.among(contacts.lightest_neighbours(), contacts.heaviest_neighbours());
  summary.critical_dt = std::min(summary.critical_dt, critical.dt);
  stage_begins = true;
}

/// What laws remember of the step before.
void Simulation::State::exchange_memory(Archive& archive) {
  contacts.exchange(archive, model);
  deformation.exchange(archive);
}

/// Those of the half step behind come in their place.
void Simulation::State::take_velocities_at_stage() {
  std::ranges::swap_ranges(motion.bodies, velocities_at_stage.bodies);
  std::ranges::swap_ranges(motion.patch_velocity, velocities_at_stage.patches);
}

bool Simulation::State::enter_stage(const StageSettings& next) {
  stage = next;
  const bool changed = contacts.set_interfaces(stage.interface_values);
  blocks.set_supports(stage.supports);
  votes = StepVote(scene, stage, model, contacts);
  loads = Loads(scene, stage, model);
  return changed;
}

}  // namespace talus
