/// Box plots in a chart.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "support/chart.hpp"
#include "support/statistics.hpp"

namespace examples {

/// Quartiles of fewer values say nothing.
inline constexpr std::size_t quartile_values_min = 4;

/// Draws values at a place on x: a box from quartile to quartile, whiskers from the least to the greatest, a bar at the median, and a point
/// each. Of fewer than quartile_values_min no box, of none nothing.
inline void add_box(Chart& chart, double x, const std::vector<double>& values, const std::string& color, const std::string& point_color) {
  if (values.empty()) return;
  const Spread spread = spread_of(values);
  constexpr double half = 0.25;
  const auto line = [&](std::vector<double> xs, std::vector<double> ys, double width) {
    chart.series.push_back({.x = std::move(xs), .y = std::move(ys), .color = color, .width = width});
  };
  if (values.size() >= quartile_values_min) {
    line({x - half, x + half, x + half, x - half, x - half},
         {spread.lower_quartile, spread.lower_quartile, spread.upper_quartile, spread.upper_quartile, spread.lower_quartile}, 2.0);
    line({x, x}, {spread.lower_quartile, spread.least}, 1.5);
    line({x, x}, {spread.upper_quartile, spread.greatest}, 1.5);
  } else {
    line({x, x}, {spread.least, spread.greatest}, 1.5);
  }
  line({x - half, x + half}, {spread.median, spread.median}, 4.0);
  chart.series.push_back({.x = std::vector<double>(values.size(), x), .y = values, .color = point_color, .stroke = Stroke::points});
}

}  // namespace examples
