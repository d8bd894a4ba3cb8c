#pragma once

#include "archive/archive.hpp"
#include "scene/scene.hpp"
#include "simulation/profile.hpp"
#include "simulation/time_step.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus {

/// Numerical trouble that stops a run: what, which bodies, where, when, and what to change.
class NumericalTrouble : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct RunSettings {
  int threads = 1;
  bool neighbour_skin = true;  ///< off: candidate pairs are sought anew every step, for checking
  bool profile = false;        ///< take the time of each part of the steps
  double largest_dt = 0;       ///< s, cap on the automatic step; 0 for none
  /// Nobody asks for contacts() but the frames and monitors of the scene: without either none are kept.
  bool contacts_as_recorded = false;
};

/// Energies per metre of thickness, J/m, since t = 0.
struct EnergyLedger {
  double kinetic = 0;  ///< ½ v₋ᵀ M v₊
  double strain = 0;
  double contact = 0;  ///< stored in contact springs
  double friction_loss = 0, contact_damping_loss = 0, global_damping_loss = 0, material_loss = 0;
  double sleep_loss = 0;     ///< kinetic energy taken from islands that went to sleep
  double external_work = 0;  ///< gravity, loads, prescribed motion
  double residual = 0;       ///< what the sum above misses
  double throughput = 0;     ///< the largest energy in circulation so far; the residual is judged against it
};

/// What the ledger is made of, as it is written.
struct LedgerEntry {
  const char* name;
  double EnergyLedger::*value;
};
inline constexpr LedgerEntry ledger_entries[] = {
    {"kinetic", &EnergyLedger::kinetic},
    {"strain", &EnergyLedger::strain},
    {"contact", &EnergyLedger::contact},
    {"friction_loss", &EnergyLedger::friction_loss},
    {"contact_damping_loss", &EnergyLedger::contact_damping_loss},
    {"global_damping_loss", &EnergyLedger::global_damping_loss},
    {"material_loss", &EnergyLedger::material_loss},
    {"sleep_loss", &EnergyLedger::sleep_loss},
    {"external_work", &EnergyLedger::external_work},
    {"residual", &EnergyLedger::residual},
    {"throughput", &EnergyLedger::throughput},
};

/// Motion of a body or of a material point at t_n; velocity is ½(v₋ + v₊). Displacement since t = 0.
struct Motion {
  Vec2 position;  ///< m, without the scene's origin
  Vec2 displacement, velocity;
  double rotation;  ///< rad since t = 0, counter-clockwise
  /// Pa, Cauchy, area mean of the body; 0 for rigid bodies.
  double stress_xx = 0, stress_yy = 0, stress_xy = 0;
};

/// A point of a body at t_n: m without the scene's origin, m since t = 0, m/s.
struct PartPoint {
  Vec2 position, displacement, velocity;
};

/// A part of a body that strains uniformly: a manifold element, or the whole body.
struct BodyPart {
  std::vector<std::vector<PartPoint>> loops;  ///< outer ones counter-clockwise, holes clockwise
  std::array<double, 3> stress;               ///< Pa, Cauchy xx, yy, xy
};

/// A contact at t_n, positions without the scene's origin.
struct Contact {
  std::uint32_t body_a, body_b;
  Vec2 point, normal_force, tangential_force;  ///< m, N/m on body b
  double penetration;
  bool slipping;
  double moment;  ///< N, of all that acts on body b, about the point
};

/// The deepest overlap of two bodies at t_n; none of depth 0.
struct DeepestOverlap {
  std::uint32_t body_a, body_b;
  double penetration;  ///< m
};

/// Islands that slept. The bounds hold where accelerations would not have grown: v + a T and v T + a T²/2 of
/// the fastest corner of an island and of the one that accelerated most when it went to sleep.
struct SleepReport {
  std::uint64_t islands = 0, woken = 0;  ///< counted each time
  std::size_t bodies_asleep = 0;         ///< at the end
  double longest = 0;                    ///< s
  double body_time = 0;                  ///< s, of all bodies together
  double speed = 0, acceleration = 0;    ///< m/s and m/s² of a corner, the largest not followed
  double velocity_bound = 0;             ///< m/s
  double displacement_bound = 0;         ///< m
  double kinetic_energy = 0;             ///< J/m that was taken
};

