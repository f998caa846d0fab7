#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/io/carmen_writer.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;

namespace {

constexpr double no_reading = std::numeric_limits<double>::quiet_NaN();
constexpr double degree_rad = std::numbers::pi / 180.0;

RobotLog log_of(std::size_t beams, double first_rad, double increment_rad) {
  RobotLog log;
  log.limits.usable_m = 30.0;
  log.beams = planar_beams(beams, first_rad, increment_rad, 30.0);
  return log;
}

/// Scans of a robot that wanders about, some readings invalid and many at the largest range.
RobotLog random_log(std::uint64_t seed, std::size_t beams, double first_rad, double increment_rad) {
  Random random(seed);
  RobotLog log = log_of(beams, first_rad, increment_rad);
  log.T_robot_laser = {0.2, -0.05, 0.1};
  for (int i = 0; i < 40; ++i) {
    LogScan scan;
    scan.time_s = 1.1e9 + 0.2 * i + random.uniform(0.0, 0.1);
    scan.T_odom_robot = {random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-3.14, 3.14)};
    for (std::size_t beam = 0; beam < beams; ++beam) {
      const double draw = random.uniform();
      scan.ranges_m.push_back(draw < 0.1 ? no_reading : draw < 0.3 ? 30.0 : random.uniform(0.1, 29.0));
    }
    log.scans.push_back(scan);
  }
  return log;
}

/// How the log above is read back: nothing is left to be detected.
RobotLogParams as_written(double no_return_m) {
  RobotLogParams params;
  params.usable_m = 30.0;
  params.no_return_m = no_return_m;
  return params;
}

void require_same(const RobotLog& a, const RobotLog& b) {
  REQUIRE(a.scans.size() == b.scans.size());
  REQUIRE(a.beams.directions.size() == b.beams.directions.size());
  CHECK(a.beams.range_max_m == b.beams.range_max_m);
  for (std::size_t beam = 0; beam < a.beams.directions.size(); ++beam) {
    CHECK((a.beams.directions[beam] - b.beams.directions[beam]).norm() < 1e-9);
  }
  CHECK((a.T_robot_laser.position() - b.T_robot_laser.position()).norm() < 1e-9);
  CHECK(a.T_robot_laser.yaw_rad == Approx(b.T_robot_laser.yaw_rad).margin(1e-9));
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    const LogScan& x = a.scans[i];
    const LogScan& y = b.scans[i];
    REQUIRE(x.time_s == y.time_s);
    REQUIRE(x.T_odom_robot.x_m == y.T_odom_robot.x_m);
    REQUIRE(x.T_odom_robot.y_m == y.T_odom_robot.y_m);
    REQUIRE(x.T_odom_robot.yaw_rad == Approx(y.T_odom_robot.yaw_rad).margin(1e-15));
    for (std::size_t beam = 0; beam < x.ranges_m.size(); ++beam) {
      REQUIRE((x.ranges_m[beam] == y.ranges_m[beam] || (std::isnan(x.ranges_m[beam]) && std::isnan(y.ranges_m[beam]))));
    }
  }
}

}  // namespace

TEST_CASE("CARMEN: a written log has CARMEN's messages field by field") {
  RobotLog log = log_of(3, -0.5, 0.5);
  log.scans = {{976.25, {1.0, 2.0, 0.5}, {1.5, no_reading, 2.5}}, {976.5, {1.25, 2.0, 0.5}, {1.5, 2.0, 2.25}}};
  CHECK(carmen_log_text(log) ==
        "# CARMEN log by incognita\n"
        "ODOM 1 2 0.5 0 0 0 976.25 incognita 976.25\n"
        "ROBOTLASER1 0 -0.5 1 0.5 30 0 0 3 1.5 nan 2.5 0 1 2 0.5 1 2 0.5 0 0 0 0 0 976.25 incognita 976.25\n"
        "ODOM 1.25 2 0.5 0 0 0 976.5 incognita 976.5\n"
        "ROBOTLASER1 0 -0.5 1 0.5 30 0 0 3 1.5 2 2.25 0 1.25 2 0.5 1.25 2 0.5 0 0 0 0 0 976.5 incognita 976.5\n");
  RobotLog sick = log_of(180, -90.0 * degree_rad, degree_rad);
  sick.scans = {{1.5, {1.0, 2.0, 0.5}, std::vector<double>(180, 4.0)}};
  sick.scans[0].ranges_m[179] = no_reading;
  std::string line = "FLASER 180";
  for (int beam = 0; beam < 179; ++beam) line += " 4";
  CHECK_THAT(carmen_log_text(sick, {CarmenMessage::front_laser, 81.91}),
             Contains("\n" + line + " 81.91 1 2 0.5 1 2 0.5 1.5 incognita 1.5\n"));
}

