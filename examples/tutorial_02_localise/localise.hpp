/// Learning a map from a log whose poses are good, and localisation in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/io/robot_log.hpp"
#include "incognita/map/map.hpp"
#include "incognita/metrics/nees.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/simulation/simulator.hpp"

namespace tutorial_localise {

inline constexpr double frame_turn_rad = 0.5;  // of the map's frame against the walls

using Slam = incognita::Slam<incognita::Map<>, incognita::DvlEkf>;

/// Yesterday: the log's poses are good, and filter and map learn from its scans.
[[nodiscard]] inline Slam learn(const incognita::RobotLog& log, incognita::DvlEkf::Params params = {}) {
  params.start.pose = {0.0, 0.0, frame_turn_rad};  // the first pose of the log in the map's frame, which you choose
  Slam slam{incognita::DvlEkf(params)};
  const incognita::LogScan* before = &log.scans.front();
  for (const incognita::LogScan& entry : log.scans) {
    slam.move(before->T_odom_robot.inverse() * entry.T_odom_robot, entry.time_s - before->time_s);
    slam.observe(incognita::Scan<2>(log.beams, entry.ranges_m));
    before = &entry;
  }
  return slam;
}

/// What is written down at each scan, in the map's frame.
struct Instant {
  double time_s;
  incognita::Pose2 truth;
  incognita::PoseBelief belief;
  incognita::Pose2 odometry;
};

/// Today: odometry drifts, nothing is learned, and the pose is corrected by the map alone.
[[nodiscard]] inline std::vector<Instant> localise(const Slam& slam, const std::vector<Eigen::Vector2d>& route_m, const incognita::Pose2& T_map_world,
                                                   incognita::Simulator& robot) {
  incognita::DvlEkf filter = slam.filter();
  const incognita::Map<>& map = slam.map();
  incognita::DeadReckoning::Params from_here;
  from_here.start = filter.belief();
  incognita::DeadReckoning odometry(from_here);

  incognita::PathFollower follower(route_m, incognita::FollowParams{});
  std::vector<Instant> instants;
  while (!follower.is_finished() && robot.time_s() < 300.0) {
    const incognita::Pose2 increment = robot.step(follower.command(filter.belief().pose));
    filter.predict(increment, 0.02);
    odometry.predict(increment, 0.02);
    if (!robot.scan_is_new()) continue;
    const incognita::CorrectionReport report = filter.correct(robot.scan(), map);
    if (report.lost) std::printf("lost at %.1f s\n", robot.time_s());
    instants.push_back({robot.time_s(), T_map_world * robot.T_world_robot(), filter.belief(), odometry.belief().pose});
  }
  return instants;
}

/// Today's robot and its way, in the building's frame. It starts where the log ends.
[[nodiscard]] inline incognita::Simulator robot_after(const incognita::RobotLog& log, const incognita::World& world, std::uint64_t seed) {
  incognita::SimulatorParams params;
  params.odometry = {0.15, 0.1};  // sigmas of speed (m/s) and turn rate (rad/s), three and five times the usual
  params.sensor.beams = log.beams;
  return {world, log.scans.back().T_odom_robot, params, seed};
}

[[nodiscard]] inline std::vector<Eigen::Vector2d> todays_route_m() {
  return {{1.0, 4.7},  {4.0, 4.7},  {4.0, 6.6}, {6.6, 7.4}, {9.4, 7.4}, {11.5, 6.4}, {11.5, 4.7},
          {13.0, 4.7}, {13.0, 2.2}, {13.0, 4.7}, {8.0, 4.7}, {8.0, 2.6}, {8.0, 4.7},  {1.0, 4.7}};
}

/// The log's poses are in the building's frame; the map's is turned against it.
[[nodiscard]] inline incognita::Pose2 map_from_world(const incognita::RobotLog& log) {
  return incognita::Pose2{0.0, 0.0, frame_turn_rad} * log.scans.front().T_odom_robot.inverse();
}

[[nodiscard]] inline double distance_m(const incognita::Pose2& a, const incognita::Pose2& b) { return (a.position() - b.position()).norm(); }

/// How good the filter was, and how honest.
struct Score {
  double rmse_m = 0.0;
  double worst_m = 0.0;
  double odometry_worst_m = 0.0;
  double within_3_sigma = 0.0;  ///< share of the instants
  double sigma_m = 0.0;         ///< mean of what the filter thinks
  double nees = 0.0;            ///< of the position: 2 when honest, less when cautious
};

[[nodiscard]] inline Score score_of(const std::vector<Instant>& instants) {
  Score score;
  incognita::MeanNees nees;
  const double share = 1.0 / static_cast<double>(instants.size());
  for (const Instant& now : instants) {
    const double error_m = distance_m(now.belief.pose, now.truth);
    const double sigma_m = incognita::position_sigma_m(now.belief.covariance);
    score.rmse_m += share * error_m * error_m;
    score.worst_m = std::max(score.worst_m, error_m);
    score.odometry_worst_m = std::max(score.odometry_worst_m, distance_m(now.odometry, now.truth));
    score.within_3_sigma += error_m <= 3.0 * sigma_m ? share : 0.0;
    score.sigma_m += share * sigma_m;
    nees.add(now.belief.pose, now.truth, now.belief.covariance);
  }
  score.rmse_m = std::sqrt(score.rmse_m);
  score.nees = nees.position();
  return score;
}

}  // namespace tutorial_localise
