#include "contact_models/block_on_base.hpp"
#include "simulation/working_scene.hpp"

#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace talus;
using namespace talus::bench;

namespace {

Values bonded() {
  return with(undamped_interface(), {{"cohesion", 2e5}, {"tensile_strength", 1e5}});
}

}  // namespace

TEST_CASE("A bonded contact holds up to its tensile strength and then breaks for good", "[vertex_edge]") {
  LawBench bench("vertex_edge", bonded());
  bench.bodies = block_on_base(0);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  // sigma_t / alpha is 1e-4 m.
  CHECK(shifted(bench, {0, 9.9e-5}).on(1).y == Approx(-1e9 * 9.9e-5).epsilon(1e-9));
  CHECK(shifted(bench, {0, -5e-5}).on(1).y == Approx(-1e9 * 4.9e-5).epsilon(1e-9));
  CHECK(shifted(bench, {0, 5.2e-5}).size() == 0);   // 1.01e-4 m
  CHECK(shifted(bench, {0, -9.1e-5}).size() == 0);  // 1e-5 m of gap: no bond any more
  CHECK(shifted(bench, {0, -2e-5}).on(1).y == Approx(1e9 * 1e-5).epsilon(1e-6));
}

TEST_CASE("A bond on springs given directly holds up to its strength, whatever the stiffness per area says",
          "[vertex_edge]") {
  for (const double stiffness : {0.0, 1e12}) {
    INFO(stiffness << " Pa/m");
    LawBench bench("vertex_edge", with(bonded(), {{"normal_stiffness", stiffness}}),
                   {{"calibration", 1}, {"normal_spring", 1e6}, {"tangential_spring", 1e6}});
    bench.bodies = block_on_base(0);
    bench.bonds_form = true;
    bench.step();
    bench.bonds_form = false;
    // sigma_t l over the spring is 0.05 m.
    CHECK(shifted(bench, {0, 0.049}).on(1).y == Approx(-2 * 1e6 * 0.049).epsilon(1e-9));
    CHECK(shifted(bench, {0, 0.002}).size() == 0);
  }
}

TEST_CASE("Bonds between blocks of one width are those on a wider base, pulled and sheared",
          "[vertex_edge]") {
  for (const double half : {0.5, 2.0}) {
    INFO("half the width of the base: " << half);
    LawBench bench("vertex_edge", bonded());
    bench.bodies = {box(-half, -1, half, 0), box(-0.5, 0, 0.5, 1)};
    bench.bonds_form = true;
    bench.step();
    bench.bonds_form = false;
    CHECK(shifted(bench, {0, 9.9e-5}).on(1).y == Approx(-1e9 * 9.9e-5).epsilon(1e-9));
    CHECK(shifted(bench, {0, -1.09e-4}).on(1).y == Approx(1e9 * 1e-5).epsilon(1e-9));
    // Its corners pass those of the base by more than they are deep, and by more than bonds reach across.
    double lost = 0, stored = 0;
    for (int i = 1; i <= 280; ++i) {
      const Evaluation e = shifted(bench, {1e-6, 0});
      CHECK(e.on(1).x == Approx(-7e8 * 1e-6 * i).epsilon(1e-3));
      CHECK(e.on(1).y == Approx(1e4).epsilon(1e-3));
      lost += e.pairs[0].slip_loss;
      stored = e.pairs[0].stored;
    }
    CHECK(stored + lost == Approx(7e8 * 2.8e-4 * 2.8e-4 / 2).epsilon(5e-3));
  }
}

TEST_CASE("A tensile strength beyond the line of Mohr and Coulomb is told", "[vertex_edge]") {
  for (const auto& [tensile, told] : {std::pair{1.00001e5, true}, {1e5, false}}) {
    WorkingScene text;
    text.law = "vertex_edge";
    text.bodies = talus::box("table", -3, -1, 6, 0, R"("fixed": true)") + ", " + talus::box("a", 0, 0, 1, 1);
    text.interface =
        fmt::format(R"("normal_stiffness": 1e9, "tangential_stiffness": 1e9, "friction_angle": 45,
        "normal_damping": 0, "tangential_damping": 0, "cohesion": 1e5, "tensile_strength": {})",
                    tensile);
    const std::vector<std::string> warnings = text.read().warnings;
    CHECK(warnings.size() == (told ? 1 : 0));
    if (told) CHECK_THAT(warnings.at(0), Catch::Contains("above cohesion/tan(friction angle), 1e+05 Pa"));
  }
}

