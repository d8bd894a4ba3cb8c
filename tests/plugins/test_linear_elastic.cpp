#include "plugin/registry.hpp"
#include "simulation/working_scene.hpp"

#include <talus/material.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

using namespace talus;

namespace {

using Tensor = std::array<double, 4>;  ///< xx, xy, yx, yy

constexpr double young = 2e9, poisson = 0.3;
constexpr double plane_strain = 0, plane_stress = 1;

struct Response {
  Tensor stress;
  double energy, dissipated;
};

Made<Material> material(double plane, double nu = poisson) {
  const RegisteredComponent* found = shipped_registry().find(ComponentKind::material, "linear_elastic");
  REQUIRE(found != nullptr);
  return make<Material>(*found, std::array{young, nu, plane});
}

Response respond(const Material& law, const Tensor& f) {
  const Tensor identity{1, 0, 0, 1};
  Response response{};
  MaterialBatch batch{};
  MaterialResponse output{};
  for (std::size_t k = 0; k < 4; ++k) {
    batch.deformation[k] = &f[k];
    batch.previous_deformation[k] = &identity[k];
    output.stress[k] = &response.stress[k];
  }
  batch.dt = 1e-3;
  batch.count = 1;
  output.energy = &response.energy;
  output.dissipated = &response.dissipated;
  law.evaluate(batch, output);
  return response;
}

Tensor product(const Tensor& p, const Tensor& q) {
  return {p[0] * q[0] + p[1] * q[2], p[0] * q[1] + p[1] * q[3], p[2] * q[0] + p[3] * q[2],
          p[2] * q[1] + p[3] * q[3]};
}

Tensor rotation(double angle) {
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

double size_of(const Tensor& t) {
  return std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + t[3] * t[3]);
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
    const auto law = material(plane);
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
  const auto law = material(plane_strain);
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
  const auto law = material(plane_strain);
  for (int i = 0; i < 100; ++i) {
    const Response response = respond(*law, rotation(0.0628 * i));
    CHECK(size_of(response.stress) < 1e-15 * 10 * young);
    CHECK(response.energy < 1e-29 * 100 * young);
  }
  CHECK(size_of(respond(*law, {1, 0, 0, 1}).stress) == 0);
}

TEST_CASE("the stress of a turned body is symmetric: no moment", "[plugins][linear_elastic]") {
  const auto law = material(plane_stress);
  for (const Tensor& f : deformations(0.1)) {
    const Tensor p = respond(*law, f).stress;
    const Tensor kirchhoff = product(p, {f[0], f[2], f[1], f[3]});
    REQUIRE(kirchhoff[1] == Approx(kirchhoff[2]).margin(1e-14 * young));
  }
}

TEST_CASE("uniaxial stress: the moduli of plane strain and plane stress", "[plugins][linear_elastic]") {
  const double pull = 1e-6;
  // Plane strain: pulled by σ, ε = σ (1 − ν²)/E and sideways −ν/(1 − ν) of it.
  const auto strain = material(plane_strain);
  const Response confined = respond(*strain, {1 + pull, 0, 0, 1 - poisson / (1 - poisson) * pull});
  CHECK(confined.stress[0] == Approx(young / (1 - poisson * poisson) * pull).epsilon(1e-9));
  CHECK(confined.stress[3] == Approx(0).margin(1e-9 * young * pull));
  CHECK(confined.energy == Approx(young / (1 - poisson * poisson) * pull * pull / 2).epsilon(1e-9));

  // Plane stress: E and −ν.
  const auto stress = material(plane_stress);
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
    const Response sheared = respond(*material(plane), {1, angle, 0, 1});
    CHECK(sheared.stress[1] == Approx(young / (2 * (1 + poisson)) * angle).epsilon(1e-5));
    CHECK(sheared.dissipated == 0);
  }
}

TEST_CASE("the stiffest tangent is the one at rest", "[plugins][linear_elastic]") {
  for (const double plane : {plane_strain, plane_stress}) {
    const auto law = material(plane);
    double tangent[9];
    law->stiffest_tangent(tangent);
    const double step = 1e-7;
    const Tensor x = respond(*law, {1 + step, 0, 0, 1}).stress;
    const Tensor xy = respond(*law, {1, step / 2, step / 2, 1}).stress;
    CHECK(tangent[0] == Approx(x[0] / step).epsilon(1e-6));
    CHECK(tangent[1] == Approx(x[3] / step).epsilon(1e-6));
    CHECK(tangent[8] == Approx(xy[1] / step).epsilon(1e-6));
    CHECK(tangent[4] == tangent[0]);
    CHECK(tangent[3] == tangent[1]);
    for (const int zero : {2, 5, 6, 7}) CHECK(tangent[zero] == 0);
    CHECK(law->doubles_per_element() == 0);
  }
}

TEST_CASE("a batch gives each element what it gives it alone", "[plugins][linear_elastic]") {
  const auto law = material(plane_strain);
  const std::vector<Tensor> all = deformations(0.02);
  const std::size_t count = all.size();
  std::vector<double> f[4], stress[4], energy(count), dissipated(count, 1.0);
  MaterialBatch batch{};
  MaterialResponse output{};
  for (std::size_t k = 0; k < 4; ++k) {
    for (const Tensor& one : all) f[k].push_back(one[k]);
    stress[k].resize(count);
    batch.deformation[k] = batch.previous_deformation[k] = f[k].data();
    output.stress[k] = stress[k].data();
  }
  batch.dt = 1;
  batch.count = static_cast<std::uint32_t>(count);
  output.energy = energy.data();
  output.dissipated = dissipated.data();
  law->evaluate(batch, output);
  for (std::size_t i = 0; i < count; ++i) {
    const Response alone = respond(*law, all[i]);
    for (std::size_t k = 0; k < 4; ++k) REQUIRE(stress[k][i] == alone.stress[k]);
    REQUIRE(energy[i] == alone.energy);
    REQUIRE(dissipated[i] == 0);
  }
}
