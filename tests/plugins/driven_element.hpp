#pragma once

#include "conformance/driven_element.hpp"
#include "plugin/registry.hpp"

#include <span>
#include <string>

namespace talus {

using conformance::contraction_of;
using conformance::determinant_of;
using conformance::DrivenElement;
using conformance::lively_path;
using conformance::product;
using conformance::Response;
using conformance::rotation;
using conformance::size_of;
using conformance::Tensor;
using conformance::transposed;

constexpr double young = 2e9, poisson = 0.3;          ///< Pa; of the elastic samples
constexpr double plane_strain = 0, plane_stress = 1;  ///< values of the parameter "plane"

/// σ = P Fᵀ / det F.
Tensor cauchy(const Tensor& p, const Tensor& f);

/// A material of this build by its name and the values of its parameters in declared order.
Made<Material> shipped_material(const std::string& name, std::span<const double> values);

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
