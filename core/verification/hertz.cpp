#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

// A cylinder on a half-plane, per metre of thickness; scenes/generate/hertz.py writes the same as files.
constexpr double cylinder_radius = 1, hertz_load = 1e6, hertz_young = 1e10, hertz_poisson = 0.25;
constexpr double contact_stiffness = 1e13;  // Pa/m: softer, and the answer is that of springs
const double half_width = std::sqrt(8 * hertz_load * cylinder_radius * (1 - hertz_poisson * hertz_poisson) /
                                    (std::numbers::pi * hertz_young));
const double peak_pressure = 2 * hertz_load / (std::numbers::pi * half_width);
constexpr double fine = 1.3, growth = 1.45;  // of the half width; from cell to cell beyond it
constexpr int probes = 65;                   // from the middle outwards

/// From 0 to `end`: cells of one size up to `even`, then growing ones, all stretched a little to fit.
std::vector<double> steps_to(double end, double cell, double even) {
  std::vector<double> at{0};
  while (at.back() < even * (1 - 1e-9)) at.push_back(at.back() + cell);
  std::size_t kept = 0;
  while (kept < at.size() && at[kept] <= even * (1 + 1e-9)) ++kept;
  for (double size = cell; at.back() < end;) {
    size *= growth;
    at.push_back(at.back() + size);
  }
  const double from = at[kept - 1], stretch = (end - from) / (at.back() - from);
  for (std::size_t i = kept; i < at.size(); ++i) at[i] = from + stretch * (at[i] - from);
  return at;
}

using NodeRows = std::vector<std::vector<Vec2>>;  ///< from the lowest to the highest

/// `place` gives a node from its x and its share of the height from the contact on.
template <class Place>
NodeRows grid(double width, double height, int cells, const Place& place) {
  const double cell = half_width / cells;
  const std::vector<double> right = steps_to(width, cell, fine * half_width),
                            away = steps_to(height, cell, half_width);
  std::vector<double> across;
  for (std::size_t i = right.size(); i-- > 1;) across.push_back(-right[i]);
  across.insert(across.end(), right.begin(), right.end());
  NodeRows rows;
  for (const double y : away) {
    std::vector<Vec2>& row = rows.emplace_back();
    for (const double x : across) row.push_back(place(x, y / height));
  }
  return rows;
}

NodeRows cylinder_rows(int cells) {
  return grid(0.8 * cylinder_radius, cylinder_radius, cells, [](double x, double share) {
    const double low = cylinder_radius - std::sqrt(cylinder_radius * cylinder_radius - x * x);
    return Vec2{x, low + share * (cylinder_radius - low)};
  });
}

NodeRows block_rows(int cells) {
  NodeRows rows = grid(3 * cylinder_radius, 3 * cylinder_radius, cells, [](double x, double share) {
    return Vec2{x, -3 * cylinder_radius * share};
  });
  std::reverse(rows.begin(), rows.end());
  return rows;
}

/// MSH 2.2; the sides along `far_row` are the surface "far".
std::string mesh_of(const NodeRows& rows, std::size_t far_row) {
  const std::size_t columns = rows[0].size();
  const auto node = [&](std::size_t i, std::size_t j) { return 1 + i + j * columns; };
  std::string nodes, elements;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < columns; ++i)
    elements += fmt::format("{} 1 2 1 1 {} {}\n", ++count, node(i, far_row), node(i + 1, far_row));
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const std::size_t a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
      const bool left = 2 * i < columns - 1;
      elements += fmt::format("{} 2 2 2 2 {} {} {}\n", ++count, a, b, left ? c : d);
      elements += fmt::format("{} 2 2 2 2 {} {} {}\n", ++count, left ? a : b, c, d);
    }
  }
  for (std::size_t j = 0; j < rows.size(); ++j) {
    for (std::size_t i = 0; i < columns; ++i)
      nodes += fmt::format("{} {:.17g} {:.17g} 0\n", node(i, j), rows[j][i].x, rows[j][i].y);
  }
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 1 \"far\"\n2 2 "
      "\"body\"\n$EndPhysicalNames\n"
      "$Nodes\n{}\n{}$EndNodes\n$Elements\n{}\n{}$EndElements\n",
      rows.size() * columns, nodes, count, elements);
}

/// Height of the lower side of the cylinder as it is meshed.
double chord_at(const NodeRows& rows, double x) {
  const std::vector<Vec2>& low = rows[0];
  std::size_t i = 0;
  while (i + 2 < low.size() && low[i + 1].x <= x) ++i;
  return low[i].y + (low[i + 1].y - low[i].y) * (x - low[i].x) / (low[i + 1].x - low[i].x);
}

