/// A natural logarithm for inner loops.
#pragma once

#include <bit>
#include <cstdint>

namespace incognita {

/// ln(x) of a number without a unit to a relative error of 1e-10, without a branch or a call, so that loops over it become vector code. x must be
/// positive, finite and not subnormal.
[[nodiscard]] inline double fast_log(double x) {
  // x = 2^exponent * mantissa with the mantissa within a factor of sqrt(2) of 1.
  constexpr auto sqrt_half = std::bit_cast<std::uint64_t>(0.70710678118654752);
  constexpr auto one = std::bit_cast<std::uint64_t>(1.0);
  constexpr double ln_2 = 0.69314718055994531;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (one - sqrt_half);
  const auto exponent = static_cast<std::int32_t>(bits >> 52U) - 1023;
  const auto mantissa = std::bit_cast<double>((bits & 0xFFFFFFFFFFFFFULL) + sqrt_half);
  // ln(m) = 2 artanh(z); the series' next term is below 1e-10 of the first.
  const double z = (mantissa - 1.0) / (mantissa + 1.0);
  const double z2 = z * z;
  const double series = 1.0 + z2 * (1.0 / 3 + z2 * (1.0 / 5 + z2 * (1.0 / 7 + z2 * (1.0 / 9 + z2 / 11))));
  return exponent * ln_2 + 2.0 * z * series;
}

}  // namespace incognita
