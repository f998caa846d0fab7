/// How likely a measurement lies in a box around its mean: a number for its uncertainty between 0 and 1 (Sansoni et al., 3.1).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/core/quadrature.hpp"

namespace incognita {

namespace detail {

[[nodiscard]] inline double normal_density(double x) {
  return 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2 * std::exp(-0.5 * x * x);
}

/// The mass of a standard normal variable within [low, high], or without.
[[nodiscard]] inline double normal_mass(double low, double high, bool inside) {
  constexpr double scale = 1.0 / std::numbers::sqrt2;
  if (!inside) return 0.5 * (std::erfc(high * scale) + std::erfc(-low * scale));
  const double width = high - low;
  const double middle = 0.5 * (low + high);
  if (width * (1.0 + std::abs(middle)) < 0.01) {  // a difference of two values of erf would lose its digits
    const double square = middle * middle;
    return width * (1.0 + width * width * (square - 1.0) / 24.0) * normal_density(middle);
  }
  if (low > 0.0) return 0.5 * (std::erfc(low * scale) - std::erfc(high * scale));
  if (high < 0.0) return 0.5 * (std::erfc(-high * scale) - std::erfc(-low * scale));
  return 0.5 * (std::erf(high * scale) - std::erf(low * scale));
}

/// The mass within, or without, |x_i| < half_sides_i of a normal vector x = factor z, z standard normal, of which the first
/// `given` elements of z are fixed. One integral inside another, each over the conditional normal of its element; all terms
/// are positive, so that nothing is lost in small boxes.
template <int Dim>
[[nodiscard]] double box_mass(const Eigen::Matrix<double, Dim, Dim>& factor, const Eigen::Matrix<double, Dim, 1>& half_sides,
                              Eigen::Matrix<double, Dim, 1>& z, int given, bool inside, double tolerance) {
  double mean = 0.0;
  for (int i = 0; i < given; ++i) mean += factor(given, i) * z[i];
  const double sigma = factor(given, given);
  const double low = (-half_sides[given] - mean) / sigma;
  const double high = (half_sides[given] - mean) / sigma;
  if (given + 1 == Dim) return normal_mass(low, high, inside);

  // Beyond 39 sigma a double is 0. Steps are where a later element's mean leaves its box.
  constexpr double reach = 39.0;
  const double from = std::max(low, -reach);
  const double to = std::min(high, reach);
  if (!(from < to)) return inside ? 0.0 : 1.0;
  std::array<double, 2 + 6 * static_cast<std::size_t>(Dim)> ends{from, to, 0.0};
  std::size_t count = from < 0.0 && 0.0 < to ? 3 : 2;
  for (int later = given + 1; later < Dim; ++later) {
    const double slope = factor(later, given);
    if (slope == 0.0) continue;
    double known = 0.0;
    for (int i = 0; i < given; ++i) known += factor(later, i) * z[i];
    double rest = 0.0;
    for (int i = given + 1; i <= later; ++i) rest += factor(later, i) * factor(later, i);
    const double width = 8.0 * std::sqrt(rest);
    for (const double side : {-half_sides[later], half_sides[later]}) {
      for (const double shift : {-width, 0.0, width}) {
        const double end = (side - known + shift) / slope;
        if (from < end && end < to) ends[count++] = end;
      }
    }
  }
  std::sort(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(count));
  const double inner_tolerance = 0.1 * tolerance;
  const auto integrand = [&](double at) {
    z[given] = at;
    return normal_density(at) * box_mass<Dim>(factor, half_sides, z, given + 1, inside, inner_tolerance);
  };
  double mass = inside ? 0.0 : normal_mass(low, high, false);
  double largest = mass;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double panel = integrate(integrand, ends[i], ends[i + 1], tolerance, tolerance * largest);
    mass += panel;
    largest = std::max(largest, panel);
  }
  return mass;
}

/// A covariance and a box in units of the standard deviations, its narrowest side first, as box_mass takes them.
template <int Dim>
struct StandardBox {
  Eigen::Matrix<double, Dim, Dim> factor = Eigen::Matrix<double, Dim, Dim>::Zero();  // of the correlation, lower triangle
  Eigen::Matrix<double, Dim, 1> half_sides;

