#include "preview/preview.hpp"

#include "apps/program.hpp"
#include "output/scratch.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>

using namespace talus;
using Catch::Matchers::Contains;

namespace {

constexpr const char* elastic =
    R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.2)";

/// Two blocks of an edge of 2 m, one on the other; the lower one is fixed.
WorkingScene resting() {
  WorkingScene text;
  text.material = elastic;
  text.cover = "block";
  text.bodies = box("base", 0, 0, 2, 2, R"("fixed": true)") + "," + box("top", 0.5, 2, 1.5, 3);
  text.gravity = "[0, -10]";
  text.time = R"({"end": 0.1})";
  text.output = R"({"history": 0.01, "frames": 0.05})";
  return text;
}

Scene monitored(const WorkingScene& text) {
  Scene scene = text.read();
  scene.monitors.push_back({"m", 0, std::nullopt, {"uy"}});
  return scene;
}

Preview of(const WorkingScene& text) {
  Simulation simulation(monitored(text), {});
  return preview(simulation, 0.01);
}

bool warned(const WorkingScene& text, const std::string& words) {
  for (const std::string& warning : of(text).warnings) {
    if (warning.find(words) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("A preview counts what a run will do", "[preview]") {
  const Preview foreseen = of(resting());
  CHECK(foreseen.smallest_edge == 1);
  CHECK(foreseen.smallest_edge_body == 1);
  CHECK(foreseen.pairs == 1);
  CHECK(foreseen.rows == 11);
  CHECK(foreseen.frames == 3);
  CHECK(foreseen.bytes > 3 * 1000);
  CHECK(foreseen.trial_steps > 0);
  CHECK(foreseen.estimated_seconds > 0);
  CHECK(foreseen.memory > 1'000'000);
  CHECK(foreseen.settle_steps == 0);
  CHECK(foreseen.warnings.empty());
  Simulation simulation(resting().read(), {});
  while (simulation.advance()) {
  }
  CHECK(static_cast<double>(simulation.summary().steps) == Approx(foreseen.steps).epsilon(0.01));
}

TEST_CASE("A preview knows what stages do to the step", "[preview]") {
  WorkingScene text = resting();
  text.rest =
      R"("stages": [{"name": "stiff", "from": 0.05, "set": {"/interfaces/0/normal_stiffness": 1e13}}],)";
  const Preview foreseen = of(text);
  CHECK(foreseen.warnings.empty());
  REQUIRE(foreseen.stages.size() == 1);
  Simulation simulation(text.read(), {});
  while (simulation.advance()) {
  }
  CHECK(static_cast<double>(simulation.summary().steps) == Approx(foreseen.steps).epsilon(0.02));
  CHECK(foreseen.steps > 2 * of(resting()).steps);

  text.time = R"({"end": 0.1, "dt": 5e-5})";
  CHECK(warned(text, "from stage 'stiff' on the fixed step"));
  text.rest = R"("stages": [{"name": "same", "from": 0.05, "set": {"/gravity": [0, -9]}}],)";
  CHECK_FALSE(warned(text, "fixed step"));
}

TEST_CASE("A preview compares the stiffness of interfaces with E/h", "[preview]") {
  const Preview foreseen = of(resting());
  REQUIRE(foreseen.softest);
  CHECK(foreseen.softest->body == 1);
  CHECK(foreseen.softest->young == 1e8);
  CHECK(foreseen.softest->width == Approx(1));
  CHECK(foreseen.softest->share() == Approx(foreseen.softest->stiffness / 1e8));
  CHECK(foreseen.stiffest->share() == foreseen.softest->share());
  WorkingScene rigid = resting();
  rigid.cover = "rigid";
  CHECK_FALSE(of(rigid).softest);
}

TEST_CASE("Overlaps at the start are told with their bodies", "[preview]") {
  WorkingScene text = resting();
  text.bodies = box("base", 0, 0, 2, 2, R"("fixed": true)") + "," + box("top", 0.5, 1.9999995, 1.5, 3);
  const Preview foreseen = of(text);
  CHECK(foreseen.contacts > 0);
  CHECK(foreseen.overlap == Approx(5e-7).epsilon(0.01));
  CHECK(foreseen.overlap_a == 0);
  CHECK(foreseen.overlap_b == 1);
}

TEST_CASE("A scene that cannot take its first step is told so", "[preview]") {
  WorkingScene text = resting();
  text.bodies += "," + box("bullet", 10, 10, 11, 11, R"("velocity": [1e6, 0])");
  text.time = R"({"end": 0.1, "dt": 1e-4})";
  const Preview foreseen = of(text);
  REQUIRE_FALSE(foreseen.warnings.empty());
  CHECK_THAT(foreseen.warnings[0], Contains("it stops at t = 0: the step is too large for the speed"));
  CHECK(foreseen.trial_steps == 0);
}

TEST_CASE("A reviewer asks about scenes in which nothing moves or nothing is seen", "[preview]") {
  WorkingScene still = resting();
  still.gravity = "[0, 0]";
  CHECK(warned(still, "nothing moves: there is no gravity"));
  still.rest += R"("stages": [{"name": "later", "from": 0.05, "set": {"/gravity": [0, -1]}}],)";
  CHECK_FALSE(warned(still, "nothing moves"));
  CHECK(review(resting().read(), 1e-4) ==
        std::vector<std::string>{"there is no monitor: history.csv will hold the "
                                 "time alone"});
  WorkingScene fixed = resting();
  fixed.bodies = box("top", 0, 0, 1, 1, R"("fixed": true)");
  CHECK(warned(fixed, "every body is fixed"));
  WorkingScene falling = resting();
  CHECK_FALSE(warned(falling, "fall together"));
  falling.bodies = box("left", 0, 0, 1, 1) + "," + box("right", 2, 0, 3, 1);
  CHECK(warned(falling, "all bodies fall together"));
}

TEST_CASE("A reviewer asks about gravity that points up, or that nothing settles under", "[preview]") {
  WorkingScene text = resting();
  CHECK_FALSE(warned(text, "gravity points up"));
  text.gravity = "[0, 10]";
  CHECK(warned(text, "gravity points up: [0, 10] m/s2"));
  text.gravity = "[0, 0]";
  CHECK_FALSE(warned(text, "while it settles"));
  text.rest = R"("settle": {"duration": 1, "damping": 10},)";
  CHECK(warned(text, "nothing loads the scene while it settles"));
}

TEST_CASE("A reviewer asks about bodies that are thin beside the others", "[preview]") {
  WorkingScene text = resting();
  text.bodies += "," + box("second", 3, 2, 4, 3) + "," + box("plate", 5, 2, 6, 2.002);
  CHECK_FALSE(warned(text, "thinner"));
  text.bodies += "," + box("foil", 7, 2, 8, 2.0005);
  CHECK(warned(text, "1 of 4 bodies that move is thinner than a thousandth of most, 'foil' the thinnest"));
}

TEST_CASE("What may flutter is found beside what is stiffer and slides without friction", "[preview]") {
  WorkingScene text = resting();
  text.bodies = box("base", 0, 0, 4, 2, R"("fixed": true)") + "," + box("smooth", 0.5, 2, 1.5, 3) + "," +
                box("rough", 2.5, 2, 3.5, 3, R"("surfaces": {"sole": [0]})");
  text.interface = R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 0,
                      "normal_damping": 0, "tangential_damping": 0},
                     {"between": ["sole", "rock"], "normal_stiffness": 1e9, "tangential_stiffness": 1e9,
                      "friction_angle": 30, "normal_damping": 0, "tangential_damping": 0)";
  const Preview foreseen = of(text);
  REQUIRE(foreseen.fluttering);
  CHECK(foreseen.stiffest->row == 0);
  CHECK(foreseen.fluttering->row == 1);
}

TEST_CASE("A reviewer tells of cohesion that the first gap takes away", "[preview]") {
  WorkingScene text = resting();
  text.law = GENERATE("vertex_edge", "cohesive_overlap");
  const std::string common = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0, "tangential_damping": 0, "cohesion": 1e5)",
                    words = "/interfaces/0 has a cohesion of 1e+05 Pa and no tensile_strength";
  text.interface = common;
  CHECK(warned(text, words));
  text.interface = common + R"(, "tensile_strength": 1e4)";
  CHECK_FALSE(warned(text, words));
}

TEST_CASE("A reviewer asks about values that look as if they were in other units", "[preview]") {
  WorkingScene text = resting();
  for (const char* words : {"t/m3", "GPa", "coefficient", "go through"}) CHECK_FALSE(warned(text, words));
  text.material = R"("density": 2.3, "model": "linear_elastic", "young_modulus": 10, "poisson_ratio": 0.2)";
  CHECK(warned(text, "is 2.3 kg/m3: is it given in t/m3?"));
  CHECK(warned(text, "is 10 Pa: is it given in MPa or GPa?"));
  text.material =
      R"("density": 2.3e6, "model": "linear_elastic", "young_modulus": 2e13, "poisson_ratio": 0.2)";
  text.gravity = "[0, -9810]";
  for (const char* words : {"is it given in g/m3?", "nothing is as stiff", "is it given in mm/s2?"})
    CHECK(warned(text, words));
  text = resting();
  text.interface = R"("normal_stiffness": 0, "tangential_stiffness": 1e9, "friction_angle": 0.6,
                      "normal_damping": 0, "tangential_damping": 0)";
  CHECK(warned(text,
               "friction_angle of /interfaces/0 is 0.6 degrees: is it a coefficient? that would be "
               "30.96 degrees"));
  CHECK(warned(text, "normal_stiffness of /interfaces/0 is 0"));
  CHECK_FALSE(warned(text, "tangential_stiffness"));
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 35,
                      "normal_damping": 0, "tangential_damping": 0)";
  CHECK(warned(text, "tangential_stiffness of /interfaces/0 is 0: its friction of 35 degrees never acts"));
  text.bodies = box("top", 0.5, 2, 1.5, 3);  // which meets nothing
  CHECK_FALSE(warned(text, "normal_stiffness"));
}

