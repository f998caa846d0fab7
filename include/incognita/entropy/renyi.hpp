/// Rényi entropy of a binary cell.
#pragma once

#include <cmath>
#include <numbers>

#include "incognita/core/error.hpp"
#include "incognita/entropy/binary_cell.hpp"
#include "incognita/entropy/shannon.hpp"

namespace incognita {

/// ln(p^alpha + (1 - p)^alpha) / (1 - alpha), in nats; ln 2 at p = 1/2 for every alpha, and non-increasing in
/// alpha. Seo et al., Fig. 1a. alpha = 1 is Shannon, to the bit.
class Renyi {
 public:
  /// alpha = 1.
  Renyi() = default;

  /// Throws std::invalid_argument unless alpha is finite and > 0.
  explicit Renyi(double alpha) : alpha_(alpha) { require_positive("Renyi", "alpha", alpha); }

  [[nodiscard]] double alpha() const { return alpha_; }  ///< the order, without a unit; 1 is Shannon

  /// In nats, for p in [0, 1], else NaN. Within 1e-12 relative, for alpha next to 1 and for large alpha too.
  [[nodiscard]] double operator()(double p) const {
    if (alpha_ == 1.0) return Shannon{}(p);
    return detail::entropy_of_binary_cell(p, [this](double minor, double minor_surprise,
                                                    double major_surprise) {
      if (minor == 0.5) return std::numbers::ln2;
      if (alpha_ < 2.0) {
        const double one_minus_alpha = 1.0 - alpha_;
        return std::log1p(detail::excess_power_sum(one_minus_alpha, minor, minor_surprise, major_surprise)) /
               one_minus_alpha;
      }
      // The power sum may underflow here, so its larger term is taken out of the logarithm.
      const double rest = std::log1p(std::exp(-alpha_ * (minor_surprise - major_surprise)));
      return (major_surprise - rest / alpha_) * (alpha_ / (alpha_ - 1.0));
    });
  }

  friend bool operator==(const Renyi&, const Renyi&) = default;  ///< when they have one alpha

 private:
  double alpha_ = 1.0;
};

}  // namespace incognita
