/// Intervals for means, by drawing the values again.
#pragma once

#include <algorithm>
#include <array>
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

/// combine(means) of what is drawn with one another, averaged over several groups of such tuples; of one group and one number, its mean. A bootstrap
/// percentile interval (Efron 1979) that is not too narrow for few values: each draw is of one less than there are, and the percentiles are those that
/// lie as far out as Student's t (Hesterberg 2015), with Welch's degrees of freedom over groups. Every group must have a value; the interval is there
/// where each has interval_values_min. The same values give the same interval. O(10000 values).
template <std::size_t N, class Combine>
[[nodiscard]] MeanInterval bootstrapped(const std::vector<std::vector<std::array<double, N>>>& groups, Combine&& combine) {
  constexpr std::size_t draws = 10000;
  const auto count = static_cast<double>(groups.size());
  const auto combined = [&combine](std::array<double, N> sums, std::size_t of) {
    for (double& sum : sums) sum /= static_cast<double>(of);
    return combine(sums);
  };
  MeanInterval result;
  bool are_enough = true;
  for (const auto& values : groups) {
    std::array<double, N> sums{};
    for (const auto& value : values) {
      for (std::size_t n = 0; n < N; ++n) sums[n] += value[n];
    }
    result.mean += combined(sums, values.size()) / count;
    are_enough = are_enough && values.size() >= interval_values_min;
  }
  if (!are_enough) return result;
  incognita::Random random(20240229);
  std::vector<double> all(draws, 0.0);
  double variance = 0.0;
  double weight = 0.0;
  double freedom = 0.0;
  for (const auto& values : groups) {
    double sum = 0.0;
    double sum2 = 0.0;
    for (double& of_all : all) {
      std::array<double, N> sums{};
      for (std::size_t k = 1; k < values.size(); ++k) {
        const auto& value = values[random.index(values.size())];
        for (std::size_t n = 0; n < N; ++n) sums[n] += value[n];
      }
      const double drawn = combined(sums, values.size() - 1);
      of_all += drawn / count;
      sum += drawn;
      sum2 += drawn * drawn;
    }
    const double of_group = std::max(0.0, sum2 / draws - sum * sum / draws / draws);
    variance += of_group;
    weight += of_group * of_group / static_cast<double>(values.size() - 1);
    freedom += static_cast<double>(values.size() - 1);
  }
  if (weight > 0.0) freedom = std::min(freedom, variance * variance / weight);
  std::sort(all.begin(), all.end());
  const double beyond = 0.5 * std::erfc(student_t_975(freedom) / std::numbers::sqrt2);
  result.interval = Interval{quantile(all, beyond), quantile(all, 1.0 - beyond)};
  return result;
}

/// The mean of the means of several groups of values.
[[nodiscard]] inline MeanInterval bootstrapped_mean(const std::vector<std::vector<double>>& groups) {
  std::vector<std::vector<std::array<double, 1>>> singles;
  for (const std::vector<double>& values : groups) {
    singles.emplace_back();
    for (const double value : values) singles.back().push_back({value});
  }
  return bootstrapped(singles, [](const std::array<double, 1>& means) { return means[0]; });
}

/// Of one group.
[[nodiscard]] inline MeanInterval bootstrapped_mean(const std::vector<double>& values) {
  return bootstrapped_mean(std::vector<std::vector<double>>{values});
}

}  // namespace examples
