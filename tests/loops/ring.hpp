/// A building in which a robot comes back to its start by another way.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "../estimation/room.hpp"
#include "incognita/core/angles.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita::test {

/// A corridor of 2 m width around a block, longer than the scanner sees, with pillars along its walls.
inline std::vector<room::Wall> ring() {
  std::vector<room::Wall> walls = room::box(room::kTurned, 13.0, 9.0);
  for (const room::Wall& wall : room::box(room::kTurned, 11.0, 7.0)) walls.push_back(wall);
  Random random(3);
  for (int pillar = 0; pillar < 24; ++pillar) {
    const bool is_beside = pillar % 2 == 0;
    const double side = pillar % 4 < 2 ? 1.0 : -1.0;
    const Pose2 at{is_beside ? 12.9 * side : random.uniform(-12.0, 12.0), is_beside ? random.uniform(-8.0, 8.0) : 8.9 * side, 0.0};
    for (const room::Wall& wall : room::box(room::kTurned * at, 0.2, 0.2)) walls.push_back(wall);
  }
  return walls;
}

/// Around the ring along the corridor's middle, 0.1 m or 0.1 rad a scan.
inline std::vector<Pose2> way_around(double laps) {
  const std::vector<Eigen::Vector2d> corners{{12.0, 0.0}, {12.0, 8.0}, {-12.0, 8.0}, {-12.0, -8.0}, {12.0, -8.0}};
  std::vector<Pose2> way{{12.0, 0.0, 0.5 * std::numbers::pi}};
  double left_m = laps * 80.0;
  for (std::size_t next = 1; left_m > 0.0; next = next % (corners.size() - 1) + 1) {
    const auto ahead_rad = [&] {
      const Eigen::Vector2d to = corners[next] - way.back().position();
      return std::atan2(to.y(), to.x());
    };
    while (std::abs(angle_between_rad(way.back().yaw_rad, ahead_rad())) > 1e-6) {
      const double turn_rad = angle_between_rad(way.back().yaw_rad, ahead_rad());
      way.push_back(way.back() * Pose2{0.0, 0.0, std::clamp(turn_rad, -0.1, 0.1)});
    }
    while (distance(way.back().position(), corners[next]) > 1e-6) {
      const double step_m = std::min(0.1, distance(way.back().position(), corners[next]));
      way.push_back(way.back() * Pose2{step_m, 0.0, 0.0});
      left_m -= step_m;
    }
  }
  for (Pose2& pose : way) pose = room::kTurned * pose;
  return way;
}

}  // namespace incognita::test
