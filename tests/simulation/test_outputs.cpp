#include "simulation/simulation.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <cstring>
#include <string>

using namespace talus;

namespace {

bool same_bits(double p, double q) {
  return std::memcmp(&p, &q, sizeof p) == 0;
}

}  // namespace

TEST_CASE("outputs are hit to the bit, whatever the step", "[simulation][outputs]") {
  for (const char* time :
       {R"({"end": 0.1})", R"({"end": 0.1, "dt": 1.7e-4})", R"({"end": 0.1, "safety": 0.031})"}) {
    INFO(time);
    WorkingScene text = resting_block();
    text.time = time;
    text.output = R"({"history": 0.007, "frames": 0.021})";
    Simulation simulation(text.read(), {});
    int outputs = 0, frames = 0;
    for (; simulation.advance(); ++outputs) {
      const double expected = outputs * 0.007 < 0.1 ? outputs * 0.007 : 0.1;
      CHECK(same_bits(simulation.time(), expected));
      CHECK(simulation.history_due());
      frames += simulation.frame_due() ? 1 : 0;
    }
    CHECK(outputs == 16);  // 0, 0.007 … 0.098, 0.1
    CHECK(frames == 6);    // 0, 0.021 … 0.084, 0.1
    CHECK(same_bits(simulation.time(), 0.1));
    CHECK_FALSE(simulation.advance());
  }
}

TEST_CASE("how often results are written changes the motion by no more than the steps do",
          "[simulation][outputs]") {
  WorkingScene often = resting_block(), seldom = resting_block();
  often.output = R"({"history": 0.001})";
  seldom.output = R"({"history": 0.1})";
  Simulation one(often.read(), {}), other(seldom.read(), {});
  while (one.advance()) {
  }
  while (other.advance()) {
  }
  CHECK(one.body_motion(1).position.y == Approx(other.body_motion(1).position.y).epsilon(1e-7));
}

TEST_CASE("an interrupted run stops between outputs and goes on", "[simulation][outputs]") {
  WorkingScene text = resting_block();
  text.output = R"({"history": 0.05})";
  Simulation whole(text.read(), {}), broken(text.read(), {});
  bool interrupted = true;
  const Pause pause = [&] { return interrupted; };
  while (whole.advance()) {
  }
  broken.advance(pause);
  CHECK(broken.time() == 0);
  REQUIRE(broken.advance(pause));
  CHECK(broken.time() > 0);
  CHECK(broken.time() < 0.05);
  interrupted = false;
  while (broken.advance(pause)) {
  }
  CHECK(broken.time() == 0.1);
  CHECK(broken.state_hash() == whole.state_hash());
}

TEST_CASE("a step longer than the time between outputs is told, and what shortened it", "[simulation]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [1, 0])");
  text.output = R"({"history": 0.001})";
  struct Case {
    const char *dt, *stages;
    bool told;
  };
  // A step that ends with the output before a stage is no shorter for the others.
  for (const auto& [dt, stages, told] :
       {Case{"0.01", "", true},
        {"0.0005", "", false},
        {"0.0005", R"("stages": [{"name": "later", "from": 1e-5, "set": {"/damping": 1}}],)", false}}) {
    CAPTURE(dt, stages);
    text.rest = stages;
    text.time = std::string(R"({"end": 0.0022, "dt": )") + dt + "}";  // the last interval is a short one
    const RunSummary summary = run_to_end(text).summary();
    CHECK((summary.dt_limiter == "time.dt of the scene") == !told);
    CHECK((!summary.warnings.empty() &&
           summary.warnings[0].find("longer than the time between outputs") != std::string::npos) == told);
  }
}
