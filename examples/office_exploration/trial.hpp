/// One exploration by a robot that knows its pose.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/simulation/simulator.hpp"
#include "office_exploration/arena.hpp"
#include "support/drive.hpp"

namespace office_exploration {

/// What is compared.
struct Choice {
  incognita::Strategy strategy = incognita::Strategy::last_mile;
  incognita::FrontierInformation information = incognita::FrontierInformation::size;
  incognita::NavigationCost navigation = incognita::NavigationCost::geodesic;
};

/// A scan frees no cell of TBayes within half a metre of where a beam ends, be it in open space. To a robot that sees 1.5 m
/// that leaves frontiers which its viewpoints do not clear; where the pose is known such caution serves nothing.
using Belief = incognita::Map<incognita::LogOdds>;

struct Progress {
  double distance_m;
  double mapped_fraction;
};

struct Trial {
  incognita::StopReason stop_reason = incognita::StopReason::out_of_time;
  std::size_t collisions = 0;
  double distance_m = 0.0;
  double duration_s = 0.0;
  double position_error_max_m = 0.0;     ///< of the pose that is meant to be known
  std::vector<Progress> progress;        ///< at each scan
  std::vector<Eigen::Vector2d> path_m;   ///< in the world, at each scan

  [[nodiscard]] double mapped_fraction() const { return progress.back().mapped_fraction; }

  /// Whether the robot found nothing more to do.
  [[nodiscard]] bool is_complete() const {
    return stop_reason == incognita::StopReason::complete || stop_reason == incognita::StopReason::nothing_informative;
  }

  /// How far it had driven when so much was mapped; none when it never was.
  [[nodiscard]] std::optional<double> distance_to_m(double mapped_fraction) const {
    const auto found = std::find_if(progress.begin(), progress.end(),
                                    [=](const Progress& p) { return p.mapped_fraction >= mapped_fraction; });
    return found == progress.end() ? std::nullopt : std::optional<double>(found->distance_m);
  }
};

/// A mission that takes longer than this, in simulated seconds, is ended: an hour, several times what the slowest needs.
inline constexpr double duration_max_s = 3600.0;

[[nodiscard]] inline incognita::ExplorerParams explorer_params(const incognita::RobotParams& robot, const Choice& choice) {
  incognita::ExplorerParams params;
  params.travel.robot_radius_m = robot.radius_m;
  params.guard.robot_radius_m = robot.radius_m;
  params.follow.speed_max_m_per_s = robot.speed_max_m_per_s;
  params.follow.turn_rate_max_rad_per_s = robot.turn_rate_max_rad_per_s;
  params.gain.range_max_m = range_max_m;
  params.gain.speed_m_per_s = robot.speed_max_m_per_s;
  params.strategy = choice.strategy;
  params.information = choice.information;
  params.navigation = choice.navigation;
  params.travel_offset_m = 0.0;  // (26) has none
  // Assumption 2: a viewpoint serves from wherever near it the robot stops. With less, a frontier can stay after a visit.
  params.visibility_tolerance_m = params.follow.goal_tolerance_m;
  params.threads = 1;            // trials run side by side
  return params;
}

/// From one of the arena's starts. Odometry and the filter are without noise, so the pose is known, as by the paper's
/// motion capture.
[[nodiscard]] inline Trial run_trial(const Arena& arena, const incognita::Pose2& start,
                                     const incognita::ExplorerParams& params) {
  using namespace incognita;
  SimulatorParams simulation;
  simulation.robot = arena.robot;
  simulation.odometry = {0.0, 0.0};
  simulation.sensor.beams = circular_beams(360, range_max_m);
  Simulator simulator(arena.world, start, simulation, 1);
  Explorer<Belief, Behavioral, DeadReckoning> explorer(params, Belief{}, Behavioral{},
                                                            DeadReckoning({MotionNoise{}, PoseBelief{}}));
  const Coverage coverage(arena.visible, simulator.T_start_world(), explorer.map().lattice());
  const auto is_known = [&](const Index<2>& cell) { return explorer.occupancy().grid().value(cell) != Occupancy::unknown; };

  Trial trial;
  const auto observe_and_decide = [&] {
    explorer.observe(simulator.scan());
    explorer.decide();
    trial.progress.push_back({simulator.distance_m(), coverage.explored_fraction(is_known)});
    trial.path_m.push_back(simulator.T_world_robot().position());
  };
  examples::drive(explorer, simulator, duration_max_s, observe_and_decide, [&] {
    const double error_m = distance(explorer.belief().pose.position(), simulator.T_start_robot().position());
    trial.position_error_max_m = std::max(trial.position_error_max_m, error_m);
  });
  trial.stop_reason = explorer.stopped().value_or(StopReason::out_of_time);
  trial.collisions = simulator.collisions();
  trial.distance_m = simulator.distance_m();
  trial.duration_s = simulator.time_s();
  return trial;
}

}  // namespace office_exploration
