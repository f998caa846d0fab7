/// The last layer of safety: slows a robot down before what its latest scan shows.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// How far a disc-shaped robot keeps away from what it measures.
struct CollisionGuardParams {
  double robot_radius_m = 0.2;         ///< > 0
  double margin_m = 0.03;              ///< beyond the radius
  double creep_margin_m = 0.02;        ///< enough up to creep_speed, for doors hardly wider than the robot
  double creep_speed_m_per_s = 0.1;    ///< slow enough for creep_margin_m
  double reaction_time_s = 0.15;       ///< from a scan to the moment at which the robot brakes
  double deceleration_m_per_s2 = 1.0;  ///< of the robot
  double speed_min_m_per_s = 0.02;     ///< slower than this is standing still

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("CollisionGuardParams", "robot_radius_m", robot_radius_m);
    require_non_negative("CollisionGuardParams", "margin_m", margin_m);
    require(creep_margin_m >= 0.0 && creep_margin_m <= margin_m, "CollisionGuardParams", "creep_margin_m",
            creep_margin_m, ">= 0 and <= margin_m");
    require_non_negative("CollisionGuardParams", "creep_speed_m_per_s", creep_speed_m_per_s);
    require_non_negative("CollisionGuardParams", "reaction_time_s", reaction_time_s);
    require_positive("CollisionGuardParams", "deceleration_m_per_s2", deceleration_m_per_s2);
    require_positive("CollisionGuardParams", "speed_min_m_per_s", speed_min_m_per_s);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "robot_radius_m, margin_m, creep_margin_m, creep_speed_m_per_s, reaction_time_s, deceleration_m_per_s2, speed_min_m_per_s",
        robot_radius_m, margin_m, creep_margin_m, creep_speed_m_per_s, reaction_time_s, deceleration_m_per_s2, speed_min_m_per_s);
  }
};

/// How far a point can travel from the origin, along its x axis at first and then on a circle of the given
/// curvature (counter-clockwise > 0), before `obstacle_m` is within `radius_m`; infinity when it never is.
/// When the obstacle is within it already: 0 if it gets nearer at first, else how far until it does again.
[[nodiscard]] inline double distance_to_contact_m(const Eigen::Vector2d& obstacle_m, double curvature_per_m,
                                                  double radius_m) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (std::abs(curvature_per_m) < 1e-5) {
    const double ahead_m = obstacle_m[0];
    if (ahead_m <= 0.0 || std::abs(obstacle_m[1]) >= radius_m) return never;
    return std::max(0.0, ahead_m - std::sqrt(radius_m * radius_m - obstacle_m[1] * obstacle_m[1]));
  }
  // Mirrored, so that the circle turns to the left: its centre is (0, turn_m), where the origin lies at
  // -pi/2.
  const double turn_m = 1.0 / std::abs(curvature_per_m);
  const double across_m = curvature_per_m > 0.0 ? obstacle_m[1] : -obstacle_m[1];
  const double from_center_m = std::hypot(obstacle_m[0], across_m - turn_m);
  const double cosine = (turn_m * turn_m + from_center_m * from_center_m - radius_m * radius_m) /
                        (2.0 * turn_m * from_center_m);
  if (!(cosine < 1.0)) return never;
  double along_rad = std::atan2(across_m - turn_m, obstacle_m[0]) + std::numbers::pi / 2.0;
  if (along_rad < 0.0) along_rad += 2.0 * std::numbers::pi;
  return turn_m * std::max(0.0, along_rad - std::acos(std::max(-1.0, cosine)));
}

/// A hit beam's range as the mean over it and up to `reach` beams on either side (the first follows the last), of
/// those that end within `similar_m` of where it ends. The nearest of many noisy readings is always too near;
/// between two walls, that would hold a robot for ever.
[[nodiscard]] inline double smoothed_range_m(const Scan<2>& scan, std::size_t beam, std::size_t reach = 2,
                                             double similar_m = 0.05) {
  const Eigen::Vector2d end_m = scan.end_point_m(beam);
  double sum_m = 0.0;
  double count = 0.0;
  const std::size_t side = std::min(reach, (scan.size() - 1) / 2);
  for (std::size_t step = 0; step <= 2 * side; ++step) {
    const std::size_t near = (beam + scan.size() - side + step) % scan.size();
    if (scan.reading(near) != Reading::hit) continue;
    const Eigen::Vector2d near_m = scan.end_point_m(near);
    if (std::hypot(near_m[0] - end_m[0], near_m[1] - end_m[1]) > similar_m) continue;
    sum_m += scan.range_m(near);
    count += 1.0;
  }
  return sum_m / count;
}

/// `command` with its speed lowered until the robot can stop before any measured point comes within its
/// radius and margin, or within its radius and creep_margin_m while it creeps; what is nearer than that
/// already must not come nearer still. It keeps turning as told, which is always safe for a disc, so a robot
/// that met a wall aslant turns away from it. Speed goes down in steps of a quarter, to 0 below speed_min;
/// never up, never the other way. `scan` is in the robot's frame, its latest; beams without a hit are
/// ignored. Throws std::invalid_argument for parameters outside of their bounds. O(beams).
[[nodiscard]] inline Twist2 guard_command(const Twist2& command, const Scan<2>& scan,
                                          const CollisionGuardParams& params = {}) {
  params.validate();
  const double keep_m = params.robot_radius_m + params.margin_m;
  const double wanted_m_per_s = std::abs(command.speed_m_per_s);
  const auto stopping_distance_m = [&](double speed_m_per_s) {
    return speed_m_per_s * params.reaction_time_s +
           speed_m_per_s * speed_m_per_s / (2.0 * params.deceleration_m_per_s2);
  };
  double nearest_m = std::numeric_limits<double>::infinity();
  std::vector<Eigen::Vector2d> obstacles_m;  // what the robot could meet before it stops
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit) continue;
    if (scan.range_m(beam) > keep_m + stopping_distance_m(wanted_m_per_s)) continue;
    const double range_m = smoothed_range_m(scan, beam);
    nearest_m = std::min(nearest_m, range_m);
    obstacles_m.push_back(scaled(scan.direction(beam), range_m));
  }
  const double creep_keep_m =
      std::clamp(nearest_m, params.robot_radius_m, params.robot_radius_m + params.creep_margin_m);
  const double heading = command.speed_m_per_s < 0.0 ? -1.0 : 1.0;  // backwards: mirrored, turn included

  const auto can_stop = [&](double speed_m_per_s) {
    const double radius_m = speed_m_per_s <= params.creep_speed_m_per_s ? creep_keep_m : keep_m;
    const double curvature_per_m = heading * command.turn_rate_rad_per_s / speed_m_per_s;
    const double stopping_m = stopping_distance_m(speed_m_per_s);
    for (const Eigen::Vector2d& obstacle_m : obstacles_m) {
      const double range_m = norm(obstacle_m);
      if (range_m > radius_m + stopping_m) continue;
      const Eigen::Vector2d ahead_m(heading * obstacle_m[0], obstacle_m[1]);
      if (distance_to_contact_m(ahead_m, curvature_per_m, std::min(range_m, radius_m)) < stopping_m)
        return false;
    }
    return true;
  };
  double speed_m_per_s = wanted_m_per_s;
  while (speed_m_per_s > 0.0 && !can_stop(speed_m_per_s)) {
    speed_m_per_s *= 0.75;
    if (speed_m_per_s < params.speed_min_m_per_s) speed_m_per_s = 0.0;
  }
  return {heading * speed_m_per_s, command.turn_rate_rad_per_s};
}

}  // namespace incognita
