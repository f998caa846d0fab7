/// SiREn: coverage and certainty in one number (Sansoni et al., 3.4).
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/core/error.hpp"
#include "incognita/geometry/d_optimality.hpp"
#include "incognita/map/cell_policy.hpp"

namespace incognita {

namespace detail {

/// ln |q| - ln |p|.
template <class Matrix>
[[nodiscard]] double log_determinant_ratio(const Matrix& p, const Matrix& q) {
  return log_determinant(q, "relative entropy") - log_determinant(p, "relative entropy");
}

}  // namespace detail

/// D(P || Q) in nats of two Gaussians with one mean, (A.9). Throws std::invalid_argument unless both covariances are symmetric and
/// positive definite and of one size. O(n^3).
template <class Matrix>
[[nodiscard]] double relative_entropy_nats(const Matrix& p, const Matrix& q) {
  require(p.rows() == q.rows(), "relative_entropy_nats", "the size of p", static_cast<double>(p.rows()), "that of q");
  const double log_ratio = detail::log_determinant_ratio(p, q);
  // tr(Q^-1 P) by elimination, which needs no exchange of rows where a matrix is positive definite.
  typename Matrix::PlainObject left = q;
  typename Matrix::PlainObject right = p;
  const Eigen::Index size = q.rows();
  for (Eigen::Index pivot = 0; pivot < size; ++pivot) {
    for (Eigen::Index row = 0; row < size; ++row) {
      if (row == pivot) continue;
      const double factor = left(row, pivot) / left(pivot, pivot);
      for (Eigen::Index column = 0; column < size; ++column) {
        left(row, column) -= factor * left(pivot, column);
        right(row, column) -= factor * right(pivot, column);
      }
    }
  }
  double trace = 0.0;
  for (Eigen::Index i = 0; i < size; ++i) trace += right(i, i) / left(i, i);
  return 0.5 * (log_ratio + trace - static_cast<double>(size));
}

/// A term of (19): relative_entropy_nats(p, tolerated), negative where |p| > |tolerated|. Throws likewise.
template <class Matrix>
[[nodiscard]] double signed_relative_entropy_nats(const Matrix& p, const Matrix& tolerated) {
  const double nats = relative_entropy_nats(p, tolerated);
  return detail::log_determinant_ratio(p, tolerated) >= 0.0 ? nats : -nats;
}

/// (20) and (21), signed, of N dimensions: that of N(0, sigma^2 I) with sigma = ratio sigma_max. Of other covariances with that
/// determinant it is a lower bound of the magnitude (equal where they are proportional, which the paper does not say). Decreases
/// strictly. Throws std::invalid_argument unless ratio is finite and > 0 and dimension > 0.
[[nodiscard]] inline double signed_relative_entropy_nats_of_ratio(double ratio, int dimension) {
  require_positive("signed_relative_entropy_nats_of_ratio", "ratio", ratio);
  require(dimension > 0, "signed_relative_entropy_nats_of_ratio", "dimension", dimension, "> 0");
  const double nats = dimension * (0.5 * (ratio - 1.0) * (ratio + 1.0) - std::log(ratio));
  return ratio <= 1.0 ? nats : -nats;
}

/// (22), signed, with the exponent 2 / N of (A.13), from dispersion probabilities: ratio = p / beta. The printed exponent 1 / N makes
/// a divergence negative. Increases strictly. Throws likewise.
[[nodiscard]] inline double signed_relative_entropy_nats_of_probability(double ratio, int dimension) {
  require_positive("signed_relative_entropy_nats_of_probability", "ratio", ratio);
  require(dimension > 0, "signed_relative_entropy_nats_of_probability", "dimension", dimension, "> 0");
  const double half = 0.5 * dimension;
  const double nats = std::log(ratio) + half * std::expm1(-std::log(ratio) / half);
  return ratio >= 1.0 ? nats : -nats;
}

/// The share of one cell in a map's SiREn, (19) with (22), in nats times the unit of cell_size (m^2 in a plane): the measure of a
/// CellSum over a Map<Dispersion>. A cell that was never seen has none.
class SignedRelativeEntropy {
 public:
  /// cell_size is C_k of (19), the space that a cell takes, in m^2 in a plane. Throws std::invalid_argument unless it is finite and > 0.
  explicit SignedRelativeEntropy(double cell_size) : cell_size_(cell_size) {
    require_positive("SignedRelativeEntropy", "cell_size", cell_size);
  }

  /// In nats times that unit; 0 for cells that were never seen. Asks beta(), dispersion_log_odds(state) and state.is_explored, as a
  /// DispersionPolicy has them.
  template <class Cell>
  [[nodiscard]] double operator()(const Cell& policy, const typename Cell::State& state) const {
    if (!state.is_explored) return 0.0;
    // ln p from log-odds keeps its digits where p is near 1.
    const double log_ratio = -std::log1p(std::exp(-static_cast<double>(policy.dispersion_log_odds(state)))) - std::log(policy.beta());
    const double nats = log_ratio + std::expm1(-log_ratio);
    return cell_size_ * (log_ratio >= 0.0 ? nats : -nats);
  }

 private:
  double cell_size_;
};

/// The same of a whole map of the plane, in nats m^2. Zero where nothing was seen; cells that were not seen do not count. O(cells);
/// a CellSum<SignedRelativeEntropy> follows a map at the cost of what changes.
template <class Map>
[[nodiscard]] double map_signed_relative_entropy_nats_m2(const Map& map) {
  const SignedRelativeEntropy measure(map.resolution_m() * map.resolution_m());
  double sum = 0.0;
  for (const auto& state : map.grid().values()) sum += measure(map.cell(), state);
  return sum;
}

}  // namespace incognita
