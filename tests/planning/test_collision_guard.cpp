#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/planning/collision_guard.hpp"

using namespace incognita;

namespace {

/// Where a robot that starts at the origin along x is after `along_m` of an arc.
Eigen::Vector2d on_arc(double curvature_per_m, double along_m) {
  if (curvature_per_m == 0.0) return {along_m, 0.0};
  const double turn_rad = curvature_per_m * along_m;
  return {std::sin(turn_rad) / curvature_per_m, (1.0 - std::cos(turn_rad)) / curvature_per_m};
}

Scan<2> scan_of(const std::vector<Eigen::Vector2d>& points_m) {
  BeamPattern<2> beams;
  std::vector<double> ranges_m;
  for (const Eigen::Vector2d& point_m : points_m) {
    beams.directions.push_back(point_m.normalized());
    ranges_m.push_back(point_m.norm());
  }
  return {beams, ranges_m};
}

double stopping_m(double speed_m_per_s, const CollisionGuardParams& params) {
  return speed_m_per_s * params.reaction_time_s +
         speed_m_per_s * speed_m_per_s / (2.0 * params.deceleration_m_per_s2);
}

}  // namespace

TEST_CASE("The distance to contact is where a stepped drive first meets the obstacle", "[planning]") {
  Random random(1);
  int met = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double curvature_per_m = trial % 4 == 0   ? 0.0
                                   : trial % 4 == 1 ? random.uniform(-1e-4, 1e-4)
                                                    : random.uniform(-6.0, 6.0);
    const double radius_m = random.uniform(0.1, 0.5);
    const Eigen::Vector2d obstacle_m{random.uniform(-2.0, 2.0), random.uniform(-1.0, 1.0)};
    if (obstacle_m.norm() <= radius_m) continue;
    const double turn_m = curvature_per_m == 0.0 ? 3.0 : std::min(3.0, 6.28 / std::abs(curvature_per_m));
    double stepped_m = std::numeric_limits<double>::infinity();
    double nearest_m = std::numeric_limits<double>::infinity();
    for (double along_m = 0.0; along_m < turn_m; along_m += 1e-3) {
      const double distance_m = (on_arc(curvature_per_m, along_m) - obstacle_m).norm();
      nearest_m = std::min(nearest_m, distance_m);
      if (distance_m <= radius_m) {
        stepped_m = along_m;
        break;
      }
    }
    const double contact_m = distance_to_contact_m(obstacle_m, curvature_per_m, radius_m);
    if (stepped_m < turn_m) {
      REQUIRE(contact_m == Approx(stepped_m).margin(0.002 + 1e-3 * std::abs(curvature_per_m)));
      ++met;
    } else if (nearest_m > radius_m + 1e-3) {
      REQUIRE(contact_m > turn_m - 0.01);
    }
  }
  REQUIRE(met > 50);
}

TEST_CASE("An obstacle that is too near counts only when it gets nearer", "[planning]") {
  for (const double curvature_per_m : {0.0, 2.0, -2.0}) {
    REQUIRE(distance_to_contact_m({0.1, 0.05}, curvature_per_m, 0.2) == 0.0);
    REQUIRE(distance_to_contact_m({-0.1, 0.05}, curvature_per_m, 0.2) > 1.0);
  }
}

TEST_CASE("Noise does not make a flat wall look nearer than it is", "[planning]") {
  Random random(5);
  BeamPattern<2> beams = circular_beams(360, 10.0);
  Scan<2> scan(beams);
  double nearest_m = 10.0;
  double nearest_smoothed_m = 10.0;
  for (std::size_t beam = 30; beam < 150; ++beam) {  // a wall 0.22 m to the left
    scan.set_range_m(beam, 0.22 / scan.direction(beam).y() + random.normal(0.0, 0.01));
  }
  for (std::size_t beam = 30; beam < 150; ++beam) {
    nearest_m = std::min(nearest_m, scan.range_m(beam));
    nearest_smoothed_m = std::min(nearest_smoothed_m, smoothed_range_m(scan, beam));
  }
  CHECK(nearest_m < 0.205);
  CHECK(nearest_smoothed_m > nearest_m + 0.005);
}