TEST_CASE("A reviewer asks about elements too coarse to turn as their body does", "[preview]") {
  const auto on = [](double size) {
    WorkingScene text = resting();
    text.bodies = box("base", 0, 0, 2, 2, R"("fixed": true)") + "," +
                  box("spins", 0, 2, 1, 3,
                      fmt::format(R"("angular_velocity": 90, "cover": {{"model": "hexagonal", "size": {},
                                     "slivers": "keep"}})",
                                  size));
    return text;
  };
  // Row sums of equilateral triangles of side h add m h²/4: 1.5 (h/L)² of the inertia of a square.
  for (const double size : {0.5, 0.25, 0.1}) {
    CAPTURE(size);
    const Simulation simulation(monitored(on(size)), {});
    CHECK(simulation.inertia_share(0) == 1);
    CHECK(simulation.inertia_share(1) == Approx(1 + 1.5 * size * size).epsilon(1e-2));
  }
  CHECK(warned(on(0.25), "'spins' has 1.09 times its moment of inertia"));
  CHECK_FALSE(warned(on(0.1), "moment of inertia"));
}

TEST_CASE("A reviewer asks about intervals that do not fit", "[preview]") {
  WorkingScene text = resting();
  text.output = R"({"history": 1e-6})";
  CHECK(warned(text, "/output/history 1e-06 s is shorter than the step"));
  text.output = R"({"history": 0.2})";
  CHECK(warned(text, "less than one interval of /output/history"));
  text.output = R"({"history": 0.01, "frames": 0.2})";
  CHECK(warned(text, "less than one interval of /output/frames"));
}

