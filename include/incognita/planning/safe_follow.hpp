/// Following a path without leaving the control space (Isleyen et al., III-B).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/disc_hull.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/polyline.hpp"
#include "incognita/planning/safe_space.hpp"

namespace incognita {

/// Where a unicycle under (18) may come by on its way to a goal that stays where it is (after (19)): the hull of itself and of a
/// disc around a goal before it, a disc through itself around a goal behind it.
[[nodiscard]] inline DiscHull motion_prediction(const Pose2& pose, const Eigen::Vector2d& goal_m) {
  const Eigen::Vector2d way_m = difference(goal_m, pose.position());
  const double cosine = std::cos(pose.yaw_rad);
  const double sine = std::sin(pose.yaw_rad);
  const double ahead_m = cosine * way_m[0] + sine * way_m[1];
  const double aside_m = cosine * way_m[1] - sine * way_m[0];
  return DiscHull(pose.position(), goal_m, ahead_m >= 0.0 ? std::abs(aside_m) : norm(way_m));
}

/// (19): how far a set is from the nearest cell, as a square, that is not in `space`, but at most distance_max_m. What lies
/// outside of the space's box is not in it. O(cells within distance_max_m of the set).
[[nodiscard]] inline double distance_to_exterior_m(const DiscHull& set, const CellSet& space, double distance_max_m) {
  const Lattice<2>& lattice = space.lattice();
  const double side_m = lattice.resolution_m();
  const IndexBox<2> cells = lattice.cells_of(set.box().padded(distance_max_m));
  double least_m = distance_max_m;
  for (int y = cells.lower[1]; y < cells.upper[1]; ++y) {
    for (int x = cells.lower[0]; x < cells.upper[0]; ++x) {
      if (space.value({x, y}) != 0) continue;
      const Eigen::Vector2d lower(lattice.origin_m()[0] + x * side_m, lattice.origin_m()[1] + y * side_m);
      least_m = std::min(least_m, set.distance_to({lower, {lower[0] + side_m, lower[1] + side_m}}));
    }
  }
  return least_m;
}

/// The gains of (18) and the robot's limits.
struct SafeFollowParams {
  double speed_per_m = 1.0;              ///< kappa_v, 1/s
  double turn_rate_per_rad = 2.0;        ///< kappa_omega, 1/s
  double progress_per_clearance = 1.0;   ///< kappa_sigma, 1/(m s)
  double progress_per_rest = 1.0;        ///< kappa_s, 1/s
  double speed_max_m_per_s = 1.0;  ///< > 0
  double turn_rate_max_rad_per_s = 1.0;  ///< > 0
  double goal_tolerance_m = 0.1;  ///< this near to its end the path is finished
  double hold_margin_m = 0.02;    ///< what a command held until the next may add to where the robot comes by, >= 0; a quarter of a cell at most is kept

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("SafeFollowParams", "speed_per_m", speed_per_m);
    require_positive("SafeFollowParams", "turn_rate_per_rad", turn_rate_per_rad);
    require_positive("SafeFollowParams", "progress_per_clearance", progress_per_clearance);
    require_positive("SafeFollowParams", "progress_per_rest", progress_per_rest);
    require_positive("SafeFollowParams", "speed_max_m_per_s", speed_max_m_per_s);
    require_positive("SafeFollowParams", "turn_rate_max_rad_per_s", turn_rate_max_rad_per_s);
    require_positive("SafeFollowParams", "goal_tolerance_m", goal_tolerance_m);
    require_non_negative("SafeFollowParams", "hold_margin_m", hold_margin_m);
  }
};

