#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/simulation/odometry.hpp"

using namespace incognita;

TEST_CASE("Odometry without noise is the true motion", "[simulation]") {
  Odometry odometry({.speed_sigma_m_per_s = 0.0, .turn_rate_sigma_rad_per_s = 0.0}, 1);
  const Pose2 measured = odometry.measure({0.7, 0.3}, 0.02);
  const Pose2 expected = unicycle_motion({0.7, 0.3}, 0.02);
  CHECK(measured.x_m == expected.x_m);
  CHECK(measured.y_m == expected.y_m);
  CHECK(measured.yaw_rad == expected.yaw_rad);
}

TEST_CASE("Odometry's noise has the given sigmas, drawn anew each step", "[simulation]") {
  const OdometryParams params;
  Odometry odometry(params, 2);
  const double step_s = 0.02;
  const int count = 20000;
  double speed_sum = 0.0, speed_squares = 0.0, turn_sum = 0.0, turn_squares = 0.0, product = 0.0;
  double previous = 0.0, successive = 0.0;
  for (int i = 0; i < count; ++i) {
    const Pose2 measured = odometry.measure({0.5, 0.2}, step_s);
    const double chord_m = std::copysign(measured.position().norm(), measured.x_m);
    const double speed = (chord_m / step_s - 0.5) / params.speed_sigma_m_per_s;
    const double turn = (measured.yaw_rad / step_s - 0.2) / params.turn_rate_sigma_rad_per_s;
    speed_sum += speed;
    speed_squares += speed * speed;
    turn_sum += turn;
    turn_squares += turn * turn;
    product += speed * turn;
    successive += speed * previous;
    previous = speed;
  }
  // In units of sigma; means have a standard deviation of 0.007, variances of 0.01.
  CHECK(speed_sum / count == Approx(0.0).margin(0.03));
  CHECK(turn_sum / count == Approx(0.0).margin(0.03));
  CHECK(speed_squares / count == Approx(1.0).margin(0.04));
  CHECK(turn_squares / count == Approx(1.0).margin(0.04));
  CHECK(product / count == Approx(0.0).margin(0.03));
  CHECK(successive / count == Approx(0.0).margin(0.03));
}

TEST_CASE("Odometry with a seed repeats itself; its noise does not depend on the motion", "[simulation]") {
  Odometry one({}, 3);
  Odometry same({}, 3);
  Odometry moving({}, 3);
  Odometry other({}, 4);
  int differs = 0;
  for (int i = 0; i < 50; ++i) {
    const Pose2 a = one.measure({0.0, 0.0}, 0.02);
    const Pose2 b = same.measure({0.0, 0.0}, 0.02);
    CHECK(a.x_m == b.x_m);
    CHECK(a.y_m == b.y_m);
    CHECK(a.yaw_rad == b.yaw_rad);
    CHECK(moving.measure({1.0, 1.0}, 0.02).yaw_rad - 0.02 == Approx(a.yaw_rad).margin(1e-15));
    differs += other.measure({0.0, 0.0}, 0.02).x_m != a.x_m ? 1 : 0;
  }
  CHECK(differs == 50);
}

TEST_CASE("Odometry refuses sigmas that are none", "[simulation]") {
  CHECK_THROWS_AS(Odometry({.speed_sigma_m_per_s = -0.1}, 1), std::invalid_argument);
  CHECK_THROWS_AS(Odometry({.turn_rate_sigma_rad_per_s = std::numeric_limits<double>::infinity()}, 1),
                  std::invalid_argument);
}
