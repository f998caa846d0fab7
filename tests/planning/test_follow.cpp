#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/room_aside.hpp"
#include "incognita/sensor/ray_cast.hpp"

using namespace incognita;

namespace {

constexpr double control_step_s = 0.02;

Pose2 driven(const Pose2& pose, const Twist2& twist) {
  const double middle_rad = pose.yaw_rad + 0.5 * control_step_s * twist.turn_rate_rad_per_s;
  return {pose.x_m + control_step_s * twist.speed_m_per_s * std::cos(middle_rad),
          pose.y_m + control_step_s * twist.speed_m_per_s * std::sin(middle_rad),
          wrap_angle_rad(pose.yaw_rad + control_step_s * twist.turn_rate_rad_per_s)};
}

double distance_to_path_m(const Polyline& path, const Eigen::Vector2d& point_m) {
  return (path.point_at(path.nearest_along_m(point_m, 0.0, path.length_m())) - point_m).norm();
}

struct Drive {
  double time_s = 0.0;
  double deviation_max_m = 0.0;
  Pose2 pose;
};

/// Follows until finished or for `time_max_s`; checks the limits and that progress never decreases.
Drive follow(const std::vector<Eigen::Vector2d>& path_m, const Pose2& start, const FollowParams& params,
             double time_max_s) {
  PathFollower follower(path_m, params);
  Drive drive{0.0, 0.0, start};
  double progress_m = 0.0;
  bool within_limits = true;
  bool forwards = true;
  while (!follower.is_finished() && drive.time_s < time_max_s) {
    const Twist2 twist = follower.command(drive.pose);
    within_limits = within_limits && twist.speed_m_per_s >= 0.0 &&
                    twist.speed_m_per_s <= params.speed_max_m_per_s &&
                    std::abs(twist.turn_rate_rad_per_s) <= params.turn_rate_max_rad_per_s * (1.0 + 1e-12);
    forwards = forwards && follower.progress_m() >= progress_m;
    progress_m = follower.progress_m();
    drive.pose = driven(drive.pose, twist);
    drive.time_s += control_step_s;
    drive.deviation_max_m =
        std::max(drive.deviation_max_m, distance_to_path_m(follower.path(), drive.pose.position()));
  }
  REQUIRE(within_limits);
  REQUIRE(forwards);
  REQUIRE(follower.is_finished());
  REQUIRE((drive.pose.position() - path_m.back()).norm() <= params.goal_tolerance_m);
  const Twist2 at_rest = follower.command(drive.pose);
  REQUIRE(at_rest.speed_m_per_s == 0.0);
  REQUIRE(at_rest.turn_rate_rad_per_s == 0.0);
  return drive;
}

}  // namespace

TEST_CASE("A straight path is driven straight at full speed", "[planning]") {
  const Drive drive = follow({{0.0, 0.0}, {10.0, 0.0}}, {}, {}, 30.0);
  REQUIRE(drive.deviation_max_m < 1e-9);
  REQUIRE(drive.time_s < 11.5);
}

TEST_CASE("A robot that looks the wrong way turns in place first", "[planning]") {
  const Pose2 backwards{0.0, 0.0, std::numbers::pi};
  PathFollower follower({{0.0, 0.0}, {3.0, 0.0}});
  REQUIRE(follower.command(backwards).speed_m_per_s == 0.0);
  REQUIRE(std::abs(follower.command(backwards).turn_rate_rad_per_s) == 1.0);
  const Drive drive = follow({{0.0, 0.0}, {3.0, 0.0}}, backwards, {}, 15.0);
  REQUIRE(drive.deviation_max_m < 0.25);
}

TEST_CASE("Corners are not cut by more than asked, at any angle and speed", "[planning]") {
  for (const double speed_m_per_s : {0.3, 1.0}) {
    for (double turn_rad = -3.0; turn_rad <= 3.0; turn_rad += 0.25) {
      FollowParams params;
      params.speed_max_m_per_s = speed_m_per_s;
      const Eigen::Vector2d corner_m(3.0, 0.0);
      const Eigen::Vector2d end_m = corner_m + 3.0 * Eigen::Vector2d(std::cos(turn_rad), std::sin(turn_rad));
      const Drive drive = follow({{0.0, 0.0}, corner_m, end_m}, {}, params, 60.0);
      REQUIRE(drive.deviation_max_m < 0.08);
    }
  }
}