struct RunSummary {
  std::uint64_t steps = 0, settle_steps = 0;
  std::uint64_t pair_searches = 0;
  double dt = 0;                   ///< s, the largest step taken
  std::string dt_limiter;          ///< who limited it, in words
  double critical_dt = 0;          ///< s, bound of the scene
  double largest_penetration = 0;  ///< m, of the run; of settling until that is over
  std::string largest_penetration_pair;
  double largest_residual_share = 0;  ///< of the throughput
  std::vector<std::string> warnings;
  std::optional<SleepReport> sleep;  ///< where the scene lets islands sleep
  Profile profile{false};
};

/// Displacements and the like of every body, to start another run from the same settled geometry.
struct Geometry {
  std::vector<double> unknowns;
  std::vector<double> stars;             ///< [patch, component] m, in the order of their displacements
  std::vector<double> memory;            ///< of the materials; used where both have the same
  std::vector<std::uint32_t> own_end;    ///< [body] of its patches, for the memory: elements go by it
  std::vector<std::uint32_t> numbering;  ///< of the bodies, for the memory
};

/// Asked once per step whether to leave off after it.
using Pause = std::function<bool()>;

/// A scene in motion. advance() runs to the next output time and leaves the state at t_n in reach.
class Simulation {
 public:
  Simulation(Scene scene, const RunSettings& settings);
  ~Simulation();
  Simulation(Simulation&&) noexcept;

  const Scene& scene() const;

  /// Starts from the geometry another run settled into; before settle(). Takes nothing and returns why where
  /// the scenes differ in their bodies' covers, or where bodies are bonded: bonds form where these are drawn,
  /// and bear what they have moved since. Else "".
  std::string take_geometry(const Geometry& geometry);
  Geometry geometry() const;

  /// The settle stage, if the scene asks for one; friction held stuck, then velocities and clock to zero.
  /// False where it was left off; the next call goes on.
  bool settle(const Pause& pause = {});

  /// Runs to the next output time (the first call: to t = 0). False when the end was reached before. Where it
  /// was left off between two output times the next call goes on. Throws NumericalTrouble.
  bool advance(const Pause& pause = {});

  /// After advance() was left off: makes motions of the present time fit to be looked at. The way there is no
  /// longer the same to the last bit. False where the last step was not made to be looked at: velocities at
  /// t_n, stresses and contacts are then those of an earlier one.
  bool look_now();

  double time() const;                 ///< s
  bool history_due() const;            ///< whether this is an output time of the history
  bool frame_due() const;              ///< whether it is one of the frames
  bool started() const;                ///< whether t = 0 was reached
  double critical_dt() const;          ///< s, bound over strain modes and contacts, whoever meets whom
  double last_dt() const;              ///< s, of the step that led here; 0 at the start
  CriticalStep present_bound() const;  ///< of the stable step, with the neighbours that bodies have now
  /// The same, were a stage to hold now.
  CriticalStep bound_of_stage(std::size_t stage);
  double automatic_dt() const;            ///< s, what "auto" takes as long as nothing moves too fast for it
  std::string automatic_limiter() const;  ///< who limits automatic_dt(), in words
  std::string model_hash() const;         ///< of the bodies as they were laid, before they moved
  std::string state_hash() const;         ///< of displacements, velocities and contact history

  std::size_t body_count() const;
  std::size_t block_count() const;            ///< bodies with unknowns
  double body_width(std::size_t body) const;  ///< m, see Body::width
  Motion body_motion(std::size_t body) const;
  Motion point_motion(std::size_t body, Vec2 point_at_start) const;
  /// Of a monitor of the scene; stress is 0 where it does not record that.
  Motion monitor_motion(std::size_t monitor) const;
  std::vector<BodyPart> parts(std::size_t body) const;
  std::vector<std::uint32_t> fragments(std::size_t body) const;  ///< [part] see fragments_of()
  /// [point] of parts(), loop after loop, see talus::distinct_points(); empty where the body moves as a
  /// whole.
  std::vector<std::uint32_t> distinct_points(std::size_t body) const;
  std::size_t patch_count() const;
  std::size_t element_count() const;
  /// What resists the turning of a body as it is drawn, over its moment of inertia; more than 1 on many
  /// elements, whose masses are row sums.
  double inertia_share(std::size_t body) const;
  std::vector<SliverEffect> slivers() const;  ///< of the bodies that have any
  std::size_t pair_count() const;             ///< of bodies that are near each other, found last
  std::size_t touching_pair_count() const;    ///< of those that the last step found in contact
  DeepestOverlap deepest_overlap() const;
  std::vector<Contact> contacts() const;
  const EnergyLedger& ledger() const;

  /// All that the coming steps depend on. What was put in at any time between two steps makes another
  /// simulation of the same scene go on with the same bits. Throws InputError where it does not fit.
  void exchange(Archive& archive);

  RunSummary summary() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace talus
