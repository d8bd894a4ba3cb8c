#include "figures/runs.hpp"
#include "output/scratch.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

const double degree = std::acos(-1.0) / 180;

/// Rigid bodies of which the first is fixed, settled, with friction of `angle` degrees; `rest` begins with
/// "bodies".
std::string settled(double angle, const std::string& rest) {
  return fmt::format(R"({{
    "talus": 1, "gravity": [0, -10], "materials": {{"rock": {{"density": 2300}}}},
    "cover": {{"model": "rigid"}}, "contact": {{"model": "overlap_area"}},
    "interfaces": [{{"between": ["*", "*"], "normal_stiffness": 1e10, "tangential_stiffness": 1e10,
                    "friction_angle": {}, "normal_damping": 0.3, "tangential_damping": 0.3}}],
    "settle": {{"duration": 0.3, "damping": 300}}, {}}})",
                     angle, rest);
}

}  // namespace

TEST_CASE("Stages: a support that is let go falls freely, and so does what stood on it or hung",
          "[figures]") {
  const std::string text = settled(20, R"("bodies": [
      {"name": "table", "polygon": [[-20, -1], [20, -1], [20, 0], [-20, 0]], "material": "rock", "fixed": true},
      {"name": "support", "polygon": [[-1, 5], [1, 5], [1, 6], [-1, 6]], "material": "rock", "fix": ["x", "y", "rotation"]},
      {"name": "block", "polygon": [[-1, 6], [1, 6], [1, 7], [-1, 7]], "material": "rock"},
      {"name": "hung", "polygon": [[3, 5], [5, 5], [5, 6], [3, 6]], "material": "rock", "surfaces": {"hold": [2]}}
    ],
    "prescribed": [{"body": "hung", "surface": "hold", "stiffness": 1e10, "displacement": [0, 0]}],
    "stages": [{"name": "release", "from": 0.5, "set": {"/bodies/1/fix": [], "/prescribed": []}}],
    "time": {"end": 1.2}, "output": {"history": 0.05})");
  for (const std::string body : {"support", "block", "hung"}) {
    const Course course = run(from_text(text), body);
    const Motion& last = course.motion.back();
    INFO(fmt::format("{}: moved {:.1e} m before, fell {:.6f} m, speed {:.6f} m/s", body,
                     course.moved_between(0, 0.501), -last.displacement.y, -last.velocity.y));
    CHECK(course.moved_between(0, 0.501) < 1e-9);
    // The springs between block and support push them apart: the energy they hold is worth some mm/s.
    CHECK(last.displacement.y == Approx(-0.5 * 10 * 0.7 * 0.7).epsilon(0.005));
    CHECK(last.velocity.y == Approx(-7).epsilon(0.002));
    CHECK(std::abs(last.rotation) < 1e-6);
  }
}

TEST_CASE("Stages: when a stage takes friction away, a block starts to slide by what is left", "[figures]") {
  const std::string text = settled(40, R"("bodies": [
      {"name": "ramp", "polygon": [[-20, -11.547005383792515], [20, -20], [20, 11.547005383792515]], "material": "rock", "fixed": true},
      {"name": "block", "polygon": [[0, 0], [1.7320508075688772, 1], [1.2320508075688772, 1.8660254037844386], [-0.5, 0.8660254037844386]], "material": "rock"}
    ],
    "stages": [{"name": "wet", "from": 0.5, "set": {"/interfaces/0/friction_angle": 20}}],
    "time": {"end": 1.5}, "output": {"history": 0.05})");
  const Course course = run(from_text(text), "block");
  const double a = 10 * (std::sin(30 * degree) - std::tan(20 * degree) * std::cos(30 * degree));
  INFO(fmt::format("moved {:.1e} m before, speed {:.6f} m/s at 1 and {:.6f} m/s at 1.5 s, wanted {:.6f} m/s2",
                   course.moved_between(0, 0.501), course.speed(1), course.speed(1.4999), a));
  CHECK(course.moved_between(0, 0.501) < 1e-6);
  CHECK(course.speed(1) == Approx(0.5 * a).epsilon(1e-3));
  const Motion& last = course.motion.back();
  CHECK(std::hypot(last.velocity.x, last.velocity.y) == Approx(a).epsilon(1e-3));
  CHECK(std::hypot(last.displacement.x, last.displacement.y) == Approx(0.5 * a).epsilon(1e-3));
}