  StandardBox(const Eigen::Matrix<double, Dim, Dim>& covariance, const Eigen::Matrix<double, Dim, 1>& sides) {
    Eigen::Matrix<double, Dim, 1> sigmas;
    for (int i = 0; i < Dim; ++i) {
      require_positive("dispersion_probability", "a side of the box", sides[i]);
      require_positive("dispersion_probability", "a variance", covariance(i, i));
      sigmas[i] = std::sqrt(covariance(i, i));
      for (int j = 0; j < i; ++j) {
        const double difference = std::abs(covariance(i, j) - covariance(j, i));
        require(difference <= 1e-9 * sigmas[i] * sigmas[j], "dispersion_probability", "the covariance's asymmetry", difference,
                "0: a covariance is symmetric");
      }
    }
    std::array<int, static_cast<std::size_t>(Dim)> order;
    for (int i = 0; i < Dim; ++i) order[static_cast<std::size_t>(i)] = i;
    std::sort(order.begin(), order.end(), [&](int a, int b) { return sides[a] / sigmas[a] < sides[b] / sigmas[b]; });
    for (int row = 0; row < Dim; ++row) {
      const int i = order[static_cast<std::size_t>(row)];
      half_sides[row] = 0.5 * sides[i] / sigmas[i];
      for (int column = 0; column <= row; ++column) {
        const int j = order[static_cast<std::size_t>(column)];
        double rest = covariance(i, j) / (sigmas[i] * sigmas[j]);
        for (int k = 0; k < column; ++k) rest -= factor(row, k) * factor(column, k);
        if (row == column) {
          require(rest > 0.0, "dispersion_probability", "a pivot of the correlation", rest, "> 0: a covariance is positive definite");
          factor(row, row) = std::sqrt(rest);
        } else {
          factor(row, column) = rest / factor(column, column);
        }
      }
    }
  }

  [[nodiscard]] double mass(bool inside) const {
    Eigen::Matrix<double, Dim, 1> z;
    return box_mass<Dim>(factor, half_sides, z, 0, inside, 1e-11);
  }
};

}  // namespace detail

/// P(|X_i - mu_i| < sides_i / 2 for all i) of a Gaussian X, in (0, 1]: (6) to (8), (11) and (12) of Sansoni et al., for one to three
/// dimensions and any correlation. Units of sides and covariance need only agree, axis by axis. Error below 1e-10, and relative
/// to the result below 1e-6, down to sides of 1e-6 sigma. Throws std::invalid_argument for a side or variance that is not
/// finite and > 0 and for a covariance that is not symmetric and positive definite. About 0.05 us, 1 us and 30 us for one, two and three
/// dimensions; several times that for boxes of several sigma and correlations near 1.
template <int Dim>
[[nodiscard]] double dispersion_probability(const Eigen::Matrix<double, Dim, Dim>& covariance,
                                            const Eigen::Matrix<double, Dim, 1>& sides) {
  static_assert(Dim >= 1 && Dim <= 3);
  return std::clamp(detail::StandardBox<Dim>(covariance, sides).mass(true), std::numeric_limits<double>::min(), 1.0);
}

/// The log-odds (14) of the same, to the same error where 1 - p is far below what a double holds beside 1 too. At most 700.
template <int Dim>
[[nodiscard]] double dispersion_log_odds(const Eigen::Matrix<double, Dim, Dim>& covariance,
                                         const Eigen::Matrix<double, Dim, 1>& sides) {
  static_assert(Dim >= 1 && Dim <= 3);
  const detail::StandardBox<Dim> box(covariance, sides);
  const double inside = std::max(box.mass(true), std::numeric_limits<double>::min());
  const double outside = inside < 0.5 ? 1.0 - inside : box.mass(false);
  return std::log(inside) - std::log(std::max(outside, 1e-304));
}

/// The same probability of any distribution, from samples of it, the columns of a Dim x samples matrix: the share of them that
/// lies in the box around `center` (mean or mode). Standard error sqrt(p (1 - p) / samples). Throws std::invalid_argument for no
/// samples, an element that is not finite, and a side that is not finite and > 0.
template <int Dim>
[[nodiscard]] double dispersion_probability_of_samples(const Eigen::Matrix<double, Dim, Eigen::Dynamic>& samples,
                                                       const Eigen::Matrix<double, Dim, 1>& center,
                                                       const Eigen::Matrix<double, Dim, 1>& sides) {
  for (int i = 0; i < Dim; ++i) require_positive("dispersion_probability_of_samples", "a side of the box", sides[i]);
  require(samples.cols() > 0, "dispersion_probability_of_samples", "the number of samples", 0.0, "> 0");
  Eigen::Index count = 0;
  for (Eigen::Index sample = 0; sample < samples.cols(); ++sample) {
    bool is_inside = true;
    for (int i = 0; i < Dim; ++i) {
      const double deviation = samples(i, sample) - center[i];
      require(std::isfinite(deviation), "dispersion_probability_of_samples", "a deviation from the center", deviation, "finite");
      is_inside = is_inside && std::abs(deviation) < 0.5 * sides[i];
    }
    count += static_cast<Eigen::Index>(is_inside);
  }
  return static_cast<double>(count) / static_cast<double>(samples.cols());
}

}  // namespace incognita
