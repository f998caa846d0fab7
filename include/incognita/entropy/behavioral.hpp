/// Behavioral entropy, of a binary cell and of a probability vector.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "incognita/core/error.hpp"
#include "incognita/entropy/binary_cell.hpp"
#include "incognita/entropy/shannon.hpp"

namespace incognita {

/// -sum w(p_i) ln w(p_i) over the L outcomes, in nats, with Prelec's weight w(p) = exp(-beta (-ln p)^alpha)
/// and beta = (ln L)^(1-alpha) (Seo et al., (17) and below (18); Fig. 1b). alpha < 1 makes unlikely outcomes
/// count more (uncertainty averse), alpha > 1 less; alpha = 1 is Shannon, to the bit.
///
/// For a cell (L = 2) it is ln 2 at p = 1/2 for every alpha, non-increasing in alpha and at most ln 2. For L
/// > 2 it can exceed ln L.
class Behavioral {
 public:
  /// alpha = 1.
  Behavioral() = default;

  /// Throws std::invalid_argument unless alpha is finite and > 0.
  explicit Behavioral(double alpha) : alpha_(alpha) { require_positive("Behavioral", "alpha", alpha); }

  [[nodiscard]] double alpha() const { return alpha_; }  ///< the order, without a unit; 1 is Shannon

  /// Of a cell, in nats, for p in [0, 1], else NaN. Within 1e-12 relative, for large alpha too.
  [[nodiscard]] double operator()(double p) const {
    if (alpha_ == 1.0) return Shannon{}(p);
    return detail::entropy_of_binary_cell(p, [this](double, double minor_surprise, double major_surprise) {
      return term(minor_surprise, std::numbers::ln2) + term(major_surprise, std::numbers::ln2);
    });
  }

  /// Of a probability vector of L entries. Throws std::invalid_argument unless L >= 2, every entry is in [0,
  /// 1] and they add up to 1 within 1e-9. Of {p, 1 - p} it is the cell's, as far as the rounding of 1 - p
  /// allows.
  [[nodiscard]] double operator()(std::span<const double> probabilities) const {
    const std::size_t outcomes = probabilities.size();
    require(outcomes >= 2, "Behavioral", "number of outcomes", static_cast<double>(outcomes), ">= 2");
    const double log_outcomes = std::log(static_cast<double>(outcomes));
    double sum = 0.0;
    double entropy = 0.0;
    for (const double p : probabilities) {
      require(p >= 0.0 && p <= 1.0, "Behavioral", "a probability", p, "in [0, 1]");
      sum += p;
      entropy += term(-std::log(p), log_outcomes);
    }
    require(std::abs(sum - 1.0) <= 1e-9, "Behavioral", "the sum of the probabilities", sum, "1 within 1e-9");
    return entropy;
  }

  friend bool operator==(const Behavioral&, const Behavioral&) = default;  ///< when they have one alpha

 private:
  /// -w ln w of an outcome with the surprise -ln p. beta (-ln p)^alpha is written ln L (-ln p / ln L)^alpha,
  /// which has no rounding at p = 1/L, so that a cell at p = 1/2 has ln 2 exactly.
  [[nodiscard]] double term(double surprise, double log_outcomes) const {
    const double weighted_surprise = log_outcomes * std::pow(surprise / log_outcomes, alpha_);
    // exp underflows here, and infinity times zero would be NaN.
    if (weighted_surprise > 800.0) return 0.0;
    return weighted_surprise * std::exp(-weighted_surprise);
  }

  double alpha_ = 1.0;
};

}  // namespace incognita