TEST_CASE("While a scene settles a bond holds whatever pulls, and breaks when it is let go",
          "[vertex_edge]") {
  LawBench bench("vertex_edge", bonded());
  bench.bodies = block_on_base(0);
  bench.bonds_form = bench.hold_stick = true;
  bench.step();
  CHECK(shifted(bench, {0, 3e-4}).on(1).y == Approx(-1e9 * 3e-4).epsilon(1e-9));  // three times its strength
  CHECK(shifted(bench, {0, -2.5e-4}).on(1).y == Approx(-1e9 * 5e-5).epsilon(1e-9));
  bench.bonds_form = bench.hold_stick = false;
  CHECK(shifted(bench, {0, 0}).on(1).y == Approx(-1e9 * 5e-5).epsilon(1e-9));  // within its strength again
  CHECK(shifted(bench, {0, 1e-4}).size() == 0);
  // Contacts without tensile strength open as ever.
  LawBench loose("vertex_edge", with(undamped_interface(), {{"cohesion", 2e5}}));
  loose.bodies = block_on_base(0);
  loose.bonds_form = loose.hold_stick = true;
  loose.step();
  CHECK(shifted(loose, {0, 1e-4}).size() == 0);
}

TEST_CASE("A bonded contact opened in one stride breaks as well", "[vertex_edge]") {
  LawBench bench("vertex_edge", bonded());
  bench.bodies = block_on_base(0);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  CHECK(shifted(bench, {0, 0.1}).size() == 0);
  CHECK(shifted(bench, {0, -0.1 + 5e-5}).size() == 0);
}

TEST_CASE("Cohesion adds to friction until the contact slips once", "[vertex_edge]") {
  const double mu = std::tan(25 * 3.14159265358979323846 / 180), load = 1e6;
  LawBench bench("vertex_edge", bonded());
  bench.bodies = block_on_base(1e-3);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  const double limit = mu * load + 2e5, slip = limit / 7e8;
  CHECK(shifted(bench, {0.99 * slip, 0}).on(1).x == Approx(-0.99 * limit).epsilon(1e-9));
  const Evaluation broken = shifted(bench, {0.02 * slip, 0});
  CHECK(broken.on(1).x == Approx(-mu * load).epsilon(1e-9));
  CHECK(broken.pairs[0].slip_loss > 0);
  CHECK(shifted(bench, {slip, 0}).on(1).x == Approx(-mu * load).epsilon(1e-9));
}

TEST_CASE("A bond without cohesion is broken by slip, too", "[vertex_edge]") {
  LawBench bench("vertex_edge", with(undamped_interface(), {{"tensile_strength", 1e5}}));
  bench.bodies = block_on_base(1e-4);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  CHECK(shifted(bench, {1e-3, 0}).on(1).x < 0);
  CHECK(shifted(bench, {0, 1.5e-4}).size() == 0);
}

TEST_CASE("A bond without friction and cohesion only ties", "[vertex_edge]") {
  LawBench bench("vertex_edge",
                 with(undamped_interface(), {{"friction_angle", 0}, {"tensile_strength", 1e5}}));
  bench.bodies = block_on_base(1e-4);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  CHECK(shifted(bench, {1e-3, 0}).on(1).x == 0);
  CHECK(shifted(bench, {0, 1.5e-4}).on(1).y == Approx(-1e9 * 5e-5).epsilon(1e-9));
}

TEST_CASE("A contact that comes about later is not bonded", "[vertex_edge]") {
  LawBench bench("vertex_edge", bonded());
  bench.bodies = block_on_base(-1e-3);
  bench.bonds_form = true;
  bench.step();
  bench.bonds_form = false;
  CHECK(shifted(bench, {0, -2e-3}).on(1).y > 0);
  CHECK(shifted(bench, {0, 1.05e-3}).size() == 0);
}

TEST_CASE("A bond is damped while it opens, too", "[vertex_edge][bonds]") {
  WorkingScene text = bonded_block(R"("friction_angle": 30, "normal_damping": 0.3, "tangential_damping": 0.3,
      "cohesion": 1e6, "tensile_strength": 1e6)");
  text.bodies = box("ceiling", -1, 0, 2, 0.5, R"("fixed": true)") + "," + box("a", 0, -0.5, 1, 0);
  text.time = R"({"end": 0.1, "dt": 1e-5})";
  text.output = R"({"history": 1e-4})";
  Simulation simulation(text.read(), {});
  double lowest = 0;
  while (simulation.advance()) lowest = std::min(lowest, simulation.body_motion(1).displacement.y);
  const double zeta = 0.3, overshoot = std::exp(-std::acos(-1.0) * zeta / std::sqrt(1 - zeta * zeta));
  CHECK(lowest == Approx(-1e-4 * (1 + overshoot)).epsilon(2e-3));
}

TEST_CASE("A bond under tension bears less along the edge: c l + N tan phi", "[vertex_edge][bonds]") {
  const double mu = std::tan(std::acos(-1.0) / 6);
  for (const double tension : {2e4, 9e4}) {
    LawBench bench("vertex_edge", with(undamped_interface(), {{"normal_stiffness", 1e8},
                                                              {"tangential_stiffness", 1e8},
                                                              {"friction_angle", 30},
                                                              {"cohesion", 1e5},
                                                              {"tensile_strength", 1e5}}));
    bench.bodies = block_on_base(0);
    bench.bonds_form = true;
    bench.step();
    bench.bonds_form = false;
    CHECK(shifted(bench, {0, tension / 1e8}).on(1).y == Approx(-tension).epsilon(1e-6));
    double most = 0;
    for (int i = 0; i < 120; ++i) most = std::max(most, std::abs(shifted(bench, {1e-5, 0}).on(1).x));
    CHECK(most == Approx(1e5 - mu * tension).epsilon(0.02));
  }
}

