/// The way out for a robot that stands so near to something that no path can begin there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// How a robot gets out of a tight place.
struct RetreatParams {
  double speed_m_per_s = 0.1;
  double turn_rate_rad_per_s = 0.5;
  double aim_rad = 0.1;      ///< it drives once its heading is this near to the way out
  double look_m = 0.5;       ///< ways that are free for this long are as good as each other
  int headings = 36;         ///< how many ways are tried

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("RetreatParams", "speed_m_per_s", speed_m_per_s);
    require_positive("RetreatParams", "turn_rate_rad_per_s", turn_rate_rad_per_s);
    require_positive("RetreatParams", "aim_rad", aim_rad);
    require_positive("RetreatParams", "look_m", look_m);
    require(headings >= 4, "RetreatParams", "headings", headings, ">= 4");
  }
};

/// The speeds that turn a robot on the spot, which is safe for a disc, towards the heading in which it can drive straight for
/// longest, and then take it there; among equals, the smallest turn. `scan` is in the robot's frame, its latest. Pass the
/// result through guard_command. Throws std::invalid_argument for parameters outside of their bounds.
/// O(headings * near beams).
[[nodiscard]] inline Twist2 retreat_command(const Scan<2>& scan, double robot_radius_m,
                                            const RetreatParams& params = {}) {
  params.validate();
  std::vector<Eigen::Vector2d> near_m;
  double nearest_m = robot_radius_m;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit || scan.range_m(beam) > robot_radius_m + params.look_m) continue;
    const double range_m = smoothed_range_m(scan, beam);
    near_m.push_back(scaled(scan.direction(beam), range_m));
    nearest_m = std::min(nearest_m, range_m);
  }
  double best_free_m = -1.0;
  double best_turn_rad = 0.0;
  for (int heading = 0; heading < params.headings; ++heading) {
    const double turn_rad = wrap_angle_rad(2.0 * std::numbers::pi * heading / params.headings);
    const Eigen::Vector2d ahead(std::cos(turn_rad), std::sin(turn_rad));
    double free_m = params.look_m;
    for (const Eigen::Vector2d& point_m : near_m) {
      const Eigen::Vector2d seen_m(dot(ahead, point_m), ahead[0] * point_m[1] - ahead[1] * point_m[0]);
      free_m = std::min(free_m, distance_to_contact_m(seen_m, 0.0, nearest_m));
    }
    const bool better = free_m > best_free_m ||
                        (free_m == best_free_m && std::abs(turn_rad) < std::abs(best_turn_rad));
    if (!better) continue;
    best_free_m = free_m;
    best_turn_rad = turn_rad;
  }
  const double turn_rad_per_s =
      std::clamp(2.0 * best_turn_rad, -params.turn_rate_rad_per_s, params.turn_rate_rad_per_s);
  return {std::abs(best_turn_rad) <= params.aim_rad ? params.speed_m_per_s : 0.0, turn_rad_per_s};
}

}  // namespace incognita
