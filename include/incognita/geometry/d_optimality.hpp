/// The size of a covariance as one number.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/core/error.hpp"

namespace incognita {

/// ln |covariance|, its entries of any unit, by Cholesky's pivots. Throws std::invalid_argument, naming `where`, unless the matrix is square, finite,
/// symmetric and positive definite. O(n^3).
template <class Matrix>
[[nodiscard]] double log_determinant(const Matrix& covariance, const char* where = "log_determinant") {
  const Eigen::Index size = covariance.rows();
  require(size > 0 && covariance.cols() == size, where, "the number of columns", static_cast<double>(covariance.cols()),
          "that of the rows, > 0");
  typename Matrix::PlainObject factor = covariance;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < size; ++i) require_positive(where, "a variance", covariance(i, i));
  for (Eigen::Index column = 0; column < size; ++column) {
    for (Eigen::Index row = column; row < size; ++row) {
      const double difference = std::abs(covariance(row, column) - covariance(column, row));
      const double scale = std::sqrt(covariance(row, row)) * std::sqrt(covariance(column, column));
      require(difference <= 1e-9 * scale, where, "the covariance's asymmetry", difference, "0: a covariance is symmetric");
      for (Eigen::Index k = 0; k < column; ++k) factor(row, column) -= factor(row, k) * factor(column, k);
      if (row == column) {
        const double pivot = factor(column, column);
        require(std::isfinite(pivot) && pivot > 0.0, where, "a pivot of the covariance", pivot,
                "finite and > 0: a covariance is positive definite");
        sum += std::log(pivot);
        factor(column, column) = std::sqrt(pivot);
      } else {
        factor(row, column) /= factor(column, column);
      }
    }
  }
  return sum;
}

/// D-opt: |covariance|^(1 / N), (1) of Sansoni et al., in the units of a variance. Not the N-th root of the ellipsoid's volume, as
/// the text says, but a multiple of its 2 / N-th power. Throws as log_determinant.
template <class Matrix>
[[nodiscard]] double d_optimality(const Matrix& covariance) {
  return std::exp(log_determinant(covariance, "d_optimality") / static_cast<double>(covariance.rows()));
}

/// |covariance|^(1 / 2N), (A.2): the geometric mean of the standard deviations along the principal axes. Throws as
/// log_determinant.
template <class Matrix>
[[nodiscard]] double mean_sigma(const Matrix& covariance) {
  return std::exp(0.5 * log_determinant(covariance, "mean_sigma") / static_cast<double>(covariance.rows()));
}

}  // namespace incognita
