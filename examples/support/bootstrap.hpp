/// Intervals for means, by drawing the values again.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "incognita/core/random.hpp"
#include "support/statistics.hpp"

namespace examples {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// A mean, and the interval that holds the true one in 95 % of cases, where there are enough values to tell.
struct MeanInterval {
  double mean = 0.0;
  std::optional<Interval> interval;
};

/// With fewer values no interval is given: no way of drawing five again says much about their mean.
inline constexpr std::size_t interval_values_min = 6;

/// The quantile of Student's t distribution at 0.975, to 3e-4 from 5 degrees of freedom on (Abramowitz and Stegun 1964, 26.7.5).
[[nodiscard]] inline double student_t_975(double freedom) {
  constexpr double z = 1.959963984540054;
  constexpr double z2 = z * z;
  const double first = z * (z2 + 1.0) / 4.0;
  const double second = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double third = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double fourth = z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z + (first + (second + (third + fourth / freedom) / freedom) / freedom) / freedom;
}

/// The mean of the means of several groups of values, which are drawn again within each: of one group, its mean. A bootstrap percentile interval
/// (Efron 1979) that is not too narrow for few values: each draw is of one value less than there are, and the percentiles are those that lie as far
/// out as Student's t (Hesterberg 2015). Every group must have a value; the interval is there where each has interval_values_min. The same values
/// give the same interval. O(10000 values).
[[nodiscard]] inline MeanInterval bootstrapped_mean(const std::vector<std::vector<double>>& groups) {
  constexpr std::size_t draws = 10000;
  const auto count = static_cast<double>(groups.size());
  MeanInterval result;
  double freedom = 0.0;
  bool are_enough = true;
  for (const std::vector<double>& values : groups) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    result.mean += sum / static_cast<double>(values.size()) / count;
    freedom += static_cast<double>(values.size()) - 1.0;
    are_enough = are_enough && values.size() >= interval_values_min;
  }
  if (!are_enough) return result;
  incognita::Random random(20240229);
  std::vector<double> means(draws, 0.0);
  for (double& mean : means) {
    for (const std::vector<double>& values : groups) {
      double sum = 0.0;
      for (std::size_t k = 1; k < values.size(); ++k) sum += values[random.index(values.size())];
      mean += sum / static_cast<double>(values.size() - 1) / count;
    }
  }
  std::sort(means.begin(), means.end());
  const double beyond = 0.5 * std::erfc(student_t_975(freedom) / std::numbers::sqrt2);
  result.interval = Interval{quantile(means, beyond), quantile(means, 1.0 - beyond)};
  return result;
}

/// Of one group.
[[nodiscard]] inline MeanInterval bootstrapped_mean(const std::vector<double>& values) {
  return bootstrapped_mean(std::vector<std::vector<double>>{values});
}

}  // namespace examples
