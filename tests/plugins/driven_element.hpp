#pragma once

#include "plugin/registry.hpp"

#include <talus/material.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace talus {

constexpr double young = 2e9, poisson = 0.3;          ///< Pa; of the elastic samples
constexpr double plane_strain = 0, plane_stress = 1;  ///< values of the parameter "plane"

using Tensor = std::array<double, 4>;  ///< xx, xy, yx, yy

Tensor product(const Tensor& p, const Tensor& q);
Tensor transposed(const Tensor& t);
Tensor rotation(double angle);
double size_of(const Tensor& t);
double determinant_of(const Tensor& t);
/// p : q.
double contraction_of(const Tensor& p, const Tensor& q);
/// σ = P Fᵀ / det F.
Tensor cauchy(const Tensor& p, const Tensor& f);

struct Response {
  Tensor stress;  ///< Pa, P
  double energy, dissipated;
};

/// A material of this build by its name and the values of its parameters in declared order.
Made<Material> shipped_material(const std::string& name, std::span<const double> values);

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
  double dissipated() const { return dissipated_; }

 private:
  const Material* law_;
  Tensor f_{1, 0, 0, 1}, stress_{0, 0, 0, 0};
  std::vector<double> state_;
  double work_ = 0, dissipated_ = 0;
};

/// A walk about the identity: strains of up to `strain`, under a rotation by `spin` per step.
std::vector<Tensor> lively_path(double strain, int steps, double spin = 0.01);

// What must hold for every law.

/// Going on from a copy of state and deformation gives the same bits.
void check_restart(const Material& law, std::span<const Tensor> path);
/// In a batch each element gets what it gets alone, state included.
void check_batch(const Material& law, std::span<const Tensor> path);
/// P Fᵀ is symmetric: no element turns itself. `margin` in Pa.
void check_no_moment(const Material& law, std::span<const Tensor> path, double margin);
/// A path seen from another, fixed direction gives stresses that are turned and energies that are not.
void check_fixed_turn(const Material& law, std::span<const Tensor> path, double margin);
/// The tangent at rest is the one that is declared the stiffest.
void check_tangent(const Material& law);
/// Under a spin of the deformed element a viscous law gives no more than `margin` Pa beyond `elastic`, its
/// twin without viscosity.
void check_spin_is_free(const Material& law, const Material& elastic, const Tensor& deformed, double margin);

}  // namespace talus