TEST_CASE("A guarded robot can stop before all that it measures", "[planning]") {
  Random random(2);
  int slowed = 0;
  int crept = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    CollisionGuardParams params;
    params.margin_m = random.uniform(0.02, 0.1);
    params.reaction_time_s = random.uniform(0.0, 0.4);
    std::vector<Eigen::Vector2d> points_m;
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector2d point_m{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
      // Neighbouring beams that end at one place are taken for one reading, so places are kept apart.
      const bool apart = std::none_of(points_m.begin(), points_m.end(), [&](const Eigen::Vector2d& other_m) {
        return (other_m - point_m).norm() <= 0.05;
      });
      if (apart && point_m.norm() > params.robot_radius_m + params.creep_margin_m) points_m.push_back(point_m);
    }
    const Twist2 wanted{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const Twist2 given = guard_command(wanted, scan_of(points_m), params);

    REQUIRE(given.turn_rate_rad_per_s == wanted.turn_rate_rad_per_s);
    REQUIRE(std::abs(given.speed_m_per_s) <= std::abs(wanted.speed_m_per_s));
    REQUIRE(given.speed_m_per_s * wanted.speed_m_per_s >= 0.0);
    slowed += given.speed_m_per_s != wanted.speed_m_per_s ? 1 : 0;
    if (given.speed_m_per_s == 0.0) continue;
    const double speed_m_per_s = std::abs(given.speed_m_per_s);
    const bool creeps = speed_m_per_s <= params.creep_speed_m_per_s;
    crept += creeps && speed_m_per_s != std::abs(wanted.speed_m_per_s) ? 1 : 0;
    const double keep_m = params.robot_radius_m + (creeps ? params.creep_margin_m : params.margin_m);
    const double side = given.speed_m_per_s > 0.0 ? 1.0 : -1.0;
    double too_near_m = 0.0;
    for (int step = 0; step <= 100; ++step) {
      const double along_m = side * stopping_m(speed_m_per_s, params) * step / 100.0;
      const Eigen::Vector2d at_m = on_arc(given.turn_rate_rad_per_s / given.speed_m_per_s, along_m);
      for (const Eigen::Vector2d& point_m : points_m) {
        // What was within the margin must not come nearer.
        too_near_m = std::max(too_near_m, std::min(keep_m, point_m.norm()) - (at_m - point_m).norm());
      }
    }
    REQUIRE(too_near_m < 1e-9);
  }
  REQUIRE(slowed > 100);
  REQUIRE(crept > 10);
}

TEST_CASE("A command is not slowed for nothing, nor more than by a quarter too much", "[planning]") {
  const CollisionGuardParams params;
  const double keep_m = params.robot_radius_m + params.margin_m;
  const Twist2 wanted{1.0, 0.0};
  const double far_m = keep_m + stopping_m(1.0, params);
  REQUIRE(guard_command(wanted, scan_of({{far_m + 1e-6, 0.0}})).speed_m_per_s == 1.0);
  REQUIRE(guard_command(wanted, scan_of({{far_m - 1e-3, 0.0}})).speed_m_per_s == 0.75);
  // Beside and behind.
  REQUIRE(guard_command(wanted, scan_of({{0.5, keep_m + 0.001}, {-0.3, 0.0}})).speed_m_per_s == 1.0);
  for (double free_m = 0.03; free_m < 0.6; free_m += 0.01) {
    const double given_m_per_s = guard_command(wanted, scan_of({{keep_m + free_m, 0.0}})).speed_m_per_s;
    REQUIRE(stopping_m(given_m_per_s, params) <= free_m);
    REQUIRE(stopping_m(given_m_per_s / 0.75, params) > free_m);
  }
}

TEST_CASE("Turning in place is always allowed, and so is leaving", "[planning]") {
  const Scan<2> boxed_in = scan_of({{0.205, 0.0}, {0.0, 0.205}, {0.0, -0.205}, {-0.205, 0.0}});
  const Twist2 turn = guard_command({0.0, 1.0}, boxed_in);
  REQUIRE(turn.turn_rate_rad_per_s == 1.0);
  const Twist2 ahead = guard_command({0.5, 0.7}, boxed_in);
  REQUIRE(ahead.speed_m_per_s == 0.0);
  REQUIRE(ahead.turn_rate_rad_per_s == 0.7);

  const Scan<2> touched_ahead = scan_of({{0.19, 0.01}});
  REQUIRE(guard_command({0.5, 0.0}, touched_ahead).speed_m_per_s == 0.0);
  REQUIRE(guard_command({-0.5, 0.0}, touched_ahead).speed_m_per_s == -0.5);
}