TEST_CASE("CARMEN: logs come back through the reader") {
  const io_test::TemporaryFolder folder;
  for (const std::optional<double> code : {std::optional<double>{}, std::optional<double>{81.91}}) {
    const RobotLog wide = random_log(1, 271, -135.0 * degree_rad, degree_rad);
    write_carmen_log(folder / "a.log", wide, {CarmenMessage::robot_laser, code});
    require_same(wide, read_carmen_log(folder / "a.log", as_written(code.value_or(100.0))));
    const RobotLog backwards = random_log(2, 360, std::numbers::pi, -2.0 * std::numbers::pi / 360);
    write_carmen_log(folder / "a.log", backwards, {CarmenMessage::robot_laser, code});
    require_same(backwards, read_carmen_log(folder / "a.log", as_written(code.value_or(100.0))));
    const RobotLog sick = random_log(3, 361, -90.0 * degree_rad, 0.5 * degree_rad);
    write_carmen_log(folder / "a.log", sick, {CarmenMessage::front_laser, code});
    require_same(sick, read_carmen_log(folder / "a.log", as_written(code.value_or(100.0))));
  }
  CHECK(folder.names() == std::vector<std::string>{"a.log"});
}

TEST_CASE("CARMEN: what a reader would refuse is not written") {
  const io_test::TemporaryFolder folder;
  const RobotLog good = random_log(4, 181, -90.0 * degree_rad, degree_rad);
  const auto throws = [&](const RobotLog& log, const CarmenWriterParams& params, const std::string& what) {
    CHECK_THROWS_WITH(write_carmen_log(folder / "a.log", log, params), Contains("write_carmen_log: ") && Contains(what));
  };
  const auto changed = [&](auto&& change) {
    RobotLog log = good;
    change(log);
    return log;
  };
  throws(changed([](RobotLog& log) { log.scans.clear(); }), {}, "the number of scans is 0");
  throws(changed([](RobotLog& log) { log.beams.directions.clear(); }), {}, "no beams");
  throws(changed([](RobotLog& log) { log.scans[3].ranges_m.pop_back(); }), {}, "a scan has 180 readings");
  throws(changed([](RobotLog& log) { log.scans[3].time_s = no_reading; }), {}, "a time is nan");
  throws(changed([](RobotLog& log) { log.scans[3].T_odom_robot.x_m = 2e6; }), {}, "x of a pose is 2e+06");
  throws(changed([](RobotLog& log) { log.T_robot_laser.yaw_rad = no_reading; }), {}, "of a pose is nan");
  throws(changed([](RobotLog& log) { std::swap(log.beams.directions[3], log.beams.directions[4]); }), {}, "even spacing");
  throws(good, {CarmenMessage::robot_laser, 20.0}, "a reading is ");
  throws(good, {CarmenMessage::robot_laser, -1.0}, "no_return_m is -1");
  throws(random_log(5, 181, -80.0 * degree_rad, degree_rad), {CarmenMessage::front_laser, {}}, "write ROBOTLASER1");
  throws(random_log(5, 100, -90.0 * degree_rad, degree_rad), {CarmenMessage::front_laser, {}}, "write ROBOTLASER1");
  CHECK(folder.names().empty());
  CHECK_THAT(io_test::refusal([&] {
               write_carmen_log("/proc/none/a.log", good);
               return 0;
             }),
             Contains("cannot be written"));
}
