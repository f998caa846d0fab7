/// Angles in radians on the circle (-pi, pi].
#pragma once

#include <cmath>
#include <numbers>

namespace incognita {

/// The same direction in (-pi, pi]. Not finite stays not finite.
[[nodiscard]] inline double wrap_angle_rad(double angle_rad) {
  // remainder() is exact and lands in [-pi, pi]; the lower end belongs to the upper.
  const double wrapped_rad = std::remainder(angle_rad, 2.0 * std::numbers::pi);
  return wrapped_rad <= -std::numbers::pi ? std::numbers::pi : wrapped_rad;
}

/// The shortest turn from `from_rad` to `to_rad`, in (-pi, pi].
[[nodiscard]] inline double angle_between_rad(double from_rad, double to_rad) {
  return wrap_angle_rad(to_rad - from_rad);
}

}  // namespace incognita
