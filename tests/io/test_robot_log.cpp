#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/robot_log.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

constexpr double infinite_m = std::numeric_limits<double>::infinity();

std::vector<LogScan> one_scan(std::vector<double> ranges_m) { return {{0.0, {}, std::move(ranges_m)}}; }

/// Readings of a smooth density up to `longest_m`, none of them alike.
std::vector<LogScan> smooth_scans(double longest_m, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> ranges_m;
  for (std::size_t i = 0; i < count; ++i) ranges_m.push_back(random.uniform(0.1, longest_m));
  return one_scan(ranges_m);
}

}  // namespace

TEST_CASE("robot log: beams of a SICK start at the right") {
  for (const std::size_t count : {180U, 181U, 360U, 361U}) {
    CAPTURE(count);
    const BeamAngles angles = default_beam_angles(count).value();
    const double last_rad = angles.first_rad + angles.increment_rad * static_cast<double>(count - 1);
    CHECK(angles.first_rad == Approx(-std::numbers::pi / 2));
    const bool has_both_ends = count % 2 == 1;
    CHECK(last_rad == Approx(std::numbers::pi / 2 - (has_both_ends ? 0.0 : angles.increment_rad)));
  }
  CHECK_FALSE(default_beam_angles(0));
  CHECK_FALSE(default_beam_angles(541));
}

TEST_CASE("range limits: codes at the top of the scale are found") {
  for (const double longest_m : {8.0, 25.0, 50.0}) {
    for (const double code_m : {81.83, 1e3}) {
      CAPTURE(longest_m, code_m);
      std::vector<LogScan> scans = smooth_scans(longest_m, 5000, 1);
      double largest_m = 0.0;
      for (const double range_m : scans[0].ranges_m) largest_m = std::max(largest_m, range_m);
      // A SICK has several codes within a thousandth.
      for (int i = 0; i < 40; ++i) scans[0].ranges_m.push_back(code_m * (1.0 + 2.5e-4 * (i % 4)));
      const RangeLimits limits = detect_range_limits(scans);
      CHECK(limits.no_return_m == code_m);
      CHECK(limits.usable_m > largest_m);
      CHECK(limits.usable_m < largest_m + 1e-9);
    }
  }
}

TEST_CASE("range limits: readings clipped to the range are found") {
  std::vector<LogScan> scans = smooth_scans(12.0, 5000, 2);
  for (double& range_m : scans[0].ranges_m) range_m = std::min(range_m, 10.0);
  CHECK(detect_range_limits(scans).no_return_m == Approx(10.0).epsilon(0.002));
}

TEST_CASE("range limits: a log without codes has none") {
  for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
    const std::vector<LogScan> scans = smooth_scans(20.0, 20000, seed);
    const RangeLimits limits = detect_range_limits(scans);
    CHECK(limits.no_return_m == infinite_m);
    CHECK(limits.usable_m == Approx(20.0).epsilon(0.01));
  }
  // A few stray readings at one place are no pile.
  std::vector<LogScan> scans = smooth_scans(20.0, 100, 7);
  for (int i = 0; i < 9; ++i) scans[0].ranges_m.push_back(40.0);
  CHECK(detect_range_limits(scans).no_return_m == infinite_m);
}

TEST_CASE("range limits: what is no reading counts for nothing") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RangeLimits limits =
      detect_range_limits(one_scan({1.0, nan, infinite_m, -infinite_m, -3.0, 0.0, 2.0}));
  CHECK(limits.no_return_m == infinite_m);
  CHECK(limits.usable_m == Approx(2.0));
  CHECK(detect_range_limits(one_scan({nan, 0.0, infinite_m})).usable_m == 0.0);
  CHECK(detect_range_limits({}).usable_m == 0.0);
  CHECK(detect_range_limits(one_scan(std::vector<double>(20, 2.0))).no_return_m == infinite_m);
}

