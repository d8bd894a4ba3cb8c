#include "blocks/generator.hpp"
#include "figures/runs.hpp"
#include "geometry/outlines.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>

using namespace talus;

namespace {

double distance(Vec2 a, Vec2 b, Vec2 p) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double share = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

/// Whether a corner of one comes within `margin` of an edge of the other.
bool touches(const Ring& corners, const Ring& edges, double margin) {
  for (const Vec2 corner : corners) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (distance(edges[i], edges[(i + 1) % edges.size()], corner) <= margin) return true;
    }
  }
  return false;
}

bool boxes_touch(const Ring& a, const Ring& b, double margin) {
  const auto apart = [&](auto coordinate) {
    const auto less = [&](Vec2 p, Vec2 q) { return coordinate(p) < coordinate(q); };
    const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
    return coordinate(*low_a) > coordinate(*high_b) + margin ||
           coordinate(*low_b) > coordinate(*high_a) + margin;
  };
  return !apart([](Vec2 p) { return p.x; }) && !apart([](Vec2 p) { return p.y; });
}

}  // namespace

TEST_CASE("the Vaiont scene has the blocks, the area and the pairs that are known", "[blocks]") {
  const Scene scene = figures::shipped("vaiont");
  std::vector<const SceneBody*> slide;
  for (const SceneBody& body : scene.bodies) {
    if (!body.fixed) slide.push_back(&body);
  }
  CHECK(slide.size() >= 494);
  CHECK(slide.size() <= 514);
  double area = 0;
  std::map<std::size_t, int> corners;
  for (const SceneBody* body : slide) {
    area += area_of(*body);
    ++corners[body->outer.vertices.size()];
  }
  // 270 to 280 million m3 over a width of 1.8 to 2 km.
  CHECK(area > 270e6 / 2000);
  CHECK(area < 280e6 / 1800);
  CHECK(corners[3] + corners[4] > 0.85 * static_cast<double>(slide.size()));
  // Pairs, of a block and a block or of a block and the bed, that meet along an edge or at a corner.
  int pairs = 0;
  const double margin = 1e-9 * 1300;  // of the size of the slide
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    for (std::size_t j = i + 1; j < scene.bodies.size(); ++j) {
      const SceneBody &a = scene.bodies[i], &b = scene.bodies[j];
      const Ring &p = a.outer.vertices, &q = b.outer.vertices;
      if ((a.fixed && b.fixed) || !boxes_touch(p, q, margin)) continue;
      if (touches(p, q, margin) || touches(q, p, margin)) ++pairs;
    }
  }
  CHECK(pairs > 2000);
  for (const Monitor& monitor : scene.monitors) CHECK_FALSE(scene.bodies[monitor.body].fixed);
}

TEST_CASE("The Vaiont slide comes to rest as soon under vertex_edge as under overlap_area",
          "[blocks][slow]") {
  const auto settling_time = [](const std::string& law) {
    Simulation simulation(figures::shipped("vaiont", {{"/contact/model", law}}), {});
    simulation.settle();
    return static_cast<double>(simulation.summary().settle_steps) * simulation.last_dt();
  };
  CHECK(settling_time("vertex_edge") < 2 * settling_time("overlap_area"));
}
