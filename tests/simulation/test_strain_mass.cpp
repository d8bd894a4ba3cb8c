#include "contact/contact_stage.hpp"
#include "parallel/alone.hpp"
#include "simulation/simulation.hpp"
#include "simulation/strain_mass.hpp"
#include "simulation/time_step.hpp"
#include "working_scene.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace talus;

namespace {

using std::numbers::pi;

std::string scaled(double scale) {
  return fmt::format(R"("cover": {{"model": "block", "strain_mass_scale": {}}})", scale);
}

std::string with(const std::string& more, double scale) {
  return more.empty() ? scaled(scale) : more + ", " + scaled(scale);
}

/// About the origin, kg m/s per metre: of rectangles that deform evenly.
double angular_momentum(const Simulation& simulation, std::size_t body, double width, double height,
                        Vec2 corner) {
  const Motion middle = simulation.body_motion(body);
  const double mass = 2300 * width * height;
  const auto at = [&](double x, double y) {
    return simulation.point_motion(body, {corner.x + x, corner.y + y});
  };
  const Motion origin = at(0, 0), right = at(width, 0), top = at(0, height);
  const auto turning = [](const Motion& p, const Motion& q) {
    const double x = p.position.x - q.position.x, y = p.position.y - q.position.y;
    return x * (p.velocity.y - q.velocity.y) - y * (p.velocity.x - q.velocity.x);
  };
  // Second moments of a rectangle along its two sides, over their squared lengths: m/12 each.
  return mass / 12 * (turning(right, origin) + turning(top, origin)) +
         mass * (middle.position.x * middle.velocity.y - middle.position.y * middle.velocity.x);
}

StepVote vote(const Scene& scene, const Model& model, const ContactStage& contacts) {
  return {scene, settings_of(scene), model, contacts};
}

}  // namespace

TEST_CASE("mass of strain: the scaled mass and its inverse fit, and leave spin alone",
          "[simulation][strain_mass]") {
  Body body;
  body.moments = {2, 0.4, 0.1, 0.3};
  body.strain_mass_scale = 7;
  const Matrix2 h{0.1, -0.8, 0.7, -0.2};
  const StrainMass scaled_mass(body, 1000, h);
  body.strain_mass_scale = 1;
  const StrainMass mass(body, 1000, h);
  const Matrix2 spin{-h.yx, -(1 + h.yy), 1 + h.xx, h.xy}, p{0.3, 0.1, -0.4, 0.9}, q{-0.2, 0.5, 0.6, 0.1};
  CHECK(scaled_mass.product(spin, spin) == Approx(mass.product(spin, spin)).epsilon(1e-13));
  CHECK(scaled_mass.product(spin, p) == Approx(mass.product(spin, p)).epsilon(1e-13));
  // P · M_s M_s⁻¹ M Q = P · M Q.
  CHECK(scaled_mass.product(p, scaled_mass.acceleration(q)) == Approx(mass.product(p, q)).epsilon(1e-12));
  CHECK(scaled_mass.product(p, p) > mass.product(p, p));
  CHECK(scaled_mass.product(p, p) < 7 * mass.product(p, p));

  const Matrix2 turned = scaled_mass.turned(p, 0.4);
  CHECK(mass.product(spin, turned) == Approx(mass.product(spin, p)).epsilon(1e-12));
  const Matrix2 same = mass.turned(p, 0.4);  // s = 1: nothing is left over
  CHECK(same.xx == Approx(p.xx).epsilon(1e-13));
  CHECK(same.yx == Approx(p.yx).epsilon(1e-13));
}

TEST_CASE("mass of strain: a factor of 1 changes no bit", "[simulation][strain_mass]") {
  WorkingScene text;
  text.gravity = "[0, -10]";
  text.time = R"({"end": 0.05})";
  const std::string base = box("base", -2, -1, 3, 0, R"("fixed": true)");
  const std::string moving = R"("velocity": [1, -1], "angular_velocity": 90)";
  text.bodies = base + ", " + box("a", 0, 0.01, 1, 0.5, moving + R"(, "cover": {"model": "block"})");
  const Simulation plain = run_to_end(text);
  text.bodies = base + ", " + box("a", 0, 0.01, 1, 0.5, with(moving, 1));
  const Simulation once = run_to_end(text);
  CHECK(once.state_hash() == plain.state_hash());
  CHECK(once.ledger().residual == plain.ledger().residual);
  CHECK(once.summary().dt == plain.summary().dt);
}

