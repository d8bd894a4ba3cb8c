#include "safety/safety.hpp"
#include "verification/case.hpp"
#include "verification/course.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace talus::verification {
namespace {

double sunk(const Course& course) {
  return -course.motion.back().displacement.y;
}

void column(const Bench& bench, Rows& rows) {
  // ρgh/α n(n+1)/2 and ρgh² (1 − ν²)/E (n²/2 − ¼), n = 10.
  constexpr double joints = 2300 * 10 / 1e10 * 55, blocks = 2300 * 10 * (1 - 0.0625) / 1e10 * (50 - 0.25);
  for (const char* law : {"overlap_area", "frictionless", "vertex_edge"}) {
    const Course course = run(bench.shipped("column", {{"/contact/model", law}}), "b10");
    // Springs at vertices hinder the blocks in widening.
    rows.near(Kind::analytic, fmt::format("{}: the top sinks by", law), sunk(course), joints + blocks,
              std::string(law) == "vertex_edge" ? 0.08 : 1e-3, "m");
    rows.below(Kind::bound, fmt::format("{}: speed at the end", law),
               magnitude(course.motion.back().velocity), 1e-9, "m/s");
  }
}

void brick_wall(const Bench& bench, Rows& rows) {
  const Scene scene = bench.shipped("brick_wall", {{"/time/end", "0.5"}});
  const std::uint32_t left = body_number(scene, "c20b1"), right = body_number(scene, "c20b21");
  Motion l{}, r{};
  const Course course = run(scene, "c20b11", {}, [&](const Simulation& simulation) {
    l = simulation.body_motion(left);
    r = simulation.body_motion(right);
  });
  rows.between(Kind::analytic, "the top sinks by", sunk(course), 3.37e-4, 3.49e-4, "m");
  rows.below(Kind::bound, "speed at 0.5 s", magnitude(course.motion.back().velocity), 1e-4, "m/s");
  rows.about(Kind::exact, "left and right end: sum of ux", l.displacement.x + r.displacement.x, 0, 1e-9, "m");
}

/// The members of the shipped arch with other voussoirs, `share` of its radius of 10 m thick.
Scene arch_of(const Bench& bench, int voussoirs, double share, const std::string& end) {
  constexpr double radius = 10;
  const double thickness = share * radius, inner = radius - thickness / 2, outer = radius + thickness / 2;
  std::string bodies;
  for (const double side : {-1.0, 1.0}) {
    const double middle = side * radius, half = 1.5 * thickness;
    const std::vector<Vec2> abutment{
        {middle - half, -thickness}, {middle + half, -thickness}, {middle + half, 0}, {middle - half, 0}};
    bodies += fmt::format(R"({{"name": "{}", "material": "rock", "fixed": true, "polygon": {}}}, )",
                          side < 0 ? "left" : "right", polygon_text(abutment));
  }
  for (int i = 0; i < voussoirs; ++i) {
    const double from = (i - voussoirs / 2.0) * std::numbers::pi / voussoirs,
                 to = from + std::numbers::pi / voussoirs;
    const auto at = [&](double r, double angle) {
      const double height = r * std::cos(angle);
      return Vec2{r * std::sin(angle), std::abs(height) < 1e-9 ? 0 : height};
    };
    bodies += fmt::format(R"({{"name": "v{}", "material": "rock", "polygon": {}}}{})", i + 1,
                          polygon_text({at(inner, from), at(inner, to), at(outer, to), at(outer, from)}),
                          i + 1 < voussoirs ? ", " : "");
  }
  return bench.shipped("arch", {{"/bodies", "[" + bodies + "]"}, {"/monitors", "[]"}, {"/time/end", end}});
}

/// Thinnest semicircular arch of so many equal voussoirs with a line of thrust within all joints.
struct ArchLimit {
  int voussoirs;
  double thickness;  ///< share of the radius
};
constexpr ArchLimit arch_limits[] = {{5, 0.09498}, {7, 0.09570}, {25, 0.10696}};

void arch(const Bench& bench, Rows& rows) {
  for (const ArchLimit limit : arch_limits) {
    const std::string crown = fmt::format("v{}", (limit.voussoirs + 1) / 2);
    const Course stands = run(arch_of(bench, limit.voussoirs, 1.05 * limit.thickness, "10"), crown);
    rows.below(Kind::published,
               fmt::format("{} voussoirs, 1.05 of the limit: moves in 10 s", limit.voussoirs),
               stands.moved_between(0, 11), 1e-6, "m");
    const Course falls = run(arch_of(bench, limit.voussoirs, 0.97 * limit.thickness, "2"), crown);
    rows.above(Kind::published,
               fmt::format("{} voussoirs, 0.97 of the limit: falls in 2 s by", limit.voussoirs), sunk(falls),
               1, "m");
  }
}

/// Four bricks that overhang the edge of a table by `share` of what balance allows, Σ L/2k.
Scene overhang(const Bench& bench, double share, double end) {
  constexpr int count = 4;
  constexpr double length = 1, height = 0.25;
  std::string bodies =
      R"({"name": "table", "polygon": [[-3, -1], [0, -1], [0, 0], [-3, 0]], "material": "rock",
                           "fixed": true})";
  double reach = 0;  // of the lower side's end over the table
  for (int i = 0; i < count; ++i) {
    const int from_top = count - i;
    reach += share * length / (2 * from_top);
    const double low = height * i, high = height * (i + 1);
    bodies += fmt::format(
        R"(, {{"name": "b{}", "material": "rock", "polygon": {}}})", i + 1,
        polygon_text({{reach - length, low}, {reach, low}, {reach, high}, {reach - length, high}}));
  }
  return bench.from_text(fmt::format(
      R"({{"talus": 1, "gravity": [0, -9.81], "materials": {{"rock": {{"density": 2300}}}},
          "cover": {{"model": "rigid"}}, "contact": {{"model": "overlap_area"}},
          "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e12, "tangential_stiffness": 1e12,
                          "friction_angle": 60, "normal_damping": 0, "tangential_damping": 0}}],
          "bodies": [{}],
          "settle": {{"duration": 1, "damping": "adaptive", "until": 1e-6}},
          "time": {{"end": {}, "safety": 0.4}}, "output": {{"history": 0.02}}}})",
      bodies, end));
}

