// What must hold of the material my_component, whatever its stress is; that this is the derivative of an
// energy only as long as its component says so.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>

#include <talus/plane_tensor.hpp>
#include <talus/testing/component.hpp>

#include <cmath>
#include <vector>

extern "C" const talus::Library talus_library;

namespace {

using talus::TwoPointTensor;

constexpr double young = 1e10, poisson = 0.25;

struct Response {
  TwoPointTensor stress;  ///< Pa, first Piola–Kirchhoff
  double energy;          ///< J/m³
};

/// One element that goes from rest through some deformation gradients, a step each.
Response respond_along(const std::vector<TwoPointTensor>& path) {
  const auto material =
      talus::testing::make<talus::Material>(talus_library, "my_component", {young, poisson});
  TwoPointTensor before;
  std::vector<double> state(material->doubles_per_element(), 0.0), next(state.size(), NAN);
  Response response{{NAN, NAN, NAN, NAN}, NAN};
  TwoPointTensor &p = response.stress, v;  // the latter of viscous stress
  for (const TwoPointTensor& now : path) {
    double dissipated = NAN;
    material->evaluate({{&now.xx, &now.xy, &now.yx, &now.yy},
                        {&before.xx, &before.xy, &before.yx, &before.yy},
                        state.data(),
                        1e-3,
                        1},
                       {{&p.xx, &p.xy, &p.yx, &p.yy},
                        {&v.xx, &v.xy, &v.yx, &v.yy},
                        &response.energy,
                        &dissipated,
                        next.data()});
    CHECK(dissipated >= 0);
    before = now;
    state = next;
  }
  return response;
}
Response respond(const TwoPointTensor& deformation) {
  return respond_along({deformation});
}

const TwoPointTensor deformations[] = {{1.001, 0, 0, 1}, {1, 0.002, 0, 1}, {0.999, 0.001, -0.0005, 1.0015}};

}  // namespace

TEST_CASE("Without deformation there is no stress") {
  const Response response = respond({});
  CHECK(response.stress.xx == Approx(0).margin(1e-6));
  CHECK(response.stress.yy == Approx(0).margin(1e-6));
  CHECK(response.energy == Approx(0).margin(1e-6));
}

TEST_CASE("Stress is the derivative of the energy") {
  if ((talus_library.components[0].traits & talus::trait::has_potential) == 0) return;
  for (const TwoPointTensor& f : deformations) {
    const Response at = respond(f);
    for (double TwoPointTensor::*component :
         {&TwoPointTensor::xx, &TwoPointTensor::xy, &TwoPointTensor::yx, &TwoPointTensor::yy}) {
      const double step = 1e-6;
      TwoPointTensor more = f, less = f;
      more.*component += step;
      less.*component -= step;
      const double slope = (respond(more).energy - respond(less).energy) / (2 * step);
      CHECK(at.stress.*component == Approx(slope).epsilon(1e-4).margin(1e-6 * young * 1e-3));
    }
  }
}

TEST_CASE("A rotation turns the stress and leaves the energy") {
  const double c = std::cos(1.1), s = std::sin(1.1);
  for (const TwoPointTensor& f : deformations) {
    const Response at = respond_along({{}, f});
    const Response turned =
        respond_along({{c, -s, s, c},
                       {c * f.xx - s * f.yx, c * f.xy - s * f.yy, s * f.xx + c * f.yx, s * f.xy + c * f.yy}});
    CHECK(turned.energy == Approx(at.energy));
    CHECK(turned.stress.xx == Approx(c * at.stress.xx - s * at.stress.yx).margin(1e-6 * young * 1e-3));
    CHECK(turned.stress.yy == Approx(s * at.stress.xy + c * at.stress.yy).margin(1e-6 * young * 1e-3));
  }
}

TEST_CASE("The time step is made for the stiffness that the material shows") {
  const auto material =
      talus::testing::make<talus::Material>(talus_library, "my_component", {young, poisson});
  double tangent[9];
  material->stiffest_tangent(tangent);
  CHECK(tangent[0] == Approx((respond({1 + 1e-6, 0, 0, 1}).stress.xx) / 1e-6).epsilon(1e-3));
  CHECK(tangent[4] == Approx((respond({1, 0, 0, 1 + 1e-6}).stress.yy) / 1e-6).epsilon(1e-3));
}
