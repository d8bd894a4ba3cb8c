#include "conformance/boundary_arrays.hpp"
#include "conformance/contact_energy.hpp"
#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace talus::conformance {
namespace {

/// m/s, by which corners of the two bodies differ at most.
double fastest_approach(const std::vector<HeldBody>& bodies) {
  const BoundaryArrays arrays(bodies);
  double most = 0;
  for (std::size_t i = 0; i < arrays.corners.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (arrays.corner_body[i] == arrays.corner_body[j]) continue;
      const BoundaryCorner &p = arrays.corners[i], &q = arrays.corners[j];
      most = std::max(most, size_of({p.vx - q.vx, p.vy - q.vy}));
    }
  }
  return most;
}

/// Power is force times what moves it, and nothing between two bodies moves faster than their corners do.
void expect_power_of_force(const DrivenLaw& law, const PairReport& report, double dt, Trial& trial) {
  trial.at_most(-report.damping_power, 0, "energy that dashpots give back [J/m]");
  if (report.damping_power == 0) return;
  trial.at_most(
      report.damping_power / (fastest_approach(law.bodies) * dt), (1 + 1e-6) * report.damping_force,
      "damping_power over the largest displacement between the bodies, against damping_force [N/m]");
}

}  // namespace

void expect_dashpots_booked(const Subject& subject, Trial& trial) {
  constexpr double dt = 1e-4;
  for (const HeldPair& pair : random_pairs(36)) {
    trial.feed(fed_pair(pair, 0.5) + ", moving, damped");
    DrivenLaw law(*subject.component);
    law.bodies = pair.bodies;
    for (int step = 0; step < 3; ++step) {
      const Evaluation e = law.step(dt);
      expect_power_of_force(law, e.pairs[0], dt, trial);
    }
  }
}

}  // namespace talus::conformance
