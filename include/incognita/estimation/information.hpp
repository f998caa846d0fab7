/// The information form of a Gaussian update over (x, y, yaw). Written out by coefficient: every program that includes the
/// library would otherwise pay seconds for instances of Eigen's decompositions.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "incognita/geometry/vector.hpp"

namespace incognita {

/// The sum of H^T R^-1 H and H^T R^-1 r over measurements.
struct Information {
  Eigen::Matrix3d matrix = zero<Eigen::Matrix3d>();  ///< H^T R^-1 H, over (x, y, yaw)
  Eigen::Vector3d vector{0.0, 0.0, 0.0};             ///< H^T R^-1 r, likewise

  /// Adds a scalar measurement with Jacobian `jacobian`, residual measured minus expected, and weight 1 / variance.
  void add(const Eigen::Vector3d& jacobian, double residual, double weight) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        matrix(row, column) += weight * (jacobian[row] * jacobian[column]);
      }
      vector[row] += weight * residual * jacobian[row];
    }
  }
};

/// The lower triangular L with L L^T = matrix, for a symmetric positive semi-definite matrix; where it is singular, the
/// columns that carry nothing are 0.
[[nodiscard]] inline Eigen::Matrix3d lower_factor(const Eigen::Matrix3d& matrix) {
  Eigen::Matrix3d lower = zero<Eigen::Matrix3d>();
  for (int column = 0; column < 3; ++column) {
    double pivot = matrix(column, column);
    for (int k = 0; k < column; ++k) pivot -= lower(column, k) * lower(column, k);
    if (!(pivot > 1e-15 * matrix(column, column))) continue;
    lower(column, column) = std::sqrt(pivot);
    for (int row = column + 1; row < 3; ++row) {
      double rest = matrix(row, column);
      for (int k = 0; k < column; ++k) rest -= lower(row, k) * lower(column, k);
      lower(row, column) = rest / lower(column, column);
    }
  }
  return lower;
}

/// (11a) of Seo et al., (P^-1 + J)^-1, without inverting the prior P, which may be singular: with P = F F^T it is
/// F (I + F^T J F)^-1 F^T, symmetric to the last bit and positive semi-definite by construction.
[[nodiscard]] inline Eigen::Matrix3d updated_covariance(const Eigen::Matrix3d& prior,
                                                        const Eigen::Matrix3d& information) {
  const Eigen::Matrix3d factor = lower_factor(prior);
  Eigen::Matrix3d inner;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) sum += factor(k, i) * information(k, l) * factor(l, j);
      }
      inner(i, j) = (i == j ? 1.0 : 0.0) + sum;
      inner(j, i) = inner(i, j);
    }
  }
  const Eigen::Matrix3d root = lower_factor(inner);
  Eigen::Matrix3d half;  // root^-1 factor^T
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double rest = factor(column, row);
      for (int k = 0; k < row; ++k) rest -= root(row, k) * half(k, column);
      half(row, column) = rest / root(row, row);
    }
  }
  Eigen::Matrix3d posterior;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) sum += half(k, i) * half(k, j);
      posterior(i, j) = posterior(j, i) = sum;
    }
  }
  return posterior;
}

}  // namespace incognita
