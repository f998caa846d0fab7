/// Tables of the experiments, and what they say of the paper's findings.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "support/csv.hpp"
#include "support/statistics.hpp"
#include "uncertainty_frontiers/experiments.hpp"

namespace uncertainty_frontiers {

inline void write_trials(const std::filesystem::path& path, const std::vector<Series>& all) {
  examples::write_csv(path,
                      "system,landmarks,start,seed,siren_at_0.6_nats_m2,siren_at_1.0_nats_m2,explored_m2,landmark_sigma_m,uncertainty_m,"
                      "position_error_m,distance_m,plans,is_done",
                      [&](std::ostream& file) {
                        for (const Series& series : all) {
                          for (std::size_t seed = 0; seed < series.trials.size(); ++seed) {
                            const Trial& trial = series.trials[seed];
                            file << series.setting.system.name << ',' << (series.setting.complete ? "complete" : "incomplete") << ",P"
                                 << series.setting.start << ',' << seed + 1 << ',' << trial.siren_nats_m2[0] << ',' << trial.siren_nats_m2[1]
                                 << ',' << trial.explored_m2 << ',' << trial.landmark_sigma_m << ',' << trial.uncertainty_m << ','
                                 << trial.position_error_m << ',' << trial.distance_m << ',' << trial.plans << ',' << trial.is_done << '\n';
                          }
                        }
                      });
}

namespace detail {

/// The mean SiREn of the settings for which a condition holds.
template <class Holds>
[[nodiscard]] double mean_siren(const std::vector<Series>& all, std::size_t judge, Holds&& holds) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Series& series : all) {
    if (!holds(series.setting)) continue;
    for (const Trial& trial : series.trials) sum += trial.siren_nats_m2[judge];
    count += series.trials.size();
  }
  return sum / static_cast<double>(count);
}

/// A planning system by its place in planning_systems.
[[nodiscard]] inline bool is_system(const Setting& setting, std::size_t which) {
  return std::string(setting.system.name) == planning_systems[which].name;
}

}  // namespace detail

/// SiREn of each setting, the effect of each factor, and (23).
inline void print_hall(const std::vector<Series>& all) {
  std::printf("SiREn in nats m^2 (sigma_max 1 m): median [quartiles]; explored m^2, distance m (medians)\n");
  for (const Series& series : all) {
    std::vector<double> siren;
    std::vector<double> explored_m2;
    std::vector<double> distance_m;
    for (const Trial& trial : series.trials) {
      siren.push_back(trial.siren_nats_m2[1]);
      explored_m2.push_back(trial.explored_m2);
      distance_m.push_back(trial.distance_m);
    }
    const examples::Spread box = examples::spread_of(siren);
    std::printf("  %-16s %s %7.0f [%.0f %.0f] %6.0f %5.0f\n", series.layout().c_str(), series.setting.system.name, box.median,
                box.lower_quartile, box.upper_quartile, examples::median(explored_m2), examples::median(distance_m));
  }
  struct Factor {
    const char* name;
    double difference[2];
  };
  std::vector<Factor> factors{{"landmarks (complete - incomplete)", {}},
                              {"start (P2 - P1)", {}},
                              {"planner (PPS2 - PPS1)", {}},
                              {"frontiers (PPS4 - PPS2)", {}},
                              {"sigma_max (PPS4 - PPS3)", {}}};
  for (std::size_t judge = 0; judge < 2; ++judge) {
    const auto mean = [&](auto&& holds) { return detail::mean_siren(all, judge, holds); };
    const auto of_system = [&](std::size_t which) { return mean([=](const Setting& setting) { return detail::is_system(setting, which); }); };
    factors[0].difference[judge] = mean([](const Setting& s) { return s.complete; }) - mean([](const Setting& s) { return !s.complete; });
    factors[1].difference[judge] = mean([](const Setting& s) { return s.start == 2; }) - mean([](const Setting& s) { return s.start == 1; });
    factors[2].difference[judge] = of_system(1) - of_system(0);
    factors[3].difference[judge] = of_system(3) - of_system(1);
    factors[4].difference[judge] = of_system(3) - of_system(2);
  }
  std::printf("Mean difference of SiREn by factor, judged with sigma_max 1 m and 0.6 m:\n");
  for (const Factor& factor : factors) std::printf("  %-34s %7.0f %7.0f\n", factor.name, factor.difference[1], factor.difference[0]);
  std::vector<double> sigma_m;
  std::vector<double> uncertainty_m;
  for (const Series& series : all) {
    if (!series.setting.system.by_uncertainty) continue;
    for (const Trial& trial : series.trials) {
      sigma_m.push_back(trial.landmark_sigma_m);
      uncertainty_m.push_back(trial.uncertainty_m);
    }
  }
  const examples::Line line = examples::fitted_line(sigma_m, uncertainty_m);
  std::printf("(23): U = %.3f sigma %+.4f m, correlation %.2f, over %zu maps of PPS3 and PPS4\n", line.slope, line.offset, line.correlation,
              sigma_m.size());
}

inline void print_corridors(const std::vector<CorridorDrive>& drives) {
  std::size_t by_uncertainty = 0;
  std::size_t by_classical = 0;
  Snapshot around = drives.front().around;
  Snapshot home = drives.front().home;
  for (Snapshot* mean : {&around, &home}) mean->mean_uncertainty_m = mean->siren_nats_m2 = 0.0;
  const auto count = static_cast<double>(drives.size());
  for (const CorridorDrive& drive : drives) {
    by_uncertainty += static_cast<std::size_t>(cells_of_r2(drive.around, drive.around.uncertain) > 0);
    by_classical += static_cast<std::size_t>(cells_of_r2(drive.around, drive.around.classical) > 0);
    around.mean_uncertainty_m += drive.around.mean_uncertainty_m / count;
    around.siren_nats_m2 += drive.around.siren_nats_m2 / count;
    home.mean_uncertainty_m += drive.home.mean_uncertainty_m / count;
    home.siren_nats_m2 += drive.home.siren_nats_m2 / count;
  }
  std::printf("Corridors, %zu drives: R2 is an uncertainty frontier in %zu and a classical one in %zu. Closing the loop there takes the\n"
              "mean uncertainty of the map from %.3f m to %.3f m and SiREn from %.0f to %.0f nats m^2.\n",
              drives.size(), by_uncertainty, by_classical, around.mean_uncertainty_m, home.mean_uncertainty_m, around.siren_nats_m2,
              home.siren_nats_m2);
}

inline void write_corridors(const std::filesystem::path& path, const std::vector<CorridorDrive>& drives) {
  const char* header = "seed,when,classical,uncertain,classical_cells_of_r2,uncertain_cells_of_r2,position_sigma_m,mean_uncertainty_m,siren_nats_m2";
  examples::write_csv(path, header, [&](std::ostream& file) {
    for (std::size_t seed = 0; seed < drives.size(); ++seed) {
      for (const bool is_home : {false, true}) {
        const Snapshot& shot = is_home ? drives[seed].home : drives[seed].around;
        file << seed + 1 << ',' << (is_home ? "home" : "around") << ',' << shot.classical.size() << ',' << shot.uncertain.size() << ','
             << cells_of_r2(shot, shot.classical) << ',' << cells_of_r2(shot, shot.uncertain) << ',' << shot.position_sigma_m << ','
             << shot.mean_uncertainty_m << ',' << shot.siren_nats_m2 << '\n';
      }
    }
  });
}

}  // namespace uncertainty_frontiers
