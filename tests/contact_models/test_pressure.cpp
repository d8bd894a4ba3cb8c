// Laws on the kit's overlaps with a pressure of their own.
#include <catch2/catch.hpp>
#include <talus/overlap/distributed_contact.hpp>
#include <talus/testing/two_bodies.hpp>

#include <cmath>

using namespace talus;
using talus::testing::Outcome;
using talus::testing::TwoBodies;

namespace {

/// p = α g^n without friction.
class PowerLaw final : public ContactModel {
 public:
  static constexpr bool frictional = false;

  explicit PowerLaw(int power) : power_(power) {}

  overlap::Pressure pressure(const overlap::InterfaceParameters& at, double depth) const {
    const double below = std::pow(depth, power_ - 1);
    return {at.normal_stiffness * below * depth, power_ * at.normal_stiffness * below};
  }

  std::uint32_t doubles_per_contact() const noexcept override { return 0; }
  void evaluate(const ContactBatch& batch, const ContactLoads& loads) const noexcept override {
    overlap::DistributedContact<PowerLaw> contact;
    contact.evaluate(*this, batch, loads);
  }
  ContactStiffness stiffness(const double*, double) const noexcept override { return {}; }
  static overlap::InterfaceParameters interface(const double* values) {
    return {.normal_stiffness = values[0], .normal_damping = values[1]};
  }

 private:
  int power_;
};

/// A triangle that dips one corner and a part of a side into a slab's corner, shifted.
Outcome dipped(const PowerLaw& law, double dx, double dy, double master_share, double damping = 0) {
  TwoBodies bodies({{0, 0}, {2, 0}, {2, 1}, {0, 1}},
                   {{1.7 + dx, 0.96 + dy}, {2.9 + dx, 1.2 + dy}, {1.5 + dx, 2 + dy}});
  bodies.master_share = master_share;
  return bodies.evaluate(law, {1e9, damping});
}

}  // namespace

TEST_CASE("A linear pressure of one's own is that of the kit", "[laws]") {
  // A block of 1 m stands 1 mm deep on a slab that is master: α g L and α g² L / 2.
  TwoBodies standing({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, {{0, -1e-3}, {1, -1e-3}, {1, 1}, {0, 1}});
  standing.master_share = 1;
  const Outcome outcome = standing.evaluate(PowerLaw(1), {1e9, 0});
  CHECK(outcome.on_b.y == Approx(1e6).epsilon(1e-12));
  CHECK(outcome.report.stored == Approx(500).epsilon(1e-12));
  CHECK(outcome.loads[4].y == Approx(5e5).epsilon(1e-12));
  TwoBodies quadratic({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, {{0, -1e-3}, {1, -1e-3}, {1, 1}, {0, 1}});
  quadratic.master_share = 1;
  const Outcome squared = quadratic.evaluate(PowerLaw(2), {1e9, 0});
  CHECK(squared.on_b.y == Approx(1e3).epsilon(1e-12));
  CHECK(squared.report.stored == Approx(1 / 3.0).epsilon(1e-12));
}

TEST_CASE("A pressure of one's own is the derivative of its energy and leaves no moment", "[laws]") {
  for (const int power : {1, 2, 3, 4}) {
    for (const double share : {0.0, 0.5, 1.0}) {
      INFO("g^" << power << ", master share " << share);
      const PowerLaw law(power);
      const Outcome at = dipped(law, 0, 0, share), damped = dipped(law, 0, 0, share, 0.3);
      const double size = std::hypot(at.on_b.x, at.on_b.y), step = 1e-6;
      REQUIRE(size > 0);
      const auto energy = [&](double dx, double dy) { return dipped(law, dx, dy, share).report.stored; };
      CHECK(at.on_b.x == Approx((energy(-step, 0) - energy(step, 0)) / (2 * step)).margin(1e-6 * size));
      CHECK(at.on_b.y == Approx((energy(0, -step) - energy(0, step)) / (2 * step)).margin(1e-6 * size));
      for (const Outcome& outcome : {at, damped}) {
        CHECK(std::hypot(outcome.net.x, outcome.net.y) <= 1e-12 * size);
        CHECK(std::abs(outcome.net_moment) <= 1e-12 * size);
      }
    }
  }
}
