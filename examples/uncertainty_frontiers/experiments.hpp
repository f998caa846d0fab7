/// The experiments of section 5: a drive through corridors, and sixteen settings of the hall.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/parallel.hpp"
#include "uncertainty_frontiers/trial.hpp"

namespace uncertainty_frontiers {

/// What a robot knows at one moment of the drive through corridors.
struct Snapshot {
  Belief map;
  std::vector<incognita::Frontier<2>> classical;
  std::vector<incognita::Frontier<2>> uncertain;
  std::vector<Eigen::Vector2d> path_m;
  double siren_nats_m2;
  double mean_uncertainty_m;  ///< over what was seen
  double position_sigma_m;
};

inline constexpr double corridor_sigma_max_m = 1.0;

[[nodiscard]] inline Snapshot snapshot(const Robot& robot) {
  Snapshot shot{robot.map(0), {}, {}, robot.path_m(), incognita::map_signed_relative_entropy_nats_m2(robot.map(0)), 0.0, robot.position_sigma_m()};
  const KnownFloor floor(shot.map, robot.position_m());
  shot.classical = objectives({"", false, false, corridor_sigma_max_m}, shot.map, floor);
  shot.uncertain = objectives({"", true, false, corridor_sigma_max_m}, shot.map, floor);
  const std::vector<double> all_m = explored_uncertainties_m(shot.map);
  shot.mean_uncertainty_m = std::accumulate(all_m.begin(), all_m.end(), 0.0) / static_cast<double>(all_m.size());
  return shot;
}

/// Section 5.1: at P_f, around the block, and after the loop was closed.
struct CorridorDrive {
  Snapshot around;
  Snapshot home;
};

/// By hand: who drives sees the walls, so the robot's belief does not matter.
inline void drive_along(Robot& robot, const std::vector<Eigen::Vector2d>& way_m) {
  for (const Eigen::Vector2d& place_m : way_m) {
    for (int pace = 0; pace < 400 && (robot.truth_m() - place_m).norm() > 0.5 * pace_m; ++pace) robot.step(place_m - robot.truth_m());
  }
}

[[nodiscard]] inline CorridorDrive corridor_drive(std::uint64_t seed) {
  const Place place = corridors();
  const std::vector<Eigen::Vector2d> around = way_around();
  Robot robot(place, around.front(), {corridor_sigma_max_m}, seed);
  drive_along(robot, around);
  Snapshot at_end = snapshot(robot);
  drive_along(robot, way_home());
  return {std::move(at_end), snapshot(robot)};
}

/// How many cells of frontiers lie in the left corridor, where what was seen from the start meets what is seen from the end: R_2.
[[nodiscard]] inline std::size_t cells_of_r2(const Snapshot& shot, const std::vector<incognita::Frontier<2>>& frontiers) {
  std::size_t count = 0;
  for (const auto& frontier : frontiers) {
    for (const incognita::Index<2>& cell : frontier.cells) {
      const Eigen::Vector2d place_m = shot.map.lattice().center_m(cell);
      count += static_cast<std::size_t>(place_m.x() < 2.1 && place_m.y() > 2.1 && place_m.y() < 10.0);
    }
  }
  return count;
}

/// All seeds of one setting.
struct Series {
  Setting setting;
  std::vector<Trial> trials = {};

  [[nodiscard]] std::string layout() const {
    return std::string(setting.complete ? "complete" : "incomplete") + ", P" + std::to_string(setting.start);
  }
};

/// The sixteen settings, layouts in the paper's order.
[[nodiscard]] inline std::vector<Series> hall_settings() {
  std::vector<Series> all;
  for (const auto& [complete, start] : {std::pair(false, 2), std::pair(false, 1), std::pair(true, 1), std::pair(true, 2)}) {
    for (const PlanningSystem& system : planning_systems) all.push_back({{system, complete, start}});
  }
  return all;
}

/// Runs `seeds` trials of each, side by side; none depends on another or on the number of threads (0: OpenMP's own number).
/// report(done, all) is called as trials end, by any thread.
inline void run_trials(std::vector<Series>& all, std::size_t seeds, int threads, const std::function<void(std::size_t, std::size_t)>& report) {
  for (Series& series : all) series.trials.resize(seeds);
  std::atomic<std::size_t> done = 0;
  incognita::for_each_index(all.size() * seeds, threads, [&](std::size_t index, int) {
    Series& series = all[index / seeds];
    series.trials[index % seeds] = run_trial(series.setting, 1 + index % seeds);
    if (report) report(++done, all.size() * seeds);
  });
}

}  // namespace uncertainty_frontiers
