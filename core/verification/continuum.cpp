#include "verification/case.hpp"
#include "verification/course.hpp"
#include "verification/free_bar.hpp"
#include "verification/patch_test.hpp"
#include "verification/rectangle_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace talus::verification {
namespace {

using std::numbers::pi;
constexpr double young = 1e10, poisson = 0.25;

/// Concave, with a hole; no side follows a lattice.
constexpr const char* frame_text =
    R"("polygon": [[0, 0], [2.1, 0.2], [2.3, 1.1], [1.2, 0.9], [1.1, 1.7], [-0.2, 1.5]],
       "holes": [[[0.3, 0.4], [0.8, 0.5], [0.6, 1.1]]])";

Scene single_body(const Bench& bench, const std::string& shape, const std::string& cover,
                  const std::string& model = "linear_elastic") {
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{"rock": {{"density": 2300, "model": "{}", "young_modulus": {}, "poisson_ratio": {}}}}},
          "cover": {}, "bodies": [{{"name": "a", "material": "rock", {}}}], "time": {{"end": 1}}}})",
      model, young, poisson, cover, shape));
}

std::string lattice_cover(double size, double x, double y, double angle, const std::string& slivers) {
  return fmt::format(
      R"({{"model": "hexagonal", "size": {}, "offset_x": {}, "offset_y": {}, "angle": {}, "slivers": "{}"}})",
      size, x, y, angle, slivers);
}

void hold_patch_test(Rows& rows, const std::string& what, const PatchTest& found) {
  rows.below(Kind::exact, what + ": stress off D : ε, share", found.stress, 1e-12, "");
  rows.below(Kind::exact, what + ": forces off the tractions, share", found.force, 1e-12, "");
}

void patch(const Bench& bench, Rows& rows) {
  std::mt19937 source(7);
  const auto random = [&] { return static_cast<double>(source()) / 4294967296.0; };
  PatchTest worst;
  for (int i = 0; i < 30; ++i) {
    const double size = 0.08 + 0.5 * random(), x = size * random(), y = size * random(),
                 angle = 60 * random();
    for (const char* slivers : {"merge", "keep"}) {
      const PatchTest one = patch_test(
          single_body(bench, frame_text, lattice_cover(size, x, y, angle, slivers)), young, poisson);
      worst = {std::max(worst.stress, one.stress), std::max(worst.force, one.force)};
    }
  }
  hold_patch_test(rows, "60 lattices anywhere", worst);
  const TemporaryFolder folder;
  const std::string mesh = folder.write("skew.msh", RectangleMesh{{0.1, 0.2}, {2, 1}, 7, 3, 0.3}.text());
  hold_patch_test(rows, "mesh",
                  patch_test(single_body(bench, fmt::format(R"("mesh": "{}")", mesh), R"({"model": "mesh"})"),
                             young, poisson));
  hold_patch_test(rows, "block",
                  patch_test(single_body(bench, frame_text, R"({"model": "block"})"), young, poisson));
}

void turns(const Bench& bench, Rows& rows) {
  for (const char* model : {"linear_elastic", "hypoelastic"}) {
    const Scene scene = single_body(bench, frame_text, lattice_cover(0.35, 0.1, 0.05, 13, "merge"), model);
    rows.below(Kind::bound, fmt::format("{}: strain", model), strain_of_turns(scene, young),
               std::string(model) == "hypoelastic" ? 1e-10 : 1e-12, "");
  }
}

void spin(const Bench& bench, Rows& rows) {
  const Scene scene = bench.from_text(fmt::format(
      R"({{"talus": 1,
          "materials": {{"rock": {{"density": 2300, "model": "linear_elastic", "young_modulus": 1e9, "poisson_ratio": 0.25}}}},
          "cover": {{"model": "hexagonal", "size": 0.35, "offset_x": 0.1, "angle": 13}},
          "bodies": [{{"name": "a", "material": "rock", "angular_velocity": 720, {}}}],
          "time": {{"end": 10, "safety": 0.8}}, "output": {{"history": 0.003}}}})",
      frame_text));
  std::vector<double> energy;
  double rotation = 0;
  run_through(scene, {}, [&](const Simulation& simulation) {
    energy.push_back(simulation.ledger().strain);
    rotation = simulation.body_motion(0).rotation;
  });
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += energy[i];
    return sum / static_cast<double>(to - from);
  };
  const std::size_t quarter = energy.size() / 4;
  rows.near(Kind::exact, "turns in 10 s", rotation / (2 * pi), 20, 1e-3, "");
  rows.near(Kind::exact, "elastic energy, last quarter over first",
            mean(3 * quarter, 4 * quarter) / mean(0, quarter), 1, 0.01, "");
}

