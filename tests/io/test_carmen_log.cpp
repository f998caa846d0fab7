#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "incognita/io/carmen_log.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

RobotLogParams any_beams() {
  RobotLogParams params;
  params.beams = BeamAngles{0.0, 0.1};
  return params;
}

RobotLog parse_log(const std::string& text) { return parse_carmen_log(text, "a.log", any_beams()); }

std::string log_refusal(const std::string& text) {
  return refusal([&] { return parse_log(text); });
}

const std::string good_line = "FLASER 3 1.5 2 2.5 0.3 0.2 0.1 1 2 0.5 976.25 pippo 0.3\n";
/// Of 3 readings over 90 degrees, remissions, a laser 0.1 m ahead of the robot.
const std::string robot_laser_line =
    "ROBOTLASER1 0 -0.785 1.57 0.785 81.9 0.01 0 3 1.5 2 2.5 2 7 8 1.1 2 0 1 2 0 0.2 0.1 0 0 0 976.25 pippo "
    "0.3\n";

}  // namespace

TEST_CASE("CARMEN: FLASER lines are read, others skipped") {
  const RobotLog log =
      parse_log("# message formats\nPARAM robot_length 1\nODOM 9 9 9 0 0 0 1 pippo 0\n\n" + good_line +
            "RLASER 1 2\n  FLASER 3 1 nan inf 0.3 0.2 0.1 1 2 4 970 pippo 0.2 \r\n");
  REQUIRE(log.scans.size() == 2);
  CHECK(log.scans[0].time_s == 970.0);
  CHECK(log.scans[1].time_s == 976.25);
  CHECK(log.scans[1].ranges_m == std::vector<double>{1.5, 2.0, 2.5});
  CHECK(log.scans[1].T_odom_robot.x_m == 1.0);
  CHECK(log.scans[1].T_odom_robot.y_m == 2.0);
  CHECK(log.scans[1].T_odom_robot.yaw_rad == 0.5);
  CHECK(log.scans[0].T_odom_robot.yaw_rad == Approx(4.0 - 2.0 * std::numbers::pi));
  CHECK(Scan<2>(log.beams, log.scans[0].ranges_m).reading(1) == Reading::invalid);
  // The words after the time are not needed.
  CHECK(parse_log("FLASER 1 2 0 0 0 0 0 0 5").scans[0].time_s == 5.0);
}

TEST_CASE("CARMEN: the number of readings says where FLASER looks") {
  for (const std::size_t count : {180U, 361U}) {
    std::string line = "FLASER " + std::to_string(count);
    for (std::size_t i = 0; i < count; ++i) line += " 2";
    const RobotLog log = parse_carmen_log(line + " 0 0 0 0 0 0 5", "a.log");
    CHECK(log.beams.directions.size() == count);
    CHECK(log.beams.directions[0].y() == Approx(-1.0));
    CHECK(log.beams.directions[count / 2].x() == Approx(1.0));
  }
  CHECK_THAT(refusal([] { return parse_carmen_log(good_line, "a.log"); }), Contains("3 readings"));
}

TEST_CASE("CARMEN: ROBOTLASER1 says itself where it looks and sits") {
  const RobotLog log = parse_carmen_log(robot_laser_line + good_line, "a.log");
  REQUIRE(log.scans.size() == 1);  // FLASER is another message: the same scan again, as a rule
  CHECK(log.scans[0].time_s == 976.25);
  CHECK(log.scans[0].ranges_m == std::vector<double>{1.5, 2.0, 2.5});
  CHECK(log.scans[0].T_odom_robot.x_m == 1.0);
  CHECK(log.beams.directions[0].y() == Approx(std::sin(-0.785)));
  CHECK(log.beams.directions[1].x() == Approx(1.0));
  CHECK(log.T_robot_laser.x_m == Approx(0.1));
}

