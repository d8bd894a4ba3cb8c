#pragma once

#include <talus/material.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace talus::conformance {

using Tensor = std::array<double, 4>;  ///< xx, xy, yx, yy

Tensor product(const Tensor& p, const Tensor& q);
Tensor transposed(const Tensor& t);
Tensor rotation(double angle);
double size_of(const Tensor& t);
double determinant_of(const Tensor& t);
Tensor difference_of(const Tensor& p, const Tensor& q);
Tensor mean_of(const Tensor& p, const Tensor& q);
/// p : q.
double contraction_of(const Tensor& p, const Tensor& q);

struct Response {
  Tensor stress, viscous_stress;  ///< Pa, P, and what of it goes with the rate
  double energy, dissipated;      ///< J/m³, the latter as the law tells it
  double viscous;                 ///< J/m³, work of that stress over the step behind
};

/// One element that is led along a path of deformation gradients as the host does it.
class DrivenElement {
 public:
  explicit DrivenElement(const Material& law) : law_(&law), state_(law.doubles_per_element()) {}

  /// The first step of a run, dt = 0, is up to the caller.
  Response to(const Tensor& f, double dt = 1e-3);
  /// To F in steps of equal change; the last response.
  Response along(const Tensor& f, int steps, double dt = 1e-3);

  const Tensor& deformation() const { return f_; }
  const std::vector<double>& state() const { return state_; }
  double work() const { return work_; }  ///< J/m³, ½ (P_{n-1} + P_n) : (F_n − F_{n-1}) summed up
  /// J/m³, with the work of viscous stress as the host books it.
  double dissipated() const { return dissipated_ + viscous_; }
  double viscous() const { return viscous_; }  ///< J/m³, of it

 private:
  const Material* law_;
  Tensor f_{1, 0, 0, 1}, stress_{0, 0, 0, 0}, viscous_stress_{0, 0, 0, 0};
  std::vector<double> state_;
  double work_ = 0, dissipated_ = 0, viscous_ = 0;
};

/// A walk about the identity: strains of up to `strain`, under a rotation by `spin` per step.
std::vector<Tensor> lively_path(double strain, int steps, double spin = 0.01);

}  // namespace talus::conformance