struct PressureProfile {
  std::vector<double> at, pressure;  ///< m, Pa

  /// Where the boundaries part, m.
  double width() const {
    std::size_t out = 1;
    while (out + 1 < at.size() && pressure[out] > 0) ++out;
    return at[out - 1] + (at[out] - at[out - 1]) * pressure[out - 1] / (pressure[out - 1] - pressure[out]);
  }

  /// From p² against x² in the inner 0.6 of the width, Pa.
  double peak() const {
    double n = 0, u = 0, v = 0, uu = 0, uv = 0;
    for (std::size_t i = 0; i < at.size() && at[i] < 0.6 * width(); ++i) {
      const double x = at[i] * at[i], p = pressure[i] * pressure[i];
      n += 1, u += x, v += p, uu += x * x, uv += x * p;
    }
    const double slope = (uv - u * v / n) / (uu - u * u / n);
    return std::sqrt((v - slope * u) / n);
  }
};

PressureProfile hertz_profile(const Bench& bench, int cylinder, int block) {
  const TemporaryFolder folder;
  const NodeRows upper = cylinder_rows(cylinder), lower = block_rows(block);
  const std::string upper_file = folder.write("cylinder.msh", mesh_of(upper, upper.size() - 1)),
                    lower_file = folder.write("block.msh", mesh_of(lower, 0));
  const Scene scene = bench.from_text(fmt::format(
      R"({{"talus": 1, "materials": {{{}}}, "cover": {{"model": "mesh"}}, "contact": {{"model": "frictionless"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": {}, "normal_damping": 0}}],
          "bodies": [{{"name": "block", "mesh": "{}", "material": "rock"}},
                     {{"name": "cylinder", "mesh": "{}", "material": "rock", "fix": ["x", "rotation"]}}],
          "prescribed": [{{"body": "block", "surface": "far", "stiffness": 1e11, "displacement": [0, 0]}}],
          "surface_loads": [{{"body": "cylinder", "surface": "far", "traction": [0, {}]}}],
          "settle": {{"duration": 0.012, "damping": "adaptive"}},
          "time": {{"end": 1e-8, "safety": 0.4}}, "output": {{"history": 1}}}})",
      rock_text, contact_stiffness, lower_file, upper_file, -hertz_load / (1.6 * cylinder_radius)));
  PressureProfile profile;
  run_through(scene, {}, [&](const Simulation& simulation) {
    profile = {};
    for (int i = 0; i < probes; ++i) {
      const double x = fine * half_width * i / probes;
      const Vec2 b = simulation.point_motion(0, {x, 0}).position,
                 c = simulation.point_motion(1, {x, chord_at(upper, x)}).position;
      profile.at.push_back((b.x + c.x) / 2);
      profile.pressure.push_back(contact_stiffness * (b.y - c.y));
    }
  });
  return profile;
}

void hold_hertz(const Bench& bench, Rows& rows, int cylinder, int block) {
  const PressureProfile found = hertz_profile(bench, cylinder, block);
  const std::string sizes = fmt::format("a/{} on a/{}", cylinder, block);
  rows.near(Kind::analytic, sizes + ": half width a", found.width(), half_width, 0.03, "m");
  rows.near(Kind::analytic, sizes + ": peak pressure", found.peak() / 1e6, peak_pressure / 1e6, 0.03, "MPa");
}

void hertz_coarse(const Bench& bench, Rows& rows) {
  hold_hertz(bench, rows, 6, 6);
}
void hertz_fine_block(const Bench& bench, Rows& rows) {
  hold_hertz(bench, rows, 6, 10);
}
void hertz_fine_cylinder(const Bench& bench, Rows& rows) {
  hold_hertz(bench, rows, 10, 6);
}
void hertz_fine(const Bench& bench, Rows& rows) {
  hold_hertz(bench, rows, 10, 10);
}

}  // namespace

std::span<const Case> hertz_cases() {
  static constexpr Case cases[] = {
      {"hertz", "6_on_6",
       "A cylinder on a block, both of a/6 at the contact: a = 0.015451 m, p = 41.203 MPa.", 60,
       hertz_coarse},
      {"hertz", "6_on_10", "The same with a finer block.", 80, hertz_fine_block},
      {"hertz", "10_on_6", "The same with a finer cylinder.", 80, hertz_fine_cylinder},
      {"hertz", "10_on_10", "The same with both finer.", 100, hertz_fine},
  };
  return cases;
}

}  // namespace talus::verification