TEST_CASE("mass of strain: a body breathes √s times slower, and its step is √s times as long",
          "[simulation][strain_mass]") {
  // A pressure on all sides from t = 0: H = H₀ (1 − cos ωt) in swelling, ω² = 12 (λ + 2G + λ)/(ρ h² s).
  const double omega = std::sqrt(12 * (1e10 * 0.75 + 1e10 * 0.25) / (1.25 * 0.5) / 2300);
  double step = 0;
  for (const double scale : {1.0, 4.0, 100.0}) {
    INFO(scale);
    const double period = 2 * pi / omega * std::sqrt(scale);
    WorkingScene text;
    text.bodies = box("a", 0, 0, 1, 1, with(R"("surfaces": {"all": [0, 1, 2, 3]})", scale));
    text.rest = R"("surface_loads": [{"body": "a", "surface": "all", "pressure": 1e6}],)";
    text.time = fmt::format(R"({{"end": {:.17g}, "safety": 0.02}})", 10 * period);
    text.output = fmt::format(R"({{"history": {:.17g}}})", period / 200);
    Simulation simulation(text.read(), {});
    std::vector<double> time, swelling;
    while (simulation.advance()) {
      time.push_back(simulation.time());
      swelling.push_back(simulation.point_motion(0, {1, 1}).displacement.x);
    }
    const double still = 0.5 * -1e6 / (1e10 * (0.75 + 0.25) / (1.25 * 0.5));
    std::vector<double> passes;
    for (std::size_t i = 1; i < time.size(); ++i) {
      const double a = swelling[i - 1] - still, b = swelling[i] - still;
      if (a * b < 0) passes.push_back(time[i - 1] + (time[i] - time[i - 1]) * a / (a - b));
    }
    REQUIRE(passes.size() == 20);
    // Central differences raise the frequency by (ωΔt)²/24, with ωΔt = 0.04: 7e-5.
    CHECK((passes.back() - passes.front()) / 9.5 == Approx(period).epsilon(2e-4));
    CHECK(simulation.summary().largest_residual_share < 1e-3);
    if (scale == 1) step = simulation.critical_dt();
    CHECK(simulation.critical_dt() == Approx(step * std::sqrt(scale)).epsilon(1e-9));
  }
}

TEST_CASE("mass of strain: a spinning body is strained by its centrifugal force, not by s times that",
          "[simulation][strain_mass]") {
  double mean_of_one = 0;
  for (const double scale : {1.0, 16.0, 64.0}) {
    INFO(scale);
    WorkingScene text;
    text.bodies = box("a", 0, 0, 1, 0.5, with(R"("velocity": [0.5, 0], "angular_velocity": 3600)", scale));
    text.time = R"({"end": 2, "safety": 0.5})";
    text.output = R"({"history": 0.00037})";
    Simulation simulation(text.read(), {});
    const double inertia = 1150 * (1 + 0.25) / 12, energy = (1150 * 0.25 + inertia * 400 * pi * pi) / 2;
    double first = 0, worst = 0, sum = 0;
    int count = 0;
    while (simulation.advance()) {
      // About the centre, which moves evenly along a line through its place at the start.
      const double now = angular_momentum(simulation, 0, 1, 0.5, {0, 0}) + 0.25 * 1150 * 0.5;
      if (count == 0) first = now;
      worst = std::max(worst, std::abs(now / first - 1));
      sum += simulation.ledger().strain;
      ++count;
    }
    const double mean = sum / count;
    if (scale == 1) mean_of_one = mean;
    CHECK(first == Approx(inertia * 20 * pi).epsilon(1e-9));
    CHECK(worst < 1e-10);
    // But for the turning frame, which shifts strain frequencies by a share of s (ω/ω₁)², 0.005.
    CHECK(mean == Approx(mean_of_one).epsilon(0.03));
    CHECK(simulation.ledger().kinetic + simulation.ledger().strain == Approx(energy).epsilon(1e-4));
    CHECK(simulation.summary().largest_residual_share < 1e-4);
    CHECK(simulation.body_motion(0).rotation == Approx(40 * pi).epsilon(1e-3));
  }
}

