/// Runs and curves as CSV files, and the table on the terminal.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "office_exploration/averages.hpp"
#include "support/csv.hpp"
#include "support/exploration_names.hpp"

namespace office_exploration {

/// "experiment,world,strategy,information,navigation" of a row.
[[nodiscard]] inline std::string columns_of(const Series& series) {
  const Choice& choice = series.choice;
  return series.experiment + ',' + series.arena->name + ',' + examples::name_of(choice.strategy) + ',' +
         examples::name_of(choice.information) + ',' + examples::name_of(choice.navigation);
}

/// One row a trial; the distance to 90 percent is empty where so much was never mapped.
inline void write_runs(const std::filesystem::path& path, const std::vector<Series>& all) {
  const char* header =
      "experiment,world,strategy,information,navigation,pose,stop_reason,collisions,mapped_fraction,distance_m,"
      "distance_to_90_percent_m,time_s,position_error_max_m";
  examples::write_csv(path, header, [&](std::ostream& out) {
    for (const Series& series : all) {
      for (std::size_t start = 0; start < series.trials.size(); ++start) {
        const Trial& trial = series.trials[start];
        out << columns_of(series) << ',' << start << ',' << to_string(trial.stop_reason) << ',' << trial.collisions << ','
            << trial.mapped_fraction() << ',' << trial.distance_m << ',';
        if (const std::optional<double> distance_m = trial.distance_to_m(0.9)) out << *distance_m;
        out << ',' << trial.duration_s << ',' << trial.position_error_max_m << '\n';
      }
    }
  });
}

/// One row a metre of each choice, as far as its longest trial.
inline void write_curves(const std::filesystem::path& path, const std::vector<Series>& all) {
  const char* header = "experiment,world,strategy,information,navigation,distance_m,mapped_fraction_mean";
  examples::write_csv(path, header, [&](std::ostream& out) {
    for (const Series& series : all) {
      for (const Progress& mean : mean_progress(series, longest_m(series) + 1.0)) {
        out << columns_of(series) << ',' << mean.distance_m << ',' << mean.mapped_fraction << '\n';
      }
    }
  });
}

/// One line a choice.
inline void print_table(const std::vector<Series>& all) {
  std::printf("%-10s %-13s %-11s %-11s %-10s  complete  collisions  mapped  distance  to 90 %%\n", "experiment", "world",
              "strategy", "information", "navigation");
  for (const Series& series : all) {
    std::size_t complete = 0;
    std::size_t collisions = 0;
    for (const Trial& trial : series.trials) {
      complete += trial.is_complete() ? 1 : 0;
      collisions += trial.collisions;
    }
    const Choice& choice = series.choice;
    std::printf("%-10s %-13s %-11s %-11s %-10s  %3zu/%-4zu  %10zu  %5.1f %%  %6.1f m  %5.1f m\n", series.experiment.c_str(),
                series.arena->name.c_str(), examples::name_of(choice.strategy).c_str(),
                examples::name_of(choice.information).c_str(), examples::name_of(choice.navigation).c_str(), complete,
                series.trials.size(), collisions,
                100.0 * mean_of(series, [](const Trial& trial) { return trial.mapped_fraction(); }),
                mean_of(series, [](const Trial& trial) { return trial.distance_m; }), mean_distance_to_m(series, 0.9));
  }
}

}  // namespace office_exploration
