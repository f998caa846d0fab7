/// How a robot moves that drives along its own x axis and turns.
#pragma once

#include <cmath>

#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"

namespace incognita {

/// Where a unicycle is after it has held a twist, in its frame before: an arc of a circle, exactly, of any
/// turn rate.
[[nodiscard]] inline Pose2 unicycle_motion(const Twist2& twist, double duration_s) {
  const double half_turn_rad = 0.5 * twist.turn_rate_rad_per_s * duration_s;
  const double shortening = half_turn_rad == 0.0 ? 1.0 : std::sin(half_turn_rad) / half_turn_rad;
  const double chord_m = twist.speed_m_per_s * duration_s * shortening;
  return {chord_m * std::cos(half_turn_rad), chord_m * std::sin(half_turn_rad),
          wrap_angle_rad(2.0 * half_turn_rad)};
}

}  // namespace incognita
