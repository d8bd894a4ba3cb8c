#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "simulation/blocks.hpp"
#include "simulation/deformation.hpp"
#include "simulation/integrator.hpp"
#include "simulation/ledger.hpp"
#include "simulation/loads.hpp"
#include "simulation/numbering.hpp"
#include "simulation/patch_mass.hpp"
#include "simulation/profile.hpp"
#include "simulation/relaxation.hpp"
#include "simulation/simulation.hpp"
#include "simulation/since_start.hpp"
#include "simulation/sleep.hpp"
#include "simulation/time_step.hpp"

#include <optional>

namespace talus {

/// Everything a simulation holds.
struct Simulation::State {
  State(Scene scene, const RunSettings& settings);

  Numbering numbering;            ///< the only numbers that leave are those of the scene as it was given
  std::optional<Scene> as_given;  ///< where bodies have other numbers within
  Scene scene;
  RunSettings settings;
  StageSettings stage;  ///< what holds now
  Workers workers;
  Model model;
  MotionState motion;
  Blocks blocks;
  PatchMass mass;
  ContactStage contacts;
  Deformation deformation;
  Loads loads;
  Relaxation relaxation;
  StepVote votes;
  CriticalStep critical;  ///< with the neighbours that bodies have now
  std::optional<Sleep> sleep;

  // Where it stands.
  double time = 0;       ///< s, t_n
  double dt_behind = 0;  ///< s, t_n − t_{n−1}; 0 at the start
  bool settling = false;
  bool settle_over = false;  ///< there is nothing left of the settle stage
  bool started = false;      ///< t = 0 has been reached
  bool fresh = true;         ///< no contact has been evaluated yet
  std::uint64_t output = 0;  ///< number of the output time reached last
  SinceStart since_start;

  // Who looks.
  bool watched = false;                      ///< the coming step is the last before the state is looked at
  bool observed = true;                      ///< somebody may look at t_n
  bool to_be_seen = false;                   ///< t_n was observed, and all of it is there
  bool velocities_left = false;              ///< MotionState::velocity_at_step() is that of t_n
  std::vector<Vec2> patch_velocity_at_step;  ///< [patch] m/s, at t_n
  std::vector<std::uint32_t> monitored_elements;  ///< [monitor] that its point is in, see element_at()

  /// Equal steps to a time that is hit exactly.
  struct Plan {
    double begin = 0, end = 0, dt = 0;
    std::uint64_t steps = 0, done = 0;
    double target = 0;  ///< s, the output time; later than `end` where a stage begins before
  };
  Plan plan;
  bool beside_stage = false;      ///< the plan begins or ends at a stage
  bool was_beside_stage = false;  ///< that before did
  enum class Limit { none, scene, speed, critical, output };
  Limit limit = Limit::none;    ///< what made the step of the plan as short as it is
  CriticalStep planned_with{};  ///< the bound then

  // Where a stage begins, or velocities are taken; flags are for the coming forces().
  std::size_t stages_begun = 0;
  bool stage_begins = false, springs_changed = false;
  struct {
    std::vector<BodyMotion> bodies;
    std::vector<Vec2> patches;  ///< [patch] m/s
  } velocities_at_stage;
  bool past_peak = false;  ///< kinetic damping: velocities are to be taken
  bool from_rest = false;  ///< they were, at this t_n

  // What was found at t_n, and the books.
  MotionState::Speeds speeds;
  ContactTotals contact_totals;
  Deformation::Energy strain_energy;
  Vec2 last_gravity;            ///< m/s², at t_{n−1}
  double unbalanced_share = 0;  ///< unbalanced over applied force, while settling
  LedgerKeeper ledger;
  Profile profile;
  RunSummary summary;
  std::pair<std::uint32_t, std::uint32_t> deepest_pair{0, 0};  ///< bodies of the largest overlap so far
  bool told_of_thin_ground = false;

  /// Of the smallest width, that two bodies may approach in a step.
  static constexpr double speed_share = 0.1;
  /// Times the allowed step: plan anew, or stop where the step is fixed.
  static constexpr double too_fast = 1.5;
  /// Of the smallest width: who moves so far in a step may have passed through another body.
  static constexpr double passed_share = 0.5;
  /// Share by which a step may be stretched rather than split in two, and of a time that is no time.
  static constexpr double rounding = 1e-9;

  // state.cpp: one step.
  void begin(double end);  ///< plans the way to the first target and finds the velocity at the present time
  void step(double next_end);  ///< one step; when it reaches its target it plans on to next_end
  void forces();
  void follow_boundaries();
  void find_pairs();
  void evaluate_contacts();
  void apply_loads();
  StepConditions conditions_ahead();
  void book(const AccelerationWork& work, const StepConditions& conditions, bool sleeps);
  void remember_deepest();
  bool may_sleep() const;
  Sleep::Parts sleeping_parts() { return {model, blocks, contacts, deformation, motion}; }
  const Damping& damping() const;  ///< of the settle stage or of the run
  bool forces_first() const;
  bool settled() const;
  double energy_floor() const;
  Vec2 gravity() const;
  StepSpan step_span() const;
  /// s of the step behind over whose second half the forces of t_n act.
  double pushed_behind() const { return stage_begins ? 0 : dt_behind; }

  // planned_state.cpp: how long steps are.
  void make_plan(double end);
  std::string limiter() const;  ///< of the plan's step, in words
  void vote_again();
  double nominal_dt() const;
  double allowed_dt() const;
  CriticalStep with_numbers_outside(CriticalStep bound) const;
  void refuse_uncountable_steps() const;

  // staged_state.cpp: what happens at once.
  void set_initial_velocities();
  void set_rigid_motion(std::size_t body, Vec2 velocity, double spin);
  void go_on_from_rest();
  void begin_due_stages();
  bool enter_stage(const StageSettings& next);  ///< true when springs along contacts have other stiffness
  void exchange_memory(Archive& archive);
  void take_velocities_at_stage();

  // checked_state.cpp: trouble and warnings.
  void check_numbers() const;
  void check_shapes() const;
  void refuse_inside_out() const;
  void check_law() const;
  void check_materials(double kinetic) const;
  void check_step() const;
  void check_stored() const;
  void check_balance();
  void warn_of_large_step();
  void warn_of_initial_overlap();
  void warn_of_settlement();
  void warn_of_unbalanced_settling();
  void warn_of_thin_ground();
  std::string above_critical() const;
  std::string place(std::uint32_t body) const;
  std::string without_number() const;

  // seen_motion.cpp: what monitors and frames show.
  PartPoint point(const MaterialPoint& at, Vec2 as_drawn) const;
  /// Without stress: of the centre of mass, or of a point and the element it is in.
  Motion motion_of(std::uint32_t body) const;
  Motion motion_of(std::uint32_t body, std::uint32_t element, Vec2 as_drawn) const;
  /// Of a body of many elements; of others it stands for nothing.
  std::uint32_t element_at(std::uint32_t body, Vec2 as_drawn) const;
  std::array<double, 3> stress_of(std::uint32_t body, std::uint32_t element) const;
  std::vector<std::uint32_t> elements_of_monitors() const;

  // kept_state.cpp: between steps; see Simulation::exchange().
  void exchange_clock(Archive& archive);
  void exchange_books(Archive& archive);
};

}  // namespace talus
