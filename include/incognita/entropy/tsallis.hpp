/// Tsallis entropy of a binary cell.
#pragma once

#include "incognita/core/error.hpp"
#include "incognita/entropy/binary_cell.hpp"
#include "incognita/entropy/shannon.hpp"

namespace incognita {

/// (1 - p^q - (1 - p)^q) / (q - 1), in nats (at q = 1, and by custom elsewhere). Its greatest value, at p =
/// 1/2, is (1 - 2^(1-q)) / (q - 1): ln 2 at q = 1 only. Non-increasing in q. q = 1 is Shannon, to the bit.
class Tsallis {
 public:
  /// q = 1.
  Tsallis() = default;

  /// Throws std::invalid_argument unless q is finite and > 0.
  explicit Tsallis(double q) : q_(q) { require_positive("Tsallis", "q", q); }

  [[nodiscard]] double q() const { return q_; }  ///< the order, without a unit; 1 is Shannon

  /// In nats, for p in [0, 1], else NaN. Within 1e-12 relative, for q next to 1 and for large q too.
  [[nodiscard]] double operator()(double p) const {
    if (q_ == 1.0) return Shannon{}(p);
    return detail::entropy_of_binary_cell(
        p, [this](double minor, double minor_surprise, double major_surprise) {
          const double one_minus_q = 1.0 - q_;
          return detail::excess_power_sum(one_minus_q, minor, minor_surprise, major_surprise) / one_minus_q;
        });
  }

  friend bool operator==(const Tsallis&, const Tsallis&) = default;  ///< when they have one q

 private:
  double q_ = 1.0;
};

}  // namespace incognita
