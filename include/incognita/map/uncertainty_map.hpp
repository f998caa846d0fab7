/// Dispersion as a length: how uncertain the place of what was measured is, cell by cell (Sansoni et al., 3.3).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "incognita/core/error.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// Gauss' bound (5): of any unimodal variable with its mean at its mode, P(|X - mu| < side / 2) is at least this, for
/// 0 < side <= 4 sigma / sqrt(3), both of any unit: a probability. Throws std::invalid_argument for a side or sigma out of these bounds.
[[nodiscard]] inline double gauss_bound(double side, double sigma) {
  require_positive("gauss_bound", "sigma", sigma);
  require_positive("gauss_bound", "side", side);
  require(side <= 4.0 * sigma / std::numbers::sqrt3, "gauss_bound", "side", side, "<= 4 sigma / sqrt(3)");
  return side / (2.0 * sigma * std::numbers::sqrt3);
}

/// a of (9) and (17) as printed, from Gauss' bound: the mean side of a box, (s_1 ... s_N)^(1 / N), by 2 sqrt(3), in the unit of
/// the sides. Throws std::invalid_argument for a side that is not finite and > 0.
template <class Vector>
[[nodiscard]] double gauss_scale(const Vector& sides) {
  double log_product = 0.0;
  for (Eigen::Index i = 0; i < sides.size(); ++i) {
    require_positive("gauss_scale", "a side", sides[i]);
    log_product += std::log(sides[i]);
  }
  return std::exp(log_product / static_cast<double>(sides.size())) / (2.0 * std::numbers::sqrt3);
}

/// U = a / p^(1 / N), (17), in the unit of a. Throws std::invalid_argument for a probability out of (0, 1], or an a or a dimension that is
/// not > 0.
[[nodiscard]] inline double uncertainty_of_probability(double probability, double a, int dimension) {
  require(probability > 0.0 && probability <= 1.0, "uncertainty_of_probability", "probability", probability, "in (0, 1]");
  require_positive("uncertainty_of_probability", "a", a);
  require(dimension > 0, "uncertainty_of_probability", "dimension", dimension, "> 0");
  return a * std::pow(probability, -1.0 / dimension);
}

/// What the uncertainty of a cell is measured in.
enum class UncertaintyScale {
  /// So that U of a covariance sigma_max^2 I is sigma_max: the mean standard deviation where the errors are Gaussian. What the
  /// authors' figures and their fit (23) show.
  calibrated,
  /// (17) as printed, from Gauss' bound: a lower bound of the mean standard deviation whatever the distribution, 0.72 of it where
  /// errors are Gaussian; none for strong correlations.
  gauss
};

/// U = a / p^(1 / 2), (17), of log-odds of the dispersion probability p in the plane.
class UncertaintyOfDispersion {
 public:
  /// For cells of a policy such as Dispersion.
  template <class Cell>
  explicit UncertaintyOfDispersion(const Cell& policy, UncertaintyScale scale = UncertaintyScale::calibrated)
      : a_m_(scale == UncertaintyScale::gauss ? policy.params().box_side_m / (2.0 * std::numbers::sqrt3)
                                              : std::sqrt(policy.beta()) * policy.params().sigma_max_m),
        tolerated_m_(a_m_ / std::sqrt(policy.beta())) {}

  /// In metres.
  [[nodiscard]] double operator()(double log_odds) const { return a_m_ * std::sqrt(1.0 + std::exp(-log_odds)); }

  /// U_beta: that of what is just tolerated, and of a cell that was never seen.
  [[nodiscard]] double tolerated_m() const { return tolerated_m_; }

 private:
  double a_m_;
  double tolerated_m_;
};

/// The uncertainty map, (17), in metres: U of each cell of a map's box, U_beta where nothing was ever seen. O(cells).
template <class Map>
[[nodiscard]] Grid<float, 2> uncertainty_map(const Map& map, UncertaintyScale scale = UncertaintyScale::calibrated) {
  const UncertaintyOfDispersion uncertainty_m(map.cell(), scale);
  Grid<float, 2> result(map.lattice(), map.grid().box(), static_cast<float>(uncertainty_m.tolerated_m()));
  for (Offset offset = 0; offset < static_cast<Offset>(result.size()); ++offset) {
    const auto& state = map.grid()[offset];
    if (state.is_explored) {
      result[offset] = static_cast<float>(uncertainty_m(static_cast<double>(map.cell().dispersion_log_odds(state))));
    }
  }
  return result;
}

}  // namespace incognita
