/// The pose that belongs to a dimension, and the check of a covariance.
#pragma once

#include <type_traits>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/pose3.hpp"

namespace incognita {

/// Pose2 for 2, Pose3 for 3.
template <int Dim>
using Pose = std::conditional_t<Dim == 2, Pose2, Pose3>;

/// True when `matrix` is finite, symmetric and has no negative eigenvalue, each within `tolerance` of its largest entry.
template <class Matrix>
[[nodiscard]] bool is_covariance(const Matrix& matrix, double tolerance = 1e-9) {
  if (!matrix.allFinite()) return false;
  const double slack = tolerance * matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > slack) return false;
  return Eigen::SelfAdjointEigenSolver<Matrix>(matrix, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() >= -slack;
}

}  // namespace incognita
