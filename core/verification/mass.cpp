#include "verification/case.hpp"
#include "verification/free_bar.hpp"
#include "verification/mass_matrices.hpp"
#include "verification/rectangle_mesh.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

constexpr double bar_length = 10;
const double bar_speed = std::sqrt(1e10 / 2300);  // of waves along it, m/s

std::string bar_mesh(const TemporaryFolder& folder, double size) {
  const int columns = static_cast<int>(std::lround(bar_length / size)),
            high = static_cast<int>(std::lround(0.5 / size));
  const RectangleMesh mesh{{-bar_length / 2, -0.25}, {bar_length, 0.5}, columns, high};
  return folder.write(fmt::format("bar{}.msh", columns), mesh.text());
}

Scene meshed_bar(const Bench& bench, const TemporaryFolder& folder, double size) {
  return free_bar(bench, R"({"model": "mesh"})", fmt::format(R"("mesh": "{}")", bar_mesh(folder, size)));
}

/// ω of a free bar, n half waves along it.
double bar_frequency(int n) {
  return n * std::numbers::pi * bar_speed / bar_length;
}

struct BarErrors {
  double lumped, consistent;  ///< share of the frequency, positive: too high
};

BarErrors bar_errors(const MassMatrices& bar, int half_waves) {
  const double exact = bar_frequency(half_waves);
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(bar.lumped.size());
  for (std::size_t p = 0; p < bar.star.size(); ++p)
    shape(static_cast<Eigen::Index>(2 * p)) =
        std::cos(half_waves * std::numbers::pi * (bar.star[p].x / bar_length + 0.5));
  return {frequency_of(bar.stiffness, bar.lumped_matrix(), shape, exact) / exact - 1,
          frequency_of(bar.stiffness, bar.consistent, shape, exact) / exact - 1};
}

void mass_of_bar(const Bench& bench, Rows& rows) {
  const TemporaryFolder folder;
  constexpr std::array sizes{0.5, 0.25, 0.125};
  std::array<std::array<BarErrors, 3>, 3> errors;  // [size][mode − 1]
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const MassMatrices bar = mass_matrices(meshed_bar(bench, folder, sizes[s]));
    for (int n = 1; n <= 3; ++n) errors[s][static_cast<std::size_t>(n - 1)] = bar_errors(bar, n);
  }
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    for (std::size_t mode = 0; mode < 3; ++mode) {
      const double wave = static_cast<double>(mode + 1) * std::numbers::pi * sizes[s] / bar_length;
      const BarErrors of = errors[s][mode];
      rows.below(Kind::bound, fmt::format("{} m, mode {}: row sums, frequency off", sizes[s], mode + 1),
                 100 * of.lumped, 0, "%");
      // Rayleigh: no motion that the mesh can do is slower than the bar.
      rows.above(Kind::bound, "consistent", 100 * of.consistent, 0, "%");
      rows.near(Kind::analytic, "apart by (kh)²/12", 100 * (of.consistent - of.lumped),
                100 * wave * wave / 12, 0.01, "%");
    }
  }
  rows.near(Kind::analytic, "order from 0.5 to 0.125 m, row sums",
            std::log2(errors[0][0].lumped / errors[2][0].lumped) / 2, 2, 0.01, "");
  rows.near(Kind::analytic, "order, consistent",
            std::log2(errors[0][0].consistent / errors[2][0].consistent) / 2, 2, 0.01, "");
}

/// What the program makes of it is the bar with row sums, but for (ωΔt)²/24 of the step, 2.4e-5.
void run_of_bar(const Bench& bench, Rows& rows) {
  const TemporaryFolder folder;
  const Scene scene = meshed_bar(bench, folder, 0.5);
  const double due =
      bar_frequency(1) * (1 + bar_errors(mass_matrices(scene), 1).lumped) / (2 * std::numbers::pi);
  rows.near(Kind::analytic, "0.5 m: frequency of the run, due that of row sums", first_frequency(scene), due,
            4e-5, "Hz");
}

/// A body of E = 1e10 Pa without a load.
MassMatrices square_matrices(const Bench& bench, const std::string& cover, const std::string& shape,
                             double poisson_ratio) {
  return mass_matrices(bench.from_text(
      fmt::format(
          R"({{"talus": 1, "materials": {{{}}}, "cover": {}, "bodies": [{{"name": "a", "material": "rock", {}}}],
          "time": {{"end": 1}}}})",
          rock_text, cover, shape),
      {{"/materials/rock/poisson_ratio", fmt::format("{}", poisson_ratio)}}));
}

