#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;
using Catch::Contains;

namespace {

/// A block over a base, `gap` apart, with `more` for the scene and `moving` for the block.
std::string block_and_base(double gap, const std::string& moving, const std::string& more,
                           const std::string& cover = "rigid") {
  return fmt::format(R"({{
    "talus": 1,
    "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": 0.25}}}},
    "cover": {{"model": "{}"}},
    "contact": {{"model": "frictionless"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}}],
    "bodies": [
      {{"name": "base", "polygon": [[-4, -2], [4, -2], [4, 0], [-4, 0]], "material": "rock", "fixed": true}},
      {{"name": "block", "polygon": [[0, {}], [1, {}], [1, {}], [0, {}]], "material": "rock"{}}}
    ],
    {}
  }})",
                     cover, gap, gap, gap + 1, gap + 1, moving, more);
}

}  // namespace

TEST_CASE("An initial overlap throws the block out at d0 sqrt(alpha L/m), and the run warns of it",
          "[figures]") {
  const std::string text =
      block_and_base(0, R"(, "velocity": [0, 0])", R"("time": {"end": 0.05, "safety": 0.05})");
  Scene scene = from_text(text);
  // The reader refuses such an overlap, so the polygon is moved after it.
  for (Vec2& vertex : scene.bodies[1].outer.vertices) vertex.y -= 1e-3;
  Simulation simulation(scene, {});
  while (simulation.advance()) {
  }
  const double expected = 1e-3 * std::sqrt(1e10 / 2300);
  const double speed = simulation.body_motion(1).velocity.y;
  INFO(fmt::format("{:.6f} of {:.6f} m/s", speed, expected));
  CHECK(expected == Approx(2.085).epsilon(1e-3));
  CHECK(speed == Approx(expected).epsilon(2e-3));
  REQUIRE(!simulation.summary().warnings.empty());
  CHECK_THAT(simulation.summary().warnings[0], Contains("block") && Contains("base") && Contains("0.001"));
}

TEST_CASE("A step above the critical one stops with words that name what to change", "[figures]") {
  for (const double share : {1.01, 1.2, 2.0}) {
    // An elastic block, falling: its strain modes blow up once something excites them.
    Scene scene = from_text(block_and_base(1e-4, "", R"("gravity": [0, -10], "time": {"end": 1})", "block"));
    const double critical = Simulation(scene, {}).critical_dt();
    scene.time.dt = share * critical;
    scene.output.history = 20 * *scene.time.dt;  // no output time makes the step smaller
    const std::string words = trouble_of(scene);
    INFO(share << ": " << words);
    CHECK_THAT(words, Contains("step") && (Contains("smaller") || Contains("/time/dt below")));
    if (share < 1.5) CHECK_THAT(words, Contains("of the critical"));
  }
}

TEST_CASE("Too deep an overlap stops and names the pair and the stiffness", "[figures]") {
  Scene scene =
      from_text(block_and_base(0.1, R"(, "velocity": [0, -1000])", R"("time": {"end": 0.1, "dt": 1e-5})"));
  const std::string words = trouble_of(scene);
  INFO(words);
  CHECK_THAT(words, Contains("too deep") && Contains("'block'") && Contains("'base'") &&
                        Contains("normal_stiffness"));
}

TEST_CASE("Too fast for a fixed step stops and says which step would do", "[figures]") {
  Scene scene =
      from_text(block_and_base(3, R"(, "velocity": [0, -1000])", R"("time": {"end": 0.1, "dt": 1e-3})"));
  const std::string words = trouble_of(scene);
  INFO(words);
  CHECK_THAT(words, Contains("too large for the speed") && Contains("/time/dt") && Contains("auto"));
  scene.time.dt.reset();
  scene.time.end = 2e-3;  // before it arrives
  CHECK(trouble_of(scene).empty());
}

TEST_CASE("What gains its speed within one automatic step does not pass another unseen", "[figures]") {
  // Half a step of 1e9 m/s2 is a speed for which the next is too long: the block was below the base.
  Scene scene = from_text(block_and_base(1e-3, "", R"("gravity": [0, -1e9], "time": {"end": 0.1})"));
  const std::string words = trouble_of(scene);
  INFO(words);
  CHECK_THAT(words, Contains("too large for what acts") && Contains("/time/dt below") && Contains("gravity"));
}

TEST_CASE("A fast thin plate does not pass through another unseen", "[figures]") {
  // 0.01 m thin, at 200 m/s: more than sqrt(alpha H/(2 rho)) = 147 m/s, the spring cannot hold it.
  const std::string text = R"({
    "talus": 1,
    "materials": {"rock": {"density": 2300}},
    "cover": {"model": "rigid"},
    "contact": {"model": "frictionless"},
    "interfaces": [{"between": ["*", "*"], "normal_stiffness": 1e10, "normal_damping": 0}],
    "bodies": [
      {"name": "plate", "polygon": [[-1, -0.01], [1, -0.01], [1, 0], [-1, 0]], "material": "rock", "fixed": true},
      {"name": "flyer", "polygon": [[0, 0.02], [0.5, 0.02], [0.5, 0.03], [0, 0.03]], "material": "rock", "velocity": [0, -200]}
    ],
    "time": {"end": 0.001}
  })";
  const std::string words = trouble_of(from_text(text));
  INFO(words);
  CHECK_THAT(words, Contains("too deep"));
}
