/// What all entropies of a binary cell share: which argument means what, and logarithms that keep their
/// digits.
#pragma once

#include <cmath>
#include <limits>

namespace incognita::detail {

/// `formula(minor, minor_surprise, major_surprise)` for the cell that is occupied with probability p, where
/// minor is the smaller of p and 1 - p, and a surprise is -ln of a probability, in nats. 0 for p = 0 and p =
/// 1; NaN for p outside [0, 1] and for NaN, as std::log does, because a throw would cost every cell of a map.
///
/// 1 - p is exact for p > 1/2, so folding loses nothing and makes every entropy symmetric to the last bit.
template <class Formula>
[[nodiscard]] double entropy_of_binary_cell(double p, Formula formula) {
  const double minor = p > 0.5 ? 1.0 - p : p;
  if (minor > 0.0) return formula(minor, -std::log(minor), -std::log1p(-minor));
  return minor == 0.0 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
}

/// p_1^a + p_2^a - 1 for the two probabilities of a cell, as sum p_i (p_i^(a-1) - 1). Both terms have the
/// sign of 1 - a, so nothing cancels: not near a = 1, where the plain form loses all digits, nor for rare
/// outcomes.
[[nodiscard]] inline double excess_power_sum(double one_minus_a, double minor, double minor_surprise,
                                             double major_surprise) {
  return minor * std::expm1(one_minus_a * minor_surprise) +
         (1.0 - minor) * std::expm1(one_minus_a * major_surprise);
}

}  // namespace incognita::detail
