#include "plugins/driven_element.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

using namespace talus;

namespace {

Made<Material> linear_elastic(double plane, double damping_time = 0) {
  return shipped_material("linear_elastic", std::array{young, poisson, plane, damping_time});
}

Response respond(const Material& law, const Tensor& f) {
  return DrivenElement(law).to(f);
}

/// Deformations with strains of up to `strain` under any rotation.
std::vector<Tensor> deformations(double strain) {
  std::mt19937 random(3);
  const auto uniform = [&] { return 2 * (static_cast<double>(random()) / 4294967296.0) - 1; };
  std::vector<Tensor> result;
  for (int i = 0; i < 50; ++i) {
    const Tensor stretch{1 + strain * uniform(), strain * uniform(), strain * uniform(),
                         1 + strain * uniform()};
    result.push_back(product(rotation(3.1 * uniform()), stretch));
  }
  return result;
}

}  // namespace

TEST_CASE("stress is the derivative of the energy", "[plugins][linear_elastic]") {
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = linear_elastic(plane);
    for (const double strain : {1e-3, 0.05, 0.3}) {
      for (const Tensor& f : deformations(strain)) {
        const Tensor stress = respond(*law, f).stress;
        const double step = 1e-4 * strain;
        for (std::size_t k = 0; k < 4; ++k) {
          const auto energy = [&](double change) {
            Tensor moved = f;
            moved[k] += change;
            return respond(*law, moved).energy;
          };
          // Fourth order, so that the differences are good to 1e-7.
          const double slope =
              (8 * (energy(step) - energy(-step)) - (energy(2 * step) - energy(-2 * step))) / (12 * step);
          REQUIRE(slope == Approx(stress[k]).margin(1e-7 * size_of(stress)));
        }
      }
    }
  }
}

TEST_CASE("energy and stress turn with the body", "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_strain);
  const double pi = std::acos(-1.0);
  for (const Tensor& f : deformations(0.01)) {
    const Response upright = respond(*law, f);
    for (const double angle : {1e-6, 0.3, pi / 2, pi - 1e-9, -2.0}) {
      const Response turned = respond(*law, product(rotation(angle), f));
      const Tensor expected = product(rotation(angle), upright.stress);
      for (std::size_t k = 0; k < 4; ++k) {
        REQUIRE(turned.stress[k] == Approx(expected[k]).margin(1e-13 * young));
      }
      REQUIRE(turned.energy == Approx(upright.energy).epsilon(1e-11));
    }
    // A quarter turn is exact in the computer, too.
    const Response quarter = respond(*law, {-f[2], -f[3], f[0], f[1]});
    REQUIRE(quarter.stress[0] == Approx(-upright.stress[2]).margin(1e-14 * young));
    REQUIRE(quarter.stress[3] == Approx(upright.stress[1]).margin(1e-14 * young));
  }
}

TEST_CASE("a rotation alone causes no stress", "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_strain);
  for (int i = 0; i < 100; ++i) {
    const Response response = respond(*law, rotation(0.0628 * i));
    CHECK(size_of(response.stress) < 1e-15 * 10 * young);
    CHECK(response.energy < 1e-29 * 100 * young);
  }
  CHECK(size_of(respond(*law, {1, 0, 0, 1}).stress) == 0);
}

TEST_CASE("the stress of a turned body is symmetric: no moment", "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_stress);
  for (const Tensor& f : deformations(0.1)) {
    const Tensor p = respond(*law, f).stress;
    const Tensor kirchhoff = product(p, transposed(f));
    REQUIRE(kirchhoff[1] == Approx(kirchhoff[2]).margin(1e-14 * young));
  }
}

TEST_CASE("uniaxial stress: the moduli of plane strain and plane stress", "[plugins][linear_elastic]") {
  const double pull = 1e-6;
  // Plane strain: pulled by σ, ε = σ (1 − ν²)/E and sideways −ν/(1 − ν) of it.
  const auto strain = linear_elastic(plane_strain);
  const Response confined = respond(*strain, {1 + pull, 0, 0, 1 - poisson / (1 - poisson) * pull});
  CHECK(confined.stress[0] == Approx(young / (1 - poisson * poisson) * pull).epsilon(1e-9));
  CHECK(confined.stress[3] == Approx(0).margin(1e-9 * young * pull));
  CHECK(confined.energy == Approx(young / (1 - poisson * poisson) * pull * pull / 2).epsilon(1e-9));

  // Plane stress: E and −ν.
  const auto stress = linear_elastic(plane_stress);
  const Response plate = respond(*stress, {1 + pull, 0, 0, 1 - poisson * pull});
  CHECK(plate.stress[0] == Approx(young * pull).epsilon(1e-9));
  CHECK(plate.stress[3] == Approx(0).margin(1e-9 * young * pull));

  // Confined sideways: M = E (1 − ν)/((1 + ν)(1 − 2ν)).
  const Response oedometer = respond(*strain, {1 + pull, 0, 0, 1});
  const double confined_modulus = young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  CHECK(oedometer.stress[0] == Approx(confined_modulus * pull).epsilon(1e-9));
  CHECK(oedometer.stress[3] == Approx(confined_modulus * poisson / (1 - poisson) * pull).epsilon(1e-9));
}

