#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/simulation/robot.hpp"
#include "plans.hpp"

namespace {

using namespace incognita;

constexpr double step_s = 0.02;

void drive(Robot& robot, const World& world, const Twist2& command, int steps) {
  for (int i = 0; i < steps; ++i) robot.move(world, command, step_s);
}

}  // namespace

TEST_CASE("A robot keeps to its limits and to the arc", "[simulation]") {
  const World world(test::room(200, 200, 0.05));
  Robot robot(world, {5.0, 5.0, 0.3});
  const Twist2 done = robot.move(world, {9.0, -7.0}, step_s);
  CHECK(done.speed_m_per_s == Approx(1.0));
  CHECK(done.turn_rate_rad_per_s == -1.0);
  CHECK(robot.move(world, {-9.0, 7.0}, step_s).speed_m_per_s == Approx(-1.0));
  CHECK(robot.T_world_robot().yaw_rad == Approx(0.3));
  CHECK(robot.distance_m() == Approx(0.04));

  Robot other(world, {5.0, 5.0, 0.3});
  drive(other, world, {0.7, 0.4}, 100);
  const Pose2 expected = Pose2{5.0, 5.0, 0.3} * unicycle_motion({0.7, 0.4}, 2.0);
  CHECK(other.T_world_robot().x_m == Approx(expected.x_m).epsilon(1e-12));
  CHECK(other.T_world_robot().y_m == Approx(expected.y_m).epsilon(1e-12));
  CHECK(other.T_world_robot().yaw_rad == Approx(expected.yaw_rad).epsilon(1e-12));
  CHECK(other.distance_m() == Approx(1.4));
  CHECK(other.collisions() == 0);
}

TEST_CASE("A robot that drives at a wall stops before it: one collision", "[simulation]") {
  const World world(test::room(100, 100, 0.05));  // free to 4.95 m
  Robot robot(world, {4.0, 2.5, 0.0});
  drive(robot, world, {1.0, 0.0}, 200);
  CHECK(robot.collisions() == 1);
  CHECK(robot.T_world_robot().x_m == Approx(4.75).margin(2e-6));
  CHECK(robot.T_world_robot().x_m <= 4.75);
  CHECK(robot.T_world_robot().y_m == 2.5);
  CHECK(robot.distance_m() == Approx(0.75).margin(2e-6));
  CHECK(world.disc_is_clear(robot.T_world_robot().position(), 0.2));
  CHECK(robot.move(world, {1.0, 0.5}, step_s).speed_m_per_s < 1e-3);
  CHECK(robot.T_world_robot().yaw_rad == Approx(0.01));  // it turns on the spot

  // Turning there is still the same contact; going away and coming back is another.
  drive(robot, world, {0.0, 1.0}, 10);
  drive(robot, world, {1.0, 0.0}, 10);
  CHECK(robot.collisions() == 1);
  drive(robot, world, {-0.5, 0.0}, 1);
  drive(robot, world, {1.0, 0.0}, 10);
  CHECK(robot.collisions() == 2);
}

TEST_CASE("A robot backs off a wall and drives along it without a collision", "[simulation]") {
  const World world(test::room(100, 100, 0.05));
  Robot robot(world, {1.0, 0.25 + 1e-9, 0.0});  // a nanometre from the wall below
  drive(robot, world, {1.0, 0.0}, 100);
  CHECK(robot.collisions() == 0);
  CHECK(robot.T_world_robot().x_m == Approx(3.0));
  drive(robot, world, {0.0, -1.0}, 50);
  drive(robot, world, {1.0, 0.0}, 10);
  CHECK(robot.collisions() == 1);
  drive(robot, world, {-1.0, 0.0}, 50);
  CHECK(robot.T_world_robot().y_m > 1.0);
  CHECK(robot.collisions() == 1);
}