void overhanging_bricks(const Bench& bench, Rows& rows) {
  const Course stands = run(overhang(bench, 0.98, 10), "b4");
  rows.below(Kind::analytic, "0.98 of 1.041667 L: the top moves in 10 s", stands.moved_between(0, 11), 1e-5,
             "m");
  const Course falls = run(overhang(bench, 1.02, 2), "b4");
  rows.above(Kind::analytic, "1.02 of 1.041667 L: the top falls in 2 s by", sunk(falls), 0.2, "m");
}

void strength_reduction(const Bench& bench, Rows& rows) {
  const Safety safety = factor_of_safety(bench.shipped("stick_31deg"), {.tolerance = 0.002});
  constexpr double degree = std::numbers::pi / 180;
  rows.near(Kind::analytic, "block at 30° with φ = 31°", safety.factor().value_or(0),
            std::tan(31 * degree) / std::tan(30 * degree), 2e-3, "");
}

}  // namespace

std::span<const Case> statics_cases() {
  static constexpr Case cases[] = {
      {"statics", "column",
       "Ten blocks under their own weight settle by their joints, ρgh/α n(n+1)/2, and by their own "
       "compression.",
       2, column},
      {"statics", "brick_wall", "A wall of 410 bricks comes to rest, as high on the left as on the right.",
       15, brick_wall},
      {"statics", "arch",
       "A semicircular arch stands undamped 5 % above the thinnest in which a line of thrust fits all "
       "joints, and "
       "falls 3 % below it.",
       20, arch},
      {"statics", "overhang",
       "Four bricks of length L overhang a table by Σ L/2k = 1.041667 L at most, and do so undamped.", 6,
       overhanging_bricks},
      {"statics", "safety", "Strength reduction finds tan φ/tan α of a block on a slope.", 4,
       strength_reduction},
  };
  return cases;
}

}  // namespace talus::verification
