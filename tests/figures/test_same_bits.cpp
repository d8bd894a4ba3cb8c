#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

using namespace talus;
using namespace talus::figures;

namespace {

constexpr double far_x = 5e5, far_y = 5e6;

/// The scene as JSON with all bodies moved by (5e5, 5e6) m in the file itself.
Scene written_far_away(const std::string& name, const std::vector<Override>& overrides) {
  std::ifstream file(std::filesystem::path(TALUS_SCENES) / (name + ".json"));
  nlohmann::json scene = nlohmann::json::parse(file, nullptr, true, true);
  for (auto& body : scene["bodies"]) {
    for (auto& vertex : body["polygon"]) {
      vertex[0] = vertex[0].get<double>() + far_x;
      vertex[1] = vertex[1].get<double>() + far_y;
    }
  }
  return from_text(scene.dump(), overrides);
}

double largest_difference(const Course& p, const Course& q) {
  REQUIRE(p.time == q.time);
  double largest = 0;
  for (std::size_t i = 0; i < p.time.size(); ++i) {
    largest = std::max(largest, std::hypot(p.motion[i].displacement.x - q.motion[i].displacement.x,
                                           p.motion[i].displacement.y - q.motion[i].displacement.y));
  }
  return largest;
}

}  // namespace

TEST_CASE("One thread or two: the same bits", "[figures]") {
  const Scene wall = shipped("brick_wall", {{"/time/end", "0.01"}});
  CHECK(hash_after(wall, {1}) == hash_after(wall, {2}));
  const Scene column = shipped("column", {{"/time/end", "0.05"}});
  CHECK(hash_after(column, {1}) == hash_after(column, {2}));
}

TEST_CASE("With the neighbour skin and without: the same bits", "[figures]") {
  for (const auto& [name, end] : {std::pair{"brick_wall", "0.005"}, std::pair{"column", "0.05"},
                                  std::pair{"collision", "1.05"}, std::pair{"incline", "0.3"}}) {
    for (const std::string law : {"overlap_area", "vertex_edge", "frictionless"}) {
      INFO(name << ", " << law);
      const Scene scene = shipped(
          name,
          {{"/time/end", end}, {"/output/history", end}, {"/contact/model", law}, {"/output/frames", end}});
      CHECK(hash_after(scene, {1, true}) == hash_after(scene, {1, false}));
    }
  }
}

TEST_CASE("Through an origin of (5e5, 5e6) m the trajectory is the same to the bit", "[figures]") {
  for (const std::string name : {"incline", "column"}) {
    INFO(name);
    const std::vector<Override> near{{"/time/end", "0.5"}};
    std::vector<Override> far = near;
    far.push_back({"/origin", "[5e5, 5e6]"});
    const Course here = run(shipped(name, near), name == "incline" ? "block" : "b10");
    const Course there = run(shipped(name, far), name == "incline" ? "block" : "b10");
    CHECK(largest_difference(here, there) == 0);
    CHECK(hash_after(shipped(name, near), {}) == hash_after(shipped(name, far), {}));
  }
}

TEST_CASE("Vertices written at (5e5, 5e6) m give the same trajectory to what their rounding is worth",
          "[figures]") {
  // Numbers near 5e6 are rounded by 1e-9 m, so blocks and ramp are not quite the same.
  const std::vector<Override> short_run{{"/time/end", "0.5"}};
  const double incline = largest_difference(run(shipped("incline", short_run), "block"),
                                            run(written_far_away("incline", short_run), "block"));
  const double column = largest_difference(run(shipped("column", short_run), "b10"),
                                           run(written_far_away("column", short_run), "b10"));
  INFO(fmt::format("incline {:.2e} m, column {:.2e} m", incline, column));
  CHECK(incline < 1e-7);
  CHECK(column < 1e-7);
}
