/// Intervals for means, by drawing the values again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/core/random.hpp"
#include "support/statistics.hpp"

namespace examples {

/// A mean, and the interval that holds 95 % of the means of as many values drawn from the same with replacement (Efron 1979, percentiles).
struct MeanInterval {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Of at least one value. The same values give the same interval. O(10000 values).
[[nodiscard]] inline MeanInterval bootstrapped_mean(const std::vector<double>& values) {
  constexpr std::size_t draws = 10000;
  const auto count = static_cast<double>(values.size());
  incognita::Random random(20240229);
  std::vector<double> means;
  means.reserve(draws);
  for (std::size_t n = 0; n < draws; ++n) {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) sum += values[random.index(values.size())];
    means.push_back(sum / count);
  }
  std::sort(means.begin(), means.end());
  double sum = 0.0;
  for (const double value : values) sum += value;
  return {sum / count, quantile(means, 0.025), quantile(means, 0.975)};
}

}  // namespace examples