TEST_CASE("Within the margin the robot creeps, and along a wall never stops", "[planning]") {
  const double creep_m_per_s = guard_command({0.5, 0.0}, scan_of({{0.225, 0.0}})).speed_m_per_s;
  REQUIRE(creep_m_per_s > 0.0);
  REQUIRE(creep_m_per_s <= 0.1);
  const auto beside_wall = [](double distance_m) {
    std::vector<Eigen::Vector2d> points_m;
    for (double x_m = -1.0; x_m < 1.0; x_m += 0.02) points_m.emplace_back(x_m, distance_m);
    return guard_command({0.5, 0.0}, scan_of(points_m)).speed_m_per_s;
  };
  REQUIRE(beside_wall(0.24) == 0.5);
  for (const double distance_m : {0.22, 0.208, 0.2}) {
    REQUIRE(beside_wall(distance_m) > 0.05);
    REQUIRE(beside_wall(distance_m) <= 0.1);
  }
}

TEST_CASE("Readings that are no hits do not slow the robot", "[planning]") {
  Scan<2> scan(circular_beams(4, 0.5));
  REQUIRE(guard_command({1.0, 0.0}, scan).speed_m_per_s == 1.0);  // nothing met
  for (const double bad_m : {std::nan(""), -0.1, 0.0, std::numeric_limits<double>::infinity(), 0.6}) {
    scan.set_range_m(0, bad_m);
    REQUIRE(guard_command({1.0, 0.0}, scan).speed_m_per_s == 1.0);
  }
  scan.set_range_m(0, 0.3);
  REQUIRE(guard_command({1.0, 0.0}, scan).speed_m_per_s < 0.5);
}

TEST_CASE("A door of 0.6 m is driven through without slowing down", "[planning]") {
  for (const double offset_m : {-0.05, 0.0, 0.05}) {
    for (double x_m = -2.0; x_m < 2.0; x_m += 0.05) {
      std::vector<Eigen::Vector2d> points_m;
      for (double along_m = 0.0; along_m <= 0.2; along_m += 0.01) {
        for (const double side : {-0.3, 0.3}) points_m.emplace_back(along_m - x_m, side - offset_m);
      }
      REQUIRE(guard_command({1.0, 0.0}, scan_of(points_m)).speed_m_per_s == 1.0);
    }
  }
}

TEST_CASE("Bad guard parameters are refused", "[planning]") {
  const Scan<2> scan(circular_beams(4, 1.0));
  const auto refused = [&](auto change, const char* message) {
    CollisionGuardParams params;
    change(params);
    REQUIRE_THROWS_WITH(guard_command({}, scan, params), Catch::Contains(message));
  };
  refused([](CollisionGuardParams& params) { params.robot_radius_m = 0.0; }, "robot_radius_m is 0");
  refused([](CollisionGuardParams& params) { params.margin_m = -0.1; }, "margin_m");
  refused([](CollisionGuardParams& params) { params.reaction_time_s = -0.1; }, "reaction_time_s");
  refused([](CollisionGuardParams& params) { params.deceleration_m_per_s2 = 0.0; }, "deceleration_m_per_s2");
  refused([](CollisionGuardParams& params) { params.creep_margin_m = 0.05; }, "creep_margin_m is 0.05");
  refused([](CollisionGuardParams& params) { params.creep_speed_m_per_s = -1.0; }, "creep_speed_m_per_s");
  refused([](CollisionGuardParams& params) { params.speed_min_m_per_s = 0.0; }, "speed_min_m_per_s");
}

TEST_CASE("The first beam follows the last when ranges are smoothed", "[planning]") {
  Scan<2> scan(circular_beams(360, 10.0));
  const std::vector<double> around_m{1.02, 0.98, 1.0, 1.02, 1.03};  // beams 358, 359, 0, 1, 2
  for (std::size_t k = 0; k < around_m.size(); ++k) scan.set_range_m((358 + k) % 360, around_m[k]);
  CHECK(smoothed_range_m(scan, 0) == Approx(1.01));
  CHECK(smoothed_range_m(scan, 359, 1) == Approx(1.0));
  Scan<2> single(circular_beams(1, 10.0));
  single.set_range_m(0, 3.0);
  CHECK(smoothed_range_m(single, 0) == 3.0);
}
