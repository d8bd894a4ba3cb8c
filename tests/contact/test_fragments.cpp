#include "contact/contact_stage.hpp"
#include "model/whole_motion.hpp"
#include "parallel/alone.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

/// One body of many elements, without friction; `rest` are the members of its object after the name.
WorkingScene one_body(const std::string& rest) {
  WorkingScene text;
  text.law = "frictionless";
  text.interface = R"("normal_stiffness": 1e10, "normal_damping": 0)";
  text.bodies = R"({"name": "a", "material": "rock", )" + rest + "}";
  return text;
}

constexpr const char* square = R"("polygon": [[0, 0], [1, 0], [1, 1], [0, 1]])";

ContactTotals totals_at_rest(const WorkingScene& text) {
  const Scene scene = text.read();
  const Model model = build_model(scene);
  MotionState motion(model);
  move_boundary(model, motion);
  ContactStage contacts(scene, model, alone(), true);
  contacts.find_pairs(model, motion, 0, {});
  return contacts.evaluate(model, motion, {0, false, false});
}

}  // namespace

TEST_CASE("what joints cut out of a body presses on nothing at rest", "[contact][strips]") {
  const std::string made_of = R"(, "cover": {"model": "hexagonal", "size": )";
  const std::string cases[] = {
      // Strips that fan out around a reflex corner: of an opening, of a notch, of a kink, beside a joint.
      std::string(square) + made_of + R"(0.1}, "holes": [[[0.3, 0.3], [0.7, 0.3], [0.7, 0.7], [0.3, 0.7]]],
        "discontinuities": [{"points": [[-0.1, 0.253], [1.1, 0.253]]}])",
      R"("polygon": [[0, 0], [1, 0], [1, 0.5], [0.5, 0.5], [0.5, 1], [0, 1]])" + made_of +
          R"(0.1}, "discontinuities": [{"points": [[-0.1, 0.453], [1.1, 0.453]]}])",
      std::string(square) + made_of +
          R"(0.2}, "discontinuities": [{"points": [[-0.1, 0.05], [0.5, 0.6], [1.1, 0.05]]},
        {"points": [[-0.1, 0.65], [1.1, 0.65]]}])",
      std::string(square) + made_of +
          R"(0.3, "angle": 30}, "holes": [[[0.1, 0.1], [0.2, 0.1], [0.2, 0.2], [0.1, 0.2]]],
        "discontinuities": [{"points": [[0.657, 0.11], [1.129, -0.045]]}])",
      // The same without a joint, of a body whose parts may meet.
      std::string(square) + made_of +
          R"(0.1}, "self_contact": true, "holes": [[[0.3, 0.047], [0.7, 0.047], [0.7, 0.447], [0.3, 0.447]]])",
      // A wedge so sharp that bisectors are cut short, and a slab that gets thinner towards its end.
      std::string(square) + made_of +
          R"(0.1}, "discontinuities": [{"points": [[0.7964, 0.2837], [0.2679, -0.0734],
        [0.592, 0.0809], [0.6716, 0.9115]]}])",
      std::string(square) + made_of +
          R"(0.3, "angle": 30}, "discontinuities": [{"points": [[0.403, 0.66], [-0.012, 0.582]]},
        {"points": [[0.879, 0.091], [0.948, 0.807], [-0.033, 0.279], [0.568, 0.576]]}])",
  };
  for (const std::string& body : cases) {
    INFO(body);
    const ContactTotals totals = totals_at_rest(one_body(body));
    CHECK(totals.stored <= 1e-9);
    CHECK(totals.penetration <= 1e-9);
  }
}

TEST_CASE("between the fragments of a body the contact force is minus the gradient of its energy",
          "[contact][strips]") {
  // A wedge in the side of an opening, its tip within an element: what lies in front of the tip is none of
  // the strip's ground.
  const Scene scene = one_body(R"("polygon": [[-3, -2], [3, -2], [3, 3], [-3, 3]],
    "holes": [[[-1, -1], [1, -1], [1, 1], [-1, 1]]], "cover": {"model": "hexagonal", "size": 0.8},
    "discontinuities": [{"points": [[-1, -0.3], [-1.7, 0.4], [-1, 0.5]]}])")
                          .read();
  const Model model = build_model(scene);
  std::vector<Vec2> displacement(model.patch_star.size());
  double value = 0.35;
  const auto next = [&] { return (value = 3.9 * value * (1 - value)) - 0.5; };
  for (Vec2& d : displacement) d = {4e-6 * next(), 4e-6 * next()};
  std::vector<Vec2> force;
  const auto stored = [&](const std::vector<Vec2>& at) {
    MotionState motion(model);
    motion.patch_displacement = at;
    move_boundary(model, motion);
    ContactStage contacts(scene, model, alone(), true);
    contacts.find_pairs(model, motion, 0, {});
    const double energy = contacts.evaluate(model, motion, {0, false, false}).stored;
    force = motion.patch_force;
    return energy;
  };
  stored(displacement);
  const std::vector<Vec2> at_rest = force;
  double largest = 0;
  for (const Vec2 f : at_rest) largest = std::max(largest, std::hypot(f.x, f.y));
  REQUIRE(largest > 500);
  const double h = 1e-10;
  for (std::size_t p = 0; p < displacement.size(); ++p) {
    for (double Vec2::*axis : {&Vec2::x, &Vec2::y}) {
      std::vector<Vec2> ahead = displacement, behind = displacement;
      ahead[p].*axis += h;
      behind[p].*axis -= h;
      const double gradient = (stored(ahead) - stored(behind)) / (2 * h);
      INFO("patch " << p << " at " << model.patch_star[p].x << ", " << model.patch_star[p].y);
      CHECK(at_rest[p].*axis == Approx(-gradient).margin(1e-3 * largest));
    }
  }
}
