#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "incognita/core/random.hpp"
#include "incognita/geometry/unicycle.hpp"

using namespace incognita;

TEST_CASE("A unicycle's arc against many small straight steps", "[geometry]") {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Twist2 twist{random.uniform(-2.0, 2.0), random.uniform(-3.0, 3.0)};
    const double duration_s = random.uniform(0.01, 3.0);
    const int steps = 20000;
    Pose2 expected;
    for (int i = 0; i < steps; ++i) {
      // The midpoint rule: its error falls with the square of the step.
      const double yaw_rad = twist.turn_rate_rad_per_s * duration_s * (i + 0.5) / steps;
      expected.x_m += twist.speed_m_per_s * duration_s / steps * std::cos(yaw_rad);
      expected.y_m += twist.speed_m_per_s * duration_s / steps * std::sin(yaw_rad);
    }
    const Pose2 pose = unicycle_motion(twist, duration_s);
    CHECK(pose.x_m == Approx(expected.x_m).margin(1e-7));
    CHECK(pose.y_m == Approx(expected.y_m).margin(1e-7));
    const double turn_rad = twist.turn_rate_rad_per_s * duration_s;
    CHECK(angle_between_rad(pose.yaw_rad, turn_rad) == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE("Arcs that can be told without a sum", "[geometry]") {
  const Pose2 quarter = unicycle_motion({2.0, 1.0}, std::numbers::pi / 2.0);  // on a circle of 2 m
  CHECK(quarter.x_m == Approx(2.0));
  CHECK(quarter.y_m == Approx(2.0));
  CHECK(quarter.yaw_rad == Approx(std::numbers::pi / 2.0));
  const Pose2 straight = unicycle_motion({-1.5, 0.0}, 2.0);
  CHECK(straight.x_m == -3.0);
  CHECK(straight.y_m == 0.0);
  const Pose2 nearly_straight = unicycle_motion({1.0, 1e-12}, 1.0);
  CHECK(nearly_straight.x_m == Approx(1.0).epsilon(1e-15));
  CHECK(nearly_straight.y_m == Approx(0.5e-12));
  const Pose2 on_the_spot = unicycle_motion({0.0, 1.0}, 4.0);
  CHECK(on_the_spot.position().norm() == 0.0);
  CHECK(on_the_spot.yaw_rad == Approx(4.0 - 2.0 * std::numbers::pi));
}

TEST_CASE("Halves of an arc make the whole", "[geometry]") {
  const Twist2 twist{0.8, -0.7};
  const Pose2 half = unicycle_motion(twist, 0.65);
  const Pose2 whole = unicycle_motion(twist, 1.3);
  const Pose2 both = half * half;
  CHECK(both.x_m == Approx(whole.x_m));
  CHECK(both.y_m == Approx(whole.y_m));
  CHECK(both.yaw_rad == Approx(whole.yaw_rad));
}

TEST_CASE("A state with a unit vector for its heading drives the same arcs", "[geometry]") {
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    Pose2 pose{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.0, 3.0)};
    UnicycleState state(pose);
    for (int step = 0; step < 100; ++step) {
      const Twist2 twist{random.uniform(-2.0, 2.0), step % 7 == 0 ? 0.0 : random.uniform(-3.0, 3.0)};
      const double duration_s = random.uniform(0.01, 1.0);
      pose = pose * unicycle_motion(twist, duration_s);
      state.drive(twist, duration_s);
    }
    CHECK(state.x_m == Approx(pose.x_m).margin(1e-12));
    CHECK(state.y_m == Approx(pose.y_m).margin(1e-12));
    CHECK(state.cosine == Approx(std::cos(pose.yaw_rad)).margin(1e-12));
    CHECK(state.sine == Approx(std::sin(pose.yaw_rad)).margin(1e-12));
  }
}
