#include "simulation/state.hpp"

#include "parallel/large_pages.hpp"
#include "scene/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus {
namespace {

/// What each step of a body of many elements reads and writes in memory.
void lay_in_large_pages(const Partition& partition, const MotionState& motion) {
  for (const auto* values : {&motion.patch_displacement, &motion.patch_velocity}) prefer_large_pages(*values);
  prefer_large_pages(partition.corner);
  for (const auto& values : partition.gradient) prefer_large_pages(values);
  prefer_large_pages(partition.area);
}

/// Thin ground is found by them, too.
bool contacts_are_seen(const Scene& scene, const Model& model, const RunSettings& settings) {
  return !settings.contacts_as_recorded || scene.output.frames || !model.covered_bodies.empty() ||
         std::ranges::any_of(scene.monitors, sees_contacts);
}

}  // namespace

Simulation::State::State(Scene scene_in, const RunSettings& settings_in)
    : numbering(numbering_of(scene_in)),
      as_given(numbering.outer.empty() ? std::nullopt : std::optional(scene_in)),
      scene(renumbered(std::move(scene_in), numbering)),
      settings(settings_in),
      stage(settings_of(scene)),
      workers(settings.threads),
      model(build_model(scene, numbering.outer)),
      motion(model),
      blocks(model, scene.simd, workers, scene.contact.component != nullptr || scene.sleep),
      mass(model),
      contacts(scene, model, workers, settings.neighbour_skin, scene.simd,
               contacts_are_seen(scene, model, settings)),
      deformation(scene, model, workers),
      loads(scene, stage, model),
      votes(scene, stage, model, contacts),
      critical(votes.anyhow()),
      since_start(model, scene.settle.has_value()),
      patch_velocity_at_step(model.patch_star.size()),
      monitored_elements(elements_of_monitors()),
      profile(settings.profile) {
  if (scene.sleep) {
    sleep.emplace(*scene.sleep, model, stage);
    deformation.keep_energies(model);
  }
  summary.critical_dt = critical.dt;
  ledger.set_floor(energy_floor());
  blocks.set_supports(stage.supports);
  // Corners have both, and none but the votes of a later stage asks the model.
  std::vector<std::uint32_t>().swap(model.cut);
  if (scene.stages.empty()) std::vector<std::uint32_t>().swap(model.surface);
  lay_in_large_pages(model.partition, motion);
}

/// One step of the explicit method, t_n to t_{n+1}, and the velocity there.
void Simulation::State::step(double next_end) {
  profile.enter(Phase::move);
  move(model, plan.dt, blocks, motion);  // Eq. 22
  dt_behind = plan.dt;
  ++plan.done;
  ++(settling ? summary.settle_steps : summary.steps);
  time = plan.done == plan.steps ? plan.end : plan.begin + static_cast<double>(plan.done) * plan.dt;
  begin_due_stages();
  if (plan.done == plan.steps) {
    make_plan(plan.end < plan.target ? plan.target : next_end);
  } else if (!scene.time.dt && plan.dt > too_fast * allowed_dt()) {
    make_plan(plan.target);
  }
  forces();
  if (past_peak) go_on_from_rest();
  remember_deepest();
  check_step();
  profile.leave();
  if (settling) return;
  // The corners of a body that spins differ in speed by its spin times its width or more.
  since_start.follow(dt_behind * speeds.relative / model.smallest_width, model, motion);
}

void Simulation::State::begin(double end) {
  dt_behind = 0;
  speeds = blocks.follow(model, contacts.drift(), motion);  // the first step is bounded by them, too
  make_plan(end);
  forces();
  check_step();
  profile.leave();
}

/// The right-hand side of Eq. 16 and the velocity update.
void Simulation::State::forces() {
  follow_boundaries();  // Eq. 11
  find_pairs();         // Table 1, 1
  const bool may_sleep_now = may_sleep();
  observed = observed || may_sleep_now;
  evaluate_contacts();  // Eqs. 28–48
  apply_loads();        // Eqs. 19–20
  profile.enter(Phase::materials);
  const bool first = forces_first();
  if (first) strain_energy = deformation.apply(model, motion, dt_behind, observed);  // Eq. 18
  const StepConditions conditions = conditions_ahead();
  if (!first)
    strain_energy = deformation.apply_and_update(model, mass, stage.supports, conditions, dt_behind, observed,
                                                 motion, patch_velocity_at_step);  // Eqs. 18, 23–24
  check_shapes();
  if (sleep) strain_energy.stored += sleep->strain_energy();
  profile.enter(Phase::velocities);
  if (may_sleep_now) sleep->choose(time, sleeping_parts());
  const AccelerationWork work = accelerate(model, mass, stage.supports, conditions, observed, blocks, motion,
                                           patch_velocity_at_step, deformation.updated());  // Eqs. 23–24
  book(work, conditions, may_sleep_now);
}

void Simulation::State::follow_boundaries() {
  to_be_seen = velocities_left = false;
  observed = watched || plan.done == 0;
  profile.enter(Phase::boundary);
  motion.clear_patch_forces(model);
  speeds = blocks.follow(model, contacts.drift(), motion);
  check_numbers();
}

