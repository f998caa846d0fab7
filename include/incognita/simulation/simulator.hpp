/// One robot in one world, step by step: commands in, odometry and scans out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/core/split_mix.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/sensor/scan.hpp"
#include "incognita/simulation/odometry.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/robot.hpp"
#include "incognita/simulation/world.hpp"

namespace incognita {

/// Odometry at 50 Hz and a scan every fifth step, as in Seo et al., section VI-B.
struct SimulatorParams {
  RobotParams robot;         ///< its body and its limits
  OdometryParams odometry;   ///< its noise
  RangeSensorParams sensor;  ///< on the robot's centre, its frame the robot's
  int steps_per_s = 50;      ///< >= 1
  int steps_per_scan = 5;    ///< >= 1
};

/// The same world, start, parameters, seed and commands give the same numbers to the bit. Odometry and sensor
/// draw from streams of their own, each a fixed number of draws a step or scan, so commands do not shift the
/// noise. Not thread safe; simulators share nothing.
class Simulator {
 public:
  /// The first scan is taken at the start, at time 0. Throws std::invalid_argument for bad parameters or a
  /// start on which the robot is not clear.
  Simulator(World world, const Pose2& T_world_start, const SimulatorParams& params, std::uint64_t seed)
      : world_(std::move(world)),
        T_start_world_(T_world_start.inverse()),
        steps_per_s_(params.steps_per_s),
        steps_per_scan_(params.steps_per_scan),
        robot_(world_, T_world_start, params.robot),
        odometry_(params.odometry, stream_seed(seed, 0)),
        sensor_(params.sensor, stream_seed(seed, 1)) {
    require(params.steps_per_s >= 1, "Simulator", "steps_per_s", params.steps_per_s, ">= 1");
    require(params.steps_per_scan >= 1, "Simulator", "steps_per_scan", params.steps_per_scan, ">= 1");
    sensor_.measure(world_, robot_.T_world_robot());
  }

  /// Drives one step and returns T_before_after as odometry measures it. Takes a scan when one is due. Throws
  /// std::invalid_argument for a command that is not finite; nothing has then happened.
  Pose2 step(const Twist2& command) {
    const double step_s = 1.0 / steps_per_s_;
    const Twist2 twist = robot_.move(world_, command, step_s);
    ++steps_;
    const Pose2 T_before_after = odometry_.measure(twist, step_s);
    if (scan_is_new()) sensor_.measure(world_, robot_.T_world_robot());
    return T_before_after;
  }

  /// The last scan, and whether it was taken at this very step (or at the start) rather than an earlier one.
  [[nodiscard]] const Scan<2>& scan() const { return sensor_.scan(); }
  [[nodiscard]] bool scan_is_new() const { return steps_ % static_cast<std::size_t>(steps_per_scan_) == 0; }  ///< whether this step took it

  [[nodiscard]] std::size_t steps() const { return steps_; }  ///< so far
  /// Computed from the number of steps, so it does not drift.
  [[nodiscard]] double time_s() const { return static_cast<double>(steps_) / steps_per_s_; }
  [[nodiscard]] double distance_m() const { return robot_.distance_m(); }  ///< driven, forwards and backwards
  [[nodiscard]] std::size_t collisions() const { return robot_.collisions(); }  ///< how often the robot ran into something, see Robot

  [[nodiscard]] const World& world() const { return world_; }  ///< the building
  /// The building in the robot's start frame: what metrics call T_belief_world when the belief starts at
  /// identity.
  [[nodiscard]] const Pose2& T_start_world() const { return T_start_world_; }
  [[nodiscard]] const Pose2& T_world_robot() const { return robot_.T_world_robot(); }  ///< the true pose
  /// The true pose as an estimator would have it, which starts at identity.
  [[nodiscard]] Pose2 T_start_robot() const { return T_start_world_ * robot_.T_world_robot(); }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. The world, the start and how often what is measured must be the same.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(robot_, odometry_, sensor_, steps_);
  }

 private:
  /// Neighbouring seeds and streams give unrelated ones (Steele et al. 2014, SplitMix64).
  [[nodiscard]] static std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t stream) {
    return split_mixed((2 * seed + stream + 1) * split_mix_increment);
  }

  World world_;
  Pose2 T_start_world_;
  int steps_per_s_;
  int steps_per_scan_;
  Robot robot_;
  Odometry odometry_;
  RangeSensor sensor_;
  std::size_t steps_ = 0;
};

}  // namespace incognita