TEST_CASE("mass of strain: a collision off the centre keeps momentum, angular momentum and energy",
          "[simulation][strain_mass]") {
  for (const double scale : {4.0, 64.0, 1e6}) {
    for (const double other : {1.0, scale}) {
      INFO(scale << ", " << other);
      WorkingScene text;
      text.law = "frictionless";
      text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                          "normal_damping": 0, "tangential_damping": 0)";
      text.bodies = box("a", 0, 0.45, 1, 1.45, with(R"("velocity": [1, 0], "angular_velocity": 20)", scale)) +
                    ", " + box("b", 1.1, 0, 2.1, 1, scaled(other));
      text.time = R"({"end": 0.4, "safety": 0.1})";
      text.output = R"({"history": 0.005})";
      Simulation simulation(text.read(), {});
      double first = 0, off = 0, momentum = 0;
      bool any = false;
      while (simulation.advance()) {
        const double now = angular_momentum(simulation, 0, 1, 1, {0, 0.45}) +
                           angular_momentum(simulation, 1, 1, 1, {1.1, 0});
        if (!any) first = now;
        any = true;
        off = std::max(off, std::abs(now / first - 1));
        const Vec2 a = simulation.body_motion(0).velocity, b = simulation.body_motion(1).velocity;
        momentum = std::max({momentum, std::abs(a.x + b.x - 1), std::abs(a.y + b.y)});
      }
      CHECK(simulation.body_motion(1).velocity.x > 0.3);  // they met
      CHECK(off < 1e-9);
      CHECK(momentum < 1e-12);
      // As of a head-on collision: at most (ωΔt)²/8 for each of the two kinks of a contact.
      CHECK(simulation.summary().largest_residual_share < 0.2 * 0.2 / 8);
    }
  }
}

TEST_CASE("mass of strain: without end it is a rigid body", "[simulation][strain_mass]") {
  const auto deepest = [](const std::string& cover) {
    WorkingScene text;
    text.law = "frictionless";
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 0,
                        "normal_damping": 0, "tangential_damping": 0)";
    const std::string with_cover = fmt::format(R"("cover": {{"model": {}}})", cover);
    text.bodies = box("a", 0, 0, 1, 1, R"("velocity": [1, 0], )" + with_cover) + ", " +
                  box("b", 1.1, 0, 2.1, 1, with_cover);
    text.time = R"({"end": 0.2, "dt": 2e-5})";
    return run_to_end(text).summary().largest_penetration;
  };
  const double rigid = deepest(R"("rigid")");
  CHECK(deepest(R"("block")") < 0.99 * rigid);
  CHECK(deepest(R"("block", "strain_mass_scale": 1e6)") == Approx(rigid).epsilon(1e-4));

  // On a slope, where weight strains it however slowly.
  const auto slides = [](const std::string& cover) {
    WorkingScene text;
    text.gravity = "[5, -8.660254037844386]";
    text.bodies = box("base", -1, -1, 9, 0, R"("fixed": true)") + ", " +
                  box("a", 0, 0, 2, 1, fmt::format(R"("cover": {{"model": {}}})", cover));
    text.interface = R"("normal_stiffness": 1e10, "tangential_stiffness": 1e10, "friction_angle": 20,
                        "normal_damping": 0.3, "tangential_damping": 0.3)";
    return run_to_end(text).body_motion(1).displacement.x;
  };
  const double alone = slides(R"("rigid")");
  CHECK(alone == Approx((5 - std::tan(pi / 9) * 8.660254037844386) / 2).epsilon(1e-3));
  CHECK(slides(R"("block", "strain_mass_scale": 1e6)") == Approx(alone).epsilon(1e-4));
}