TEST_CASE("A reviewer asks about loads that begin when the run has ended", "[preview]") {
  WorkingScene text = resting();
  const auto with = [&](const char* first) {
    text.rest = fmt::format(R"("base_acceleration": [{{"time": [[0, 0], [{0}, 0], [9, 1]]}}, 0],
      "loads": [{{"body": "top", "point": [1, 2.5], "force": [0, {{"time": [[0, 0], [{0}, 0], [9, 1]]}}]}}],)",
                            first);
    return text;
  };
  CHECK(warned(with("5"), "/base_acceleration is 0 until /time/end, 0.1 s"));
  CHECK(warned(with("5"), "/loads/0/force is 0 until /time/end, 0.1 s"));
  CHECK_FALSE(warned(with("0.05"), "is 0 until"));
}

TEST_CASE("A reviewer asks about bodies put to sleep in the air", "[preview]") {
  WorkingScene text = resting();
  text.rest += R"("sleep": {"acceleration": 20},)";
  CHECK(warned(text, "/sleep/acceleration 20 m/s2 is not below gravity, 10 m/s2"));
  text.rest = R"("sleep": {},)";
  CHECK_FALSE(warned(text, "/sleep"));
}

TEST_CASE("A reviewer asks about discontinuities that cut nothing", "[preview]") {
  WorkingScene text = resting();
  const auto with_cut = [&](const char* points) {
    text.bodies =
        box("base", 0, 0, 2, 2, R"("fixed": true)") + "," +
        box("top", 0.5, 2, 1.5, 3,
            std::string(R"("cover": {"model": "hexagonal", "size": 0.3}, "discontinuities": [{"points": )") +
                points + "}]");
    return warned(text, "/bodies/1/discontinuities/0 cuts nothing of 'top'");
  };
  CHECK_FALSE(with_cut("[[0, 2.5], [2, 2.5]]"));
  CHECK(with_cut("[[5, 5], [6, 6]]"));
  CHECK(with_cut("[[1.0, 2.5], [1.01, 2.5]]"));
}

TEST_CASE("validate prints what a run would be", "[preview][apps]") {
  const Scratch scratch;
  scratch.write("small.json", small_scene());
  const Call call = call_talus(scratch.folder(), {"validate", "small.json"});
  REQUIRE(call.code == 0);
  CHECK_THAT(call.out, Contains("the smallest is 1 m, of 'slab'") &&
                           Contains("1 candidate pairs, 0 contacts") && Contains("steps      about ") &&
                           Contains("an estimate from ") && Contains(" of memory") &&
                           Contains("21 rows every 0.01 s, 3 frames every 0.1 s") && !Contains("warning"));
  CHECK(std::count(call.out.begin(), call.out.end(), '\n') <= 24);
  CHECK_FALSE(std::filesystem::exists(scratch / "out"));
}
