#include "plugins/driven_element.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace talus;

namespace {

constexpr double shear = young / (2 * (1 + poisson));

Made<Material> hypoelastic(double plane = plane_strain, double damping_time = 0) {
  return shipped_material("hypoelastic", std::array{young, poisson, plane, damping_time});
}

}  // namespace

TEST_CASE("a hundred turns leave a hypoelastic body without stress", "[plugins][hypoelastic]") {
  const double turn = 2 * std::acos(-1.0);
  const auto law = hypoelastic();
  for (const int steps_per_turn : {3, 7, 200}) {
    DrivenElement element(*law);
    Response last{};
    for (int i = 1; i <= 100 * steps_per_turn; ++i) last = element.to(rotation(turn * i / steps_per_turn));
    CHECK(size_of(last.stress) <= 1e-10 * young);
    CHECK(std::abs(last.energy) <= 1e-14 * young);
  }
}

TEST_CASE("a hundred turns carry the stress of a hypoelastic body along unchanged",
          "[plugins][hypoelastic]") {
  const double turn = 2 * std::acos(-1.0);
  const Tensor deformed{1.001, 0.0005, -0.001, 0.999};
  const auto law = hypoelastic();
  for (const int steps_per_turn : {3, 7, 200}) {
    DrivenElement element(*law);
    const Response start = element.to(deformed);
    Response last{};
    for (int i = 1; i <= 100 * steps_per_turn; ++i) {
      last = element.to(product(rotation(turn * i / steps_per_turn), deformed));
    }
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(last.stress[k] == Approx(start.stress[k]).margin(1e-10 * young));
    }
    // F is rounded in each step, and the stress works on that.
    const double round_off = 4e-16 * size_of(start.stress);
    CHECK(last.energy == Approx(start.energy).margin(100 * steps_per_turn * round_off));
  }
}

TEST_CASE("for small strains the rate form is linear elasticity", "[plugins][hypoelastic]") {
  const double strain = 1e-5, spin = 1e-4;
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = hypoelastic(plane);
    const auto total = shipped_material("linear_elastic", std::array{young, poisson, plane, 0.0});
    DrivenElement element(*law), reference(*total);
    double largest = 0;
    for (const Tensor& f : lively_path(strain, 1000, spin)) {
      const Response rate = element.to(f), expected = reference.to(f);
      for (std::size_t k = 0; k < 4; ++k) {
        REQUIRE(rate.stress[k] == Approx(expected.stress[k]).margin(5 * strain * strain * young));
      }
      // In a step that turns, the stress also works along the chord.
      const double chord = strain * spin * spin * young;
      REQUIRE(rate.energy == Approx(expected.energy).margin(5 * strain * strain * strain * young + chord));
      largest = std::max(largest, size_of(rate.stress));
    }
    CHECK(largest > strain * young);
    check_tangent(*law);
  }
}

TEST_CASE("stretched far, the strain of a hypoelastic body is logarithmic", "[plugins][hypoelastic]") {
  const double stretch = 1.5;
  const double modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  const auto law = hypoelastic();
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    DrivenElement element(*law);
    const Tensor f{stretch, 0, 0, 1};
    const Tensor stress = cauchy(element.along(f, level == 0 ? 10 : 20).stress, f);
    errors[level] = std::abs(stress[0] - modulus * std::log(stretch)) / modulus;
    CHECK(stress[3] == Approx(poisson / (1 - poisson) * stress[0]).epsilon(1e-12));
  }
  CHECK(errors[0] < 1e-3);
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.02));
}

TEST_CASE("sheared far, a hypoelastic body follows the known circle of Jaumann's rate",
          "[plugins][hypoelastic]") {
  // σ_xy = G sin γ and σ_xx = −σ_yy = G (1 − cos γ).
  const double angle = 1.5;
  const auto law = hypoelastic();
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    DrivenElement element(*law);
    const Tensor f{1, angle, 0, 1};
    const Tensor stress = cauchy(element.along(f, level == 0 ? 50 : 100).stress, f);
    errors[level] = std::abs(stress[1] - shear * std::sin(angle)) / shear;
    CHECK(stress[0] == Approx(shear * (1 - std::cos(angle))).epsilon(1e-3));
    CHECK(stress[3] == Approx(-stress[0]).epsilon(1e-12));
  }
  CHECK(errors[0] < 1e-3);
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.05));
}