TEST_CASE("mass of strain: what rests is not changed", "[simulation][strain_mass]") {
  double due = 0;
  for (const double scale : {1.0, 16.0}) {
    WorkingScene text;
    text.gravity = "[0, -10]";
    text.bodies = box("base", -1, -1, 2, 0, R"("fixed": true)") + ", " +
                  box("low", 0, 0, 1, 1, scaled(scale)) + ", " + box("high", 0, 1, 1, 2, scaled(scale));
    text.rest = R"("settle": {"duration": 5, "damping": "adaptive", "until": 1e-10},)";
    text.time = R"({"end": 1e-5})";
    Simulation simulation(text.read(), {});
    const double before = simulation.point_motion(2, {0.5, 2}).position.y;
    simulation.settle();
    simulation.advance();
    const double sunk = before - simulation.point_motion(2, {0.5, 2}).position.y;
    const double stress = simulation.body_motion(1).stress_yy;
    if (scale == 1) due = sunk;
    CHECK(sunk == Approx(due).epsilon(1e-7));
    CHECK(sunk > 1e-6);
    CHECK(stress == Approx(-2300 * 10 * 1.5).epsilon(1e-4));
  }
}

TEST_CASE("mass of strain: fixed axes and driven spins do the same work", "[simulation][strain_mass]") {
  WorkingScene text;
  text.bodies = box("a", 0, 0, 1, 1, with(R"("drive": {"rotation": 90})", 16));
  text.time = R"({"end": 2})";
  const Simulation turning = run_to_end(text);
  CHECK(turning.body_motion(0).rotation == Approx(pi).epsilon(1e-4));
  CHECK(residual_share(turning.ledger()) < 1e-4);

  text.gravity = "[0, -10]";
  text.bodies = box("a", 0, 0, 1, 1, with(R"("fix": ["y", "rotation"], "velocity": [1, 0])", 16));
  text.rest = R"("loads": [{"body": "a", "point": [1, 1], "force": [1000, 500]}],)";
  text.time = R"({"end": 0.5})";
  const Simulation sliding = run_to_end(text);
  CHECK(std::abs(sliding.body_motion(0).rotation) < 1e-8);
  CHECK(sliding.body_motion(0).displacement.x == Approx(0.5 + 1000 / 2300.0 * 0.125).epsilon(1e-9));
  CHECK(sliding.summary().largest_residual_share < 1e-6);
}

TEST_CASE("mass of strain: the vote on the step rises, up to that of a rigid body",
          "[simulation][strain_mass]") {
  const auto step = [](const std::string& cover) {
    WorkingScene text;
    text.interface = R"("normal_stiffness": 1e9, "tangential_stiffness": 0, "friction_angle": 30,
                        "normal_damping": 0, "tangential_damping": 0)";
    text.bodies = box("base", -1, -1, 2, 0, R"("fixed": true)") + ", " +
                  box("a", 0, 0, 1, 1, fmt::format(R"("cover": {{{}}})", cover));
    const Scene scene = text.read();
    const Model model = build_model(scene);
    const ContactStage contacts(scene, model, alone(), true);
    return vote(scene, model, contacts).anyhow().dt;
  };
  const double rigid = step(R"("model": "rigid")");
  double last = step(R"("model": "block")");
  for (const double scale : {2.0, 4.0, 8.0}) {
    const double now = step(fmt::format(R"("model": "block", "strain_mass_scale": {})", scale));
    CHECK(now > last);
    CHECK(now < rigid);
    CHECK(now < std::sqrt(2) * last * (1 + 1e-9));
    last = now;
  }
  CHECK(step(R"("model": "block", "strain_mass_scale": 1e6)") == Approx(rigid).epsilon(1e-5));
}

TEST_CASE("mass of strain: bodies that differ in it alone vote for themselves", "[simulation][strain_mass]") {
  for (const bool heavy_first : {true, false}) {
    WorkingScene text;
    text.bodies = box("a", 0, 0, 1, 1, scaled(heavy_first ? 100 : 1)) + ", " +
                  box("b", 9, 0, 10, 1, scaled(heavy_first ? 1 : 100));
    const Scene scene = text.read();
    const Model model = build_model(scene);
    const ContactStage contacts(scene, model, alone(), true);
    CHECK(vote(scene, model, contacts).anyhow().body == (heavy_first ? 1 : 0));
  }
}
