#include "figures/runs.hpp"
#include "output/scratch.hpp"
#include "verification/patch_test.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

constexpr double young = 1e10, poisson = 0.25;

/// One body of the material `model`; `body` holds its shape, `rest` further members with a comma behind.
Scene one_body(const std::string& body, const std::string& cover, const std::string& model = "linear_elastic",
               const std::string& rest = R"("time": {"end": 1})") {
  return from_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300, "model": "{}", "young_modulus": {}, "poisson_ratio": {}}}}},
          "cover": {}, "bodies": [{{"name": "a", "material": "rock", {}}}], {}}})",
      model, young, poisson, cover, body, rest));
}

/// Concave, with a hole; no side follows the lattice.
const std::string frame_with_hole =
    R"("polygon": [[0, 0], [2.1, 0.2], [2.3, 1.1], [1.2, 0.9], [1.1, 1.7], [-0.2, 1.5]],
    "holes": [[[0.3, 0.4], [0.8, 0.5], [0.6, 1.1]]])";

std::string lattice(double size, double x, double y, double angle, const std::string& slivers) {
  return fmt::format(
      R"({{"model": "hexagonal", "size": {}, "offset_x": {}, "offset_y": {}, "angle": {}, "slivers": "{}"}})",
      size, x, y, angle, slivers);
}

/// A square of 6 × 6 cells with skewed nodes, but for 2 × 2 cells in its middle.
std::string mesh_with_hole() {
  constexpr int cells = 6;
  const auto hollow = [](int i, int j) { return (i == 2 || i == 3) && (j == 2 || j == 3); };
  const auto node = [](int i, int j) { return 1 + i + j * (cells + 1); };
  std::string nodes, elements;
  int count = 0, element = 0;
  const auto line = [&](int from, int to) {
    elements += fmt::format("{} 1 2 1 1 {} {}\n", ++element, from, to);
  };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      if (i == 3 && j == 3) continue;  // in the middle of the hole
      nodes += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), 0.3 * i + 0.05 * std::sin(7.0 * i + 3 * j),
                           0.3 * j + 0.05 * std::cos(5.0 * i + 11 * j));
      ++count;
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      if (hollow(i, j)) continue;
      const int a = node(i, j), b = a + 1, c = b + cells + 1, d = c - 1;
      elements += fmt::format("{} 2 2 2 1 {} {} {}\n", ++element, a, b, c);
      elements += fmt::format("{} 2 2 2 1 {} {} {}\n", ++element, a, c, d);
      if (i == 0 || hollow(i - 1, j)) line(d, a);
      if (i == cells - 1 || hollow(i + 1, j)) line(b, c);
      if (j == 0 || hollow(i, j - 1)) line(a, b);
      if (j == cells - 1 || hollow(i, j + 1)) line(c, d);
    }
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"all\"\n2 2 "
      "\"body\"\n$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      count, nodes, element, elements);
}

void check(const verification::PatchTest& test) {
  INFO(fmt::format("stress {:.1e}, forces {:.1e}", test.stress, test.force));
  CHECK(test.stress <= 1e-12);
  CHECK(test.force <= 1e-12);
}

}  // namespace

TEST_CASE("Patch test: a linear field is exact on a mesh with a hole", "[figures][continuum]") {
  const Scratch folder;
  const std::string mesh = folder.write("hole.msh", mesh_with_hole()).string();
  check(verification::patch_test(one_body(fmt::format(R"("mesh": "{}")", mesh), R"({"model": "mesh"})"),
                                 young, poisson));
}

/// What is missing to a linear field that penalty supports all around hold, m.
double error_of_supports(const std::string& shape, const std::string& cover, double stiffness) {
  // u = (2e-4 x - 1.3e-4 y, -1.3e-4 x - 0.7e-4 y)
  const std::string supports = fmt::format(
      R"("prescribed": [{{"body": "a", "surface": "all", "stiffness": {}, "displacement": [
           [{{"scale": 2e-4, "x": [[-9, -9], [9, 9]]}}, {{"scale": -1.3e-4, "y": [[-9, -9], [9, 9]]}}],
           [{{"scale": -1.3e-4, "x": [[-9, -9], [9, 9]]}}, {{"scale": -7e-5, "y": [[-9, -9], [9, 9]]}}]]}}],
         "settle": {{"duration": 0.03, "damping": "adaptive", "until": 1e-10}}, "time": {{"end": 1e-9, "safety": 0.8}})",
      stiffness);
  Simulation simulation(one_body(shape, cover, "linear_elastic", supports), {});
  simulation.settle();
  simulation.advance();
  double largest = 0;
  for (const Vec2 at : {Vec2{0.1, 1.2}, {1.0, 0.7}, {1.7, 0.6}, {0.9, 1.4}, {1.4, 0.2}}) {
    const Vec2 now = simulation.point_motion(0, at).position;  // displacements count from the settled state
    largest = std::max(largest, std::hypot(now.x - at.x - 2e-4 * at.x + 1.3e-4 * at.y,
                                           now.y - at.y + 1.3e-4 * at.x + 7e-5 * at.y));
  }
  return largest;
}

TEST_CASE("Patch test: penalty supports part from the field by the inverse of their stiffness",
          "[figures][continuum]") {
  const Scratch folder;
  const std::string mesh = folder.write("hole.msh", mesh_with_hole()).string();
  const std::string meshed = fmt::format(R"("mesh": "{}")", mesh);
  const auto on_mesh = [&](double stiffness) {
    return error_of_supports(meshed, R"({"model": "mesh"})", stiffness);
  };
  const double soft = on_mesh(1e13), stiff = on_mesh(1e14), stiffest = on_mesh(1e15);
  CHECK(soft / stiff == Approx(10).epsilon(0.05));
  CHECK(stiff / stiffest == Approx(10).epsilon(0.01));

  // A lattice that does not fit the body has motions that hardly move its boundary; they come last.
  const std::string drawn = frame_with_hole + R"(, "surfaces": {"all": [0, 1, 2, 3, 4, 5, 6, 7, 8]})";
  const auto on_lattice = [&](double stiffness) {
    return error_of_supports(drawn, lattice(0.3, 0.1, 0.05, 13, "merge"), stiffness);
  };
  double last = on_lattice(1e11);
  for (const double stiffness : {1e12, 1e13, 1e14}) {
    const double error = on_lattice(stiffness);
    CHECK(last / error > 5);
    CHECK(last / error < 10.1);
    last = error;
  }
}
