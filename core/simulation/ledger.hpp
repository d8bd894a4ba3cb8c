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
  /// At t_n, once all parts of the step are known.
  void book(const ContactTotals& contact, const Deformation::Energy& strain, Loads& loads,
            const AccelerationWork& work);

  /// All velocities were just set to zero: their energy counts as taken by global damping.
  void lose_kinetic();

  /// Starts anew: what is stored now becomes the capital of t = 0.
  void reset() { *this = LedgerKeeper{}; }

  const EnergyLedger& ledger() const { return ledger_; }
  double residual_share() const;  ///< of the throughput; 0 while nothing has moved

 private:
  EnergyLedger ledger_;
  double initial_ = 0;  ///< J/m, kinetic and stored at t = 0
  double damping_ahead_ = 0, work_ahead_ = 0;
  bool started_ = false;
};

}  // namespace talus
