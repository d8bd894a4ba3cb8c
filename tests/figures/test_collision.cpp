#include "figures/runs.hpp"

#include <catch2/catch.hpp>

#include <fmt/format.h>

#include <cmath>

using namespace talus;
using namespace talus::figures;

namespace {

struct Collision {
  double v_a, v_b, momentum_error, began = 0, ended = 0, overlap, residual;
};

/// Momentum error as a share of m v0 at every output time; the contact by the times at which it is there.
Collision collide(const Scene& scene) {
  const std::uint32_t a = body_number(scene, "A"), b = body_number(scene, "B");
  const double m_a = scene.materials[scene.bodies[a].material].density;
  const double m_b = scene.materials[scene.bodies[b].material].density;
  const double whole = m_a * scene.bodies[a].velocity.x;
  Collision seen{};
  const Course course = run(scene, "B", {}, [&](const Simulation& s) {
    const double v_a = s.body_motion(a).velocity.x, v_b = s.body_motion(b).velocity.x;
    seen.momentum_error = std::max(seen.momentum_error, std::abs(m_a * v_a + m_b * v_b - whole) / whole);
    if (!s.contacts().empty()) {
      if (seen.began == 0) seen.began = s.time();
      seen.ended = s.time();
    }
    seen.v_a = v_a, seen.v_b = v_b;
    seen.overlap = s.summary().largest_penetration;
    seen.residual = s.summary().largest_residual_share;
  });
  return seen;
}

}  // namespace

TEST_CASE("Collision of section 4.1: equal blocks exchange velocities in half a period of the contact spring",
          "[figures]") {
  const Collision c = collide(shipped("collision", {{"/output/history", "1e-4"}, {"/time/end", "1.2"}}));
  INFO(fmt::format("v_B {:.6f}, momentum {:.2e}, contact {:.5f} s, overlap {:.6f} m, residual {:.2e}", c.v_b,
                   c.momentum_error, c.ended - c.began, c.overlap, c.residual));
  CHECK(c.v_b >= 0.4990);
  CHECK(c.v_b <= 0.5000);
  CHECK(c.momentum_error <= 1e-12);
  CHECK(c.began == Approx(1.0).margin(2e-4));
  CHECK(c.ended - c.began >= 8.2e-3);
  CHECK(c.ended - c.began <= 8.7e-3);
  CHECK(c.overlap >= 1.27e-3);
  CHECK(c.overlap <= 1.33e-3);
  CHECK(c.residual < 3e-4);
}

TEST_CASE("Collision: every law gives the same, for the blocks hit with whole sides", "[figures]") {
  for (const std::string law : {"vertex_edge", "frictionless"}) {
    const Collision c = collide(
        shipped("collision", {{"/contact/model", law}, {"/output/history", "1e-4"}, {"/time/end", "1.2"}}));
    INFO(law << ": v_B " << c.v_b << ", momentum " << c.momentum_error);
    CHECK(c.v_b == Approx(0.4995).margin(5e-4));
    CHECK(c.momentum_error <= 1e-12);
    CHECK(c.ended - c.began == Approx(8.45e-3).margin(2.5e-4));
  }
}

TEST_CASE("Collision: the energy residual falls with the square of the time step", "[slow][figures]") {
  // Where in a step the contact begins and ends scatters the residual of one run: worst of a few close steps.
  const auto worst = [](double dt) {
    double residual = 0;
    for (const double phase : {1.0, 0.97, 0.94, 0.91, 0.88}) {
      const Collision c = collide(shipped(
          "collision",
          {{"/output/history", "1e-3"}, {"/time/end", "1.02"}, {"/time/dt", fmt::format("{}", phase * dt)}}));
      residual = std::max(residual, c.residual);
    }
    return residual;
  };
  const double coarse = worst(1e-4), fine = worst(1.25e-5), order = std::log2(coarse / fine) / 3;
  INFO(fmt::format("{:.3e} at 1e-4, {:.3e} at 1.25e-5: order {:.2f}", coarse, fine, order));
  CHECK(coarse < 3e-4);
  CHECK(order > 1.8);
  CHECK(order < 2.4);
}

TEST_CASE("Collision of unequal masses: both leave with the velocities of an elastic impact", "[figures]") {
  const Collision c = collide(shipped("collision_unequal", {{"/time/end", "1.2"}}));
  INFO(fmt::format("v_A {:.6f}, v_B {:.6f}, momentum {:.2e}", c.v_a, c.v_b, c.momentum_error));
  CHECK(c.v_a == Approx(0.25).epsilon(0.005));
  CHECK(c.v_b == Approx(0.75).epsilon(0.003));
  CHECK(c.momentum_error <= 1e-12);
}

TEST_CASE("Collision at a mass ratio of 1e6: the light one leaves at twice the speed", "[figures]") {
  // Rigid covers: with deformable ones the light block would hold its own strain energy.
  const Scene scene = shipped("collision_unequal", {{"/materials/heavy/density", "2.8e9"},
                                                    {"/cover/model", "rigid"},
                                                    {"/time/dt", "auto"},
                                                    {"/time/safety", "0.02"},
                                                    {"/time/end", "1.1"}});
  const Collision c = collide(scene);
  const double r = 1e6;
  INFO(fmt::format("v_A {:.9f}, v_B {:.9f}, momentum {:.2e}", c.v_a, c.v_b, c.momentum_error));
  CHECK(c.v_a == Approx((r - 1) / (r + 1) * 0.5).epsilon(1e-6));
  CHECK(c.v_b == Approx(2 * r / (r + 1) * 0.5).epsilon(1e-3));
  CHECK(c.momentum_error <= 1e-12);
}
