#include "figures/runs.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

/// A rigid and an affine block, on both a lattice, on that a mesh that slides; all fall by some millimetres.
Scene pile(const Scratch& folder, const std::vector<Override>& overrides = {}) {
  const RectangleMesh top{{-0.4, 1.806}, {1, 1}, 4, 4};
  return from_text(fmt::format(R"({{
    "talus": 1, "gravity": [0, -9.81],
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25}}}},
    "contact": {{"model": "overlap_area"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                    "friction_angle": 35, "normal_damping": 0.3, "tangential_damping": 0.3}}],
    "bodies": [
      {{"name": "table", "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]], "material": "rock", "fixed": true}},
      {{"name": "rigid", "polygon": [[-1.5, 0.002], [-0.1, 0.002], [-0.1, 1.002], [-1.5, 1.002]],
       "material": "rock", "cover": {{"model": "rigid"}}}},
      {{"name": "block", "polygon": [[0.1, 0.002], [1.5, 0.002], [1.5, 1.002], [0.1, 1.002]],
       "material": "rock", "cover": {{"model": "block"}}}},
      {{"name": "lattice", "polygon": [[-1.2, 1.004], [1.2, 1.004], [1.2, 1.804], [-1.2, 1.804]],
       "material": "rock", "cover": {{"model": "hexagonal", "size": 0.4}}}},
      {{"name": "mesh", "mesh": "{}", "material": "rock", "velocity": [0.2, 0], "cover": {{"model": "mesh"}}}}
    ],
    "stages": [{{"name": "rest", "from": 0.1, "set": {{"/damping": 200}}}}],
    "time": {{"end": 0.4, "safety": 0.1}}, "output": {{"history": 0.01}}
  }})",
                               folder.write("top.msh", top.text()).string()),
                   overrides);
}

constexpr double weight = 2300 * 9.81 * (1.4 + 1.4 + 2.4 * 0.8 + 1);  // N/m

double upward_on_table(const Simulation& simulation) {
  double up = 0;
  for (const Contact& contact : simulation.contacts()) {
    if (contact.body_a == 0) up += contact.normal_force.y + contact.tangential_force.y;
    if (contact.body_b == 0) up -= contact.normal_force.y + contact.tangential_force.y;
  }
  return up;
}

}  // namespace

TEST_CASE("Bodies of all covers in one pile come to rest, and the table carries their weight", "[figures]") {
  const Scratch folder;
  double carried = 0, share = 0;
  EnergyLedger ledger;
  const Course course = run(pile(folder), "mesh", {}, [&](const Simulation& s) {
    carried = upward_on_table(s);
    share = s.summary().largest_residual_share;
    ledger = s.ledger();
  });
  const Motion& last = course.motion.back();
  INFO(fmt::format("carried {:.8g} of {:.8g} N/m, speed {:.1e} m/s, slid {:.6f} m, energy missing {:.2e}",
                   carried, weight, std::hypot(last.velocity.x, last.velocity.y), last.displacement.x,
                   share));
  CHECK(carried == Approx(weight).epsilon(1e-3));
  CHECK(std::hypot(last.velocity.x, last.velocity.y) < 1e-9);
  CHECK(last.displacement.x > 0.001);  // it did slide before it stopped
  CHECK(last.displacement.y < -0.006);
  CHECK(ledger.friction_loss > 0);
  CHECK(share < 0.01);
}

TEST_CASE("Bodies of all covers in one pile: the same bits on two threads and without the skin",
          "[figures]") {
  const Scratch folder;
  const Scene scene = pile(folder, {{"/time/end", "0.12"}});
  const std::string once = hash_after(scene, {1, true});
  CHECK(hash_after(scene, {2, true}) == once);
  CHECK(hash_after(scene, {1, false}) == once);
}
