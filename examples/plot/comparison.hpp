/// All that is drawn of groups of runs.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "plot/bands.hpp"
#include "plot/groups.hpp"

namespace plot {

/// One group's curves.
struct GroupBands {
  Band explored_over_time, explored_over_distance, entropy, error, three_sigma, nees;
};

[[nodiscard]] inline GroupBands bands_of(const Group& group) {
  constexpr double step_s = 1.0;
  constexpr double step_m = 1.0;
  const auto band = [&](Column Run::* x, Column Run::* y, double step) {
    std::vector<Curve> curves;
    for (const Run* run : group.runs) curves.push_back({&(run->*x), &(run->*y)});
    return band_of(curves, step);
  };
  return {band(&Run::time_s, &Run::explored_fraction, step_s),     band(&Run::distance_m, &Run::explored_fraction, step_m),
          band(&Run::time_s, &Run::map_entropy_bits, step_s),      band(&Run::time_s, &Run::position_error_m, step_s),
          band(&Run::time_s, &Run::three_sigma_m, step_s),         band(&Run::time_s, &Run::nees, step_s)};
}

/// What the runs of a group ended with, but for those without a value.
[[nodiscard]] inline std::vector<double> end_values(const Group& group, const std::string& key) {
  std::vector<double> values;
  for (const Run* run : group.runs) {
    const double value = run->end_value(key);
    if (!std::isnan(value)) values.push_back(value);
  }
  return values;
}

struct Comparison {
  std::vector<Group> groups;
  std::vector<GroupBands> bands;  ///< one a group
};

[[nodiscard]] inline Comparison compared(std::vector<Group> groups) {
  Comparison comparison{std::move(groups), {}};
  for (const Group& group : comparison.groups) comparison.bands.push_back(bands_of(group));
  return comparison;
}

}  // namespace plot
