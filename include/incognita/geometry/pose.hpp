/// The pose that belongs to a dimension, and the check of a covariance.
#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// The pose of a dimension; for 3 include geometry/pose3.hpp.
template <int Dim>
struct PoseOf;

/// The plane.
template <>
struct PoseOf<2> {
  using Type = Pose2;  ///< over (x, y, yaw)
};

/// Pose2 for 2; Pose3 for 3, where geometry/pose3.hpp is included, which parses a good part of Eigen.
template <int Dim>
using Pose = typename PoseOf<Dim>::Type;

/// True when `matrix` is finite, symmetric and has no eigenvalue below 0, each within `tolerance` of its largest entry:
/// raised by that much on its diagonal, it must have a Cholesky factor.
template <class Matrix>
[[nodiscard]] bool is_covariance(const Matrix& matrix, double tolerance = 1e-9) {
  constexpr int size = Matrix::RowsAtCompileTime;
  double largest = 0.0;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      if (!std::isfinite(matrix(row, column))) return false;
      largest = std::max(largest, std::abs(matrix(row, column)));
    }
  }
  if (largest == 0.0) return true;
  const double slack = tolerance * largest;
  Matrix lower = zero<Matrix>();
  for (int column = 0; column < size; ++column) {
    double pivot = matrix(column, column) + slack;
    for (int k = 0; k < column; ++k) pivot -= lower(column, k) * lower(column, k);
    if (!(pivot > 0.0)) return false;
    lower(column, column) = std::sqrt(pivot);
    for (int row = column + 1; row < size; ++row) {
      if (std::abs(matrix(row, column) - matrix(column, row)) > slack) return false;
      double rest = matrix(row, column);
      for (int k = 0; k < column; ++k) rest -= lower(row, k) * lower(column, k);
      lower(row, column) = rest / lower(column, column);
    }
  }
  return true;
}

/// Throws std::invalid_argument, with the matrix, unless it is a covariance.
template <class Matrix>
void require_covariance(std::string_view where, std::string_view field, const Matrix& matrix) {
  if (is_covariance(matrix)) return;
  std::ostringstream text;
  for (int row = 0; row < Matrix::RowsAtCompileTime; ++row) {
    for (int column = 0; column < Matrix::RowsAtCompileTime; ++column) {
      text << (column > 0 ? ", " : row > 0 ? "; " : "[") << matrix(row, column);
    }
  }
  throw_invalid(where, field, text.str() + ']', "finite, symmetric and positive semi-definite");
}

/// Throws std::invalid_argument, with the pose, unless it is finite.
template <class PoseType>
void require_finite_pose(std::string_view where, std::string_view field, const PoseType& pose) {
  if (!pose.is_finite()) throw_invalid(where, field, tuple_text(pose), "finite");
}

}  // namespace incognita
