/// The last layer of safety: slows a robot down before what its latest scan shows.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "incognita/core/error.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// How far a disc-shaped robot keeps away from what it measures.
struct CollisionGuardParams {
  double robot_radius_m = 0.2;
  double margin_m = 0.03;              ///< beyond the radius; small, for doors hardly wider than the robot
  double reaction_time_s = 0.15;       ///< from a scan to the moment at which the robot brakes
  double deceleration_m_per_s2 = 1.0;  ///< of the robot
  double speed_min_m_per_s = 0.02;     ///< slower than this is standing still

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("CollisionGuardParams", "robot_radius_m", robot_radius_m);
    require_non_negative("CollisionGuardParams", "margin_m", margin_m);
    require_non_negative("CollisionGuardParams", "reaction_time_s", reaction_time_s);
    require_positive("CollisionGuardParams", "deceleration_m_per_s2", deceleration_m_per_s2);
    require_non_negative("CollisionGuardParams", "speed_min_m_per_s", speed_min_m_per_s);
  }
};

/// How far a point can travel from the origin, along its x axis at first and then on a circle of the given
/// curvature (counter-clockwise > 0), before `obstacle_m` is within `radius_m`; infinity when it never is.
/// When the obstacle is within it already: 0 if it gets nearer at first, else how far until it does again.
[[nodiscard]] inline double distance_to_contact_m(const Eigen::Vector2d& obstacle_m, double curvature_per_m,
                                                  double radius_m) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (std::abs(curvature_per_m) < 1e-5) {
    const double ahead_m = obstacle_m.x();
    if (ahead_m <= 0.0 || std::abs(obstacle_m.y()) >= radius_m) return never;
    return std::max(0.0, ahead_m - std::sqrt(radius_m * radius_m - obstacle_m.y() * obstacle_m.y()));
  }
  // Mirrored, so that the circle turns to the left: its centre is (0, turn_m), where the origin lies at
  // -pi/2.
  const double turn_m = 1.0 / std::abs(curvature_per_m);
  const double across_m = curvature_per_m > 0.0 ? obstacle_m.y() : -obstacle_m.y();
  const double from_center_m = std::hypot(obstacle_m.x(), across_m - turn_m);
  const double cosine = (turn_m * turn_m + from_center_m * from_center_m - radius_m * radius_m) /
                        (2.0 * turn_m * from_center_m);
  if (!(cosine < 1.0)) return never;
  double along_rad = std::atan2(across_m - turn_m, obstacle_m.x()) + std::numbers::pi / 2.0;
  if (along_rad < 0.0) along_rad += 2.0 * std::numbers::pi;
  return turn_m * std::max(0.0, along_rad - std::acos(std::max(-1.0, cosine)));
}

/// `command` slowed down, on the same arc, until the robot can stop before any measured point comes within
/// its radius and margin. A point that is within them already must not come nearer than the radius and a
/// third of the margin, and one that is within that not nearer at all. Where no speed is left the robot still
/// turns in place, which is always safe for a disc. Never faster than the command, never the other way.
/// `scan` is in the robot's frame, its latest; beams without a hit are ignored. Throws std::invalid_argument
/// for parameters outside of their bounds. O(beams).
[[nodiscard]] inline Twist2 guard_command(const Twist2& command, const Scan<2>& scan,
                                          const CollisionGuardParams& params = {}) {
  params.validate();
  const double speed_m_per_s = std::abs(command.speed_m_per_s);
  if (!(speed_m_per_s > 0.0)) return command;
  const double curvature_per_m = command.turn_rate_rad_per_s / speed_m_per_s;
  const double heading = command.speed_m_per_s > 0.0 ? 1.0 : -1.0;  // backwards: mirrored, turn included
  const double brake = params.deceleration_m_per_s2;
  const double stopping_m =
      speed_m_per_s * params.reaction_time_s + speed_m_per_s * speed_m_per_s / (2.0 * brake);
  const double keep_m = params.robot_radius_m + params.margin_m;
  const double touch_m = params.robot_radius_m + params.margin_m / 3.0;

  double free_m = stopping_m;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.range_m(beam) > stopping_m + keep_m || scan.reading(beam) != Reading::hit) continue;
    const double range_m = scan.range_m(beam);
    const double radius_m = range_m > keep_m ? keep_m : std::min(range_m, touch_m);
    Eigen::Vector2d obstacle_m = scan.end_point_m(beam);
    obstacle_m.x() *= heading;
    free_m = std::min(free_m, distance_to_contact_m(obstacle_m, heading * curvature_per_m, radius_m));
  }
  if (free_m >= stopping_m) return command;
  // The largest v with v * reaction_time + v^2 / (2 brake) <= free_m.
  const double lost_m_per_s = brake * params.reaction_time_s;
  const double allowed_m_per_s = std::sqrt(lost_m_per_s * lost_m_per_s + 2.0 * brake * free_m) - lost_m_per_s;
  if (allowed_m_per_s < params.speed_min_m_per_s) return {0.0, command.turn_rate_rad_per_s};
  const double scale = std::min(1.0, allowed_m_per_s / speed_m_per_s);
  return {scale * command.speed_m_per_s, scale * command.turn_rate_rad_per_s};
}

}  // namespace incognita
