#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/planning/retreat.hpp"

using namespace incognita;

namespace {

/// A scan of 360 beams from the middle of a passage that is closed but for one end: walls `half_width_m` to either side of
/// the way out, which lies at out_rad, and one across it behind the robot.
Scan<2> dead_end(double out_rad, double half_width_m) {
  Scan<2> scan(circular_beams(360, 10.0));
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const Eigen::Vector2d& direction = scan.direction(beam);
    const double along = std::cos(out_rad) * direction.x() + std::sin(out_rad) * direction.y();
    const double across = std::cos(out_rad) * direction.y() - std::sin(out_rad) * direction.x();
    double range_m = half_width_m / std::max(std::abs(across), 1e-9);
    if (along < 0.0) range_m = std::min(range_m, half_width_m / -along);
    scan.set_range_m(beam, std::min(range_m, 10.0));
  }
  return scan;
}

}  // namespace

TEST_CASE("A robot in a dead end turns towards its opening, and drives once it faces it", "[planning]") {
  Random random(3);
  const RetreatParams params;
  for (int trial = 0; trial < 100; ++trial) {
    const double out_rad = random.uniform(-std::numbers::pi, std::numbers::pi);
    const Scan<2> scan = dead_end(out_rad, random.uniform(0.23, 0.3));
    const Twist2 command = Retreat({}, scan, {}).command({}, scan);
    CAPTURE(out_rad);
    if (std::abs(out_rad) > params.aim_rad + 0.1) {
      CHECK(command.speed_m_per_s == 0.0);
      if (std::abs(out_rad) < std::numbers::pi - 0.2) CHECK(command.turn_rate_rad_per_s * out_rad > 0.0);
      CHECK(std::abs(command.turn_rate_rad_per_s) <= params.turn_rate_rad_per_s);
    }
    if (std::abs(out_rad) < params.aim_rad - 0.09) CHECK(command.speed_m_per_s == params.speed_m_per_s);
  }
}

TEST_CASE("With nothing near, a retreat drives straight on, and is over when it has gone its distance", "[planning]") {
  const Scan<2> nothing(circular_beams(90, 10.0));
  Retreat retreat({2.0, 1.0, 0.5}, nothing, {});
  const Twist2 command = retreat.command({2.0, 1.0, 0.5}, nothing);
  CHECK(command.speed_m_per_s == RetreatParams{}.speed_m_per_s);
  CHECK(std::abs(command.turn_rate_rad_per_s) < 1e-12);
  CHECK_FALSE(retreat.is_over({2.09, 1.0, 0.5}));
  CHECK(retreat.is_over({2.0, 1.11, 0.5}));
}

TEST_CASE("A robot beside a wall, or in a corner, gets away from it whatever the noise and its heading", "[planning]") {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const bool in_corner = trial % 2 == 1;
    const double wall_m = random.uniform(0.204, 0.225);
    const Pose2 start{wall_m, in_corner ? random.uniform(0.204, 0.225) : 1.0,
                      random.uniform(-std::numbers::pi, std::numbers::pi)};  // walls along x = 0 and y = 0
    Pose2 pose = start;
    const auto scan_at = [&](const Pose2& at) {
      Scan<2> scan(circular_beams(360, 10.0));
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        const Eigen::Vector2d direction = at.rotation() * scan.direction(beam);
        double range_m = direction.x() < -1e-6 ? at.x_m / -direction.x() : 10.0;
        if (in_corner && direction.y() < -1e-6) range_m = std::min(range_m, at.y_m / -direction.y());
        if (range_m < 10.0) scan.set_range_m(beam, std::min(10.0, range_m + random.normal(0.0, 0.01)));
      }
      return scan;
    };
    Retreat retreat(pose, scan_at(pose), {});
    int scans = 0;
    for (; scans < 300 && !retreat.is_over(pose); ++scans) {
      const Twist2 command = retreat.command(pose, scan_at(pose));
      pose = pose * Pose2{0.1 * command.speed_m_per_s, 0.0, 0.1 * command.turn_rate_rad_per_s};
      REQUIRE(pose.x_m > 0.2);
      if (in_corner) REQUIRE(pose.y_m > 0.2);
    }
    CAPTURE(trial, start.x_m, start.y_m, start.yaw_rad);
    CHECK(scans < 200);
  }
}

TEST_CASE("Parameters of a retreat out of bounds are refused by name", "[planning]") {
  const Scan<2> scan(circular_beams(4, 10.0));
  RetreatParams params;
  params.headings = 3;
  CHECK_THROWS_WITH(Retreat({}, scan, {}, params), Catch::Contains("headings") && Catch::Contains("3"));
  params = {};
  params.look_m = -0.5;
  CHECK_THROWS_WITH(Retreat({}, scan, {}, params), Catch::Contains("look_m") && Catch::Contains("-0.5"));
}
