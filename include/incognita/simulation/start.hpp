/// Where a simulated robot may start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "incognita/core/error.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/sensor/obstacle_field.hpp"

namespace incognita {

/// Throws std::invalid_argument "check_start: ..." with the point and the room there is, unless a disc is
/// clear on it.
inline void check_start(const ObstacleField& obstacles, const Point<2>& start_m, double radius_m) {
  if (obstacles.disc_is_clear(start_m, radius_m)) return;
  std::ostringstream message;
  message << "check_start: the start " << start_m.x() << "," << start_m.y() << " (m) is "
          << obstacles.clearance_m(start_m) << " m from the nearest obstacle, but must be " << radius_m
          << " m away or more";
  throw std::invalid_argument(message.str());
}

/// A start pose T_world_robot in an ObstacleField or a World: the centre of a cell drawn from the largest
/// region (by cells, joined by their faces) on whose centres a disc is clear, and a heading drawn from the
/// whole circle. Takes two draws. Throws std::invalid_argument for a negative radius or when the disc is
/// clear nowhere. O(cells).
template <class Obstacles>
[[nodiscard]] Pose2 random_start(const Obstacles& obstacles, double radius_m, Random& random) {
  require_non_negative("random_start", "radius_m", radius_m);
  const Components<2> regions = connected_components(disc_positions(obstacles, radius_m), Adjacency::faces,
                                                     [](std::uint8_t is_clear) { return is_clear != 0; });
  const std::int32_t largest = regions.largest();
  if (largest == Components<2>::none) {
    throw_invalid("random_start", "radius_m", radius_m, "so small that there is room for the robot somewhere");
  }
  std::uint64_t left = random.index(regions.sizes[static_cast<std::size_t>(largest)]);
  Offset cell = 0;
  while (regions.labels[cell] != largest || left-- > 0) ++cell;
  const Point<2> position_m = obstacles.lattice().center_m(regions.labels.index_at(cell));
  const double yaw_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
  return {position_m.x(), position_m.y(), wrap_angle_rad(yaw_rad)};
}

}  // namespace incognita
