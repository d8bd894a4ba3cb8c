#include "simulation/body_vote.hpp"

#include <Eigen/Dense>

#include <algorithm>

namespace talus {
namespace {

/// u(X) = N q with q = (u, H by rows) for an affine body, (u, θ) for a rigid one.
using Shape = Eigen::Matrix<double, 2, Eigen::Dynamic>;

Shape shape_at(Kinematics kinematics, Vec2 p) {
  if (kinematics == Kinematics::rigid) {
    Shape n(2, 3);
    n << 1, 0, -p.y, 0, 1, p.x;
    return n;
  }
  Shape n = Shape::Zero(2, 6);
  n(0, 0) = n(1, 1) = 1;
  n(0, 2) = n(1, 4) = p.x;
  n(0, 3) = n(1, 5) = p.y;
  return n;
}

Eigen::MatrixXd mass_matrix(const Body& body, double density) {
  if (body.kinematics == Kinematics::rigid) {
    return Eigen::Vector3d(body.mass, body.mass, body.inertia()).asDiagonal();
  }
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(6, 6);
  mass(0, 0) = mass(1, 1) = body.mass;
  for (int row = 2; row < 6; row += 2) {
    mass(row, row) = density * body.moments.xx;
    mass(row + 1, row + 1) = density * body.moments.yy;
    mass(row, row + 1) = mass(row + 1, row) = density * body.moments.xy;
  }
  if (body.strain_mass_scale == 1) return mass;
  // s M + (1 − s) (M r)(M r)ᵀ/(rᵀ M r) of the deformation part, r the spin (see StrainMass), with F = I.
  const Eigen::Vector4d spin(0, -1, 1, 0);
  const Eigen::Matrix4d unscaled = mass.bottomRightCorner<4, 4>();
  const Eigen::Vector4d turning = unscaled * spin;
  mass.bottomRightCorner<4, 4>() = body.strain_mass_scale * unscaled + (1 - body.strain_mass_scale) /
                                                                           spin.dot(turning) * turning *
                                                                           turning.transpose();
  return mass;
}

/// A Bᵀ D B over (u, H), strains xx, yy, 2·xy; and the same times the viscous time.
struct Elastic {
  Eigen::MatrixXd stiffness, damping;
};

Elastic elastic_matrix(const Body& body, const SceneMaterial& material) {
  Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
  b(0, 2) = b(1, 5) = b(2, 3) = b(2, 4) = 1;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> d;
  const auto model = make<Material>(*material.model.component, material.model.values);
  model->stiffest_tangent(d.data());
  const Eigen::MatrixXd stiffness = body.moments.area * b.transpose() * d * b;
  return {stiffness, model->viscous_time() * stiffness};
}

/// What a support gives moves by no force: as if it were very heavy.
void hold(Eigen::MatrixXd& mass, const Support& support) {
  constexpr double heavy = 1e6;
  if (support.x) mass(0, 0) *= heavy;
  if (support.y) mass(1, 1) *= heavy;
  if (!support.rotation) return;
  Eigen::VectorXd spin = Eigen::VectorXd::Zero(mass.rows());
  if (mass.rows() == 3) {
    spin(2) = 1;
  } else {
    spin(3) = -1, spin(4) = 1;
  }
  const Eigen::VectorXd turning = mass * spin;
  mass += heavy / spin.dot(turning) * turning * turning.transpose();
}

double largest_eigenvalue(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, mass,
                                                                         Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

}  // namespace

BodyVote vote_as_a_whole(const Scene& scene, const Model& model, std::uint32_t index,
                         const SpringsOfSides& springs, const Support& support, double factor) {
  const Body& body = model.bodies[index];
  const SceneMaterial& material = scene.materials[scene.bodies[index].material];
  Eigen::MatrixXd mass = mass_matrix(body, material.density);
  hold(mass, support);
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  Elastic elastic{zero, zero};
  if (body.kinematics == Kinematics::affine) elastic = elastic_matrix(body, material);
  Eigen::MatrixXd contacts = zero, supports = zero, damping = elastic.damping,
                  damping_alone = elastic.damping;
  const std::vector<BoundarySide> sides = boundary_of(scene, model, index);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const BoundarySide& side = sides[i];
    const Vec2 start = side.start.reference, end = side.end.reference;
    const Eigen::Vector2d along = Eigen::Vector2d(end.x - start.x, end.y - start.y).normalized();
    const Eigen::Vector2d across(along.y(), -along.x());
    const Shape at_start = shape_at(body.kinematics, start), at_end = shape_at(body.kinematics, end);
    const Shape mean = (at_start + at_end) / 2, change = at_end - at_start;
    const auto add = [&](Eigen::MatrixXd& to, const Eigen::Vector2d& direction, double half, Reach reach) {
      const Eigen::VectorXd m = mean.transpose() * direction, d = change.transpose() * direction;
      to += 2 * half * (reach.mean * m * m.transpose() + reach.change * d * d.transpose());
    };
    const SideSprings& on = springs[i];
    // A rigid side has one velocity along it, wherever somebody holds it.
    const bool at_one_place = on.spread && body.kinematics != Kinematics::rigid;
    add(contacts, across, on.normal, on.spread ? spread_evenly : at_ends);
    add(contacts, along, on.tangential, at_one_place ? at_resultant : at_ends);
    add(damping, across, on.normal_damping, on.spread ? spread_dashpot : at_ends);
    add(damping, along, on.tangential_damping, at_one_place ? dashpot_at_resultant : at_ends);
    for (const Shape& shape : {at_start, at_end}) {
      supports += on.support * shape.transpose() * shape;
      damping += on.support_damping * shape.transpose() * shape;
      damping_alone += on.support_damping * shape.transpose() * shape;
    }
  }
  return {largest_eigenvalue(elastic.stiffness + supports + factor * contacts, mass),
          largest_eigenvalue(damping, mass), largest_eigenvalue(damping_alone, mass),
          largest_eigenvalue(elastic.stiffness, mass), largest_eigenvalue(supports + contacts, mass)};
}

}  // namespace talus