struct StableSteps {
  double lumped, consistent;
};

StableSteps stable_steps(const MassMatrices& matrices) {
  return {largest_stable_step(matrices.stiffness, matrices.lumped_matrix()),
          largest_stable_step(matrices.stiffness, matrices.consistent)};
}

void show_steps(Rows& rows, const std::string& what, const StableSteps& of) {
  rows.shown(what + ": stable step, row sums", of.lumped, "s");
  rows.shown("consistent", of.consistent, "s");
}

void mass_and_step(const Bench& bench, Rows& rows) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("square.msh", RectangleMesh{{0, 0}, {2, 2}, 10, 10}.text());
  constexpr double size = 0.25;
  for (const double nu : {0.0, 0.25, 0.45}) {
    const StableSteps of = stable_steps(
        square_matrices(bench, R"({"model": "mesh"})", fmt::format(R"("mesh": "{}")", mesh), nu));
    show_steps(rows, fmt::format("mesh of 0.2 m, ν = {}", nu), of);
    rows.between(Kind::bound, "consistent over row sums, at least 1/2", of.consistent / of.lumped, 0.5, 1,
                 "");
  }
  for (const double nu : {0.0, 0.25, 0.45}) {
    // A triangle of whole triangles: the vertex at its left corner lies on the lattice.
    constexpr double side = 16 * size;
    const StableSteps of = stable_steps(square_matrices(
        bench,
        fmt::format(
            R"({{"model": "hexagonal", "size": {}, "offset_x": {:.17g}, "offset_y": {:.17g}, "slivers": "keep"}})",
            size, -side / 2, -side / std::sqrt(12.0)),
        fmt::format(R"("polygon": [[0, 0], [{0}, 0], [{1:.17g}, {2:.17g}]])", side, side / 2,
                    side * std::sqrt(0.75)),
        nu));
    show_steps(rows, fmt::format("whole lattice of 0.25 m, ν = {}", nu), of);
    rows.between(Kind::bound, "consistent over row sums, 1/2 to 1/√3", of.consistent / of.lumped, 0.5,
                 1 / std::sqrt(3.0), "");
  }
}

/// A lattice, the top of whose body lies `above` a row of vertices, as a share of the height of a row.
StableSteps cut_lattice(const Bench& bench, double above) {
  constexpr double size = 0.25;
  const double row = size * std::sqrt(0.75), height = (4 + above) * row;
  return stable_steps(square_matrices(
      bench,
      fmt::format(R"({{"model": "hexagonal", "size": {}, "offset_y": {:.17g}, "slivers": "keep"}})", size,
                  -height / 2),
      fmt::format(R"("polygon": [[0, 0], [1.1, 0], [1.1, {0:.17g}], [0, {0:.17g}]])", height), 0.25));
}

void cut_and_step(const Bench& bench, Rows& rows) {
  const StableSteps thick = cut_lattice(bench, 1e-2), thin = cut_lattice(bench, 1e-4);
  rows.near(Kind::analytic, "order of the step in the height of the cut, row sums",
            std::log10(thick.lumped / thin.lumped) / 2, 0.5, 0.05, "");
  rows.near(Kind::analytic, "order, consistent", std::log10(thick.consistent / thin.consistent) / 2, 1, 0.05,
            "");
  // Jensen: (Σ w_i v_i)² ≤ Σ w_i v_i², so the consistent mass is never the heavier.
  show_steps(rows, "cut 1/100 of a row above", thick);
  rows.below(Kind::bound, "consistent over row sums", thick.consistent / thick.lumped, 1, "");
  show_steps(rows, "cut 1/10,000 of a row above", thin);
  rows.below(Kind::bound, "consistent over row sums", thin.consistent / thin.lumped, 1, "");
}

}  // namespace

std::span<const Case> mass_cases() {
  static constexpr Case cases[] = {
      {"mass", "frequencies",
       "Row sums make the longitudinal frequencies of a bar too low and the consistent mass too high, "
       "(kh)²/12 apart.",
       3, mass_of_bar},
      {"mass", "run", "A bar that the program lets swing does so at the frequency of row sums.", 2,
       run_of_bar},
      {"mass", "step",
       "The consistent mass takes a shorter step, in whole triangles half as long at least; on a whole "
       "lattice 1/√3 at most.",
       2, mass_and_step},
      {"mass", "cut",
       "Where a lattice is cut ε above a row of vertices, the step falls with √ε for row sums and with ε for "
       "the consistent mass.",
       1, cut_and_step},
  };
  return cases;
}

}  // namespace talus::verification
