// What must hold of the contact law my_component, whatever its pressure is.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#include <talus/testing/component.hpp>
#include <talus/testing/two_bodies.hpp>

extern "C" const talus::Library talus_library;

namespace {

using talus::testing::TwoBodies;

/// A block of 1 x 1 m stands on a slab, `depth` m deep.
TwoBodies standing(double depth) {
  return TwoBodies({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}},
                   {{0, -depth}, {1, -depth}, {1, 1 - depth}, {0, 1 - depth}});
}

// normal_stiffness, tangential_stiffness [Pa/m], friction_angle [rad], normal_damping, tangential_damping [-]
const std::vector<double> interface { 1e9, 1e9, 0.5, 0, 0 };
const std::vector<double> damped{1e9, 1e9, 0.5, 0.3, 0.3};

auto law() {
  return talus::testing::make<talus::ContactModel>(talus_library, "my_component");
}

}  // namespace

TEST_CASE("The force is the derivative of the energy") {
  for (const double depth : {1e-6, 1e-5, 1e-4, 1e-3}) {
    const double step = 1e-3 * depth;
    const auto at = [&](double deep) { return standing(deep).evaluate(*law(), interface); };
    const double slope = (at(depth + step).report.stored - at(depth - step).report.stored) / (2 * step);
    CHECK(at(depth).on_b.y > 0);
    CHECK(at(depth).on_b.y == Approx(slope).epsilon(1e-4));
    CHECK(at(depth).report.penetration == Approx(depth));
  }
}

TEST_CASE("Loads are equal and opposite and leave no moment") {
  TwoBodies bodies({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, {{0.7, 0.99}, {1.9, 1.2}, {1.5, 2}});
  for (int step = 0; step < 4; ++step) {
    bodies.move_b(1e-4, -1e-4);
    const auto outcome = bodies.evaluate(*law(), damped);
    const double size = std::abs(outcome.on_b.x) + std::abs(outcome.on_b.y);
    REQUIRE(size > 0);
    CHECK(std::abs(outcome.net.x) <= 1e-9 * size);
    CHECK(std::abs(outcome.net.y) <= 1e-9 * size);
    CHECK(std::abs(outcome.net_moment) <= 1e-9 * size);
  }
}

TEST_CASE("Friction resists and never exceeds its limit") {
  TwoBodies bodies = standing(1e-4);
  bodies.master_share = 1;  // of the slab: as master, the block would be pressed at its flanks, too
  double largest = 0;
  for (int step = 0; step < 20; ++step) {
    bodies.move_b(1e-5, 0);
    const auto outcome = bodies.evaluate(*law(), interface);
    CHECK(outcome.on_b.x < 0);
    CHECK(-outcome.on_b.x <= std::tan(interface[2]) * outcome.on_b.y * (1 + 1e-9));
    largest = std::max(largest, -outcome.on_b.x / outcome.on_b.y);
  }
  CHECK(largest == Approx(std::tan(interface[2])));
}

TEST_CASE("There is no force at a gap") {
  const auto outcome = standing(-1e-6).evaluate(*law(), interface);
  CHECK(outcome.report.contact_count == 0);
  CHECK(outcome.report.stored == 0);
}

TEST_CASE("The time step is made for the stiffness that the law shows") {
  const double depth = 1e-4, step = 1e-6;
  std::vector<double> prepared = interface;
  law()->prepare_interface(prepared.data());
  const double shown = (standing(depth + step).evaluate(*law(), interface).on_b.y -
                        standing(depth).evaluate(*law(), interface).on_b.y) /
                       step;
  CHECK(law()->stiffness(prepared.data(), 1).normal >= shown * (1 - 1e-6));
}
