#include "model/distinct_points.hpp"
#include "model/motion.hpp"
#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>
#include <utility>

using namespace talus;

namespace {

struct Moved {
  Vec2 at, by;
};

/// The points of a body in the order of distinct_points(), when each patch goes somewhere else.
std::vector<Moved> moved_points(const Model& model, std::uint32_t index = 0) {
  std::vector<Vec2> displacement(model.patch_star.size());
  double value = 0.3;
  const auto next = [&] { return value = 3.9 * value * (1 - value); };
  for (Vec2& d : displacement) d = {next(), next()};
  std::vector<Moved> points;
  const Body& body = model.bodies[index];
  for (std::uint32_t i = body.element_begin; i < body.element_end; ++i) {
    const std::uint32_t element = model.body_element[i];
    for (const Ring& ring : model.element_region[element]) {
      for (const Vec2 at : ring)
        points.push_back({at, carried(model.carrier(model.elements[element], at), displacement)});
    }
  }
  return points;
}

Model body_with(const std::string& discontinuities) {
  WorkingScene text;
  text.bodies = R"({"name": "a", "material": "rock", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]],
    "cover": {"model": "hexagonal", "size": 0.61, "angle": 17})" +
                discontinuities + "}";
  return build_model(text.read());
}

std::size_t places(const std::vector<Moved>& points) {
  std::set<std::pair<double, double>> all;
  for (const Moved& point : points) all.insert({point.at.x, point.at.y});
  return all.size();
}

}  // namespace

TEST_CASE("in a whole body there are as many distinct points as places", "[model][output]") {
  const Model model = body_with("");
  const std::vector<std::uint32_t> numbers = distinct_points(model, 0);
  const std::vector<Moved> points = moved_points(model);
  REQUIRE(numbers.size() == points.size());
  const std::set<std::uint32_t> distinct(numbers.begin(), numbers.end());
  CHECK(distinct.size() == places(points));
  CHECK(*distinct.rbegin() == distinct.size() - 1);
  CHECK(3 * distinct.size() < numbers.size());
}

TEST_CASE("a side that nearly lies on a row of the lattice has each point once", "[model][output]") {
  for (const double off : {0.0, 4e-10, 7e-10, -7e-10}) {
    WorkingScene text;
    text.bodies = box("a", 0, off, 4, 2, R"("cover": {"model": "hexagonal", "size": 0.5})") + "," +
                  box("b", 10, off, 14, 2, R"("cover": {"model": "hexagonal", "size": 0.5},
                      "holes": [[[12, 0.9], [12.6, 0.9], [12.6, 1.5], [12, 1.5]]])");
    const Model model = build_model(text.read());
    for (const std::uint32_t body : {0u, 1u}) {
      INFO(off << " of body " << body);
      const std::vector<std::uint32_t> numbers = distinct_points(model, body);
      const std::vector<Moved> points = moved_points(model, body);
      REQUIRE(numbers.size() == points.size());
      CHECK(std::set<std::uint32_t>(numbers.begin(), numbers.end()).size() == places(points));
    }
  }
}

TEST_CASE("distinct points move apart, one and the same does not", "[model][output]") {
  // One joint goes through, the other ends within the body.
  const Model model = body_with(R"(, "discontinuities": [{"points": [[-1, 1.3], [5, 1.7]]},
    {"points": [[2.2, 3.5], [2.6, 2.1]]}])");
  const std::vector<std::uint32_t> numbers = distinct_points(model, 0);
  const std::vector<Moved> points = moved_points(model);
  REQUIRE(numbers.size() == points.size());
  std::map<std::uint32_t, Moved> first;
  std::map<std::pair<double, double>, std::set<std::uint32_t>> at_place;
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(numbers[i] <= first.size());  // in the order of appearance
    const Moved& known = first.try_emplace(numbers[i], points[i]).first->second;
    CHECK(points[i].at.x == known.at.x);
    CHECK(points[i].at.y == known.at.y);
    CHECK(std::hypot(points[i].by.x - known.by.x, points[i].by.y - known.by.y) < 1e-6);
    at_place[{points[i].at.x, points[i].at.y}].insert(numbers[i]);
  }
  std::size_t faces = 0;
  for (const auto& [place, there] : at_place) {
    faces += there.size() > 1 ? 1 : 0;
    for (const std::uint32_t p : there) {
      for (const std::uint32_t q : there) {
        if (p < q)
          CHECK(std::hypot(first.at(p).by.x - first.at(q).by.x, first.at(p).by.y - first.at(q).by.y) > 1e-3);
      }
    }
  }
  CHECK(faces > 10);
}
