/// The information form of a Gaussian update over (x, y, yaw).
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace incognita {

/// The sum of H^T R^-1 H and H^T R^-1 r over measurements.
struct Information {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();

  /// Adds a scalar measurement with Jacobian `jacobian`, residual measured minus expected, and weight 1 / variance.
  void add(const Eigen::Vector3d& jacobian, double residual, double weight) {
    matrix.noalias() += weight * jacobian * jacobian.transpose();
    vector += weight * residual * jacobian;
  }
};

/// (11a) of Seo et al. without inverting the prior, which may be singular: (P^-1 + J)^-1 = (I + P J)^-1 P. Symmetric to
/// the last bit.
[[nodiscard]] inline Eigen::Matrix3d updated_covariance(const Eigen::Matrix3d& prior, const Eigen::Matrix3d& information) {
  const Eigen::Matrix3d gain = (Eigen::Matrix3d::Identity() + prior * information).inverse();
  const Eigen::Matrix3d posterior = gain * prior;
  return 0.5 * (posterior + posterior.transpose());
}

}  // namespace incognita
