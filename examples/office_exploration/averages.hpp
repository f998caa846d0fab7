/// What the trials of a choice come to on average.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "office_exploration/experiments.hpp"

namespace office_exploration {

/// The mapped share after each metre driven, the mean of a choice's trials; one that has ended stays at what it had mapped.
[[nodiscard]] inline std::vector<Progress> mean_progress(const Series& series, double distance_max_m) {
  std::vector<Progress> means;
  std::vector<std::size_t> next(series.trials.size(), 0);
  for (double distance_m = 0.0; distance_m <= distance_max_m; distance_m += 1.0) {
    double sum = 0.0;
    for (std::size_t i = 0; i < series.trials.size(); ++i) {
      const std::vector<Progress>& progress = series.trials[i].progress;
      while (next[i] + 1 < progress.size() && progress[next[i] + 1].distance_m <= distance_m) ++next[i];
      sum += progress[next[i]].mapped_fraction;
    }
    means.push_back({distance_m, sum / static_cast<double>(series.trials.size())});
  }
  return means;
}

[[nodiscard]] inline double longest_m(const Series& series) {
  double longest_m = 0.0;
  for (const Trial& trial : series.trials) longest_m = std::max(longest_m, trial.distance_m);
  return longest_m;
}

/// From where on the mean stays within half a percent of its end.
[[nodiscard]] inline double settled_m(const Series& series) {
  const std::vector<Progress> means = mean_progress(series, longest_m(series) + 1.0);
  const auto settled = std::find_if(means.begin(), means.end(), [&](const Progress& mean) {
    return mean.mapped_fraction >= means.back().mapped_fraction - 0.005;
  });
  return settled->distance_m;
}

/// The mean of value(trial) over a choice's trials.
template <class Value>
[[nodiscard]] double mean_of(const Series& series, Value&& value) {
  double sum = 0.0;
  for (const Trial& trial : series.trials) sum += value(trial);
  return sum / static_cast<double>(series.trials.size());
}

/// NaN when one never mapped so much.
[[nodiscard]] inline double mean_distance_to_m(const Series& series, double mapped_fraction) {
  return mean_of(series, [=](const Trial& trial) {
    return trial.distance_to_m(mapped_fraction).value_or(std::numeric_limits<double>::quiet_NaN());
  });
}

}  // namespace office_exploration
