/// The way out for a robot that stands so near to something that no path can begin there.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "incognita/geometry/twist2.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// How a robot backs out of a tight place.
struct RetreatParams {
  double speed_m_per_s = 0.1;
  double turn_rate_rad_per_s = 0.5;
  double aim_rad = 0.2;  ///< drive only when heading away from the obstacle within this
};

/// The speeds that turn a robot away from the nearest thing that its scan (in its own frame) shows and then
/// take it away from it; zero when the scan shows nothing. Turning in place is safe for a disc, and driving
/// straight away from the nearest point is safe until another is as near: pass the result through
/// guard_command. O(beams).
[[nodiscard]] inline Twist2 retreat_command(const Scan<2>& scan, const RetreatParams& params = {}) {
  double nearest_m = std::numeric_limits<double>::infinity();
  Eigen::Vector2d towards = Eigen::Vector2d::Zero();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit || scan.range_m(beam) >= nearest_m) continue;
    nearest_m = scan.range_m(beam);
    towards = scan.direction(beam);
  }
  if (towards.isZero()) return {};
  const double away_rad = std::atan2(-towards.y(), -towards.x());
  const double turn_rad_per_s =
      std::clamp(2.0 * away_rad, -params.turn_rate_rad_per_s, params.turn_rate_rad_per_s);
  return {std::abs(away_rad) <= params.aim_rad ? params.speed_m_per_s : 0.0, turn_rad_per_s};
}

}  // namespace incognita
