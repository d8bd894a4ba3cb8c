#include "conformance/contact_calls.hpp"
#include "conformance/contact_setup.hpp"
#include "conformance/differences.hpp"

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace talus::conformance {
namespace {

/// Largest of what an interface has by these keys, if it has one of them: a range may keep it from zero.
std::optional<double> largest_of(const Subject& subject, const Values& given,
                                 std::initializer_list<std::string_view> keys) {
  const Component& component = *subject.component->component;
  const std::span<const Parameter> table(component.interface_parameters, component.interface_parameter_count);
  const std::vector<double> values = in_order(table, given);
  std::optional<double> largest;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (std::ranges::find(keys, std::string_view(table[i].key)) != keys.end())
      largest = std::max(largest.value_or(0), values[i]);
  }
  return largest;
}

}  // namespace

void check_settling(const Subject& subject, Trial& trial) {
  const Values smooth =
      with(lively_interface(),
           {{"friction_angle", 0}, {"friction_coefficient", 0}, {"cohesion", 0}, {"tensile_strength", 0}});
  // A law may have friction by a key of its own; at rest that has nothing to hold.
  const bool moving = largest_of(subject, smooth, {"friction_angle", "friction_coefficient"}) == 0.0;
  const bool bonds = (subject.component->component->traits & trait::pulls) != 0 ||
                     largest_of(subject, smooth, {"cohesion", "tensile_strength"}).value_or(0) > 0;
  const auto compare = [&](const HeldPair& pair, double share, bool holds) {
    trial.feed(fed_pair(pair, share) + (moving ? ", moving" : ", at rest") +
               ", without friction and bonds, two steps, and the same with " +
               (holds ? "hold_stick" : "bonds_form"));
    DrivenLaw plain(*subject.component, smooth), settling(*subject.component, smooth);
    plain.bodies = pair.bodies;
    if (!moving) at_rest(plain.bodies);
    settling.bodies = plain.bodies;
    plain.master_share = settling.master_share = share;
    settling.hold_stick = holds;
    settling.bonds_form = !holds;
    for (int step = 0; step < 2; ++step) {
      const auto found = difference_of(plain.step(), settling.step(), {.history = false});
      trial.due(!found, found.value_or(""), "the same bits");
    }
  };
  for (const HeldPair& pair : pairs_without_ties(36)) {
    for (const double share : {0.0, 0.5, 1.0}) {
      compare(pair, share, true);
      if (!bonds) compare(pair, share, false);
    }
  }
}

}  // namespace talus::conformance
