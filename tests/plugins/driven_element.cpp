#include "driven_element.hpp"

#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace talus {

Tensor cauchy(const Tensor& p, const Tensor& f) {
  Tensor stress = product(p, transposed(f));
  for (double& component : stress) component /= determinant_of(f);
  return stress;
}

Made<Material> shipped_material(const std::string& name, std::span<const double> values) {
  const RegisteredComponent* found = shipped_registry().find(ComponentKind::material, name);
  REQUIRE(found != nullptr);
  REQUIRE(found->component->parameter_count == values.size());
  return make<Material>(*found, values);
}

void check_restart(const Material& law, std::span<const Tensor> path) {
  DrivenElement element(law);
  for (std::size_t i = 0; i < path.size() / 2; ++i) element.to(path[i]);
  DrivenElement other = element;
  for (std::size_t i = path.size() / 2; i < path.size(); ++i) {
    const Response one = element.to(path[i]), two = other.to(path[i]);
    REQUIRE(one.stress == two.stress);
    REQUIRE(one.energy == two.energy);
    REQUIRE(one.dissipated == two.dissipated);
    REQUIRE(one.viscous_stress == two.viscous_stress);
  }
  REQUIRE(element.state() == other.state());

  // A look at the same configuration, as at the start of a stage, changes nothing.
  const Response last = element.to(path.back());
  const Response first = element.to(path.back(), 0);
  CHECK(first.energy == last.energy);
  CHECK(first.dissipated == 0);
  CHECK(first.viscous_stress == Tensor{});
}

void check_batch(const Material& law, std::span<const Tensor> path) {
  const std::size_t count = path.size() / 2, states = law.doubles_per_element();
  std::vector<DrivenElement> alone(count, DrivenElement(law));
  std::vector<double> before[4], now[4], stress[4], viscous[4], energy(count), dissipated(count, 1.0);
  std::vector<double> state(count * states), next(count * states);
  MaterialBatch batch{};
  MaterialResponse output{};
  for (std::size_t i = 0; i < count; ++i) {
    alone[i].to(path[i]);
    std::copy(alone[i].state().begin(), alone[i].state().end(), state.data() + i * states);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      before[k].push_back(path[i][k]);
      now[k].push_back(path[count + i][k]);
    }
    stress[k].resize(count);
    batch.deformation[k] = now[k].data();
    batch.previous_deformation[k] = before[k].data();
    output.stress[k] = stress[k].data();
    viscous[k].resize(count);
    output.viscous_stress[k] = viscous[k].data();
  }
  batch.state = state.data();
  batch.dt = 1e-3;
  batch.count = static_cast<std::uint32_t>(count);
  output.energy = energy.data();
  output.dissipated = dissipated.data();
  output.state = next.data();
  law.evaluate(batch, output);
  for (std::size_t i = 0; i < count; ++i) {
    const Response expected = alone[i].to(path[count + i]);
    for (std::size_t k = 0; k < 4; ++k) REQUIRE(stress[k][i] == expected.stress[k]);
    REQUIRE(energy[i] == expected.energy);
    REQUIRE(dissipated[i] == expected.dissipated);
    for (std::size_t k = 0; k < 4; ++k) REQUIRE(viscous[k][i] == expected.viscous_stress[k]);
    REQUIRE(std::equal(alone[i].state().begin(), alone[i].state().end(), next.data() + i * states));
  }
}

void check_no_moment(const Material& law, std::span<const Tensor> path, double margin) {
  DrivenElement element(law);
  double largest = 0;
  for (const Tensor& f : path) {
    const Tensor kirchhoff = product(element.to(f).stress, transposed(f));
    REQUIRE(kirchhoff[1] == Approx(kirchhoff[2]).margin(margin));
    largest = std::max(largest, std::abs(kirchhoff[1]));
  }
  REQUIRE(largest > 1e3 * margin);  // there was something to be unequal
}

void check_fixed_turn(const Material& law, std::span<const Tensor> path, double margin) {
  const Tensor q = rotation(1.234);
  DrivenElement element(law), turned(law);
  turned.to(q);
  for (const Tensor& f : path) {
    const Response one = element.to(f), two = turned.to(product(q, f));
    const Tensor expected = product(q, one.stress);
    for (std::size_t k = 0; k < 4; ++k) REQUIRE(two.stress[k] == Approx(expected[k]).margin(margin));
    REQUIRE(two.energy == Approx(one.energy).margin(margin));
    REQUIRE(two.dissipated == Approx(one.dissipated).margin(margin));
  }
}

void check_tangent(const Material& law) {
  double tangent[9];
  law.stiffest_tangent(tangent);
  const double step = 1e-7;
  const auto stress = [&](const Tensor& f) { return DrivenElement(law).to(f, 0).stress; };
  const Tensor x = stress({1 + step, 0, 0, 1});
  const Tensor xy = stress({1, step / 2, step / 2, 1});
  CHECK(tangent[0] == Approx(x[0] / step).epsilon(1e-6));
  CHECK(tangent[1] == Approx(x[3] / step).epsilon(1e-6));
  CHECK(tangent[8] == Approx(xy[1] / step).epsilon(1e-6));
  CHECK(tangent[4] == tangent[0]);
  CHECK(tangent[3] == tangent[1]);
  for (const int zero : {2, 5, 6, 7}) CHECK(tangent[zero] == 0);
}

void check_spin_is_free(const Material& law, const Material& elastic, const Tensor& deformed, double margin) {
  DrivenElement element(law), twin(elastic);
  element.to(deformed);
  twin.to(deformed);
  for (int i = 1; i <= 300; ++i) {
    const Tensor f = product(rotation(0.05 * i), deformed);
    const Response viscous = element.to(f), plain = twin.to(f);
    for (std::size_t k = 0; k < 4; ++k) REQUIRE(viscous.stress[k] == Approx(plain.stress[k]).margin(margin));
    REQUIRE(viscous.dissipated == plain.dissipated);
    REQUIRE(size_of(viscous.viscous_stress) < margin);
  }
}

}  // namespace talus