TEST_CASE("Base acceleration: a block holds on to the ground up to mu g and is left behind beyond",
          "[figures]") {
  // 3 m/s2 is held, for tan 20 = 0.364; then 5 m/s2, of which friction takes 3.640.
  const std::string text = settled(20, R"("bodies": [
      {"name": "table", "polygon": [[-20, -1], [20, -1], [20, 0], [-20, 0]], "material": "rock", "fixed": true},
      {"name": "block", "polygon": [[-1, 0], [1, 0], [1, 1], [-1, 1]], "material": "rock"}
    ],
    "base_acceleration": [{"scale": 5, "time": [[0, 0], [0.2, 0.6], [0.5, 0.6], [0.5001, 1]]}, 0],
    "time": {"end": 1.5}, "output": {"history": 0.05})");
  const Course course = run(from_text(text), "block");
  const double a = 5 - 10 * std::tan(20 * degree);
  // The interpolated time 0.6 s may lie a hair before the output there.
  std::size_t early = 0;
  while (course.time[early] < 0.599) ++early;
  const Motion &from = course.motion[early], &to = course.motion.back();
  const double measured = -(to.velocity.x - from.velocity.x) / (course.time.back() - course.time[early]);
  INFO(fmt::format("moved {:.1e} m before, {:.6f} of {:.6f} m/s2", course.moved_between(0, 0.4999), measured,
                   a));
  CHECK(course.moved_between(0, 0.4999) < 1e-5);  // it leans into its springs
  CHECK(measured == Approx(a).epsilon(1e-3));
}

TEST_CASE("Absorbing surface: a pulse along a bar leaves, without it all of the pulse comes back",
          "[figures]") {
  const Scratch folder;
  const RectangleMesh bar{{0, 0}, {10, 0.5}, 80, 4};
  // 1000 m/s: the pulse of 4 m is at the end from 10 to 14 ms.
  const std::string text = fmt::format(R"({{
    "talus": 1,
    "materials": {{"bar": {{"density": 2000, "model": "linear_elastic", "young_modulus": 2e9, "poisson_ratio": 0}}}},
    "bodies": [{{"name": "bar", "mesh": "{}", "material": "bar", "cover": {{"model": "mesh"}}}}],
    "surface_loads": [{{"body": "bar", "surface": "left",
                       "pressure": {{"scale": 1e6, "time": [[0, 0], [0.002, 1], [0.004, 0]]}}}}],
    "absorbing": [{{"body": "bar", "surface": "right"}}],
    "time": {{"end": 0.016}}, "output": {{"history": 0.001}}
  }})",
                                       folder.write("bar.msh", bar.text()).string());
  const auto energies = [](const Scene& scene) {
    double before = 0, after = 0;
    run(scene, "bar", {}, [&](const Simulation& s) {
      const EnergyLedger& ledger = s.ledger();
      if (s.time() < 0.0085) before = ledger.kinetic + ledger.strain;
      after = ledger.kinetic + ledger.strain;
      CHECK(std::abs(ledger.residual) <= 1e-6 * ledger.throughput);
    });
    return std::pair{before, after};
  };
  const auto [sent, left] = energies(from_text(text));
  const auto [sent_free, reflected] = energies(from_text(text, {{"/absorbing", "[]"}}));
  INFO(fmt::format("sent {:.2f} J/m, left {:.4f}, reflected without {:.2f}", sent, left, reflected));
  // ∫ p²/(ρc) dt times the height: 1e12/2e6 × 0.004/3 × 0.5.
  CHECK(sent == Approx(333.33).epsilon(0.01));
  CHECK(left < 0.01 * sent);
  CHECK(reflected == Approx(sent_free).epsilon(1e-3));
}
