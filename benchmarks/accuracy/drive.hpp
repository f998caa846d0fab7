/// Explorers' missions, and the commands they leave to be driven again.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/metrics/nees.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/simulation/start.hpp"
#include "incognita/simulation/world.hpp"

namespace accuracy {

/// The errors of a belief against the truth, over time.
class DriveErrors {
 public:
  void add(const incognita::PoseBelief& belief, const incognita::Pose2& truth) {
    const Eigen::Vector3d error = incognita::pose_error(belief.pose, truth);
    position_squares_m2_ += error[0] * error[0] + error[1] * error[1];
    heading_squares_rad2_ += error[2] * error[2];
    nees_.add(belief.pose, truth, belief.covariance);
  }

  [[nodiscard]] double position_rmse_m() const { return std::sqrt(position_squares_m2_ / count()); }
  [[nodiscard]] double heading_rmse_rad() const { return std::sqrt(heading_squares_rad2_ / count()); }
  [[nodiscard]] double mean_position_nees() const { return nees_.position(); }

 private:
  [[nodiscard]] double count() const { return static_cast<double>(nees_.count()); }

  double position_squares_m2_ = 0.0;
  double heading_squares_rad2_ = 0.0;
  incognita::MeanNees nees_;
};

/// The duration of an odometry increment.
[[nodiscard]] inline double step_s(const incognita::SimulatorParams& params) {
  return 1.0 / params.steps_per_s;
}

/// As in kth_explorer: compass and loops.
using Explorer = incognita::Explorer<incognita::Map<>, incognita::Behavioral, incognita::LoopClosingDvlEkf>;

/// What an explorer did in a building: where it started there, and the command of every step.
struct Mission {
  incognita::Pose2 T_world_start;
  std::vector<incognita::Twist2> commands;
  std::string ended;
  double duration_s = 0.0;
  double distance_m = 0.0;
  DriveErrors errors;  ///< of the explorer's own estimator
};

/// An explorer with the defaults explores from a random start until it stops or the time is over. The start's
/// heading is random too, so the building lies at a random angle in the estimator's frame.
[[nodiscard]] inline Mission explore(const incognita::World& world, std::uint64_t seed, double duration_s) {
  const incognita::SimulatorParams params;
  incognita::Random random(seed);
  Mission mission;
  mission.T_world_start = random_start(world, params.robot.radius_m, random);
  incognita::Simulator simulator(world, mission.T_world_start, params, seed);
  incognita::ExplorerParams explorer_params;
  explorer_params.threads = 1;
  Explorer explorer(explorer_params);
  explorer.observe(simulator.scan());
  explorer.decide();
  incognita::Twist2 command = explorer.command(simulator.scan());
  while (!explorer.stopped() && simulator.time_s() < duration_s) {
    mission.commands.push_back(command);
    explorer.move(simulator.step(command), step_s(params));
    if (simulator.scan_is_new()) {
      explorer.observe(simulator.scan());
      explorer.decide();
      command = explorer.command(simulator.scan());
    }
    mission.errors.add(explorer.belief(), simulator.T_start_robot());
  }
  mission.ended = explorer.stopped() ? to_string(*explorer.stopped()) : "out_of_time";
  mission.duration_s = simulator.time_s();
  mission.distance_m = simulator.distance_m();
  return mission;
}

}  // namespace accuracy
