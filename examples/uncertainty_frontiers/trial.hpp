/// One exploration of the hall, and what came of it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/entropy/signed_relative_entropy.hpp"
#include "incognita/map/uncertainty_map.hpp"
#include "support/statistics.hpp"
#include "uncertainty_frontiers/planning_system.hpp"

namespace uncertainty_frontiers {

/// A setting of section 5.2.
struct Setting {
  PlanningSystem system;
  bool complete;  ///< landmarks
  int start;      ///< P_1 or P_2
};

/// SiREn is judged by the same two maps for all systems, each of which is the own map of some.
inline constexpr double judged_sigmas_max_m[] = {0.6, 1.0};

struct Trial {
  double siren_nats_m2[2] = {0.0, 0.0};  ///< by the judged sigmas
  double explored_m2 = 0.0;              ///< seen, walls included
  double landmark_sigma_m = 0.0;         ///< the median of all landmarks seen
  double uncertainty_m = 0.0;            ///< the median of U over what was seen, by the system's own map
  double position_error_m = 0.0;         ///< at the end
  double distance_m = 0.0;
  std::size_t plans = 0;
  bool is_done = false;  ///< no objective was left that it reached; else the distance ran out
  std::vector<Eigen::Vector2d> path_m;
  std::vector<Eigen::Vector2d> landmarks_m;
  std::optional<Belief> map;  ///< the system's own
};

inline constexpr double distance_max_m = 400.0;
inline constexpr std::size_t visits_max = 2;    ///< an objective that is still there after so many visits is given up
inline constexpr double same_place_m = 0.75;

/// U of each cell that was seen, in storage order.
[[nodiscard]] inline std::vector<double> explored_uncertainties_m(const Belief& map) {
  const incognita::UncertaintyOfDispersion uncertainty_m(map.cell());
  std::vector<double> all_m;
  for (const incognita::Dispersion::State& state : map.grid().values()) {
    if (state.is_explored) all_m.push_back(uncertainty_m(static_cast<double>(map.cell().dispersion_log_odds(state))));
  }
  return all_m;
}

[[nodiscard]] inline Trial run_trial(const Setting& setting, std::uint64_t seed) {
  const Place place = hall(setting.complete);
  Robot robot(place, start_m(setting.start), {judged_sigmas_max_m[0], judged_sigmas_max_m[1]}, seed);
  const std::size_t own = setting.system.sigma_max_m == judged_sigmas_max_m[0] ? 0 : 1;
  incognita::Random random(seed + 2000);  // of the planner
  std::vector<Eigen::Vector2d> visited_m;
  Trial trial;
  while (robot.distance_m() < distance_max_m) {
    const KnownFloor floor(robot.map(own), robot.position_m());
    std::vector<Eigen::Vector2d> objectives_m;
    for (const auto& frontier : objectives(setting.system, robot.map(own), floor)) {
      const Eigen::Vector2d objective_m = robot.map(own).lattice().center_m(frontier.representative);
      const auto visits = std::count_if(visited_m.begin(), visited_m.end(), [&](const Eigen::Vector2d& place_m) {
        return (place_m - objective_m).norm() < same_place_m;
      });
      if (static_cast<std::size_t>(visits) < visits_max) objectives_m.push_back(objective_m);
    }
    const std::optional<Plan> plan =
        objectives_m.empty() ? std::nullopt : make_plan(setting.system, robot, floor, objectives_m, random);
    if (!plan) {
      trial.is_done = true;
      break;
    }
    ++trial.plans;
    visited_m.push_back(plan->objective_m);
    // A robot that does not know where it is bumps into walls: it then looks for another way.
    bool is_free = true;
    for (const Eigen::Vector2d& place_m : plan->way_m) {
      while (is_free && (robot.position_m() - place_m).norm() > 0.5 * pace_m && robot.distance_m() < distance_max_m) {
        is_free = robot.step(place_m - robot.position_m());
      }
    }
  }

  for (std::size_t i = 0; i < 2; ++i) trial.siren_nats_m2[i] = incognita::map_signed_relative_entropy_nats_m2(robot.map(i));
  const Belief& map = robot.map(own);
  std::vector<double> uncertainties_m = explored_uncertainties_m(map);
  trial.explored_m2 = static_cast<double>(uncertainties_m.size()) * map.resolution_m() * map.resolution_m();
  trial.uncertainty_m = examples::median(std::move(uncertainties_m));
  std::vector<double> landmark_sigmas_m;
  for (std::size_t i = 0; i < robot.slam().landmarks().size(); ++i) {
    landmark_sigmas_m.push_back(incognita::mean_sigma(robot.slam().landmark_covariance_m2(i)));
    trial.landmarks_m.push_back(robot.landmark_m(i));
  }
  trial.landmark_sigma_m = examples::median(std::move(landmark_sigmas_m));
  trial.position_error_m = (robot.position_m() - robot.truth_m()).norm();
  trial.distance_m = robot.distance_m();
  trial.path_m = robot.path_m();
  trial.map = map;
  return trial;
}

}  // namespace uncertainty_frontiers
