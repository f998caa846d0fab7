/// A stand-in for a robot's log: a drive through the tutorials' building, written as CARMEN writes it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/planning/polyline.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/world.hpp"

namespace examples {

/// Through all rooms and around the loop, in the building's frame.
[[nodiscard]] inline std::vector<Eigen::Vector2d> recorded_route_m() {
  return {{1.0, 4.7},  {2.5, 4.7},  {2.5, 2.6},  {4.2, 1.4}, {2.5, 2.6}, {2.5, 4.7}, {8.0, 4.7},  {8.0, 2.6},
          {6.2, 2.9},  {8.0, 2.6},  {8.0, 4.7},  {13.0, 4.7}, {13.0, 2.2}, {11.6, 1.2}, {13.0, 2.2}, {13.0, 4.7},
          {11.5, 4.7}, {11.5, 6.4}, {9.4, 7.4},  {6.6, 7.4}, {4.0, 6.6}, {4.0, 4.7}, {1.0, 4.7}};
}

/// Poses 0.1 m and 0.1 rad apart at most, the heading along the way, turns in place.
[[nodiscard]] inline std::vector<incognita::Pose2> poses_along(const std::vector<Eigen::Vector2d>& route_m) {
  constexpr double spacing_m = 0.1;
  constexpr double turn_rad = 0.1;
  std::vector<incognita::Pose2> poses;
  for (std::size_t corner = 0; corner + 1 < route_m.size(); ++corner) {
    const Eigen::Vector2d way_m = route_m[corner + 1] - route_m[corner];
    const double yaw_rad = std::atan2(way_m.y(), way_m.x());
    if (!poses.empty()) {
      const incognita::Pose2 before = poses.back();
      const double left_rad = incognita::angle_between_rad(before.yaw_rad, yaw_rad);
      const double turns = std::ceil(std::abs(left_rad) / turn_rad);
      for (double turn = 1.0; turn <= turns; turn += 1.0) {
        poses.push_back({before.x_m, before.y_m, incognita::wrap_angle_rad(before.yaw_rad + left_rad * turn / turns)});
      }
    }
    incognita::for_each_place(incognita::Polyline({route_m[corner], route_m[corner + 1]}), spacing_m,
                              [&](const Eigen::Vector2d& at_m) { poses.push_back({at_m.x(), at_m.y(), yaw_rad}); });
  }
  return poses;
}

/// One FLASER message each 0.1 s: 181 ranges over 180 degrees from right to left, up to 10 m, with 0.01 m of noise, then where the
/// laser and the robot are. Both are exact here.
inline void write_recording(const std::filesystem::path& file, const incognita::World& world) {
  constexpr double degree_rad = std::numbers::pi / 180.0;
  incognita::RangeSensor laser({incognita::planar_beams(181, -90.0 * degree_rad, degree_rad, 10.0), 0.01}, 1);
  std::string text = "# CARMEN log of a simulated drive\n";
  char word[80];
  double time_s = 0.0;
  std::vector<incognita::Pose2> poses = poses_along(recorded_route_m());
  poses.insert(poses.begin(), 30, poses.front());  // it stands for 3 s before it sets out
  for (const incognita::Pose2& pose : poses) {
    const incognita::Scan<2>& scan = laser.measure(world, pose);
    text += "FLASER " + std::to_string(scan.size());
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      std::snprintf(word, sizeof word, " %.3f", scan.range_m(beam));
      text += word;
    }
    for (int twice = 0; twice < 2; ++twice) {
      std::snprintf(word, sizeof word, " %.6f %.6f %.8f", pose.x_m, pose.y_m, pose.yaw_rad);
      text += word;
    }
    std::snprintf(word, sizeof word, " %.3f tutorial %.3f\n", time_s, time_s);
    text += word;
    time_s += 0.1;
  }
  incognita::write_file_atomically(file, text);
}

}  // namespace examples