void bar(const Bench& bench, Rows& rows) {
  const double exact = std::sqrt(1e10 / 2300) / 20;
  const TemporaryFolder folder;
  for (const std::string cover : {"hexagonal", "mesh"}) {
    std::vector<double> errors;
    double finest = 0;
    for (const double size : {0.5, 0.25, 0.125}) {
      Scene scene;
      if (cover == "mesh") {
        const int columns = static_cast<int>(std::lround(10 / size)),
                  high = static_cast<int>(std::lround(0.5 / size));
        const std::string mesh = folder.write(fmt::format("bar{}.msh", columns),
                                              RectangleMesh{{-5, -0.25}, {10, 0.5}, columns, high}.text());
        scene = free_bar(bench, R"({"model": "mesh"})", fmt::format(R"("mesh": "{}")", mesh));
      } else {
        scene = free_bar(bench, lattice_cover(size, 0.123, 0.057, 17, "merge"),
                         R"("polygon": [[-5, -0.25], [5, -0.25], [5, 0.25], [-5, 0.25]],
                            "surfaces": {"top": [2], "bottom": [0]})");
      }
      finest = first_frequency(scene);
      errors.push_back(std::abs(finest - exact) / exact);
    }
    rows.near(Kind::analytic, cover + ", 0.125 m: frequency √(E/ρ)/2L", finest, exact,
              cover == "mesh" ? 1e-3 : 5e-5, "Hz");
    rows.above(Kind::analytic, cover + ": order from 0.5 to 0.125 m, due 2",
               std::log2(errors[0] / errors[2]) / 2, 1.9, "");
  }
}

double deflection_of_end(const Scene& scene) {
  double height = 0;
  run_through(scene, {}, [&](const Simulation& simulation) {
    height = simulation.point_motion(0, {10, 0}).position.y;
  });
  return height;
}

constexpr double deflection_due = 3.7766e-4;  // m, Timoshenko and Goodier, plane strain

void cantilever_on_lattices(const Bench& bench, Rows& rows) {
  std::vector<double> errors;
  for (const char* size : {"0.25", "0.176777", "0.125", "0.0883883"}) {
    const double height = deflection_of_end(bench.shipped("cantilever", {{"/cover/size", size}}));
    errors.push_back(std::abs(height - deflection_due) / deflection_due);
    if (errors.size() == 3) rows.near(Kind::analytic, "H/8: deflection", height, deflection_due, 0.025, "m");
    if (errors.size() == 4)
      rows.near(Kind::analytic, "H/11.3: deflection", height, deflection_due, 0.0125, "m");
  }
  rows.above(Kind::analytic, "order from H/4 to H/8, due 2", std::log2(errors[0] / errors[2]), 1.9, "");
  rows.above(Kind::analytic, "order from H/5.7 to H/11.3, due 2", std::log2(errors[1] / errors[3]), 1.9, "");
}

void cantilever_on_meshes(const Bench& bench, Rows& rows) {
  const TemporaryFolder folder;
  std::vector<double> errors;
  for (const int high : {4, 8, 16}) {
    std::string mesh = RectangleMesh{{0, -0.5}, {10, 1}, 10 * high, high}.text();
    for (const auto& [old, now] : {std::pair{"\"left\"", "\"wall\""}, {"\"right\"", "\"end\""}})
      mesh.replace(mesh.find(old), std::string(old).size(), now);
    const std::string file = folder.write(fmt::format("beam{}.msh", high), mesh);
    const double height = deflection_of_end(bench.shipped(
        "cantilever",
        {{"/cover", R"({"model": "mesh"})"},
         {"/bodies", fmt::format(R"([{{"name": "beam", "mesh": "{}", "material": "rock"}}])", file)}}));
    errors.push_back(std::abs(height - deflection_due) / deflection_due);
    if (high == 16) rows.near(Kind::analytic, "H/16: deflection", height, deflection_due, 0.015, "m");
  }
  rows.shown("order from H/4 to H/8", std::log2(errors[0] / errors[1]), "");
  rows.above(Kind::analytic, "order from H/8 to H/16, due 2", std::log2(errors[1] / errors[2]), 1.9, "");
}

/// Largest deviation of any element's stress from the even pressure of 1000 Pa, as a share of it.
double unevenness(const Scene& scene) {
  double largest = 0;
  run_through(scene, {}, [&](const Simulation& simulation) {
    largest = 0;
    for (std::size_t body = 0; body < simulation.body_count(); ++body) {
      for (const BodyPart& part : simulation.parts(body)) {
        largest = std::max({largest, std::abs(part.stress[0]) / 1000, std::abs(part.stress[1] + 1000) / 1000,
                            std::abs(part.stress[2]) / 1000});
      }
    }
  });
  return largest;
}

