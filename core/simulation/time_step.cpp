#include "simulation/time_step.hpp"

#include <Eigen/Dense>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    return Eigen::Vector3d(body.mass, body.mass, body.inertia).asDiagonal();
  }
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(6, 6);
  mass(0, 0) = mass(1, 1) = body.mass;
  for (int row = 2; row < 6; row += 2) {
    mass(row, row) = density * body.moments.xx;
    mass(row + 1, row + 1) = density * body.moments.yy;
    mass(row, row + 1) = mass(row + 1, row) = density * body.moments.xy;
  }
  return mass;
}

/// A Bᵀ D B over (u, H): strains xx, yy, 2·xy.
Eigen::MatrixXd elastic_matrix(const Body& body, const SceneMaterial& material) {
  Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
  b(0, 2) = b(1, 5) = b(2, 3) = b(2, 4) = 1;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> d;
  make<Material>(*material.model.component, material.model.values)->stiffest_tangent(d.data());
  return body.moments.area * b.transpose() * d * b;
}

struct Springs {
  Eigen::MatrixXd stiffness, damping;
};

/// Surface classes of the bodies that a body can meet, and by what factor its springs count for the motion of
/// the body it meets.
struct Meetings {
  std::vector<char> surfaces;
  double stiffness_factor = 1, damping_factor = 1;
};

/// The stiffest springs a side can meet on any other body, lumped at its two ends.
void add_side(Springs& springs, const Model& model, const Body& body, std::uint32_t from, std::uint32_t to,
              const ContactStage& contacts, const Meetings& met) {
  const Vec2 start{model.reference_x[from], model.reference_y[from]};
  const Vec2 end{model.reference_x[to], model.reference_y[to]};
  const Eigen::Vector2d side(end.x - start.x, end.y - start.y);
  const double length = side.norm();
  const Eigen::Vector2d along = side / length, across(along.y(), -along.x());
  ContactStiffness most{};
  const Interfaces& interfaces = contacts.interfaces();
  for (std::uint32_t other = 0; other < interfaces.surface_count; ++other) {
    if (!met.surfaces[other]) continue;
    const std::uint32_t row = interfaces.row[model.surface[from] * interfaces.surface_count + other];
    const ContactStiffness here = contacts.law()->stiffness(
        interfaces.value + std::size_t{row} * interfaces.parameter_count, length / 2);
    most.normal = std::max(most.normal, here.normal);
    most.tangential = std::max(most.tangential, here.tangential);
    most.normal_damping_ratio = std::max(most.normal_damping_ratio, here.normal_damping_ratio);
    most.tangential_damping_ratio = std::max(most.tangential_damping_ratio, here.tangential_damping_ratio);
  }
  // c = 2ζ√(k m) shared along the side: c/k = 2ζ√(m/k) with k of the whole side, two corners.
  const double normal_lag =
      most.normal > 0 ? 2 * most.normal_damping_ratio * std::sqrt(body.mass / (2 * most.normal)) : 0;
  const double tangential_lag =
      most.tangential > 0 ? 2 * most.tangential_damping_ratio * std::sqrt(body.mass / (2 * most.tangential))
                          : 0;
  for (const Vec2 corner : {start, end}) {
    const Shape shape = shape_at(body.kinematics, corner);
    const Eigen::VectorXd n = shape.transpose() * across, t = shape.transpose() * along;
    const Eigen::MatrixXd normal = most.normal * n * n.transpose();
    const Eigen::MatrixXd tangential = most.tangential * t * t.transpose();
    springs.stiffness += met.stiffness_factor * (normal + tangential);
    springs.damping += met.damping_factor * (normal_lag * normal + tangential_lag * tangential);
  }
}

void add_supports(Springs& springs, const Scene& scene, const Model& model, std::uint32_t index) {
  const Body& body = model.bodies[index];
  for (const PrescribedSurface& prescribed : scene.prescribed) {
    if (prescribed.body != index) continue;
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece) {
      for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c) {
        if (model.surface[c] != prescribed.surface_class) continue;
        const std::uint32_t next = c + 1 == model.piece_start[piece + 1] ? model.piece_start[piece] : c + 1;
        const double dx = model.reference_x[next] - model.reference_x[c];
        const double dy = model.reference_y[next] - model.reference_y[c];
        const double lumped = prescribed.stiffness * std::sqrt(dx * dx + dy * dy) / 2;
        for (const std::uint32_t end : {c, next}) {
          const Shape shape = shape_at(body.kinematics, {model.reference_x[end], model.reference_y[end]});
          springs.stiffness += lumped * shape.transpose() * shape;
        }
      }
    }
  }
}