TEST_CASE("simple shear: G, the same in both planes", "[plugins][linear_elastic]") {
  const double angle = 1e-6;
  for (const double plane : {plane_strain, plane_stress}) {
    const Response sheared = respond(*linear_elastic(plane), {1, angle, 0, 1});
    CHECK(sheared.stress[1] == Approx(young / (2 * (1 + poisson)) * angle).epsilon(1e-5));
    CHECK(sheared.dissipated == 0);
  }
}

TEST_CASE("the stiffest tangent is the one at rest", "[plugins][linear_elastic]") {
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = linear_elastic(plane);
    check_tangent(*law);
    CHECK(law->doubles_per_element() == 0);
  }
}

TEST_CASE("a batch gives each element what it gives it alone", "[plugins][linear_elastic]") {
  for (const double damping_time : {0.0, 2e-4}) {
    check_batch(*linear_elastic(plane_strain, damping_time), deformations(0.02));
    check_restart(*linear_elastic(plane_strain, damping_time), deformations(0.02));
  }
}

TEST_CASE("the work of the stress goes to the energy, more exactly in smaller steps",
          "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_strain);
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    DrivenElement element(*law);
    const Response last = element.along({1.02, 0.03, -0.01, 0.97}, level == 0 ? 20 : 40);
    errors[level] = std::abs(element.work() - last.energy) / last.energy;
    CHECK(element.dissipated() == 0);
  }
  CHECK(errors[0] < 1e-4);
  CHECK(errors[1] < errors[0] / 3.9);
}

TEST_CASE("viscous stress is damping_time times the elastic stress of the strain rate",
          "[plugins][linear_elastic]") {
  const double time = 3e-4, dt = 1e-3, rate = 1e-3;
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = linear_elastic(plane, time);
    const auto elastic = linear_elastic(plane);
    CHECK(law->viscous_time() == time);
    CHECK(elastic->viscous_time() == 0);
    check_tangent(*law);
    double tangent[9];
    law->stiffest_tangent(tangent);

    DrivenElement element(*law), twin(*elastic);
    const Tensor stretched{1 + rate * dt, 0, 0, 1};
    const Response damped = element.to(stretched, dt), plain = twin.to(stretched, dt);
    CHECK(damped.stress[0] - plain.stress[0] == Approx(time * tangent[0] * rate).epsilon(1e-9));
    CHECK(damped.stress[3] - plain.stress[3] == Approx(time * tangent[1] * rate).epsilon(1e-9));
    CHECK(damped.stress[1] == 0);
    CHECK(damped.viscous_stress[0] == Approx(time * tangent[0] * rate).epsilon(1e-9));
    CHECK(damped.viscous_stress[3] == Approx(time * tangent[1] * rate).epsilon(1e-9));
    CHECK(damped.energy == plain.energy);
    CHECK(damped.dissipated == 0);

    // Held where it is, and looked at without a step, it is elastic.
    CHECK(element.to(stretched, dt).stress == plain.stress);
    CHECK(DrivenElement(*law).to(stretched, 0).stress == plain.stress);
    CHECK(DrivenElement(*law).to(stretched, 0).viscous_stress == Tensor{});
  }
}

TEST_CASE("viscous stress takes energy, turns nothing and does not feel a spin",
          "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_strain, 3e-4);
  const std::vector<Tensor> path = lively_path(0.05, 400);
  check_no_moment(*law, path, 1e-14 * young);
  check_fixed_turn(*law, path, 1e-13 * young);
  check_spin_is_free(*law, *linear_elastic(plane_strain), {1.02, 0.01, -0.03, 0.97}, 1e-14 * young);
  DrivenElement element(*law);
  for (const Tensor& f : path) REQUIRE(element.to(f).viscous >= 0);
  CHECK(element.viscous() > 0);
}

TEST_CASE("what viscosity takes is the work of the stress that is not stored", "[plugins][linear_elastic]") {
  const auto law = linear_elastic(plane_strain, 3e-3);
  double errors[2];
  for (int level = 0; level < 2; ++level) {
    const int steps = level == 0 ? 1000 : 2000;
    const double dt = 1.0 / steps;
    DrivenElement element(*law);
    Response last{};
    for (int i = 1; i <= steps; ++i) {
      const double t = i * dt, swing = 0.01 * (1 - std::cos(12 * t));
      last = element.to(product(rotation(2 * t), {1 + swing, swing / 2, 0, 1 - swing / 3}), dt);
    }
    errors[level] = std::abs(element.work() - last.energy - element.dissipated()) / element.dissipated();
  }
  CHECK(errors[0] < 1e-4);
  CHECK(errors[1] < errors[0] / 3.9);
}
