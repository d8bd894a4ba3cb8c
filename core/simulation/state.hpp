#pragma once

#include "contact/contact_stage.hpp"
#include "model/model.hpp"
#include "model/motion.hpp"
#include "simulation/deformation.hpp"
#include "simulation/integrator.hpp"
#include "simulation/ledger.hpp"
#include "simulation/loads.hpp"
#include "simulation/simulation.hpp"
#include "simulation/time_step.hpp"

namespace talus {

/// Everything a simulation holds.
struct Simulation::State {
  State(const Scene& scene, const RunSettings& settings);

  Scene scene;
  RunSettings settings;
  Model model;
  MotionState motion;
  ContactStage contacts;
  Deformation deformation;
  Loads loads;
  CriticalStep critical;

  double time = 0;       ///< s, t_n
  double dt_behind = 0;  ///< s, t_n − t_{n−1}; 0 at the start
  bool settling = false;
  bool fresh = true;         ///< no contact has been evaluated yet
  bool started = false;      ///< t = 0 has been reached
  std::uint64_t output = 0;  ///< number of the output time reached last

  /// Equal steps to a time that is hit exactly.
  struct Plan {
    double begin = 0, end = 0, dt = 0;
    std::uint64_t steps = 0, done = 0;
  };
  Plan plan;

  std::vector<BodyMotion> at_time;  ///< with the velocities at t_n
  std::vector<BodyMotion> start;    ///< motion at t = 0, which displacements count from
  std::vector<double> rotation;     ///< rad since t = 0, followed through full turns
  std::vector<Matrix2> last_turn;   ///< where `rotation` was brought up to date
  double turned = 0;                ///< rad, bound of what any body has turned since then

  MotionState::Speeds speeds;
  ContactTotals contact_totals;
  Deformation::Energy strain_energy;
  LedgerKeeper ledger;
  RunSummary summary;
  std::pair<std::uint32_t, std::uint32_t> deepest_pair{0, 0};  ///< bodies of the largest overlap so far

  void begin(double end);  ///< plans the way to the first target and finds the velocity at the present time
  void step(double next_end);  ///< one step; when it reaches its target it plans on to next_end
  void make_plan(double end);
  double nominal_dt() const;
  double allowed_dt() const;

  void forces();
  void remember_deepest();
  void check_step() const;
  void check_balance();
  void warn_of_large_step();
  void warn_of_initial_overlap();
  void bring_rotation_up_to_date();
  void set_initial_velocities();
  std::string place(std::uint32_t body) const;
};

}  // namespace talus
