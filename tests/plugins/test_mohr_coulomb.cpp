#include "plugins/driven_element.hpp"
#include "random/random.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace talus;

namespace {

constexpr double degree = 3.14159265358979323846 / 180;
constexpr double apex = 1e300;  ///< tensile strength: as much as the shear criterion leaves

struct Soil {
  double young = 5e7, poisson = 0.3, friction = 30, cohesion = 2e4, dilation = 0, tension = apex;
  double damping_time = 0;

  Made<Material> make() const {
    return shipped_material("mohr_coulomb", std::array{young, poisson, friction * degree, cohesion,
                                                       dilation * degree, tension, damping_time});
  }
  double apex_stress() const { return cohesion / std::tan(friction * degree); }
  /// σ₁ = N σ₃ + 2c√N, pressures positive.
  double strength_at(double pressure) const {
    const double n = std::tan(45 * degree + friction * degree / 2);
    return n * n * pressure + 2 * cohesion * n;
  }
};

/// σ_xx, σ_yy, σ_xy, σ_zz as the element keeps them.
std::array<double, 3> principal(const std::vector<double>& state) {
  const double mean = (state[0] + state[1]) / 2, half = (state[0] - state[1]) / 2;
  const double radius = std::hypot(half, state[2]);
  std::array<double, 3> stress{mean + radius, mean - radius, state[3]};
  std::sort(stress.begin(), stress.end(), std::greater<>());
  return stress;
}

/// Excess over yield, Pa, written anew from the two criteria.
double excess(const Soil& soil, const std::array<double, 3>& stress) {
  const double s = std::sin(soil.friction * degree), c = std::cos(soil.friction * degree);
  const double beyond_friction =
      (stress[0] - stress[2]) + (stress[0] + stress[2]) * s - 2 * soil.cohesion * c;
  return std::max(beyond_friction, stress[0] - soil.tension);
}

double largest(const std::array<double, 3>& stress) {
  return std::max(std::abs(stress[0]), std::abs(stress[2]));
}

/// ½ σ : D⁻¹ : σ, J/m³.
double elastic_energy(const Soil& soil, const std::vector<double>& state) {
  const double sum = state[0] + state[1] + state[3];
  const double squares =
      state[0] * state[0] + state[1] * state[1] + state[3] * state[3] + 2 * state[2] * state[2];
  return ((1 + soil.poisson) * squares - soil.poisson * sum * sum) / (2 * soil.young);
}

struct Crushed {
  double pressure;  ///< Pa, borne along y
  double widening;  ///< strain along x per shortening along y, at the end
};

/// Compresses along y at a held pressure along x until the stress no longer grows.
Crushed crush(const Soil& soil, double pressure) {
  const auto law = soil.make();
  DrivenElement element(*law);
  // The pressure all round first: equal strains, sized by the plane-strain compressibility.
  const double confining = pressure * (1 + soil.poisson) * (1 - 2 * soil.poisson) / soil.young;
  element.along({1 - confining, 0, 0, 1 - confining}, 50);
  double wide = element.deformation()[0];
  Crushed result{};
  for (int i = 1; i <= 400; ++i) {
    const double high = 1 - confining - 5e-5 * i;
    // The width at which the side bears just the held pressure, by bisection.
    double low_end = wide - 1e-3, high_end = wide + 1e-3;
    for (int k = 0; k < 60; ++k) {
      wide = (low_end + high_end) / 2;
      DrivenElement trial = element;
      trial.to({wide, 0, 0, high});
      (trial.state()[0] < -pressure ? low_end : high_end) = wide;
    }
    const Tensor last = element.deformation();
    element.to({wide, 0, 0, high});
    result = {-element.state()[1], std::log(wide / last[0]) / std::log(last[3] / high)};
  }
  return result;
}

}  // namespace

TEST_CASE("below yield a Mohr–Coulomb body is the hypoelastic one, bit by bit", "[plugins][mohr_coulomb]") {
  for (const double damping_time : {0.0, 2e-4}) {
    Soil strong;
    strong.cohesion = 1e12;
    strong.damping_time = damping_time;
    const auto law = strong.make();
    const auto elastic =
        shipped_material("hypoelastic", std::array{strong.young, strong.poisson, 0.0, damping_time});
    DrivenElement element(*law), twin(*elastic);
    for (const Tensor& f : lively_path(0.01, 500)) {
      const Response found = element.to(f), expected = twin.to(f);
      REQUIRE(found.stress == expected.stress);
      REQUIRE(found.viscous_stress == expected.viscous_stress);
      REQUIRE(found.energy == expected.energy);
      REQUIRE(found.dissipated == expected.dissipated);
    }
    CHECK(element.state()[5] == 0);
    CHECK(law->viscous_time() == damping_time);
    CHECK(law->doubles_per_element() == 6);
    check_tangent(*law);
  }
}

