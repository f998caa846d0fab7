/// The information form of a Gaussian update over (x, y, yaw).
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

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

/// (11a) of Seo et al., (P^-1 + J)^-1, without inverting the prior P, which may be singular: with P = F F^T it is
/// F (I + F^T J F)^-1 F^T, symmetric to the last bit and positive semi-definite by construction.
[[nodiscard]] inline Eigen::Matrix3d updated_covariance(const Eigen::Matrix3d& prior,
                                                        const Eigen::Matrix3d& information) {
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(prior);
  const Eigen::Matrix3d lower = ldlt.matrixL();
  const Eigen::Vector3d roots = ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Matrix3d factor = ldlt.transpositionsP().transpose() * (lower * roots.asDiagonal());
  const Eigen::LLT<Eigen::Matrix3d> inner(Eigen::Matrix3d::Identity() + factor.transpose() * information * factor);
  const Eigen::Matrix3d half = inner.matrixL().solve(factor.transpose());
  return half.transpose() * half;
}

}  // namespace incognita
