/// A world, the robot in it, and where it starts.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/robot.hpp"
#include "office_exploration/start_poses.hpp"
#include "office_exploration/worlds.hpp"

namespace office_exploration {

inline constexpr double range_max_m = 1.5;  ///< of every robot's scanner (Isleyen et al., footnotes 5 and 6)

struct Arena {
  std::string name;
  incognita::World world;
  incognita::RobotParams robot;
  std::vector<incognita::Pose2> starts;
  incognita::Grid<std::uint8_t, 2> visible;  ///< not 0 where the robot can get to see the floor, from whichever start
};

[[nodiscard]] inline Arena make_arena(std::string name, incognita::FloorPlan plan, const incognita::RobotParams& robot,
                                      std::size_t start_count) {
  incognita::World world(std::move(plan));
  incognita::Random random(1);
  std::vector<incognita::Pose2> starts = spread_poses(world, robot.radius_m, start_count, random);
  incognita::Grid<std::uint8_t, 2> visible = visible_floor(world, starts.front().position(), robot.radius_m, range_max_m);
  return {std::move(name), std::move(world), robot, std::move(starts), std::move(visible)};
}

/// The simulated robot of footnote 5.
inline constexpr incognita::RobotParams office_robot{0.35, 1.0, 1.0};

/// The TurtleBot3 Waffle Pi of footnote 6.
inline constexpr incognita::RobotParams turtlebot{0.22, 0.26, 0.8};

[[nodiscard]] inline Arena small_office_arena(std::size_t start_count) {
  return make_arena("small-office", small_office(), office_robot, start_count);
}

[[nodiscard]] inline Arena large_office_arena(std::size_t start_count) {
  return make_arena("large-office", large_office(), office_robot, start_count);
}

[[nodiscard]] inline Arena room_arena(std::size_t start_count) {
  return make_arena("room", cluttered_room(), turtlebot, start_count);
}

}  // namespace office_exploration
