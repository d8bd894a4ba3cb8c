#pragma once

#include "scene/scene.hpp"

#include <Eigen/Dense>

#include <vector>

namespace talus::verification {

/// Stiffness and both masses of the one body of a scene, of many elements and linearly elastic, as it is
/// laid: Eqs. 17–18 over the regions of its elements. Unknowns are x and y of one patch after the other.
struct MassMatrices {
  Eigen::MatrixXd stiffness, consistent;
  Eigen::VectorXd lumped;  ///< row sums
  std::vector<Vec2> star;  ///< [patch] m, in the coordinates of the scene

  Eigen::MatrixXd lumped_matrix() const { return lumped.asDiagonal(); }
};

MassMatrices mass_matrices(const Scene& scene);

/// 2/ω of the highest mode, s.
double largest_stable_step(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// ω of the mode that `shape` is nearly, 1/s; no number where no mode is nearly that. `guess`: nearer to it
/// than to any other of its kind.
double frequency_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                    const Eigen::VectorXd& shape, double guess);

}  // namespace talus::verification
