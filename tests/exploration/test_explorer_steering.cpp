#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "incognita/planning/clearance_window.hpp"
#include "incognita/planning/mppi.hpp"
#include "incognita/planning/room_aside.hpp"
#include "small_office.hpp"

using namespace incognita;

namespace {

/// Drives until the explorer has a goal.
void find_goal(Explorer<>& explorer, Simulator& simulator) {
  test::run_mission(explorer, simulator, 1.9);
  REQUIRE(explorer.goal());
}

}  // namespace

TEST_CASE("another controller steers along the chosen path, under the guard") {
  Simulator simulator = test::office_simulator(0.9, 6);
  Explorer<> explorer(test::quick_params());
  find_goal(explorer, simulator);
  double progress_m = 0.0;
  int asked = 0;
  const auto as_followed = [&](const Pose2& T_map_robot, const Scan<2>& scan, const PathFollower& course) {
    ++asked;
    CHECK(T_map_robot.position() == explorer.belief().pose.position());
    CHECK(&scan == &simulator.scan());
    CHECK(course.path().points_m().back() == *explorer.goal());
    CHECK(course.progress_m() >= progress_m);
    progress_m = course.progress_m();
    return PathFollower(course).command(T_map_robot);
  };
  const Eigen::Vector2d goal_m = *explorer.goal();
  Twist2 command;
  for (int step = 0; step < 50 * 60 && explorer.goal() == goal_m; ++step) {
    explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    if (explorer.decide()) break;
    command = explorer.command(simulator.scan(), as_followed);
  }
  CHECK(asked > 5);
  CHECK(progress_m > 0.3);
  CHECK(explorer.decision().reason != DecisionReason::overdue);
  CHECK(simulator.collisions() == 0);

  // Into a wall only as far as the guard allows.
  for (int step = 0; step < 50 * 15; ++step) {
    explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    command = explorer.command(simulator.scan(), [&](const Pose2&, const Scan<2>&, const PathFollower&) { return Twist2{1.0, 0.0}; });
  }
  CHECK(command.speed_m_per_s <= explorer.params().guard.creep_speed_m_per_s);
  CHECK(simulator.collisions() == 0);
}

TEST_CASE("a twist that is none is refused, and in a pause nobody is asked") {
  Simulator simulator = test::office_simulator(0.9, 6);
  Explorer<> explorer(test::quick_params());
  find_goal(explorer, simulator);
  const auto wanting = [&](const Twist2& twist) {
    return explorer.command(simulator.scan(), [&](const Pose2&, const Scan<2>&, const PathFollower&) { return twist; });
  };
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_THROWS_WITH(wanting({not_a_number, 0.0}), "Explorer::command: the wanted speed_m_per_s is nan, but must be finite");
  REQUIRE_THROWS_WITH(wanting({0.0, std::numeric_limits<double>::infinity()}),
                      "Explorer::command: the wanted turn_rate_rad_per_s is inf, but must be finite");
  CHECK(wanting({0.0, 0.3}).turn_rate_rad_per_s == 0.3);
  explorer.pause();
  CHECK(wanting({0.0, 0.3}).turn_rate_rad_per_s == 0.0);
}

TEST_CASE("two rooms are explored by MPPI without touching a wall") {
  Simulator simulator = test::office_simulator(0.9, 4);
  Explorer<> explorer(test::quick_params());
  MppiParams params;
  params.samples = 128;
  params.robot_radius_m = explorer.params().guard.robot_radius_m + explorer.params().guard.creep_margin_m;
  MppiController controller(params);
  ClearanceWindow window(explorer.map().lattice());
  const double keep_m = params.robot_radius_m + params.margin_m;
  Twist2 command;
  for (bool first = true; first || (!explorer.stopped() && simulator.time_s() < 150.0); first = false) {
    if (!first) explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    explorer.decide();
    command = explorer.command(simulator.scan(), [&](const Pose2& T_map_robot, const Scan<2>& scan, const PathFollower& course) {
      const OccupancyGrid<2>& occupancy = explorer.occupancy().grid();
      window.measure(T_map_robot.position(), params.reach_m() + keep_m,
                     [&](const Index<2>& cell) { return occupancy.value(cell) == Occupancy::occupied; });
      return controller.command(T_map_robot, course, window.lower_to(near_hits_m(T_map_robot, scan, params.reach_m() + keep_m), keep_m));
    });
  }
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::complete);
  CHECK(simulator.collisions() == 0);
}
