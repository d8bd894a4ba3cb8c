#include "simulation/state.hpp"

#include "files/input_error.hpp"
#include "parallel/large_pages.hpp"
#include "scene/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace talus {
namespace {

constexpr double rounding = 1e-9;  ///< share by which a step may be stretched rather than split in two
/// Up to the next output: centuries of computing, and still a whole number in a double.
constexpr double countable_steps = 1e15;

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
      patch_velocity_at_step(model.patch_star.size()),
      start(scene.settle ? model.bodies.size() : 0),
      start_displacement(scene.settle ? model.patch_star.size() : 0),
      rotation(model.bodies.size(), 0.0),
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
  turned += dt_behind * speeds.relative / model.smallest_width;
  if (turned > 1) bring_rotation_up_to_date();
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

CriticalStep Simulation::State::with_numbers_outside(CriticalStep bound) const {
  bound.body = numbering.outside(bound.body);
  bound.spring_body = numbering.outside(bound.spring_body);
  return bound;
}

double Simulation::State::nominal_dt() const {
  if (scene.time.dt) return *scene.time.dt;
  const double dt = automatic_step(critical, scene.time.safety);
  return settings.largest_dt > 0 ? std::min(dt, settings.largest_dt) : dt;
}

/// The step fits the neighbours that bodies have: it is cut short at once where it must be, and grows with
/// the next plan.
void Simulation::State::vote_again() {
  critical = votes.among(contacts.lightest_neighbours(), contacts.heaviest_neighbours());
  if (scene.time.dt) return;
  const bool too_long = plan.dt > nominal_dt() * (1 + rounding);
  if (too_long || plan.done == 0) make_plan(plan.target);
}

/// v_rel Δt ≤ 0.1 h.
double Simulation::State::allowed_dt() const {
  return speeds.relative > 0 ? speed_share * model.smallest_width / speeds.relative
                             : std::numeric_limits<double>::infinity();
}

/// What cannot be run is refused before anything is written.
void Simulation::State::refuse_uncountable_steps() const {
  const double dt = scene.time.dt ? *scene.time.dt : automatic_step(votes.anyhow(), scene.time.safety);
  const auto refuse = [&](double span, const char* what) {
    if (span / dt <= countable_steps) return;
    throw InputError(fmt::format(
        "{} of {:.3g} s makes {:.3g} steps {} at {:.6g} s, more than any run can do: expected at most {:.0e}",
        scene.time.dt ? "/time/dt" : "the automatic step", dt, span / dt, what, span, countable_steps));
  };
  if (scene.settle) refuse(scene.settle->duration, "to the end of /settle");
  refuse(std::min(scene.output.history, scene.time.end), "to the first output");
}

/// At each output time, so nothing is put into words here.
void Simulation::State::make_plan(double end) {
  if (!(end > time)) {  // nowhere left to go: the velocity at the end looks ahead by the step it came with
    plan = {time, time, plan.dt, 1, 0, time};
    return;
  }
  double dt = nominal_dt();
  if (!scene.time.dt) limit = Limit::critical;
  if (!scene.time.dt && allowed_dt() < dt) {
    dt = allowed_dt();
    limit = Limit::speed;
  }
  planned_with = critical;
  const double target = end;
  // A stage a rounding before the output begins with it: no step is as short as that.
  if (!settling && stages_begun < scene.stages.size() &&
      scene.stages[stages_begun].from < target * (1 - rounding))
    end = std::min(end, scene.stages[stages_begun].from);
  const double span = end - time;
  const double wanted = std::max(1.0, std::ceil(span / dt * (1 - rounding)));
  if (!(wanted <= countable_steps)) {
    const std::string words = fmt::format(
        "from t = {:.6g} s to the next output at {:.6g} s there are {:.3g} steps of {:.3g} s, "
        "more than any run can do: expected at most {:.0e}",
        time, end, wanted, dt, countable_steps);
    if (dt_behind == 0) throw InputError(words);
    throw NumericalTrouble(words);
  }
  const auto steps = static_cast<std::uint64_t>(wanted);
  was_beside_stage = std::exchange(beside_stage, stage_begins || end < target);
  plan = {time, end, span / static_cast<double>(steps), steps, 0, target};
  // Of fixed steps that which limits the largest: what is left over at the end may be short.
  if (scene.time.dt && plan.dt > summary.dt)
    limit = span < dt * (1 - rounding) && !(end < target) ? Limit::output : Limit::scene;
  summary.dt = std::max(summary.dt, plan.dt);
}

std::string Simulation::State::limiter() const {
  switch (limit) {
    case Limit::none:
      return "";
    case Limit::scene:
      return "time.dt of the scene";
    case Limit::output:
      return "time between outputs; time.dt of the scene is longer";
    case Limit::speed:
      return "speed: no two bodies may approach by more than a tenth of the smallest width in a step";
    case Limit::critical:
      break;
  }
  return limiter_of_automatic(scene, planned_with);
}

void Simulation::State::remember_deepest() {
  if (!(contact_totals.penetration > summary.largest_penetration)) return;  // also where it is no number
  summary.largest_penetration = contact_totals.penetration;
  deepest_pair = {contact_totals.deepest_a, contact_totals.deepest_b};
}

/// Follows each body through full turns: the angle since the last time is less than half of one.
void Simulation::State::bring_rotation_up_to_date() {
  turned = 0;
  for (const std::uint32_t i : model.moving_bodies) {
    if (model.covered(i)) motion.average(model, i);
    // The angle of the polar rotation, less than half a turn from where it was.
    const Vec2 now = turn_of(motion.bodies[i].h);
    rotation[i] += std::remainder(std::atan2(now.y, now.x) - rotation[i], 2 * std::numbers::pi);
  }
}

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

}  // namespace talus
