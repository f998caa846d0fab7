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

/// A unicycle's pose with its heading as a unit vector: for rollouts of many arcs, in which no angle has to be wrapped or its cosine found
/// again. Rounding changes the vector's length by some 1e-16 an arc.
struct UnicycleState {
  double x_m;     ///< in the frame of the pose that it was made of
  double y_m;     ///< likewise
  double cosine;  ///< of the heading, no unit
  double sine;    ///< likewise

  /// At a pose.
  explicit UnicycleState(const Pose2& pose) : x_m(pose.x_m), y_m(pose.y_m), cosine(std::cos(pose.yaw_rad)), sine(std::sin(pose.yaw_rad)) {}

  /// Drives on as unicycle_motion.
  void drive(const Twist2& twist, double duration_s) {
    const double half_turn_rad = 0.5 * twist.turn_rate_rad_per_s * duration_s;
    const double c = std::cos(half_turn_rad);
    const double s = std::sin(half_turn_rad);
    const double chord_m = twist.speed_m_per_s * duration_s * (half_turn_rad == 0.0 ? 1.0 : s / half_turn_rad);
    const double chord_cosine = c * cosine - s * sine;
    const double chord_sine = s * cosine + c * sine;
    x_m += chord_m * chord_cosine;
    y_m += chord_m * chord_sine;
    cosine = c * chord_cosine - s * chord_sine;
    sine = s * chord_cosine + c * chord_sine;
  }
};

}  // namespace incognita
