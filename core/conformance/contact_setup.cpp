#include "conformance/contact_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::conformance {

std::vector<HeldBody> flat_on_flat() {
  return {box(-2, -1, 2, 0), box(-0.5, -1e-3, 0.5, 1)};
}

std::vector<HeldBody> corner_in_flat() {
  const double high = 0.5 * std::sqrt(3.0);
  return {box(-1, -1, 1, 0), held({{0, -2e-3}, {0.5, high}, {-0.5, high}})};
}

std::vector<Setup> setups() {
  return {{"a block 1 mm deep in a base", flat_on_flat()},
          {"a corner of 60 degrees 2 mm deep in a side", corner_in_flat()}};
}

Values undamped_with_friction(double angle) {
  return with(undamped_interface(), {{"friction_angle", angle},
                                     {"friction_coefficient", std::tan(angle * std::numbers::pi / 180)}});
}

double scale_of(const Subject& subject, Trial& trial) {
  trial.feed("a block 1 mm deep in a base");
  DrivenLaw law(*subject.component, undamped_interface());
  law.bodies = flat_on_flat();
  const double scale = std::abs(law.look().on(1).y) / 1e-3;
  trial.due(std::isfinite(scale), "a force that is no number", "a finite one: tolerances are shares of it");
  return scale;
}

std::vector<HeldPair> pairs_without_ties(std::uint32_t random) {
  std::vector<HeldPair> pairs = random_pairs(random);
  for (HeldPair pair : {saw_teeth(1e-3), body_in_notch(1e-3), chamfered(0.01, 3, 4e-3)}) {
    set_moving(pair, 77);
    pairs.push_back(pair);
  }
  return pairs;
}

void at_rest(std::vector<HeldBody>& bodies) {
  for (HeldBody& body : bodies) body.motion.velocity = {}, body.motion.rate = {};
}

double difference(const BodyForce& p, const BodyForce& q) {
  double worst = 0;
  for (const double one : {p.force.x - q.force.x, p.force.y - q.force.y, p.moment.xx - q.moment.xx,
                           p.moment.xy - q.moment.xy, p.moment.yx - q.moment.yx, p.moment.yy - q.moment.yy}) {
    if (!(std::abs(one) <= worst)) worst = std::abs(one);  // nan stays
    if (std::isnan(one)) return one;
  }
  return worst;
}

std::string fed_pair(const HeldPair& pair, double master_share) {
  return fmt::format("{}, {:g} m deep, master share {:g}", pair.name, pair.depth, master_share);
}

bool has_interface_parameter(const Subject& subject, std::string_view key) {
  const Component& component = *subject.component->component;
  const std::span<const Parameter> table(component.interface_parameters, component.interface_parameter_count);
  return std::ranges::any_of(table, [&](const Parameter& parameter) { return key == parameter.key; });
}

void fill_with_pairs(DrivenLaw& law) {
  std::vector<HeldPair> pairs = pairs_without_ties(21);
  for (const HeldPair& pair : pairs) {
    const auto first = static_cast<std::uint32_t>(law.bodies.size());
    law.met.emplace_back(first, first + 1);
    for (const HeldBody& body : pair.bodies) law.bodies.push_back(body);
  }
  law.step();
  law.step();
  for (HeldBody& body : law.bodies) {  // to where the next call is
    BodyMotion& m = body.motion;
    m.u.x += 1e-4 * m.velocity.x, m.u.y += 1e-4 * m.velocity.y;
  }
}

}  // namespace talus::conformance