TEST_CASE("A corner in the way counts, a corner beside it does not", "[simulation]") {
  std::vector<std::string> rows(40, std::string(60, '.'));
  rows[39] = std::string(30, '.') + std::string(30, '#');  // the wall's corner is at (1.5, 0.05)
  const World world(test::plan_from_rows(rows, 0.05));
  Robot passing(world, {0.5, 0.2501, 0.0});
  drive(passing, world, {1.0, 0.0}, 80);
  CHECK(passing.collisions() == 0);
  CHECK(passing.T_world_robot().x_m == Approx(2.1));

  Robot grazing(world, {0.5, 0.24, 0.0});
  drive(grazing, world, {1.0, 0.0}, 80);
  CHECK(grazing.collisions() == 1);
  // The disc of 0.2 m touches the corner where its centre is sqrt(0.2^2 - 0.19^2) before it.
  CHECK(grazing.T_world_robot().x_m == Approx(1.5 - std::sqrt(0.04 - 0.0361)).margin(3e-6));
}

TEST_CASE("A robot of 0.4 m fits through a door of 0.45 m and not through one of 0.35 m", "[simulation]") {
  for (const int door_pixels : {9, 7}) {
    std::vector<std::string> rows(41, std::string(80, '.'));
    for (int y = 0; y < 41; ++y) {
      if (std::abs(y - 20) > door_pixels / 2) rows[static_cast<std::size_t>(y)].replace(40, 3, "###");
    }
    const World world(test::plan_from_rows(rows, 0.05));
    Robot robot(world, {1.0, 20.5 * 0.05, 0.0});
    drive(robot, world, {0.8, 0.0}, 125);
    CHECK(robot.collisions() == (door_pixels == 9 ? 0 : 1));
    CHECK(robot.T_world_robot().x_m == (door_pixels == 9 ? Approx(3.0) : Approx(1.9).margin(0.11)));
  }
}

TEST_CASE("Whatever it is told, a robot never overlaps a wall", "[simulation]") {
  Random random(1);
  std::size_t collisions = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const World world(test::random_plan(60, 60, 0.05, random));
    Robot robot(world, random_start(world, 0.12, random), {.radius_m = 0.12});
    double distance_m = 0.0;
    Pose2 before = robot.T_world_robot();
    for (int i = 0; i < 1500; ++i) {
      const Twist2 command{random.uniform(-0.3, 1.5), random.uniform(-2.0, 2.0)};
      const Twist2 done = robot.move(world, command, step_s);
      REQUIRE(world.clearance_m(robot.T_world_robot().position()) >= 0.12);
      REQUIRE(std::abs(done.speed_m_per_s) <= 1.0 + 1e-12);
      const double moved_m = (robot.T_world_robot().position() - before.position()).norm();
      REQUIRE(moved_m <= std::abs(done.speed_m_per_s) * step_s + 1e-12);
      distance_m += std::abs(done.speed_m_per_s) * step_s;
      before = robot.T_world_robot();
    }
    CHECK(robot.distance_m() == Approx(distance_m));
    collisions += robot.collisions();
  }
  CHECK(collisions > 20);
}

TEST_CASE("A robot refuses what makes no sense", "[simulation]") {
  const World world(test::room(100, 100, 0.05));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Pose2 middle{2.5, 2.5, 0.0};
  CHECK_THROWS_AS(Robot(world, {0.1, 2.5, 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(Robot(world, {2.5, 2.5, nan}), std::invalid_argument);
  CHECK_THROWS_AS(Robot(world, middle, {.radius_m = -0.1}), std::invalid_argument);
  CHECK_THROWS_AS(Robot(world, middle, {.speed_max_m_per_s = 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(Robot(world, middle, {.turn_rate_max_rad_per_s = nan}), std::invalid_argument);
  Robot robot(world, middle);
  CHECK_THROWS_AS(robot.move(world, {nan, 0.0}, step_s), std::invalid_argument);
  CHECK_THROWS_AS(robot.move(world, {0.0, nan}, step_s), std::invalid_argument);
  CHECK_THROWS_AS(robot.move(world, {1.0, 0.0}, 0.0), std::invalid_argument);
  CHECK(robot.T_world_robot().position() == middle.position());
  CHECK(robot.distance_m() == 0.0);
}
