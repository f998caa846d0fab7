/// How a quantity went in several runs: the median and a band around it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "support/box_plot.hpp"
#include "support/statistics.hpp"

namespace plot {

/// A quantity y over x, which never falls. Both have the same length; y may be NaN.
struct Curve {
  const std::vector<double>* x;
  const std::vector<double>* y;
};

/// The value at x between neighbours in proportion; where x stays the same, the last. NaN before the first and beyond the last x, and
/// beside NaN.
[[nodiscard]] inline double value_at(const Curve& curve, double x) {
  const std::vector<double>& xs = *curve.x;
  const std::vector<double>& ys = *curve.y;
  if (xs.empty() || x < xs.front() || x > xs.back()) return std::numeric_limits<double>::quiet_NaN();
  const auto above = static_cast<std::size_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin());
  const std::size_t below = above - 1;
  if (xs[below] == x) return ys[below];
  return ys[below] + (x - xs[below]) / (xs[above] - xs[below]) * (ys[above] - ys[below]);
}

/// All of the same length.
struct Band {
  std::vector<double> at;
  std::vector<double> low;
  std::vector<double> median;
  std::vector<double> high;
  std::vector<std::size_t> runs;  ///< how many have a value there
};

/// At the multiples of `step` and where a curve begins or ends: the median of the curves that have a value there, and their quartiles, or,
/// of fewer than four curves in all, their least and greatest. A curve ends where its run ended; from there on the band is of the others.
[[nodiscard]] inline Band band_of(const std::vector<Curve>& curves, double step) {
  std::vector<double> places;
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const Curve& curve : curves) {
    if (curve.x->empty()) continue;
    places.insert(places.end(), {curve.x->front(), curve.x->back()});
    first = std::min(first, curve.x->front());
    last = std::max(last, curve.x->back());
  }
  for (double multiple = std::ceil(first / step); multiple * step <= last; ++multiple) places.push_back(multiple * step);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());

  const bool has_quartiles = curves.size() >= examples::quartile_values_min;
  Band band;
  for (const double at : places) {
    std::vector<double> values;
    for (const Curve& curve : curves) {
      const double value = value_at(curve, at);
      if (!std::isnan(value)) values.push_back(value);
    }
    if (values.empty()) continue;
    const examples::Spread spread = examples::spread_of(values);
    band.at.push_back(at);
    band.low.push_back(has_quartiles ? spread.lower_quartile : spread.least);
    band.median.push_back(spread.median);
    band.high.push_back(has_quartiles ? spread.upper_quartile : spread.greatest);
    band.runs.push_back(values.size());
  }
  return band;
}

}  // namespace plot
