// Where a corner of `vertex_edge` stands on nothing: bodies that touch or are apart, at rest.
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace talus;

namespace {

double speed_of(const Simulation& simulation, std::size_t body) {
  const Vec2 velocity = simulation.body_motion(body).velocity;
  return std::hypot(velocity.x, velocity.y);
}

}  // namespace

TEST_CASE("a vertex past the cut of a concave body stands on nothing", "[laws][vertex_edge]") {
  // B touches A, or lies above it, where a cut of A ends: of the piece beyond, the corner sees the far side
  // of the notch, also while bonds are held, which then reach any distance.
  using Points = std::vector<Vec2>;
  const auto polygon = [](const Points& points, double lifted) {
    std::string text;
    for (const Vec2& p : points)
      text += fmt::format("{}[{:.17g}, {:.17g}]", text.empty() ? "" : ", ", p.x + lifted, p.y);
    return text;
  };
  struct Case {
    Points a, b;
    double lifted;
    const char* bond;
  };
  const Points deep{{0.5, -2}, {1.5, 0}, {1, 2}, {0.6, 0.5}, {0.5, 0.5}}, slim{{1.5, 0}, {2.5, 2}, {1, 2}},
      shallow{{-3, -2}, {0.5, -2}, {1.5, 0}, {1, 2}, {1.1, 0.25}, {-3, 0.25}}, wide{{1.5, 0}, {4, 2}, {1, 2}},
      arrow{{0, 0}, {3, 0}, {3, 4}, {0, 4}, {1, 2}}, hull{{0, 0}, {1, 2}, {0, 4}, {-2, 4}, {-2, 0}};
  // Its cut ends a millimetre beside the corner that the other touches.
  const Points quadrilateral{{6.549921139513269, 2.237697905544272},
                             {6.9521817554286525, 4.060608109365036},
                             {5.5656987984883175, 4.4004169793849375},
                             {5.163438182572934, 2.577506775564172}},
      hooked{{6.9521817554286525, 4.060608109365036}, {7.024928625040901, 4.390272525083234},
             {6.5072911056252405, 4.963656067167771}, {6.163528385221413, 5.930388536141595},
             {6.175892267912417, 6.172365555702733},  {5.967959414403701, 6.223327183205703},
             {5.5656987984883175, 4.4004169793849375}};
  const char *none = R"("cohesion": 0, "tensile_strength": 0)",
             *strong = R"("cohesion": 5.9e5, "tensile_strength": 1.77e5)";
  for (const Case& given :
       {Case{deep, slim, 0, none}, Case{deep, slim, 1e-3, none}, Case{shallow, wide, 0, none},
        Case{arrow, hull, 0, none}, Case{arrow, hull, 0, strong}, Case{quadrilateral, hooked, 0, none}}) {
    INFO(polygon(given.a, 0) << "; " << polygon(given.b, given.lifted) << "; " << given.bond);
    WorkingScene text;
    text.law = "vertex_edge";
    text.interface =
        std::string(R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 12,
                                    "normal_damping": 0, "tangential_damping": 0, )") +
        given.bond;
    text.bodies = fmt::format(R"({{"name": "a", "material": "rock", "polygon": [{}]}},
                                 {{"name": "b", "material": "rock", "polygon": [{}]}})",
                              polygon(given.a, 0), polygon(given.b, given.lifted));
    text.rest = R"("settle": {"duration": 0.002, "damping": 1},)";
    text.time = R"({"end": 0.01, "dt": 5e-5})";
    Simulation simulation(text.read(), {});
    REQUIRE(simulation.settle());
    while (simulation.advance()) {
    }
    for (const std::size_t body : {0, 1}) CHECK(speed_of(simulation, body) < 1e-9);
    CHECK(simulation.summary().largest_penetration < 1e-12);
  }
}

TEST_CASE("a vertex beside a short edge does not see the far side of its neighbour", "[laws][vertex_edge]") {
  for (const double cut : {3e-3, 1e-3, 1e-6}) {
    for (const double apart : {0.0, 0.01}) {
      INFO(cut << ", " << apart);
      WorkingScene text;
      text.law = "vertex_edge";
      text.bodies = fmt::format(
          R"({{"name": "a", "material": "rock", "polygon": [[-{0}, 0], [-{0}, -4], [1, -4], [1, -2], [0, 0]]}},
             {{"name": "b", "material": "rock", "polygon": [[{1}, 0], [{2}, -2], [{2}, 0]]}})",
          cut, apart, 1 + apart);
      text.time = R"({"end": 0.01, "dt": 1e-4})";
      const Simulation simulation = run_to_end(text);
      CHECK(simulation.summary().largest_penetration < 1e-12);
      CHECK(speed_of(simulation, 1) < 1e-9);
    }
  }
}

