#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::figures;

namespace {

using std::numbers::pi;
constexpr double radius = 10;  // m, of the centre line

/// The members of the shipped arch with other voussoirs: `share` of the radius thick.
Scene arch(int voussoirs, double share, const std::string& end) {
  const double thickness = share * radius, inner = radius - thickness / 2, outer = radius + thickness / 2;
  std::string bodies;
  for (const double side : {-1.0, 1.0}) {
    const double middle = side * radius, half = 1.5 * thickness;
    bodies += fmt::format(
        R"({{"name": "{}", "material": "rock", "fixed": true, "polygon": [[{}, {}], [{}, {}], [{}, 0], [{}, 0]]}},)",
        side < 0 ? "left" : "right", middle - half, -thickness, middle + half, -thickness, middle + half,
        middle - half);
  }
  for (int i = 0; i < voussoirs; ++i) {
    const double begin = (i - voussoirs / 2.0) * pi / voussoirs, end_angle = begin + pi / voussoirs;
    const auto at = [&](double r, double angle) {
      const double height = r * std::cos(angle);
      return fmt::format("[{}, {}]", r * std::sin(angle), std::abs(height) < 1e-9 ? 0 : height);
    };
    bodies += fmt::format(R"({{"name": "v{}", "material": "rock", "polygon": [{}, {}, {}, {}]}}{})", i + 1,
                          at(inner, begin), at(inner, end_angle), at(outer, end_angle), at(outer, begin),
                          i + 1 < voussoirs ? "," : "");
  }
  const std::string crown = fmt::format(R"([{{"name": "crown", "body": "v{}"}}])", (voussoirs + 1) / 2);
  return shipped("arch", {{"/bodies", "[" + bodies + "]"}, {"/monitors", crown}, {"/time/end", end}});
}

/// Without damping from t = 0 on an arch that stands rings a little for ever; 1e-6 m is a millionth of its
/// thickness.
void check_stands(const Scene& scene, const std::string& crown) {
  const Course course = run(scene, crown);
  const double moved = course.moved_between(0, course.time.back());
  INFO(fmt::format("{}: moved {:.2e} m in {} s", crown, moved, course.time.back()));
  CHECK(moved < 1e-6);
}

void check_falls(const Scene& scene, const std::string& crown) {
  const Course course = run(scene, crown);
  INFO(fmt::format("{}: fallen by {:.3f} m", crown, -course.motion.back().displacement.y));
  CHECK(course.motion.back().displacement.y < -radius / 10);
}

}  // namespace

TEST_CASE("Arch of 7 voussoirs: 5 % above the limit of the line of thrust it stands for 10 s",
          "[slow][figures]") {
  check_stands(arch(7, 1.05 * 0.09570, "10"), "v4");
}

TEST_CASE("Arch: 3 % below the limit of the line of thrust it falls", "[slow][figures]") {
  check_falls(arch(7, 0.97 * 0.09570, "2"), "v4");
  check_falls(arch(25, 0.97 * 0.10696, "2"), "v13");
}

TEST_CASE("Arch of 25 voussoirs, as shipped: 5 % above the limit it stands for 10 s", "[slow][figures]") {
  check_stands(shipped("arch"), "v13");
}