TEST_CASE("the energy of a hypoelastic body is the work of its stress, to round-off",
          "[plugins][hypoelastic]") {
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = hypoelastic(plane);
    for (const double strain : {1e-6, 1e-3, 0.2}) {
      DrivenElement element(*law);
      for (const Tensor& f : lively_path(strain, 2000)) {
        const Response response = element.to(f);
        REQUIRE(response.dissipated == 0);
        REQUIRE(response.energy == Approx(element.work()).margin(1e-13 * young * strain * strain));
      }
      CHECK(element.work() != 0);
    }
  }
}

TEST_CASE("a closed cycle of strain gives or takes little energy: what the rate form is known for",
          "[plugins][hypoelastic]") {
  // The energy per cycle is cubic in the strain at most: smaller than the energy in motion by the strain.
  const auto law = hypoelastic();
  for (const double strain : {1e-4, 1e-3, 1e-2}) {
    DrivenElement element(*law);
    double largest = 0;
    Response last{};
    for (int i = 1; i <= 2000; ++i) {
      const double t = 2 * std::acos(-1.0) * i / 2000;
      const double a = strain * std::sin(t), b = strain * (1 - std::cos(t));
      last = element.to({1 + a, b, 0, 1 - b});
      largest = std::max(largest, last.energy);
    }
    CHECK(largest > 0.5 * shear * strain * strain);
    CHECK(std::abs(last.energy) < 5 * strain * largest);
  }
}

TEST_CASE("a hypoelastic body keeps to what every law must keep to", "[plugins][hypoelastic]") {
  const std::vector<Tensor> path = lively_path(0.02, 400);
  for (const double damping_time : {0.0, 2e-4}) {
    const auto law = hypoelastic(plane_strain, damping_time);
    CHECK(law->doubles_per_element() == 4);
    check_restart(*law, path);
    check_batch(*law, path);
    check_no_moment(*law, path, 1e-14 * young);
    check_fixed_turn(*law, path, 1e-13 * young);
  }
}

TEST_CASE("a hypoelastic path that turns on the way ends as one that does not, as steps get smaller",
          "[plugins][hypoelastic]") {
  const auto law = hypoelastic();
  const Tensor end{1.02, 0.01, 0.01, 0.97};
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    const int steps = level == 0 ? 100 : 200;
    DrivenElement straight(*law), turning(*law);
    const Tensor expected = straight.along(end, steps).stress;
    Tensor found{};
    for (int i = 1; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      const Tensor stretch{1 + share * (end[0] - 1), share * end[1], share * end[2],
                           1 + share * (end[3] - 1)};
      found = turning.to(product(rotation(2 * share), stretch)).stress;
    }
    found = product(rotation(-2), found);
    double difference = 0;
    for (std::size_t k = 0; k < 4; ++k) difference += std::abs(found[k] - expected[k]);
    errors[level] = difference / size_of(expected);
  }
  CHECK(errors[0] < 0.02 * 0.02);  // the turn of a step, squared
  CHECK(errors[0] / errors[1] == Approx(4).epsilon(0.05));
}

TEST_CASE("viscous stress of a hypoelastic body follows the strain rate and does not feel a spin",
          "[plugins][hypoelastic]") {
  const double time = 3e-4, dt = 1e-3, strain = 1e-6;
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = hypoelastic(plane, time);
    const auto elastic = hypoelastic(plane);
    CHECK(law->viscous_time() == time);
    CHECK(elastic->viscous_time() == 0);
    check_spin_is_free(*law, *elastic, {1.02, 0.01, -0.03, 0.97}, 1e-14 * young);

    const Tensor stretched{1 + strain, 0, 0, 1};
    DrivenElement element(*law);
    const Response damped = element.to(stretched, dt);
    const Response plain = DrivenElement(*elastic).to(stretched, dt);
    CHECK(damped.stress[0] / plain.stress[0] == Approx(1 + time / dt).epsilon(1e-12));
    CHECK(damped.stress[3] / plain.stress[3] == Approx(1 + time / dt).epsilon(1e-12));
    CHECK(damped.viscous == Approx(2 * time / dt * plain.energy).epsilon(1e-5));
    CHECK(damped.dissipated == 0);
    CHECK(damped.energy == plain.energy);
    CHECK(element.to(stretched, dt).stress == plain.stress);
    CHECK(DrivenElement(*law).to(stretched, 0).stress == plain.stress);
    CHECK(DrivenElement(*law).to(stretched, 0).viscous_stress == Tensor{});
  }
  const auto law = hypoelastic(plane_strain, time);
  DrivenElement element(*law);
  for (const Tensor& f : lively_path(0.05, 400)) REQUIRE(element.to(f).viscous >= 0);
}
