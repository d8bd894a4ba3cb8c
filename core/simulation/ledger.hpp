#pragma once

#include "contact/contact_stage.hpp"
#include "simulation/deformation.hpp"
#include "simulation/integrator.hpp"
#include "simulation/loads.hpp"
#include "simulation/simulation.hpp"

namespace talus {

/// Books the energies of each step and judges the balance.
class LedgerKeeper {
 public:
  /// What is about t_n besides its forces.
  struct Occasion {
    bool stage_begins;     ///< t_n is booked for the second time, and differs by what the stage changed
    bool springs_changed;  ///< it made springs along contacts stiffer or softer
    /// To or from the stretch between a stage and an output, whose steps are of another length. K_n is by
    /// ⅛ Δt² aᵀ M a less than ½ vᵀ M v, which is no matter while steps are alike; a is another after the
    /// stage, so that the two changes do not cancel.
    bool step_changes;
    bool from_rest;  ///< t_n is booked for the second time, after velocities were taken
  };

  /// At t_n, once all parts of the step are known. Where a stage begins what then differs is the work of who
  /// changed the parameters, the loads and the supports; where velocities were taken, the kinetic
  /// energy that goes with them.
  void book(const ContactTotals& contact, const Deformation::Energy& strain, Loads& loads,
            const AccelerationWork& work, const Occasion& occasion);

  /// Bodies went to sleep after book(): their kinetic energy, and what damping was to take from them over the
  /// half of the step that lies ahead.
  void lose_asleep(double kinetic, double damping_ahead);

  /// Starts anew: what is stored now becomes the capital of t = 0.
  void reset() {
    const double floor = floor_;
    *this = LedgerKeeper{};
    floor_ = floor;
  }

  /// Energy below which nothing is judged, J/m: what rounding makes of a scene at rest.
  void set_floor(double floor) { floor_ = floor; }

  const EnergyLedger& ledger() const { return ledger_; }
  double share(double energy) const;  ///< of J/m in the throughput; 0 while nothing has moved
  double residual_share() const { return share(ledger_.residual); }

 private:
  double stored() const { return ledger_.kinetic + ledger_.strain + ledger_.contact; }
  double lost() const;

  EnergyLedger ledger_;
  struct Losses {
    double friction = 0, contact_damping = 0, material = 0;
  } since_last_;        ///< J/m, in the step behind, as last booked
  double initial_ = 0;  ///< J/m, kinetic and stored at t = 0
  double damping_ahead_ = 0, work_ahead_ = 0;
  double floor_ = 0;
  bool started_ = false, step_changed_ = false;
};

}  // namespace talus
