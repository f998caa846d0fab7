/// Where beside a path there is more room, by what the robot's latest scan shows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// The ends of a scan's beams that hit something within range_max_m, smoothed, in the frame of the pose. O(beams).
[[nodiscard]] inline std::vector<Eigen::Vector2d> near_hits_m(const Pose2& T_map_robot, const Scan<2>& scan,
                                                              double range_max_m) {
  std::vector<Eigen::Vector2d> hits_m;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit || scan.range_m(beam) > range_max_m) continue;
    hits_m.push_back(T_map_robot * Eigen::Vector2d(scaled(scan.direction(beam), smoothed_range_m(scan, beam))));
  }
  return hits_m;
}

/// A place and how far it is from the nearest obstacle, or some upper bound when none is that near.
struct RoomyPlace {
  Eigen::Vector2d position_m;  ///< in the frame of the obstacles
  double clearance_m;          ///< to the nearest obstacle
};

/// How finely places are compared, and so how well they are known.
inline constexpr double room_step_m = 0.005;

/// The place with the most clearance, of which enough_m is enough, up to reach_m to either side of `place_m`, across the
/// direction `along`; the nearest of equals, so that a place with enough is left as it is. A cell's centre may lie half a
/// passage aside of its middle where the passage is as narrow as the robot; the laser knows that middle to a centimetre.
/// All in one frame. O(obstacles * reach_m / room_step_m).
[[nodiscard]] inline RoomyPlace roomiest_aside(const Eigen::Vector2d& place_m, const Eigen::Vector2d& along,
                                               const std::vector<Eigen::Vector2d>& obstacles_m, double reach_m,
                                               double enough_m) {
  std::vector<Eigen::Vector2d> offsets_m;  // of the obstacles that matter
  for (const Eigen::Vector2d& obstacle_m : obstacles_m) {
    const Eigen::Vector2d offset_m = difference(obstacle_m, place_m);
    if (norm(offset_m) < enough_m + reach_m) offsets_m.push_back(offset_m);
  }
  const auto clearance_m = [&](const Eigen::Vector2d& moved_m) {
    double least_m2 = enough_m * enough_m;
    for (const Eigen::Vector2d& offset_m : offsets_m) {
      const Eigen::Vector2d way_m = difference(offset_m, moved_m);
      least_m2 = std::min(least_m2, dot(way_m, way_m));
    }
    return std::sqrt(least_m2);
  };
  const Eigen::Vector2d stay_m(0.0, 0.0);
  RoomyPlace best{place_m, clearance_m(stay_m)};
  const double length = norm(along);
  if (!(length > 0.0)) return best;
  const Eigen::Vector2d left(-along[1] / length, along[0] / length);
  const int steps = static_cast<int>(reach_m / room_step_m + 0.5);
  for (int step = 1; step <= steps && best.clearance_m < enough_m; ++step) {
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector2d moved_m = scaled(left, side * step * room_step_m);
      const double there_m = clearance_m(moved_m);
      if (there_m > best.clearance_m) best = {sum(place_m, moved_m), there_m};
    }
  }
  return best;
}

}  // namespace incognita
