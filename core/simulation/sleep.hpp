#pragma once

#include "contact/contact_stage.hpp"
#include "simulation/blocks.hpp"
#include "simulation/deformation.hpp"
#include "simulation/integrator.hpp"
#include "simulation/simulation.hpp"

#include <span>
#include <vector>

namespace talus {

/// Puts islands at rest to sleep and wakes them. An island is a set of moving bodies that hang together by
/// contact. While it sleeps its bodies stand, and neither they nor the contacts among them are evaluated;
/// what is stored in them stays in the ledger. It wakes when a contact with another body appears, and at each
/// change of what acts on all: gravity, the motion of the ground, a stage.
class Sleep {
 public:
  Sleep(const SleepSettings& settings, const Model& model, const StageSettings& stage);

  /// What is told of the bodies that sleep, and whose state stands.
  struct Parts {
    const Model& model;
    Blocks& blocks;
    ContactStage& contacts;
    Deformation& deformation;
    MotionState& motion;
  };

  /// From now on these loads and supports hold; wakes all.
  void begin_stage(const StageSettings& stage, double time, Parts parts);

  /// Once boundaries have followed the motion: which bodies are too fast. Other gravity wakes all.
  void watch(double time, Vec2 gravity, Workers& workers, Parts parts);
  /// Whether it is time to look for islands at rest. They are sought seldom.
  bool due(double time) const { return time >= next_look_; }
  void wake(std::span<const std::uint32_t> islands, double time, Parts parts);

  /// The velocity update of a step of even length in which it is due comes next: chooses the islands whose
  /// bodies have been at rest for long enough and keeps their velocities.
  void choose(double time, Parts parts);
  /// What going to sleep took from the bodies, J/m.
  struct Taken {
    double kinetic = 0, damping_loss_ahead = 0;  ///< K_n; see AccelerationWork
  };
  /// After the update: those that hardly accelerate go to sleep.
  Taken put_to_sleep(double time, const StepConditions& conditions, Parts parts);

  void exchange(Archive& archive, Parts parts);

  double contact_energy() const { return contact_energy_; }  ///< J/m in what sleeps
  double strain_energy() const { return strain_energy_; }
  SleepReport report(double time) const;

 private:
  struct Island {
    std::uint32_t number;
    double since;                ///< s
    double speed, acceleration;  ///< m/s and m/s², the largest of a corner when it went to sleep
    std::size_t bodies = 0;
    double contact_energy = 0, strain_energy = 0;  ///< J/m
  };
  /// m/s and m/s², the largest of a corner of an island.
  struct Pace {
    double speed = 0, acceleration = 0;
  };
  void exempt(const StageSettings& stage);
  std::uint32_t root(std::uint32_t body);
  std::vector<Pace> paces(double dt, Parts parts);  ///< [root] of those chosen
  /// Takes from a body that was chosen, by its entry, what moves it.
  void lay_down(std::size_t chosen, Island& island, const StepConditions& conditions, Parts parts,
                Taken& taken);
  /// Of islands that sleep since this time.
  void take_contact_energy(double time, Parts parts);
  void enter(const Island& island, double time, SleepReport& report) const;
  void tell(Parts parts);
  void add_up();

  SleepSettings settings_;
  std::vector<double> quiet_since_;    ///< [body] s; later than now: not looked at before
  std::vector<double> awake_until_;    ///< [body] s, kept awake before by what acts on it
  std::vector<std::uint32_t> island_;  ///< [body] number of the island that sleeps; 0: awake
  std::vector<Island> islands_;        ///< those that sleep, in the order of their numbers
  std::uint32_t last_number_ = 0;
  double next_look_ = 0;   ///< s
  double calm_since_ = 0;  ///< s, last change of gravity or of the stage
  Vec2 gravity_;
  double contact_energy_ = 0, strain_energy_ = 0;
  SleepReport past_;  ///< of the islands that woke

  std::vector<std::uint32_t> parent_;  ///< [body] towards the root of its island, while choosing
  std::vector<std::uint32_t> chosen_;  ///< bodies
  std::vector<BodyMotion> before_;     ///< [entry of chosen_] with v₋
};

}  // namespace talus
