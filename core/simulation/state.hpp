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

  double time = 0;       ///< s, t_n
  double dt_behind = 0;  ///< s, t_n − t_{n−1}; 0 at the start
  bool settling = false;
  bool settle_over = false;      ///< there is nothing left of the settle stage
  bool fresh = true;             ///< no contact has been evaluated yet
  bool observed = true;          ///< somebody may look at t_n
  bool to_be_seen = false;       ///< t_n was observed, and all of it is there
  bool velocities_left = false;  ///< MotionState::velocity_at_step() is that of t_n
  bool started = false;          ///< t = 0 has been reached
  bool watched = false;          ///< the coming step is the last before the state is looked at
  std::uint64_t output = 0;      ///< number of the output time reached last

  /// Equal steps to a time that is hit exactly.
  struct Plan {
    double begin = 0, end = 0, dt = 0;
    std::uint64_t steps = 0, done = 0;
    double target = 0;  ///< s, the output time; later than `end` where a stage begins before
  };
  Plan plan;
  bool beside_stage = false,
       was_beside_stage = false;  ///< whether the plan begins or ends at one; that before
  enum class Limit { none, scene, speed, critical, output };
  Limit limit = Limit::none;    ///< what made the step of the plan as short as it is
  CriticalStep planned_with{};  ///< the bound then

  std::vector<Vec2> patch_velocity_at_step;  ///< [patch] m/s, at t_n
  // Motion at t = 0, which displacements count from; empty where nothing settles.
  std::vector<BodyMotion> start;
  std::vector<Vec2> start_displacement;  ///< [patch]
  std::size_t stages_begun = 0;
  // At t_n, for the coming forces().
  bool stage_begins = false, springs_changed = false;
  bool told_of_thin_ground = false;
  bool past_peak = false;  ///< kinetic damping: velocities are to be taken
  bool from_rest = false;  ///< they were, at this t_n
  struct {
    std::vector<BodyMotion> bodies;
    std::vector<Vec2> patches;  ///< [patch] m/s
  } velocities_at_stage;
  Vec2 last_gravity;             ///< m/s², at t_{n−1}
  double unbalanced_share = 0;   ///< unbalanced over applied force, while settling
  std::vector<double> rotation;  ///< [body] rad from the shape it is drawn in, followed through full turns
  std::vector<double>
      rotation_at_start;  ///< [body] rad, at t = 0; empty where bodies start as they are drawn
  std::vector<std::uint32_t> monitored_elements;  ///< [monitor] that its point is in, see element_at()
  double turned = 0;                              ///< rad, bound of what any body has turned since then

  MotionState::Speeds speeds;
  ContactTotals contact_totals;
  Deformation::Energy strain_energy;
  LedgerKeeper ledger;
  Profile profile;
  RunSummary summary;
  std::pair<std::uint32_t, std::uint32_t> deepest_pair{0, 0};  ///< bodies of the largest overlap so far

  /// Of the smallest width, that two bodies may approach in a step.
  static constexpr double speed_share = 0.1;
  /// Times the allowed step: plan anew, or stop where the step is fixed.
  static constexpr double too_fast = 1.5;
  /// Of the smallest width: who moves so far in a step may have passed through another body.
  static constexpr double passed_share = 0.5;

  void begin(double end);  ///< plans the way to the first target and finds the velocity at the present time
  void step(double next_end);  ///< one step; when it reaches its target it plans on to next_end
  void make_plan(double end);
  std::string limiter() const;  ///< of the plan's step, in words
  void vote_again();
  double nominal_dt() const;
  CriticalStep with_numbers_outside(CriticalStep bound) const;
  double allowed_dt() const;
  void refuse_uncountable_steps() const;

  void forces();
  void follow_boundaries();
  void find_pairs();
  void evaluate_contacts();
  void apply_loads();
  StepConditions conditions_ahead();
  void book(const AccelerationWork& work, const StepConditions& conditions, bool sleeps);
  const Damping& damping() const;  ///< of the settle stage or of the run
  bool forces_first() const;
  void begin_due_stages();
  void exchange_memory(Archive& archive);
  void take_velocities_at_stage();
  /// s of the step behind over whose second half the forces of t_n act.
  double pushed_behind() const { return stage_begins ? 0 : dt_behind; }
  bool enter_stage(const StageSettings& next);  ///< true when springs along contacts have other stiffness
  Vec2 gravity() const;
  StepSpan step_span() const;
  bool settled() const;
  bool may_sleep() const;
  Sleep::Parts sleeping_parts() { return {model, blocks, contacts, deformation, motion}; }
  double energy_floor() const;
  void remember_deepest();
  void check_numbers() const;
  void check_shapes() const;
  void refuse_inside_out() const;
  void check_law() const;
  void check_materials(double kinetic) const;
  void check_step() const;
  std::string above_critical() const;
  void check_stored() const;
  void check_balance();
  void warn_of_large_step();
  void warn_of_initial_overlap();
  void warn_of_settlement();
  void warn_of_unbalanced_settling();
  void warn_of_thin_ground();
  void bring_rotation_up_to_date();
  double rotation_since_start(std::uint32_t body) const;  ///< rad
  PartPoint point(const MaterialPoint& at, Vec2 as_drawn) const;
  /// Without stress: of the centre of mass, or of a point and the element it is in.
  Motion motion_of(std::uint32_t body) const;
  Motion motion_of(std::uint32_t body, std::uint32_t element, Vec2 as_drawn) const;
  /// Of a body of many elements; of others it stands for nothing.
  std::uint32_t element_at(std::uint32_t body, Vec2 as_drawn) const;
  std::array<double, 3> stress_of(std::uint32_t body, std::uint32_t element) const;
  std::vector<std::uint32_t> elements_of_monitors() const;
  Vec2 displacement_at_start(std::uint32_t body, Vec2 reference) const;
  Vec2 displacement_at_start(const Carrier& carrier) const;
  void set_initial_velocities();
  void set_rigid_motion(std::size_t body, Vec2 velocity, double spin);
  void go_on_from_rest();
  std::string place(std::uint32_t body) const;
  std::string without_number() const;

  // Between steps; see Simulation::exchange().
  void exchange_clock(Archive& archive);
  void exchange_books(Archive& archive);
};

}  // namespace talus