void Simulation::State::find_pairs() {
  if (sleep && !settling) sleep->watch(time, gravity(), workers, sleeping_parts());
  profile.enter(Phase::neighbours);
  if (contacts.find_pairs(model, motion, dt_behind, speeds)) vote_again();
}

void Simulation::State::evaluate_contacts() {
  profile.enter(Phase::contacts);
  const bool hold_stick = settling && scene.settle->hold_stick;
  const ContactStage::Conditions conditions{dt_behind, hold_stick, fresh || settling, observed};
  contact_totals = contacts.evaluate(model, motion, conditions);
  if (sleep) {
    sleep->wake(contacts.touched(), time, sleeping_parts());
    contact_totals.stored += sleep->contact_energy();
  }
  if (plan.done == 0 && !settling) warn_of_thin_ground();  // not where a checkpoint happens to be due
  check_law();
}

void Simulation::State::apply_loads() {
  profile.enter(Phase::loads);
  loads.apply(motion, step_span(), dt_behind);
}

/// What the velocities are updated with. Where all forces are known by now, they tell whether it is settled
/// and how much damping there is.
StepConditions Simulation::State::conditions_ahead() {
  const Vec2 pull = gravity();
  if (settling && scene.settle->until) {
    const double unbalanced = relaxation.unbalanced(model, mass, motion, stage.supports, pull);
    const double driving = Relaxation::weight(model, pull) + loads.applied();
    unbalanced_share = unbalanced > 0 ? unbalanced / (driving > 0 ? driving : loads.reactions()) : 0;
  }
  const double constant = relaxation.damping(damping(), model, mass, motion, dt_behind, critical.lambda);
  if (stage_begins) {
    take_velocities_at_stage();
    velocities_at_stage = {};  // not until the next stage
  }
  return {pull, fresh ? pull : last_gravity, constant, pushed_behind(), plan.dt, !settling};
}

/// The energies of t_n, and those that what goes to sleep now takes along.
void Simulation::State::book(const AccelerationWork& work, const StepConditions& conditions, bool sleeps) {
  profile.enter(Phase::books);
  check_materials(work.kinetic);
  const bool step_changes = (beside_stage || was_beside_stage) && conditions.dt_behind > 0 &&
                            conditions.dt_ahead > 0 && conditions.dt_behind != conditions.dt_ahead;
  ledger.book(contact_totals, strain_energy, loads, work,
              {stage_begins, springs_changed, step_changes, from_rest});
  Sleep::Taken taken{};
  if (sleeps) {
    taken = sleep->put_to_sleep(time, conditions, sleeping_parts());
    ledger.lose_asleep(taken.kinetic, taken.damping_loss_ahead);
  }
  last_gravity = conditions.gravity;
  past_peak = relaxation.past_peak(damping(), work.kinetic, taken.kinetic);
  profile.enter(Phase::checks);
  fresh = stage_begins = springs_changed = false;
  to_be_seen = velocities_left = observed;
}

/// Islands go to sleep in steps as long as the one before, of which velocities at t_n are kept.
bool Simulation::State::may_sleep() const {
  return sleep && !settling && !stage_begins && dt_behind > 0 && dt_behind == plan.dt && sleep->due(time);
}

const Damping& Simulation::State::damping() const {
  return settling ? scene.settle->damping : stage.damping;
}

/// Whether all forces have to be known before any patch can go on.
bool Simulation::State::forces_first() const {
  return damping().kind == Damping::Kind::adaptive || (settling && scene.settle->until);
}

/// What rounding makes of a body at rest: its weight by 1e-12 of its width, and motion by 1e-13 of its width
/// in a critical step.
double Simulation::State::energy_floor() const {
  const double pull = std::sqrt(scene.gravity.x * scene.gravity.x + scene.gravity.y * scene.gravity.y);
  double floor = 0;
  for (const Body& body : model.bodies) {
    const double speed = std::isfinite(critical.dt) ? 1e-13 * body.width / critical.dt : 0;
    floor += body.mass * (1e-12 * pull * body.width + speed * speed);
  }
  return floor;
}

/// Of the frame that moves with the ground.
Vec2 Simulation::State::gravity() const {
  if (stage.base_acceleration[0].zero() && stage.base_acceleration[1].zero()) return stage.gravity;
  return {stage.gravity.x - stage.base_acceleration[0].over(step_span(), {}),
          stage.gravity.y - stage.base_acceleration[1].over(step_span(), {})};
}

/// While the scene settles all that depends on time is as at the start.
StepSpan Simulation::State::step_span() const {
  return settling ? StepSpan(0, 0, 0) : StepSpan(time, pushed_behind(), plan.dt);
}

bool Simulation::State::settled() const {
  return scene.settle->until && summary.settle_steps > 0 && unbalanced_share < *scene.settle->until;
}

void Simulation::State::remember_deepest() {
  if (!(contact_totals.penetration > summary.largest_penetration)) return;  // also where it is no number
  summary.largest_penetration = contact_totals.penetration;
  deepest_pair = {contact_totals.deepest_a, contact_totals.deepest_b};
}

}  // namespace talus
