#include "figures/runs.hpp"
#include "output/scratch.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

/// Speed at 2.95 s of the block of 'incline', whose base is then half across the change of friction. What its
/// material damps stills the flutter of a body of many elements on contacts as stiff as these (theory.md).
double speed_with(const std::string& cover, const std::string& shape, const std::string& law) {
  const Scene scene = shipped(
      "incline", {{"/time/end", "3"},
                  {"/output/frames", "3"},
                  {"/contact/model", law},
                  {"/materials/rock/damping_time", "1e-5"},
                  {"/cover", cover},
                  {"/bodies/1", fmt::format(R"({{"name": "block", "material": "rock", {}}})", shape)}});
  return run(scene, "block").speed(2.95);
}

const std::string outline = R"("polygon": [[-8.005423651204648, 4.6219335], [-6.27337284363577, 3.6219335],
    [-5.77337284363577, 4.487958903784438], [-7.505423651204648, 5.487958903784438]])";

struct Speeds {
  double rigid, block, hexagonal, mesh;

  double largest() const { return std::max({rigid, block, hexagonal, mesh}); }
  double smallest() const { return std::min({rigid, block, hexagonal, mesh}); }
  std::string text() const {
    return fmt::format("rigid {:.6f}, block {:.6f}, hexagonal {:.6f}, mesh {:.6f}", rigid, block, hexagonal,
                       mesh);
  }
};

Speeds speeds(const std::string& law) {
  const Scratch folder;
  const RectangleMesh block{{-8.005423651204648, 4.6219335}, {2, 1}, 4, 2, -std::acos(-1.0) / 6};
  const std::string mesh = fmt::format(R"("mesh": "{}")", folder.write("block.msh", block.text()).string());
  return {speed_with(R"({"model": "rigid"})", outline, law),
          speed_with(R"({"model": "block"})", outline, law),
          speed_with(R"({"model": "hexagonal", "size": 0.4})", outline, law),
          speed_with(R"({"model": "mesh"})", mesh, law)};
}

}  // namespace

TEST_CASE("Incline: under all four covers the block slides as a linear base pressure does",
          "[slow][figures]") {
  const Speeds found = speeds("overlap_area");
  INFO(found.text());
  CHECK(found.largest() - found.smallest() < 0.003 * found.largest());
  CHECK(found.rigid == Approx(5.278582).epsilon(1e-5));
  CHECK(found.block == Approx(5.278582).epsilon(1e-5));
  CHECK(found.hexagonal == Approx(5.278582).epsilon(0.003));
  CHECK(found.mesh == Approx(5.278582).epsilon(0.003));
}

TEST_CASE("Incline: with springs at vertices a block of one element has two feet, a divided one many",
          "[slow][figures]") {
  // Two feet brake from the moment one is past B; the more vertices the base has, the more it is like a
  // distributed pressure.
  const Speeds found = speeds("vertex_edge");
  INFO(found.text());
  CHECK(found.rigid == Approx(5.085557).epsilon(0.002));
  CHECK(found.block == Approx(5.085557).epsilon(0.002));
  for (const double many : {found.hexagonal, found.mesh}) {
    CHECK(many > found.block + 0.1);
    CHECK(many < 5.285220);  // the peak under a distributed pressure
  }
}

TEST_CASE("A body of many elements rubs alike whichever body is listed first", "[figures][covers]") {
  // It lands on a corner, where the arcs of its two sides and of the floor do not share their ends.
  const std::string floor =
      R"({"name": "floor", "polygon": [[-4, -1], [4, -1], [4, 0], [-4, 0]], "material": "rock",
      "fixed": true})";
  const std::string body =
      R"({"name": "b", "polygon": [[0, 0.001], [0.9, 0.5], [0.1, 1.1]], "material": "rock",
      "velocity": [1, -1.5], "cover": {"model": "hexagonal", "size": 0.3}})";
  const auto landed = [](const std::string& bodies, std::size_t which) {
    WorkingScene text;
    text.bodies = bodies;
    text.material =
        R"("density": 2000, "model": "linear_elastic", "young_modulus": 1e8, "poisson_ratio": 0.25)";
    text.interface = R"("normal_stiffness": 3e7, "tangential_stiffness": 3e7, "friction_angle": 40,
                        "normal_damping": 0.1, "tangential_damping": 0)";
    text.time = R"({"end": 0.02, "dt": 1e-5})";
    return run_to_end(text).body_motion(which).velocity;
  };
  const Vec2 last = landed(floor + "," + body, 1), first = landed(body + "," + floor, 0);
  CHECK(last.x == Approx(first.x).epsilon(0).margin(1e-10));
  CHECK(last.y == Approx(first.y).epsilon(0).margin(1e-10));
  CHECK(last.x < 0.97);  // friction has acted
}