/// The unicycle's speeds (18a) and (18b) towards a goal, each limited by itself, which keeps the motion prediction's set one
/// that the robot does not leave. Zero at the goal.
[[nodiscard]] inline Twist2 drive_to(const Pose2& pose, const Eigen::Vector2d& goal_m, const SafeFollowParams& params) {
  const Eigen::Vector2d way_m = difference(goal_m, pose.position());
  const double cosine = std::cos(pose.yaw_rad);
  const double sine = std::sin(pose.yaw_rad);
  const double ahead_m = cosine * way_m[0] + sine * way_m[1];
  const double aside_m = cosine * way_m[1] - sine * way_m[0];
  if (ahead_m == 0.0 && aside_m == 0.0) return {};
  const double rate_rad_per_s = params.turn_rate_per_rad * std::atan2(aside_m, ahead_m);
  return {std::min(params.speed_per_m * std::max(0.0, ahead_m), params.speed_max_m_per_s),
          std::clamp(rate_rad_per_s, -params.turn_rate_max_rad_per_s, params.turn_rate_max_rad_per_s)};
}

/// Chases a place that moves along a path, (17) and (18): it moves on, and never back, as long as all that the robot may come by
/// on its way to it lies in the control space. A plain value.
class SafePathFollower {
 public:
  /// Nothing to follow: finished.
  SafePathFollower() = default;

  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit SafePathFollower(Polyline path, const SafeFollowParams& params = {})
      : path_(std::move(path)), params_(params), is_finished_(path_.empty()) {
    params_.validate();
  }

  /// The speeds to drive with for duration_s from `pose`, in the control space as it is now known. The path's first place must
  /// be one that the robot can go to straight; it waits for ever at a place from where it would leave the control space.
  /// Throws std::invalid_argument unless the duration is finite and >= 0. O(cells around the robot and the place that it chases).
  [[nodiscard]] Twist2 command(const Pose2& pose, const CellSet& control, double duration_s) {
    require_non_negative("SafePathFollower::command", "duration_s", duration_s);
    if (is_finished_) return {};
    advance(pose, control, duration_s);
    const double end_distance_m = distance(path_.points_m().back(), pose.position());
    if (parameter_ >= 1.0 - 1e-3 && end_distance_m <= params_.goal_tolerance_m) {
      is_finished_ = true;
      return {};
    }
    return drive_to(pose, goal_m(), params_);
  }

  [[nodiscard]] bool is_finished() const { return is_finished_; }  ///< whether it is at the path's end

  /// s in [0, 1], the share of the path's length that the place has come; never decreases.
  [[nodiscard]] double parameter() const { return parameter_; }

  /// p(s), the place that the robot chases: from here to plan anew, as it lies in the planning space. The path must not be empty.
  [[nodiscard]] Eigen::Vector2d goal_m() const { return path_.point_at(parameter_ * path_.length_m()); }

  [[nodiscard]] const Polyline& path() const { return path_; }  ///< as given

 private:
  /// (18c), for a time. In so short a time the place may not move further than half of the distance that is left, either: the
  /// prediction's disc moves with it and grows by as much.
  void advance(const Pose2& pose, const CellSet& control, double duration_s) {
    const double length_m = path_.length_m();
    if (!(length_m > 0.0)) parameter_ = 1.0;
    const double rest = params_.progress_per_rest * (1.0 - parameter_);
    if (!(rest > 0.0)) return;
    // A path from centre to centre may come as near as half a cell.
    const double hold_m = std::min(params_.hold_margin_m, 0.25 * control.resolution_m());
    const double distance_max_m = rest / params_.progress_per_clearance + hold_m;
    const double clear_m = distance_to_exterior_m(motion_prediction(pose, goal_m()), control, distance_max_m) - hold_m;
    if (!(clear_m > 0.0)) return;
    const double step = std::min(duration_s * std::min(params_.progress_per_clearance * clear_m, rest), 0.5 * clear_m / length_m);
    parameter_ = std::min(1.0, parameter_ + step);
  }

  Polyline path_;
  SafeFollowParams params_;
  double parameter_ = 0.0;
  bool is_finished_ = true;
};

}  // namespace incognita