double largest_eigenvalue(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, mass,
                                                                         Eigen::EigenvaluesOnly);
  return std::max(0.0, solver.eigenvalues().maxCoeff());
}

Meetings meetings(const Model& model, std::uint32_t index, std::size_t surface_count) {
  Meetings result{std::vector<char>(surface_count, 0)};
  for (std::uint32_t other = 0; other < model.bodies.size(); ++other) {
    if (other == index) continue;
    const Body& body = model.bodies[other];
    for (std::uint32_t c = body.corner_begin; c < body.corner_end; ++c) {
      if (model.surface[c] != internal_side) result.surfaces[model.surface[c]] = 1;
    }
    if (model.moves(other)) {
      const double ratio = model.bodies[index].mass / body.mass;
      result.stiffness_factor = std::max(result.stiffness_factor, 1 + std::sqrt(ratio));
      // c = 2ζ√(k m_a m_b/(m_a + m_b)) split alike: (1 + √r)/√(1 + r) is at most √2.
      result.damping_factor = std::sqrt(2.0);
    }
  }
  return result;
}

/// Central differences with dashpots taken at t_n − Δt/2: Δt² λ/4 + Δt γ/2 ≤ 1.
double stable_step(double lambda, double gamma) {
  if (!(lambda > 0)) return std::numeric_limits<double>::infinity();
  return 2 * (std::sqrt(gamma * gamma / 4 + lambda) - gamma / 2) / lambda;
}

/// Bodies alike in shape, material and meetings vote alike; walls and columns have few different ones.
bool votes_alike(const Scene& scene, const Model& model, std::uint32_t i, std::uint32_t j) {
  const Body &p = model.bodies[i], &q = model.bodies[j];
  if (p.kinematics != q.kinematics || scene.bodies[i].material != scene.bodies[j].material) return false;
  if (p.corner_end - p.corner_begin != q.corner_end - q.corner_begin) return false;
  for (std::uint32_t c = 0; c < p.corner_end - p.corner_begin; ++c) {
    const std::uint32_t a = p.corner_begin + c, b = q.corner_begin + c;
    const double near = 1e-9 * p.width;
    if (std::abs(model.reference_x[a] - model.reference_x[b]) > near) return false;
    if (std::abs(model.reference_y[a] - model.reference_y[b]) > near) return false;
    if (model.surface[a] != model.surface[b]) return false;
  }
  return scene.prescribed.empty();
}

CriticalStep vote(const Scene& scene, const Model& model, const ContactStage& contacts, std::uint32_t index) {
  const Body& body = model.bodies[index];
  const SceneMaterial& material = scene.materials[scene.bodies[index].material];
  const Eigen::MatrixXd mass = mass_matrix(body, material.density);
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(mass.rows(), mass.cols());
  Eigen::MatrixXd elastic = zero;
  if (body.kinematics == Kinematics::affine) elastic = elastic_matrix(body, material);
  Springs springs{zero, zero};
  if (contacts.law() != nullptr) {
    const Meetings met = meetings(model, index, contacts.interfaces().surface_count);
    for (std::uint32_t piece = body.piece_begin; piece < body.piece_end; ++piece) {
      for (std::uint32_t c = model.piece_start[piece]; c < model.piece_start[piece + 1]; ++c) {
        if (model.surface[c] == internal_side) continue;
        const std::uint32_t next = c + 1 == model.piece_start[piece + 1] ? model.piece_start[piece] : c + 1;
        add_side(springs, model, body, c, next, contacts, met);
      }
    }
  }
  add_supports(springs, scene, model, index);
  const double lambda = largest_eigenvalue(elastic + springs.stiffness, mass);
  const double elastic_share = lambda > 0 ? largest_eigenvalue(elastic, mass) / lambda : 0;
  const char* cause = elastic_share > 0.5 ? "mostly its strain modes" : "mostly its contacts";
  return {stable_step(lambda, largest_eigenvalue(springs.damping, mass)),
          fmt::format("body '{}': {}", scene.bodies[index].name, cause)};
}

}  // namespace

CriticalStep critical_step(const Scene& scene, const Model& model, const ContactStage& contacts) {
  CriticalStep smallest{std::numeric_limits<double>::infinity(), "nothing vibrates"};
  std::vector<std::uint32_t> voted;
  for (std::uint32_t i = 0; i < model.bodies.size(); ++i) {
    if (!model.moves(i)) continue;
    const auto alike = [&](std::uint32_t other) { return votes_alike(scene, model, i, other); };
    if (std::any_of(voted.begin(), voted.end(), alike)) continue;
    if (voted.size() < 64) voted.push_back(i);
    CriticalStep here = vote(scene, model, contacts, i);
    if (here.dt < smallest.dt) smallest = std::move(here);
  }
  return smallest;
}

}  // namespace talus