TEST_CASE("the stress across the plane is that of plane strain", "[plugins][mohr_coulomb]") {
  Soil strong;
  strong.cohesion = 1e12;
  const auto law = strong.make();
  DrivenElement element(*law);
  element.to({1.001, 0.0005, 0, 0.9995});
  const std::vector<double>& state = element.state();
  CHECK(state[3] == Approx(strong.poisson * (state[0] + state[1])).epsilon(1e-12));
}

TEST_CASE("compression yields at N σ3 + 2c √N and widens by the dilation angle", "[plugins][mohr_coulomb]") {
  for (const double friction : {0.0, 20.0, 40.0}) {
    for (const double dilation : {0.0, 1.0}) {
      Soil soil;
      soil.friction = friction;
      soil.dilation = dilation * friction;
      for (const double pressure : {0.0, 3e4}) {
        const Crushed crushed = crush(soil, pressure);
        CHECK(crushed.pressure == Approx(soil.strength_at(pressure)).epsilon(1e-6));
        // At constant stress all strain is plastic: (1 + sin ψ)/(1 − sin ψ).
        const double s = std::sin(soil.dilation * degree);
        CHECK(crushed.widening == Approx((1 + s) / (1 - s)).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("pulled, a Mohr–Coulomb body bears its tensile strength and no more", "[plugins][mohr_coulomb]") {
  Soil soil;
  soil.tension = 5e3;
  const auto law = soil.make();
  DrivenElement element(*law);
  const double at_yield =
      soil.tension * (1 + soil.poisson) * (1 - 2 * soil.poisson) / (soil.young * (1 - soil.poisson));
  element.along({1 + 0.9 * at_yield, 0, 0, 1}, 10);
  CHECK(element.state()[0] == Approx(0.9 * soil.tension).epsilon(1e-3));
  CHECK(element.state()[5] == 0);
  element.along({1 + 100 * at_yield, 0, 0, 1}, 100);
  CHECK(element.state()[0] == Approx(soil.tension).epsilon(1e-12));
  // A crack opens across itself only: the other stresses stay as they were when it came.
  const double sideways = soil.poisson / (1 - soil.poisson) * soil.tension;
  CHECK(element.state()[1] == Approx(sideways).epsilon(1e-3));
  CHECK(element.state()[3] == Approx(sideways).epsilon(1e-3));
  CHECK(element.state()[5] > 10 * at_yield);
  CHECK(element.dissipated() > 0);

  // Without a strength of its own the apex of the shear criterion is the end.
  Soil plain;
  const auto other = plain.make();
  DrivenElement pulled(*other);
  pulled.along({1.01, 0, 0, 1.01}, 20);
  for (const int k : {0, 1, 3}) {
    CHECK(pulled.state()[static_cast<std::size_t>(k)] == Approx(plain.apex_stress()).epsilon(1e-12));
  }
  CHECK(pulled.state()[2] == Approx(0).margin(1e-12 * plain.apex_stress()));
}

TEST_CASE("from any trial stress the return ends on the yield surface and takes energy",
          "[plugins][mohr_coulomb]") {
  Random random(11);
  int yielded = 0;
  for (int i = 0; i < 10000; ++i) {
    Soil soil;
    soil.friction = i % 5 == 0 ? 0 : random.between(1, 60);
    soil.cohesion = i % 7 == 0 && soil.friction > 0 ? 0 : random.between(1e3, 1e5);
    soil.dilation = i % 3 == 0 ? 0 : i % 3 == 1 ? soil.friction : random.between(0, soil.friction);
    soil.tension = i % 2 == 0 ? apex : i % 4 == 1 ? 0 : random.between(0, 5e4);
    soil.poisson = i % 11 == 0 ? 0.49 : random.between(0, 0.45);
    const auto law = soil.make();
    DrivenElement element(*law);
    const double size = 0.5 * std::pow(10, random.between(-6, 0));
    const auto part = [&] { return size * random.between(-0.9, 0.9); };
    // A step along one principal direction or none makes stresses that coincide.
    const bool equal = i % 13 == 0, straight = i % 17 == 0;
    const double a = part(), b = equal ? a : part(), c = straight || equal ? 0 : part();
    const Response response = element.to({1 + a, c, straight ? 0 : c, 1 + b});
    const std::array<double, 3> stress = principal(element.state());
    const double trial = soil.young * size;
    const double scale = std::max(largest(stress), soil.cohesion > 0 ? soil.cohesion : 1e-15 * trial);
    REQUIRE(excess(soil, stress) <= 1e-10 * scale);
    REQUIRE(response.dissipated >= 0);
    if (element.state()[5] > 0) {
      ++yielded;
      REQUIRE(excess(soil, stress) >= -1e-10 * scale);
    }
  }
  CHECK(yielded > 5000);
}

TEST_CASE("a Mohr–Coulomb body under random steps stays within yield and only loses energy",
          "[plugins][mohr_coulomb]") {
  Random random(11);
  for (const double tension : {apex, 0.0, 3e3}) {
    for (const double dilation : {0.0, 15.0, 30.0}) {
      Soil soil;
      soil.tension = tension;
      soil.dilation = dilation;
      const auto law = soil.make();
      DrivenElement element(*law);
      double plastic = 0;
      for (int i = 0; i < 500; ++i) {
        const auto part = [&] { return 3e-3 * random.between(-1, 1); };
        const Tensor f{1 + part(), part(), part(), 0.998 + part()};
        const Response response = element.to(product(rotation(0.1 * i), f));
        const std::array<double, 3> stress = principal(element.state());
        REQUIRE(excess(soil, stress) <= 1e-10 * std::max(largest(stress), soil.cohesion));
        REQUIRE(response.dissipated >= 0);
        REQUIRE(element.state()[5] >= plastic);
        plastic = element.state()[5];
      }
      CHECK(plastic > 1e-3);
    }
  }
}

TEST_CASE("stored energy and loss of a Mohr–Coulomb body are the work of its stress, to round-off",
          "[plugins][mohr_coulomb]") {
  for (const double dilation : {0.0, 20.0}) {
    Soil soil;
    soil.dilation = dilation;
    const auto law = soil.make();
    DrivenElement element(*law);
    for (const Tensor& f : lively_path(0.01, 3000, 1e-3)) {
      const Response response = element.to(f);
      const double work = element.work();
      REQUIRE(response.energy + element.dissipated() == Approx(work).margin(1e-12 * std::abs(work)));
      REQUIRE(response.dissipated >= 0);
    }
    CHECK(element.dissipated() > 0);
  }
}

TEST_CASE("what a Mohr–Coulomb body stores is its elastic energy", "[plugins][mohr_coulomb]") {
  const double strain = 2e-3;
  for (const double dilation : {0.0, 20.0}) {
    Soil soil;
    soil.dilation = dilation;
    soil.tension = 5e3;
    const auto law = soil.make();
    DrivenElement element(*law);
    double most = 0, off = 0;
    const std::vector<Tensor> path = lively_path(strain, 20000, 0);
    // In coarse steps, of up to a third of the strain.
    for (std::size_t i = 0; i < path.size(); i += 8) {
      const Response response = element.to(path[i]);
      const double elastic = elastic_energy(soil, element.state());
      most = std::max(most, elastic);
      off = std::max(off, std::abs(response.energy - elastic));
    }
    CHECK(element.dissipated() > 0.05 * most);
    // The remainder of the rate form is of the order of the strain.
    CHECK(off < 10 * strain * most);
  }
}

TEST_CASE("a Mohr–Coulomb body keeps to what every law must keep to", "[plugins][mohr_coulomb]") {
  Soil soil;
  soil.dilation = 10;
  soil.tension = 8e3;
  for (const double damping_time : {0.0, 2e-4}) {
    soil.damping_time = damping_time;
    const auto law = soil.make();
    const std::vector<Tensor> path = lively_path(0.02, 400);
    check_restart(*law, path);
    check_batch(*law, path);
    check_no_moment(*law, path, 1e-13 * soil.young);
    check_fixed_turn(*law, path, 1e-12 * soil.young);
  }
}

TEST_CASE("a spin neither strains nor damps a Mohr–Coulomb body at yield", "[plugins][mohr_coulomb]") {
  Soil soil, damped;
  damped.damping_time = 3e-4;
  const auto law = soil.make(), viscous = damped.make();
  const Tensor deformed{1.004, 0.003, 0, 0.996};
  check_spin_is_free(*viscous, *law, deformed, 1e-13 * soil.young);

  DrivenElement element(*law);
  const Response start = element.along(deformed, 40);
  const double plastic = element.state()[5];
  REQUIRE(plastic > 0);
  const double turn = 2 * std::acos(-1.0);
  Response last{};
  for (int i = 1; i <= 20000; ++i) last = element.to(product(rotation(turn * i / 200), deformed));
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(last.stress[k] == Approx(start.stress[k]).margin(1e-10 * soil.young));
  }
  CHECK(element.state()[5] == Approx(plastic).epsilon(1e-9));
}

TEST_CASE("a Mohr–Coulomb law refuses angles and strengths that make no sense, in words",
          "[plugins][mohr_coulomb]") {
  Soil soil;
  soil.dilation = 35;
  CHECK_THROWS_WITH(soil.make(), Catch::Contains("dilation_angle is 35 deg") &&
                                     Catch::Contains("friction_angle, 30 deg") &&
                                     Catch::Contains("at most the friction angle"));
  Soil nothing;
  nothing.friction = nothing.cohesion = 0;
  CHECK_THROWS_WITH(nothing.make(), Catch::Contains("leaves no strength"));
  Soil associated;
  associated.dilation = associated.friction;
  CHECK_NOTHROW(associated.make());
}