TEST_CASE("robot log: readings become what a scan takes") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> ranges_m{1.0, 5.0, 7.0, 30.0, nan, 0.0};
  RobotLogParams params;
  params.beams = BeamAngles{-1.0, 0.25};
  params.no_return_m = 30.0;
  params.usable_m = 6.0;
  const auto readings = [&] {
    const RobotLog log = detail::finish_log(one_scan(ranges_m), params, std::nullopt, {}, "a.log");
    CHECK(log.beams.range_max_m == 6.0);
    CHECK(log.beams.directions[1].x() == Approx(std::cos(-0.75)));
    CHECK(log.beams.directions[1].y() == Approx(std::sin(-0.75)));
    const Scan<2> scan(log.beams, log.scans[0].ranges_m);
    std::vector<Reading> all;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) all.push_back(scan.reading(beam));
    return all;
  };
  using enum Reading;
  // What was met beyond the usable range leaves the way there free; what never came back says nothing.
  CHECK(readings() == std::vector<Reading>{hit, hit, clear, invalid, invalid, invalid});
  params.no_return_is_clear = true;
  CHECK(readings() == std::vector<Reading>{hit, hit, clear, clear, invalid, invalid});
}

TEST_CASE("robot log: without limits the longest reading stays a hit") {
  const RobotLog log = detail::finish_log(one_scan(std::vector<double>{1.0, 9.0}),
                                          {BeamAngles{0.0, 0.1}, {}, {}, {}}, std::nullopt, {}, "a.log");
  const Scan<2> scan(log.beams, log.scans[0].ranges_m);
  CHECK(scan.reading(0) == Reading::hit);
  CHECK(scan.reading(1) == Reading::hit);
}

TEST_CASE("robot log: scans come in the order of time") {
  std::vector<LogScan> scans{
      {3.0, {3, 0, 0}, {1.0}}, {1.0, {1, 0, 0}, {1.0}}, {2.0, {2, 0, 0}, {1.0}}, {1.0, {4, 0, 0}, {1.0}}};
  const RobotLog log =
      detail::finish_log(scans, {BeamAngles{0.0, 0.1}, {}, {}, {}}, std::nullopt, {}, "a.log");
  std::vector<double> x_m;
  for (const LogScan& scan : log.scans) x_m.push_back(scan.T_odom_robot.x_m);
  CHECK(x_m == std::vector<double>{1.0, 4.0, 2.0, 3.0});
  CHECK(log.duration_s() == 2.0);
}

TEST_CASE("robot log: what is missing is said") {
  const auto finish = [](const std::vector<LogScan>& scans) {
    return refusal([&] { return detail::finish_log(scans, {}, std::nullopt, {}, "a.log"); });
  };
  CHECK_THAT(finish({}), Contains("a.log: holds no scans"));
  CHECK_THAT(finish(one_scan({1.0, 2.0})), Contains("2 readings") && Contains("180, 181, 360 and 361"));
  CHECK_THAT(finish(one_scan(std::vector<double>(180, 0.0))), Contains("not one reading"));
}

TEST_CASE("robot log: bad parameters are refused") {
  const auto message = [](const RobotLogParams& params) {
    try {
      params.validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RobotLogParams params;
  CHECK(message(params).empty());
  params.beams = BeamAngles{nan, 1.0};
  CHECK_THAT(message(params), Contains("beams.first_rad"));
  params.beams = BeamAngles{1.0, infinite_m};
  CHECK_THAT(message(params), Contains("beams.increment_rad"));
  params = {};
  params.T_robot_laser = Pose2{nan, 0, 0};
  CHECK_THAT(message(params), Contains("T_robot_laser"));
  params = {};
  params.no_return_m = 0.0;
  CHECK_THAT(message(params), Contains("no_return_m is 0"));
  params = {};
  params.usable_m = -1.0;
  CHECK_THAT(message(params), Contains("usable_m is -1"));
}
