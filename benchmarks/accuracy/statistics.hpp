/// Means over seeds and how sure they are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"

namespace accuracy {

/// What a few runs say of the runs that were not made.
struct Summary {
  double mean = 0.0;
  double low = 0.0;  ///< the mean's 95 % interval
  double high = 0.0;
  double worst = 0.0;  ///< the largest
};

/// Percentile bootstrap of the mean (Efron 1979), the same for the same values. All zero without values.
[[nodiscard]] inline Summary summarise(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  Summary summary;
  for (const double value : values) summary.mean += value / count;
  summary.worst = *std::max_element(values.begin(), values.end());
  constexpr std::size_t resamples = 2000;
  constexpr std::uint64_t seed = 1;
  incognita::Random random(seed);
  std::vector<double> means(resamples, 0.0);
  for (double& mean : means) {
    for (std::size_t draw = 0; draw < values.size(); ++draw) {
      mean += values[static_cast<std::size_t>(random.index(values.size()))] / count;
    }
  }
  std::sort(means.begin(), means.end());
  summary.low = means[resamples / 40];
  summary.high = means[resamples - 1 - resamples / 40];
  return summary;
}

/// The upper median; NaN without values.
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace accuracy
