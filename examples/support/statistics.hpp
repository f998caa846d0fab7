/// Numbers that sum up many trials.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace examples {

/// The value below which a share of sorted values lies, between neighbours in proportion.
[[nodiscard]] inline double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// The middle value; of an even number the mean of the two in the middle. 0 of none.
[[nodiscard]] inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : quantile(values, 0.5);
}

/// What a box plot shows.
struct Spread {
  double least, lower_quartile, median, upper_quartile, greatest;
};

/// Of at least one value.
[[nodiscard]] inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), quantile(values, 0.25), quantile(values, 0.5), quantile(values, 0.75), values.back()};
}

/// y = slope x + offset by least squares, and Pearson's correlation.
struct Line {
  double slope, offset, correlation;
};

/// Of at least two points that differ in x.
[[nodiscard]] inline Line fitted_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  return {slope, mean_y - slope * mean_x, xy / std::sqrt(xx * yy)};
}

}  // namespace examples
