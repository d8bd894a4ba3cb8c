#include "figures/runs.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

/// Two bodies of the same width, one on the other, of lattices that do not match, under a pressure.
Scene stacked(const std::string& lower, const std::string& upper, const std::string& lower_shape,
              double poisson_ratio, const std::string& roles) {
  return from_text(fmt::format(
      R"({{"talus": 1,
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e10, "poisson_ratio": {}}}}},
          "contact": {{"model": "frictionless", "roles": "{}"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e11, "normal_damping": 0}}],
          "bodies": [
            {{"name": "lower", "material": "rock", {}, "cover": {}}},
            {{"name": "upper", "material": "rock", "polygon": [[0, 1], [2, 1], [2, 1.8], [0, 1.8]],
              "surfaces": {{"above": [2]}}, "cover": {}}}],
          "prescribed": [{{"body": "lower", "surface": "bottom", "stiffness": 1e12, "displacement": [null, 0]}}],
          "surface_loads": [{{"body": "upper", "surface": "above", "pressure": 1000}}],
          "settle": {{"duration": 0.08, "damping": "adaptive"}},
          "time": {{"end": 1e-9, "safety": 0.4}}}})",
      poisson_ratio, roles, lower_shape, lower, upper));
}

const std::string lower_box = R"("polygon": [[0, 0], [2, 0], [2, 1], [0, 1]], "surfaces": {"bottom": [0]})";

/// Largest deviation of any element's stress from uniform pressure, as a share of it.
double unevenness(const Scene& scene) {
  Simulation simulation(scene, {});
  simulation.settle();
  simulation.advance();
  double largest = 0;
  for (std::size_t body = 0; body < 2; ++body) {
    for (const BodyPart& part : simulation.parts(body)) {
      largest = std::max({largest, std::abs(part.stress[0]) / 1000, std::abs(part.stress[1] + 1000) / 1000,
                          std::abs(part.stress[2]) / 1000});
    }
  }
  return largest;
}

/// A rectangle from (0, 0) to (2, 1) of 5 × 3 cells with its sides "bottom" and the rest.
std::string mesh_of_lower() {
  const auto node = [](int i, int j) { return 1 + i + 6 * j; };
  std::string nodes, elements;
  int count = 0;
  for (int j = 0; j <= 3; ++j) {
    for (int i = 0; i <= 5; ++i) nodes += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), 0.4 * i, j / 3.0);
  }
  for (int i = 0; i < 5; ++i) {
    elements += fmt::format("{} 1 2 1 1 {} {}\n", ++count, node(i, 0), node(i + 1, 0));
    for (int j = 0; j < 3; ++j) {
      const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      elements += fmt::format("{} 2 2 2 1 {} {} {}\n", ++count, a, b, c);
      elements += fmt::format("{} 2 2 2 1 {} {} {}\n", ++count, a, c, d);
    }
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"bottom\"\n2 2 "
      "\"body\"\n$EndPhysicalNames\n"
      "$Nodes\n24\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      nodes, count, elements);
}

}  // namespace

TEST_CASE("Contact patch test: pressure passes evenly between covers that do not match",
          "[figures][continuum][slow_sanitised]") {
  const std::string coarse =
      R"({"model": "hexagonal", "size": 0.3, "offset_x": 0.07, "offset_y": 0.04, "angle": 17})";
  const std::string fine =
      R"({"model": "hexagonal", "size": 0.19, "offset_x": 0.02, "offset_y": 0.11, "angle": 41})";
  CHECK(unevenness(stacked(coarse, fine, lower_box, 0, "symmetric")) <= 1e-6);
  CHECK(unevenness(stacked(coarse, fine, lower_box, 0.25, "priority")) <= 1e-6);
  CHECK(unevenness(stacked(coarse, R"({"model": "block"})", lower_box, 0.25, "symmetric")) <= 1e-6);
  const Scratch folder;
  const std::string mesh = folder.write("lower.msh", mesh_of_lower()).string();
  const std::string shape = fmt::format(R"("mesh": "{}")", mesh);
  CHECK(unevenness(stacked(R"({"model": "mesh"})", coarse, shape, 0.25, "symmetric")) <= 1e-6);
}

namespace {

/// Height of the end of the cantilever, m.
double deflection(const std::vector<Override>& overrides) {
  Simulation simulation(shipped("cantilever", overrides), {});
  simulation.settle();
  simulation.advance();
  const double height = simulation.point_motion(0, {10, 0}).position.y;
  return height;
}

}  // namespace

TEST_CASE("Cantilever: the error of its deflection is of second order in the size of the lattice",
          "[slow][figures][continuum]") {
  const double exact = 3.7766e-4;
  std::vector<double> error;
  for (const char* size : {"0.353553", "0.25", "0.176777", "0.125"})
    error.push_back(std::abs(deflection({{"/cover/size", size}}) - exact) / exact);
  INFO(fmt::format("{:.3e} {:.3e} {:.3e} {:.3e}", error[0], error[1], error[2], error[3]));
  CHECK(std::log2(error[0] / error[2]) > 1.9);
  CHECK(std::log2(error[1] / error[3]) > 1.9);
  CHECK(error[3] < 0.025);
}