TEST_CASE("The step in which a bond breaks is booked as a whole", "[vertex_edge][bonds]") {
  for (const char* way : {"[0, 0.06]", "[0.06, 0]"}) {
    INFO(way);
    WorkingScene text = bonded_block(R"("friction_angle": 0, "normal_damping": 0, "tangential_damping": 0,
      "cohesion": 1e5, "tensile_strength": 1e5)",
                                     1e10);
    text.gravity = "[0, 0]";
    text.bodies = box("floor", -1, -1, 2, 0, R"("fixed": true)") + "," +
                  box("a", 0, 0, 1, 0.5, fmt::format(R"("fix": ["rotation"], "velocity": {})", way));
    text.time = R"({"end": 0.1, "dt": 1e-4})";
    const Simulation simulation = run_to_end(text);
    const EnergyLedger& ledger = simulation.ledger();
    CHECK(ledger.friction_loss > 0.3);
    CHECK(residual_share(ledger) < 2e-3);
  }
}

TEST_CASE(
    "A corner that fills a blunt reflex corner is bonded to both of its faces, however the drawing is turned",
    "[vertex_edge]") {
  // Faces of 1 m along the base, sloping to the middle, between two bodies.
  constexpr double degree = std::numbers::pi / 180;
  for (const double incline : {1.0, 10.0, 40.0}) {
    const double slope = std::tan(incline * degree);
    for (int turn = 0; turn < 360; turn += 7) {
      const bool aside = turn % 2 == 1;
      INFO(turn << " degrees, faces of " << incline << (aside ? ", aside" : ", up"));
      const double c = std::cos(turn * degree), s = std::sin(turn * degree);
      const auto turned = [&](std::vector<Vec2> points) {
        for (Vec2& p : points) p = {0.3 + c * p.x - s * p.y, 0.7 + s * p.x + c * p.y};
        return held(points);
      };
      LawBench bench("vertex_edge", bonded());
      bench.bodies = {turned({{-2, -1}, {2, -1}, {2, 2 * slope}, {0, 0}, {-2, 2 * slope}}),
                      turned({{0, 0}, {1, slope}, {1, 1}, {-1, 1}, {-1, slope}})};
      bench.bonds_form = true;
      bench.step();
      bench.bonds_form = false;
      // Lifted off, or pushed aside and down, past the corner; each face bears by how it is shifted.
      const Vec2 shift = aside ? Vec2{-4.8e-5, -1.5e-5} : Vec2{0, 5e-5};
      Vec2 due{0, 0};
      for (const double rise : {-slope, slope}) {
        const double length = std::hypot(1, rise);
        const Vec2 along{1 / length, rise / length}, up{-along.y, along.x};
        const double opens = 1e9 * length * (up.x * shift.x + up.y * shift.y),
                     slips = 7e8 * length * (along.x * shift.x + along.y * shift.y);
        due.x -= opens * up.x + slips * along.x;
        due.y -= opens * up.y + slips * along.y;
      }
      const Vec2 force = shifted(bench, {c * shift.x - s * shift.y, s * shift.x + c * shift.y}).on(1);
      CHECK(c * force.x + s * force.y == Approx(due.x).epsilon(1e-3).margin(1));
      CHECK(-s * force.x + c * force.y == Approx(due.y).epsilon(1e-3).margin(1));
    }
  }
}

TEST_CASE("Cohesion holds where a joint bears no pressure, without tensile strength", "[vertex_edge]") {
  // A roof block of 3 m between two walls, which weighs less than its joints bear.
  const bool settles = GENERATE(false, true);
  CAPTURE(settles);
  WorkingScene text;
  text.law = "vertex_edge";
  text.cover = "block";
  text.gravity = "[0, -10]";
  text.interface = R"("normal_stiffness": 2e9, "tangential_stiffness": 2e9, "friction_angle": 30,
                      "normal_damping": 0.3, "tangential_damping": 0.3, "cohesion": 1e5)";
  text.bodies = box("left", -5, 0, -1.5, 4, R"("fixed": true)") + "," +
                box("right", 1.5, 0, 5, 4, R"("fixed": true)") + "," + box("key", -1.5, 0, 1.5, 4);
  if (settles) text.rest = R"("settle": {"duration": 0.5, "damping": 100, "hold_stick": true},)";
  text.time = R"({"end": 0.3})";
  Simulation simulation(text.read(), {});
  simulation.settle();
  while (simulation.advance()) {
  }
  CHECK(std::abs(simulation.body_motion(2).displacement.y) < 1e-4);
}
