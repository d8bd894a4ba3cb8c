#include "verification/mass_matrices.hpp"

#include "geometry/polygon.hpp"
#include "model/model.hpp"
#include "plugin/registry.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace talus::verification {
namespace {

using Weights = std::array<Eigen::Vector3d, 3>;  ///< over 1, x, y

Weights weights_of(const Model& model, const Element& element) {
  const Carrier at_centre = model.carrier(element, {0, 0});
  Weights weights;
  for (std::size_t i = 0; i < 3; ++i)
    weights[i] = {at_centre.weight[i], element.gradient[i].x, element.gradient[i].y};
  return weights;
}

/// ∫(1, x, y)ᵀ(1, x, y) over a region.
Eigen::Matrix3d second_moments(const std::vector<Ring>& region) {
  AreaMoments m{};
  for (const Ring& ring : region) m = m + ring_moments(ring, {0, 0});
  Eigen::Matrix3d moments;
  moments << m.area, m.x, m.y, m.x, m.xx, m.xy, m.y, m.xy, m.yy;
  return moments;
}

Eigen::Matrix3d elasticity(const SceneMaterial& material) {
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> d;
  make<Material>(*material.model.component, material.model.values)->stiffest_tangent(d.data());
  return d;
}

}  // namespace

MassMatrices mass_matrices(const Scene& scene) {
  const Model model = build_model(scene);
  const SceneMaterial& material = scene.materials[scene.bodies[0].material];
  const Eigen::Matrix3d d = elasticity(material);
  const auto unknowns = static_cast<Eigen::Index>(2 * model.patch_star.size());
  MassMatrices made{
      Eigen::MatrixXd::Zero(unknowns, unknowns), Eigen::MatrixXd::Zero(unknowns, unknowns), {}, {}};
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const Element& element = model.elements[e];
    const Weights weights = weights_of(model, element);
    const Eigen::Matrix3d moments = second_moments(model.element_region[e]);
    Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vec2 g = element.gradient[static_cast<std::size_t>(i)];
      b(0, 2 * i) = b(2, 2 * i + 1) = g.x;
      b(1, 2 * i + 1) = b(2, 2 * i) = g.y;
    }
    const Eigen::Matrix<double, 6, 6> stiffness = model.element_area[e] * b.transpose() * d * b;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
        const Eigen::Index row = 2 * Eigen::Index{element.patch[p]},
                           column = 2 * Eigen::Index{element.patch[q]};
        made.stiffness.block<2, 2>(row, column) += stiffness.block<2, 2>(2 * i, 2 * j);
        const double mass = material.density * weights[p].dot(moments * weights[q]);
        made.consistent.block<2, 2>(row, column) += mass * Eigen::Matrix2d::Identity();
      }
    }
  }
  made.lumped = made.consistent.rowwise().sum();
  const Vec2 centre = model.bodies[0].centre;
  for (const Vec2 star : model.patch_star) made.star.push_back(star + centre);
  return made;
}

double largest_stable_step(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass,
                                                                         Eigen::EigenvaluesOnly);
  return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

double frequency_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                    const Eigen::VectorXd& shape, double guess) {
  // Inverse iteration, which leaves of `shape` what is of the mode next to the guess.
  const Eigen::PartialPivLU<Eigen::MatrixXd> solver(stiffness - guess * guess * mass);
  Eigen::VectorXd mode = shape;
  for (int i = 0; i < 4; ++i) {
    mode = solver.solve(mass * mode);
    mode.normalize();
  }
  const Eigen::VectorXd weighted = mass * mode;
  const double square = mode.dot(weighted), share = shape.dot(weighted);
  if (!(share * share > 0.98 * square * shape.dot(mass * shape)))
    return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(mode.dot(stiffness * mode) / square);
}

}  // namespace talus::verification
