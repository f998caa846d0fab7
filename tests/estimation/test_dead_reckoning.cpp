#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "room.hpp"

using namespace incognita;

TEST_CASE("Dead reckoning's variance grows as the errors of simulated odometry do", "[estimation]") {
  // 10 s straight on at 1 m/s; speed and turn rate err anew every 0.02 s by 0.05 m/s and 0.02 rad/s.
  constexpr int runs = 3000;
  constexpr int steps = 500;
  constexpr double step_s = 0.02;
  Random random(1);
  double along = 0.0;
  double across = 0.0;
  double turn = 0.0;
  double across_turn = 0.0;
  for (int run = 0; run < runs; ++run) {
    double x_m = 0.0;
    double y_m = 0.0;
    double yaw_rad = 0.0;
    for (int step = 0; step < steps; ++step) {
      const double length_m = (1.0 + random.normal(0.0, 0.05)) * step_s;
      x_m += length_m * std::cos(yaw_rad);
      y_m += length_m * std::sin(yaw_rad);
      yaw_rad += random.normal(0.0, 0.02) * step_s;
    }
    along += (x_m - 10.0) * (x_m - 10.0) / runs;
    across += y_m * y_m / runs;
    turn += yaw_rad * yaw_rad / runs;
    across_turn += y_m * yaw_rad / runs;
  }

  DeadReckoning filter;
  for (int step = 0; step < steps; ++step) filter.predict({step_s, 0.0, 0.0}, step_s);
  const Eigen::Matrix3d& covariance = filter.belief().covariance;
  REQUIRE(filter.belief().pose.x_m == Approx(10.0));
  // A sample variance of 3000 runs is known within 2.6 %, one sigma.
  REQUIRE(covariance(0, 0) == Approx(along).epsilon(0.1));
  REQUIRE(covariance(2, 2) == Approx(turn).epsilon(0.1));
  REQUIRE(covariance(1, 2) == Approx(across_turn).epsilon(0.1));
  // The filter's noise has no preferred direction: across, it adds what the simulation has along alone.
  REQUIRE(covariance(1, 1) == Approx(across + along).epsilon(0.1));
}

TEST_CASE("Dead reckoning integrates odometry and learns nothing from scans", "[estimation]") {
  DeadReckoning::Params params;
  params.start = {{1.0, 2.0, 3.0}, Eigen::Matrix3d::Identity()};
  DeadReckoning filter(params);
  REQUIRE(filter.is_ready());
  const Map<> map;
  const Scan<2> scan = room::scan_of(room::box(room::kTurned), room::kTurned);
  const CorrectionReport report = filter.correct(scan, map);
  filter.learn(scan);
  REQUIRE(report.associations == 0);
  REQUIRE(filter.belief().pose.yaw_rad == 3.0);
  REQUIRE(filter.belief().covariance == Eigen::Matrix3d::Identity());

  filter.predict({0.0, 0.0, 1.0}, 0.0);
  REQUIRE(filter.belief().pose.yaw_rad == Approx(4.0 - 2.0 * std::acos(-1.0)));
  const PoseBelief belief = filter.belief();
  const PoseBelief imagined = filter.imagine_motion(belief, {1.0, 0.0, 0.0}, 1.0);
  filter.predict({1.0, 0.0, 0.0}, 1.0);
  REQUIRE(imagined.pose.x_m == filter.belief().pose.x_m);
  REQUIRE(imagined.covariance == filter.belief().covariance);
  const std::vector<RayObservation> hits{{{1.0, 0.0}, 0.0, 1.0}};
  REQUIRE(filter.imagine_scan(belief, hits, 1, 10.0).covariance == belief.covariance);
}

TEST_CASE("Dead reckoning refuses noise and starts that are none", "[estimation]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  DeadReckoning::Params params;
  params.noise.yaw_rad_per_sqrt_s = -1.0;
  REQUIRE_THROWS_AS(DeadReckoning(params), std::invalid_argument);
  params = {};
  params.start.pose.x_m = kNan;
  REQUIRE_THROWS_AS(DeadReckoning(params), std::invalid_argument);
  params = {};
  params.start.covariance(0, 1) = 0.1;
  REQUIRE_THROWS_AS(DeadReckoning(params), std::invalid_argument);
  params = {};
  params.noise = {0.0, 0.0};
  REQUIRE_NOTHROW(DeadReckoning(params));
}
