#include "conformance/material_laws.hpp"
#include "conformance/swept_strip.hpp"

#include <fmt/format.h>

#include <cmath>

namespace talus::conformance {

void check_material_sweep(const Subject& subject, Trial& trial) {
  const auto law = sample_material(subject);
  if (!law->sweeps()) {
    trial.not_claimed("sweeps() says no");
    return;
  }
  trial.due(law->doubles_per_element() == 0 && !law->needs_previous_deformation() && law->viscous_time() == 0,
            "sweeps() of a law with state, previous deformation or viscosity", "a law without");
  // Rounding: some ten operations on F of about one, six elements to a corner, gradients of 3 1/m.
  const double bound = 1e-13 * modulus_of(*law);
  for (const std::uint32_t cells : {1U, 7U, 8U, 21U, 128U}) {
    for (const bool wild : {false, true}) {
      trial.feed(fmt::format("{} cells under strains of 1e-4{}", cells, wild ? ", some of 0.1" : ""));
      const SweptStrip given(cells, 1e-4, wild);
      SweptStrip due = given;
      const double stored = due.one_by_one(*law);
      const auto compare = [&](const auto& sweep) {
        SweptStrip swept = given, again = given;
        const double found = sweep(swept), repeated = sweep(again);
        trial.at_most(largest_difference(swept, due), bound, "difference from forces one by one [N/m]");
        trial.at_most(std::abs(found - stored), 1e-10 * std::abs(stored), "difference of energy [J/m]");
        trial.due(largest_difference(swept, again) == 0 && found == repeated,
                  "another outcome of the same call", "the same bits");
      };
      compare([&](SweptStrip& strip) { return strip.sweep(*law); });
      compare([&](SweptStrip& strip) { return strip.sweep_as_chain(*law, true); });
      compare([&](SweptStrip& strip) { return strip.sweep_as_chain(*law, false); });
    }
  }
}

}  // namespace talus::conformance
