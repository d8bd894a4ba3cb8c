#include "parallel/alone.hpp"
#include "simulation/simulation.hpp"
#include "simulation/time_step.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;

namespace {

CriticalStep vote_of(const WorkingScene& text) {
  const Scene scene = text.read();
  const Model model = build_model(scene);
  return StepVote(scene, settings_of(scene), model, ContactStage(scene, model, alone(), true)).anyhow();
}

/// A body of one lattice, cut by its edges.
WorkingScene lattice(double size, double poisson, const std::string& slivers) {
  WorkingScene text;
  text.material = fmt::format(
      R"("density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": {})", poisson);
  text.bodies =
      box("a", 0, 0, 6, 3,
          fmt::format(R"("cover": {{"model": "hexagonal", "size": {}, "slivers": "{}"}})", size, slivers));
  return text;
}

double wave_speed(double poisson) {
  return std::sqrt(1e10 * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / 2300);
}

}  // namespace

TEST_CASE("a lattice votes for 0.866 h over the wave speed, less at its cut edges",
          "[simulation][time_step]") {
  for (const double poisson : {0.0, 0.25, 0.4}) {
    const double whole = std::sqrt(0.75) * 0.25 / wave_speed(poisson);
    for (const char* slivers : {"merge", "mass_scale"}) {
      const double dt = vote_of(lattice(0.25, poisson, slivers)).dt;
      CHECK(dt <= whole * (1 + 1e-3));
      CHECK(dt >= 0.7 * whole);
    }
  }
}

TEST_CASE("a run at the voted step stands, a little above it does not", "[simulation][time_step]") {
  WorkingScene text = lattice(0.5, 0.25, "keep");
  const double critical = vote_of(text).dt;
  text.gravity = "[0, 0]";
  text.rest =
      R"("loads": [{"body": "a", "point": [6, 3], "force": [1e5, -2e5]}], "limits": {"energy_residual": 0.5},)";
  for (const double share : {0.98, 1.03}) {
    text.time =
        fmt::format(R"({{"end": {:.17g}, "dt": {:.17g}}})", 2000 * share * critical, share * critical);
    const Scene scene = text.read();
    Simulation simulation(scene, {});
    const auto run = [&] {
      while (simulation.advance()) {
      }
    };
    if (share < 1) {
      CHECK_NOTHROW(run());
    } else {
      CHECK_THROWS_AS(run(), NumericalTrouble);
    }
  }
}

TEST_CASE("slivers left as they are set the step, treated ones do not", "[simulation][time_step]") {
  WorkingScene text;
  // The lattice vertex at the centroid is moved so that its row ends 1e-4 m before the top.
  text.bodies =
      box("a", 0, 0, 2, 2,
          R"("cover": {"model": "hexagonal", "size": 0.5, "offset_y": 0.1339245, "slivers": "keep"})");
  const Scene scene = text.read();
  const Model model = build_model(scene);
  const double kept = vote_of(text).dt;
  text.bodies.replace(text.bodies.find("keep"), 4, "merge");
  const double merged = vote_of(text).dt;
  CHECK(merged > 5 * kept);
  const Scene merged_scene = text.read();
  const std::vector<SliverEffect> effects = sliver_effects(merged_scene, build_model(merged_scene));
  REQUIRE(effects.size() == 1);
  CHECK(effects[0].tied > 0);
  CHECK(effects[0].heavier == 0);
  CHECK(effects[0].dt > 5 * effects[0].untreated_dt);
}
