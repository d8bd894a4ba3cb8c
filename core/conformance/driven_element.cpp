#include "conformance/driven_element.hpp"

#include <cmath>

namespace talus::conformance {

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

Tensor difference_of(const Tensor& p, const Tensor& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2], p[3] - q[3]};
}

Tensor mean_of(const Tensor& p, const Tensor& q) {
  return {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2, (p[3] + q[3]) / 2};
}

Response DrivenElement::to(const Tensor& f, double dt) {
  Response response{};
  MaterialBatch batch{};
  MaterialResponse output{};
  for (std::size_t k = 0; k < 4; ++k) {
    batch.deformation[k] = &f[k];
    batch.previous_deformation[k] = &f_[k];
    output.stress[k] = &response.stress[k];
    output.viscous_stress[k] = &response.viscous_stress[k];
  }
  std::vector<double> next(state_.size());
  batch.state = state_.data();
  batch.dt = dt;
  batch.count = 1;
  output.energy = &response.energy;
  output.dissipated = &response.dissipated;
  output.state = next.data();
  law_->evaluate(batch, output);
  if (!(law_->viscous_time() > 0)) response.viscous_stress = {};  // it may be left alone
  const Tensor moved = difference_of(f, f_);
  response.viscous = contraction_of(response.viscous_stress, moved);
  work_ += contraction_of(mean_of(stress_, response.stress), moved);
  viscous_ += contraction_of(mean_of(viscous_stress_, response.viscous_stress), moved);
  dissipated_ += response.dissipated;
  state_ = next;
  f_ = f;
  stress_ = response.stress;
  viscous_stress_ = response.viscous_stress;
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

}  // namespace talus::conformance
