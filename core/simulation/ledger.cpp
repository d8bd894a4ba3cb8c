#include "simulation/ledger.hpp"

#include <algorithm>
#include <cmath>

namespace talus {

void LedgerKeeper::book(const ContactTotals& contact, const Deformation::Energy& strain, Loads& loads,
                        const AccelerationWork& work, const Occasion& occasion) {
  EnergyLedger& l = ledger_;
  const double before = stored() + lost(), missed = l.residual, moved = l.kinetic;
  l.kinetic = work.kinetic;
  l.strain = strain.stored;
  l.contact = contact.stored + loads.stored();
  const Losses last = since_last_;
  since_last_ = {contact.slip_loss, contact.damping_loss, strain.dissipated};
  if (!started_) {
    // What was lost or done before t = 0 is no business of this ledger.
    initial_ = stored();
    started_ = true;
  } else if (occasion.from_rest) {
    l.global_damping_loss += moved - l.kinetic;
    // Without dashpots less friction holds.
    l.friction_loss += since_last_.friction;
    l.material_loss += since_last_.material;
  } else {
    // Those of the step behind are found anew where a stage begins.
    const Losses former = occasion.stage_begins ? last : Losses{};
    // A spring of other stiffness that bears the same force holds another energy, and a law that knows only
    // how much it held would call the difference slip.
    if (!occasion.springs_changed) l.friction_loss += since_last_.friction - former.friction;
    l.contact_damping_loss += since_last_.contact_damping - former.contact_damping;
    l.global_damping_loss += work.damping_loss + damping_ahead_;
    l.material_loss += since_last_.material - former.material;
    l.external_work +=
        occasion.stage_begins ? stored() + lost() - before : work.external_work + work_ahead_ + loads.work();
  }
  loads.reset_work();
  damping_ahead_ = work.damping_loss_ahead;
  work_ahead_ = work.external_work_ahead;

  l.residual = stored() + lost() - l.external_work - initial_;
  if (step_changed_) {
    initial_ += l.residual - missed;
    l.residual = missed;
  }
  step_changed_ = occasion.step_changes;
  l.throughput = std::max({l.throughput, initial_, stored() + lost(), std::abs(l.external_work)});
}

double LedgerKeeper::lost() const {
  const EnergyLedger& l = ledger_;
  return l.friction_loss + l.contact_damping_loss + l.global_damping_loss + l.material_loss + l.sleep_loss;
}

void LedgerKeeper::lose_asleep(double kinetic, double damping_ahead) {
  ledger_.sleep_loss += kinetic;
  ledger_.kinetic -= kinetic;
  damping_ahead_ -= damping_ahead;
}

double LedgerKeeper::share(double energy) const {
  const double scale = std::max(ledger_.throughput, floor_);
  return scale > 0 ? std::abs(energy) / scale : 0;
}

}  // namespace talus