void contact_patch(const Bench& bench, Rows& rows) {
  const std::string once = R"({"history": 1})";
  rows.below(Kind::exact, "lattice on lattice: stress of any element off, share",
             unevenness(bench.shipped("contact_patch", {{"/output", once}})), 1e-6, "");
  rows.below(Kind::exact, "block on lattice",
             unevenness(bench.shipped("contact_patch",
                                      {{"/bodies/1/cover", R"({"model": "block"})"}, {"/output", once}})),
             1e-6, "");
  const TemporaryFolder folder;
  const std::string mesh = folder.write("lower.msh", RectangleMesh{{0, 0}, {2, 1}, 5, 3}.text());
  rows.below(
      Kind::exact, "lattice on mesh",
      unevenness(bench.shipped(
          "contact_patch",
          {{"/bodies/0",
            fmt::format(
                R"({{"name": "lower", "material": "rock", "mesh": "{}", "cover": {{"model": "mesh"}}}})",
                mesh)},
           {"/output", once}})),
      1e-6, "");
}

/// Kinetic energy of a spinning block, ½ m (b² + h²)/12 ω².
void inertia(const Bench& bench, Rows& rows) {
  constexpr double width = 0.5, height = 1, spin = 1;
  const double due = 0.5 * 2300 * width * height * (width * width + height * height) / 12 * spin * spin;
  const auto kinetic = [&](const std::string& cover) {
    const Scene scene = single_body(
        bench,
        fmt::format(R"("polygon": [[0, 0], [{0}, 0], [{0}, {1}], [0, {1}]], "angular_velocity": {2:.17g})",
                    width, height, spin * 180 / pi),
        cover);
    Simulation simulation(scene, {});
    simulation.advance();
    return simulation.ledger().kinetic;
  };
  for (const char* cover : {"rigid", "block"})
    rows.near(Kind::analytic, fmt::format("{}: energy of rotation", cover),
              kinetic(fmt::format(R"({{"model": "{}"}})", cover)), due, 1e-9, "J/m");
  // Row sums: the error of the inertia falls with the square of the size.
  const double coarse = kinetic(lattice_cover(0.1, 0.02, 0.03, 7, "merge")) / due - 1,
               fine = kinetic(lattice_cover(0.05, 0.02, 0.03, 7, "merge")) / due - 1;
  rows.below(Kind::bound, "lattice of 0.1 m: share too much, at most 1.5 (size over width)²",
             std::abs(coarse), 1.5 * 0.04, "");
  rows.above(Kind::analytic, "its order from 0.1 to 0.05 m, due 2", std::log2(std::abs(coarse / fine)), 1.7,
             "");
}

/// Of a lattice of triangles of side h: 0.866025 h/c_p for any ν.
void critical_step(const Bench& bench, Rows& rows) {
  for (const char* ratio : {"0", "0.25", "0.45"}) {
    constexpr double size = 0.125;
    const Scene scene = bench.from_text(
        fmt::format(R"({{"talus": 1, "materials": {{{}}}, "cover": {{"model": "hexagonal", "size": {}}},
            "bodies": [{{"name": "a", "material": "rock", "polygon": [[0, 0], [4, 0], [4, 4], [0, 4]]}}],
            "time": {{"end": 1}}}})",
                    rock_text, size),
        {{"/materials/rock/poisson_ratio", ratio}});
    const double nu = std::stod(ratio);
    const double speed = std::sqrt(young * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / 2300);
    rows.between(Kind::bound,
                 fmt::format("ν = {}: Δt_c over 0.866025 h/c_p, a bound on the safe side", ratio),
                 Simulation(scene, {}).critical_dt() / (0.866025 * size / speed), 0.8, 1.0001, "");
  }
}

}  // namespace

std::span<const Case> continuum_cases() {
  static constexpr Case cases[] = {
      {"continuum", "patch",
       "A linear field is exact wherever the cover lies: stress and forces to round-off.", 1, patch},
      {"continuum", "inertia",
       "A spinning block has the energy of its inertia; row sums of the mass would give one element twelve "
       "times that.",
       1, inertia},
      {"continuum", "critical_step",
       "The stable step of a lattice is 0.866025 h/c_p for any Poisson's ratio.", 1, critical_step},
      {"continuum", "turns", "100 rigid turns leave no strain.", 2, turns},
      {"continuum", "spin", "The elastic energy of a spinning body has no trend.", 4, spin},
      {"continuum", "bar",
       "A free bar swings at √(E/ρ)/2L = 104.257 Hz, with an error of second order in the size.", 60, bar},
      {"continuum", "cantilever",
       "A cantilever on lattices that do not fit it bends by what Timoshenko and Goodier give, less an error "
       "of second "
       "order.",
       60, cantilever_on_lattices},
      {"continuum", "cantilever_mesh", "The same on meshes.", 60, cantilever_on_meshes},
      {"continuum", "contact_patch", "Even pressure passes evenly between covers that do not match.", 10,
       contact_patch},
  };
  return cases;
}

}  // namespace talus::verification
