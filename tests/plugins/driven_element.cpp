#include "driven_element.hpp"

#include "simulation/working_scene.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace talus {

Tensor product(const Tensor& p, const Tensor& q) {
  return {p[0] * q[0] + p[1] * q[2], p[0] * q[1] + p[1] * q[3], p[2] * q[0] + p[3] * q[2],
          p[2] * q[1] + p[3] * q[3]};
}

Tensor transposed(const Tensor& t) {
  return {t[0], t[2], t[1], t[3]};
}

Tensor rotation(double angle) {
  return {std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)};
}

double size_of(const Tensor& t) {
  return std::sqrt(contraction_of(t, t));
}

double determinant_of(const Tensor& t) {
  return t[0] * t[3] - t[1] * t[2];
}

double contraction_of(const Tensor& p, const Tensor& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

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

Response DrivenElement::to(const Tensor& f, double dt) {
  Response response{};
  MaterialBatch batch{};
  MaterialResponse output{};
  for (std::size_t k = 0; k < 4; ++k) {
    batch.deformation[k] = &f[k];
    batch.previous_deformation[k] = &f_[k];
    output.stress[k] = &response.stress[k];
  }
  std::vector<double> next(state_.size());
  batch.state = state_.data();
  batch.dt = dt;
  batch.count = 1;
  output.energy = &response.energy;
  output.dissipated = &response.dissipated;
  output.state = next.data();
  law_->evaluate(batch, output);
  for (std::size_t k = 0; k < 4; ++k) work_ += (stress_[k] + response.stress[k]) / 2 * (f[k] - f_[k]);
  dissipated_ += response.dissipated;
  state_ = next;
  f_ = f;
  stress_ = response.stress;
  return response;
}

Response DrivenElement::along(const Tensor& f, int steps, double dt) {
  const Tensor start = f_;
  Response response{};
  for (int i = 1; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    Tensor middle;
    for (std::size_t k = 0; k < 4; ++k) middle[k] = (1 - share) * start[k] + share * f[k];
    response = to(middle, dt);
  }
  return response;
}

std::vector<Tensor> lively_path(double strain, int steps, double spin) {
  std::vector<Tensor> path;
  for (int i = 0; i < steps; ++i) {
    const double t = static_cast<double>(i);
    const Tensor stretch{1 + strain * std::sin(0.031 * t), strain * std::sin(0.023 * t + 0.4),
                         strain * std::sin(0.017 * t), 1 + strain * std::sin(0.041 * t + 0.1)};
    path.push_back(product(rotation(spin * t), stretch));
  }
  return path;
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
  }
  REQUIRE(element.state() == other.state());

  // A look at the same configuration, as at the start of a stage, changes nothing.
  const Response last = element.to(path.back());
  const Response first = element.to(path.back(), 0);
  CHECK(first.energy == last.energy);
  CHECK(first.dissipated == 0);
}

void check_batch(const Material& law, std::span<const Tensor> path) {
  const std::size_t count = path.size() / 2, states = law.doubles_per_element();
  std::vector<DrivenElement> alone(count, DrivenElement(law));
  std::vector<double> before[4], now[4], stress[4], energy(count), dissipated(count, 1.0);
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
    const double lost = viscous.dissipated - plain.dissipated;
    REQUIRE(lost >= 0);
    REQUIRE(lost < 1e-15 * margin);  // the square of a strain that is round-off
  }
}

}  // namespace talus