TEST_CASE("CARMEN: the laser's place is known when all lines agree") {
  const Pose2 T_robot_laser{0.2, -0.05, 0.1};
  const auto line = [&](const Pose2& robot, const Pose2& laser) {
    std::string text = "FLASER 1 2";
    for (const Pose2& pose : {laser, robot}) {
      for (const double value : {pose.x_m, pose.y_m, pose.yaw_rad}) text += ' ' + format_number(value);
    }
    return text + " 5\n";
  };
  const std::vector<Pose2> poses{{0, 0, 0}, {1, 2, 3}, {-5, 1, -1.5}};
  std::string agreeing;
  std::string corrected;
  for (const Pose2& pose : poses) {
    agreeing += line(pose, pose * T_robot_laser);
    corrected += line(pose, Pose2{0, 0, 0.01 * pose.x_m} * pose);
  }
  const Pose2 found = parse_log(agreeing).T_robot_laser;
  CHECK(found.x_m == Approx(T_robot_laser.x_m));
  CHECK(found.y_m == Approx(T_robot_laser.y_m));
  CHECK(found.yaw_rad == Approx(T_robot_laser.yaw_rad));
  CHECK(parse_log(corrected).T_robot_laser.x_m == 0.0);
  CHECK(parse_log(line({0, 0, 0}, {50, 0, 0})).T_robot_laser.x_m == 0.0);  // a correction, not a mounting
  RobotLogParams params = any_beams();
  params.T_robot_laser = Pose2{1, 0, 0};
  CHECK(parse_carmen_log(agreeing, "a.log", params).T_robot_laser.x_m == 1.0);
}

TEST_CASE("CARMEN: a bad line is refused with its number") {
  for (const auto& [bad, what] : std::vector<std::pair<std::string, std::string>>{
           {"FLASER", "ends before the number of readings"},
           {"FLASER x", "the number of readings is \"x\""},
           {"FLASER -1 2", "the number of readings is \"-1\""},
           {"FLASER 2.5 2", "the number of readings is \"2.5\""},
           {"FLASER 99999999999 2", "whole number up to 10000"},
           {"FLASER 0 0 0 0 0 0 0 5", "has no readings"},
           {"FLASER 3 1 2", "ends before its last reading"},
           {"FLASER 3 1 x 2", "a reading is \"x\""},
           {"FLASER 3 1 2 3 0 0", "ends before the laser's pose"},
           {"FLASER 3 1 2 3 0 0 0 0 nan", "the odometry is \"nan\""},
           {"FLASER 3 1 2 3 0 0 0 1e7 0 0 5", "the odometry is \"1e7\", but must be a number within 1e+06"},
           {"FLASER 3 1 2 3 0 0 0 0 0 0", "ends before the time"},
           {"FLASER 3 1 2 3 0 0 0 0 0 0 now", "the time is \"now\""},
           {"FLASER 2 1 2 0 0 0 0 0 0 5", "has 2 readings, but must have 3"}}) {
    CAPTURE(bad);
    CHECK_THAT(log_refusal("# first\n" + good_line + bad + "\n" + good_line),
               Contains("a.log: line 3 (FLASER): ") && Contains(what));
  }
  CHECK_THAT(log_refusal("ROBOTLASER1 0 1 2 3 4 5 6 1 2 7 8"), Contains("line 1 (ROBOTLASER1)"));
  CHECK_THAT(log_refusal(""), Contains("holds no FLASER or ROBOTLASER1 message"));
  CHECK_THAT(log_refusal(std::string("\0\n\0", 3)), Contains("holds no"));
  CHECK_THAT(refusal([] { return read_carmen_log("missing.log"); }), Contains("no such file"));
}

TEST_CASE("CARMEN: files cut off or spoilt are read or refused") {
  for (const std::string& line : {good_line, robot_laser_line}) {
    const std::string good = line + line + line;
    std::size_t refused = 0;
    for (std::size_t size = 0; size < good.size(); ++size)
      refused += !log_refusal(good.substr(0, size)).empty();
    CHECK(refused > good.size() / 3);
    CHECK(io_test::refused_when_spoilt(good, 5000, parse_log) > 1000);
  }
}