TEST_CASE("Random paths are followed to their end from beside their start", "[planning]") {
  Random random(1);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Eigen::Vector2d> path_m;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector2d corner_m{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)};
      path_m.push_back(corner_m);
    }
    const Pose2 start{path_m[0].x() + random.uniform(-0.3, 0.3), path_m[0].y() + random.uniform(-0.3, 0.3),
                      random.uniform(-3.0, 3.0)};
    const Drive drive = follow(path_m, start, {}, 20.0 + 3.0 * Polyline(path_m).length_m());
    REQUIRE(drive.deviation_max_m < 0.5);
  }
}

TEST_CASE("A path that comes back to its beginning is followed all the way around", "[planning]") {
  const std::vector<Eigen::Vector2d> loop_m{{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {0.0, 3.0}, {0.0, 0.0}};
  const Drive drive = follow(loop_m, {}, {}, 60.0);
  REQUIRE(drive.time_s > 12.0);
}

TEST_CASE("A path of one place or none is followed", "[planning]") {
  PathFollower nothing;
  REQUIRE(nothing.is_finished());
  REQUIRE(nothing.command({}).speed_m_per_s == 0.0);
  REQUIRE(PathFollower(std::vector<Eigen::Vector2d>{}).is_finished());
  follow({{1.0, 1.0}}, {}, {}, 10.0);
  follow({{1.0, 1.0}, {1.0, 1.0}}, {}, {}, 10.0);
}

TEST_CASE("Bad follow parameters are refused", "[planning]") {
  const auto refused = [](auto change, const char* message) {
    FollowParams params;
    change(params);
    REQUIRE_THROWS_WITH(PathFollower({{0.0, 0.0}}, params), Catch::Contains(message));
  };
  refused([](FollowParams& params) { params.speed_max_m_per_s = 0.0; }, "speed_max_m_per_s is 0");
  refused([](FollowParams& params) { params.turn_rate_max_rad_per_s = -1.0; }, "turn_rate_max_rad_per_s");
  refused([](FollowParams& params) { params.deceleration_m_per_s2 = 0.0; }, "deceleration_m_per_s2");
  refused([](FollowParams& params) { params.lookahead_m = 0.1; }, "lookahead_m is 0.1");
  refused([](FollowParams& params) { params.lookahead_min_m = 0.0; }, "lookahead_min_m");
  refused([](FollowParams& params) { params.deviation_max_m = 0.0; }, "deviation_max_m");
  refused([](FollowParams& params) { params.aside_max_m = -0.1; }, "aside_max_m");
  refused([](FollowParams& params) { params.turn_in_place_rad = 1.6; }, "turn_in_place_rad");
  refused([](FollowParams& params) { params.goal_tolerance_m = 0.0; }, "goal_tolerance_m");
}

TEST_CASE("A robot drives through doors of 0.6 m, planned, followed and guarded, without touching",
          "[planning]") {
  // A character is 0.2 m: the doors are three wide.
  const OccupancyGrid<2> world = draw({"##############################",  //
                                       "#.............#..............#",  //
                                       "#.............#..............#",  //
                                       "#.............#..............#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#.............#..............#",  //
                                       "#.............#..............#",  //
                                       "####################...#######",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "##################...#########",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "#............................#",  //
                                       "##############################"},
                                      0.05, 4);
  const auto is_wall = [](Occupancy cell) { return cell == Occupancy::occupied; };
  const Grid<float, 2> clearance_m = clearance_of(world);
  Random random(3);
  double closest_m = 1.0;
  for (int trial = 0; trial < 6; ++trial) {
    Pose2 pose{random.uniform(0.5, 2.5), random.uniform(2.4, 3.5), random.uniform(-3.0, 3.0)};
    const TravelCostField field(world, clearance_m, pose.position());
    const auto path_m =
        shorten_path(field, find_path(field, world.lattice().index_of({random.uniform(0.5, 1.5), 0.5})));
    REQUIRE(path_m.size() >= 3);
    PathFollower follower(path_m);
    Scan<2> scan(circular_beams(360, 10.0));
    double time_s = 0.0;
    for (int step = 0; !follower.is_finished() && time_s < 90.0; ++step) {
      if (step % 5 == 0) {  // 10 Hz, while the robot is steered at 50 Hz
        for (std::size_t beam = 0; beam < scan.size(); ++beam) {
          const Eigen::Vector2d direction = pose.rotation() * scan.direction(beam);
          scan.set_range_m(beam, cast_ray_m(world, pose.position(), direction, 10.0, is_wall));
        }
      }
      pose = driven(pose, guard_command(follower.command(pose), scan));
      closest_m = std::min(closest_m, distance_to_squares_m(world, pose.position()));
      time_s += control_step_s;
    }
    REQUIRE(follower.is_finished());
    // No more than twice what a straight drive would take, and some for the turns.
    REQUIRE(time_s < 20.0 + 2.0 * follower.path().length_m());
  }
  REQUIRE(closest_m > 0.2);
}

TEST_CASE("The roomiest place aside is the middle of what is narrow, and the place itself where there is room",
          "[planning]") {
  std::vector<Eigen::Vector2d> walls_m;  // 0.45 m apart
  for (double x_m = -0.5; x_m <= 0.5; x_m += 0.01) {
    walls_m.push_back({x_m, -0.225});
    walls_m.push_back({x_m, 0.225});
  }
  const RoomyPlace middle = roomiest_aside({0.0, 0.08}, {2.0, 0.0}, walls_m, 0.1, 0.26);
  CHECK(middle.position_m.x() == Approx(0.0).margin(1e-12));
  CHECK(middle.position_m.y() == Approx(0.0).margin(1e-9));
  CHECK(middle.clearance_m == Approx(0.225));
  const RoomyPlace no_further = roomiest_aside({0.0, 0.08}, {2.0, 0.0}, walls_m, 0.05, 0.26);
  CHECK(no_further.position_m.y() == Approx(0.03));
  const RoomyPlace enough = roomiest_aside({0.0, 0.08}, {2.0, 0.0}, walls_m, 0.1, 0.14);
  CHECK(enough.position_m == Eigen::Vector2d(0.0, 0.08));
  const RoomyPlace undirected = roomiest_aside({0.0, 0.08}, {0.0, 0.0}, walls_m, 0.1, 0.26);
  CHECK(undirected.position_m == Eigen::Vector2d(0.0, 0.08));
}

TEST_CASE("A path half a cell aside of the middle leads a robot of 0.4 m through a door of 0.45 m, by what it sees",
          "[planning]") {
  // A wall of 0.15 m across x = 0; 0.05 m a cell.
  OccupancyGrid<2> world(Lattice<2>(0.05), {Index<2>(-60, -60), Index<2>(60, 60)}, Occupancy::free);
  for (int x = 0; x < 3; ++x) {
    for (int y = -60; y < 60; ++y) world.set({x, y}, y >= -4 && y < 5 ? Occupancy::free : Occupancy::occupied);
  }
  const auto is_wall = [](Occupancy cell) { return cell == Occupancy::occupied; };
  constexpr double middle_m = 0.025;
  Random random(5);
  int passed_blindly = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const bool sees = trial % 2 == 0;
    const double aside_m = random.uniform() < 0.5 ? -0.05 : 0.05;
    const double y_m = middle_m + aside_m;
    PathFollower follower({{-1.0, y_m + random.uniform(-0.5, 0.5)}, {-0.3, y_m}, {1.0, y_m}});
    Pose2 pose{-1.0, follower.path().points_m().front().y(), random.uniform(-1.0, 1.0)};
    Scan<2> scan(circular_beams(360, 10.0));
    double closest_m = 1.0;
    Twist2 command;
    for (int step = 0; !follower.is_finished() && step * control_step_s < 40.0; ++step) {
      if (step % 5 == 0) {
        for (std::size_t beam = 0; beam < scan.size(); ++beam) {
          const Eigen::Vector2d direction = pose.rotation() * scan.direction(beam);
          const double range_m = cast_ray_m(world, pose.position(), direction, 10.0, is_wall);
          scan.set_range_m(beam, range_m < 10.0 ? std::min(range_m + random.normal(0.0, 0.01), 10.0) : 10.0);
        }
        const Twist2 wanted = sees ? follower.command(pose, scan, {}) : follower.command(pose);
        command = guard_command(wanted, scan);
      }
      pose = driven(pose, command);
      closest_m = std::min(closest_m, distance_to_squares_m(world, pose.position()));
    }
    CAPTURE(trial, closest_m, pose.x_m, pose.y_m);
    CHECK(closest_m > 0.2);
    if (sees) CHECK(follower.is_finished());
    if (!sees && follower.is_finished()) ++passed_blindly;
  }
  CHECK(passed_blindly <= 2);
}