TEST_CASE("bodies that are apart do not push each other", "[laws][vertex_edge]") {
  struct Case {
    const char *what, *below, *above;
  };
  const Case cases[] = {
      // Its near side looks away from the corner of the box, which is behind the other one, outside of it.
      {"a sharp tip near the end of a side", "[0, 0], [2, 0], [2, 1], [0, 1]",
       "[1.992, 1.001], [2.292, 1.601], [1.992, 1.601]"},
      {"a tip beside a notch of 0.3 mm",
       "[0, 0], [4, 0], [4, 1], [2.0006, 1], [2.0003, 0.9997], [2, 1], [0, 1]",
       "[1.992, 1.0001], [2.292, 1.6001], [1.892, 1.6001]"},
      {"a tip above a notch with a short edge at its bottom",
       "[-1.014, -1.5], [1.867, -2.306], [1, 0.25], [8e-5, 6.5e-5], [0, 0], [-0.4117, 0.1307]",
       "[-0.002, 0.006865], [0.00408, 0.001665], [0.02408, 0.501665], [-0.09592, 0.501665]"}};
  for (const Case& given : cases) {
    INFO(given.what);
    WorkingScene text;
    text.law = "vertex_edge";
    text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = fmt::format(
        R"({{"name": "below", "material": "rock", "fixed": true, "polygon": [{}]}},
           {{"name": "above", "material": "rock", "polygon": [{}]}})",
        given.below, given.above);
    text.time = R"({"end": 0.002, "dt": 1e-5})";
    const Simulation simulation = run_to_end(text);
    CHECK(speed_of(simulation, 1) == 0);
    CHECK(simulation.summary().largest_penetration == 0);
  }
}

TEST_CASE("a flat side bears as one where a cut of its body ends on it", "[laws][vertex_edge]") {
  // The L, and the floor with a notch below, are cut where a box is not; cohesion alone holds, 20 kN/m.
  const char *box_shape = "[0, 0], [2, 0], [2, 0.75], [0, 0.75]",
             *l_shape = "[0, 0], [2, 0], [2, 0.5], [1, 0.5], [1, 1], [0, 1]";
  const char *plain = "[-5, -1], [5, -1], [5, 0], [-5, 0]",
             *notched = "[-5, -1], [1, -1], [1, -0.5], [1.2, -1], [5, -1], [5, 0], [-5, 0]";
  for (const auto& [floor, shape] :
       {std::pair{plain, box_shape}, {plain, l_shape}, {notched, box_shape}, {notched, l_shape}}) {
    INFO(floor << "; " << shape);
    const auto ends_at = [floor = floor, shape = shape](double pull) {
      WorkingScene text;
      text.law = "vertex_edge";
      text.material = R"("density": 2000)";
      text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 0,
                          "normal_damping": 0.1, "tangential_damping": 0.1, "cohesion": 1e4, "tensile_strength": 1e3)";
      text.bodies = fmt::format(
          R"({{"name": "floor", "material": "rock", "fixed": true, "polygon": [{}]}},
             {{"name": "a", "material": "rock", "fix": ["rotation"], "polygon": [{}]}})",
          floor, shape);
      text.gravity = fmt::format("[{}, -10]", pull / 3000);
      text.rest = R"("settle": {"duration": 1, "damping": 200},)";
      text.time = R"({"end": 0.2, "dt": 2e-4})";
      Simulation simulation(text.read(), {});
      REQUIRE(simulation.settle());
      while (simulation.advance()) {
      }
      CHECK(simulation.deepest_overlap().penetration == Approx(1.5e-4).epsilon(1e-3));
      return simulation.body_motion(1).displacement.x;
    };
    CHECK(std::abs(ends_at(12e3)) < 1e-4);
    CHECK(ends_at(24e3) > 0.01);
  }
}

TEST_CASE("a corner that is bonded to the one face of a bend is not to the other, across a gap",
          "[laws][vertex_edge]") {
  WorkingScene text;
  text.law = "vertex_edge";
  text.interface = R"("normal_stiffness": 1e8, "tangential_stiffness": 1e8, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3, "cohesion": 1e5, "tensile_strength": 5e4)";
  text.bodies = std::string(R"({"name": "corner", "material": "rock", "fixed": true,
                                "polygon": [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]}, )") +
                box("a", 1.009, 1, 2.009, 2);
  text.gravity = "[0, -10]";
  text.rest = R"("settle": {"duration": 0.5, "damping": 100},)";
  text.time = R"({"end": 0.02})";
  Simulation simulation(text.read(), {});
  REQUIRE(simulation.settle());
  CHECK(simulation.summary().warnings.empty());
  while (simulation.advance()) {
  }
  CHECK(std::abs(simulation.body_motion(1).position.x - 1.509) < 1e-9);
}

TEST_CASE("thin slabs on each other touch, and no more", "[laws][vertex_edge]") {
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = "block";
  text.gravity = "[0, -10]";
  text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3)";
  text.bodies = box("below", 0, 0, 60, 0.05, R"("fixed": true)") + "," + box("above", 0, 0.05, 60, 0.1);
  text.time = R"({"end": 0.02})";
  const Simulation simulation = run_to_end(text);
  CHECK(simulation.summary().largest_penetration < 1e-5);
  CHECK(std::abs(simulation.body_motion(1).displacement.y) < 1e-5);
}
