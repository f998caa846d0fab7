#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/tum.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

std::string tum_refusal(const std::string& text) {
  return refusal([&] { return parse_tum(text, "a.tum"); });
}

}  // namespace

TEST_CASE("TUM: a trajectory comes back to 1e-9") {
  const io_test::TemporaryFolder folder;
  Random random(3);
  std::vector<TimedPose2> trajectory;
  for (int i = 0; i < 2000; ++i) {
    const double far_m = std::pow(10.0, random.uniform(-9.0, 6.0));
    trajectory.push_back(
        {1.6e9 + random.uniform(0.0, 1e5),
         {random.uniform(-far_m, far_m), random.uniform(-far_m, far_m), random.uniform(-3.14, 3.14)}});
  }
  for (const double yaw_rad : {0.0, std::numbers::pi, -std::numbers::pi / 2, 1e-12})
    trajectory.push_back({0.0, {0, 0, yaw_rad}});
  write_tum(folder / "a.tum", trajectory);
  const std::vector<TimedPose2> back = read_tum(folder / "a.tum");
  REQUIRE(back.size() == trajectory.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    CHECK(back[i].time_s == trajectory[i].time_s);
    CHECK(back[i].pose.x_m == trajectory[i].pose.x_m);
    CHECK(back[i].pose.y_m == trajectory[i].pose.y_m);
    CHECK(std::abs(wrap_angle_rad(back[i].pose.yaw_rad - trajectory[i].pose.yaw_rad)) < 1e-9);
  }
  CHECK(parse_tum(tum_text({}), "x").empty());
}

TEST_CASE("TUM: what is written is what evo reads") {
  // evo splits rows at each single space: eight entries, none empty, no comment but a leading #; it takes seconds, x y z, and the
  // quaternion with its scalar last, and with --full_check wants quaternions of length 1 and times that ascend.
  Random random(4);
  std::vector<TimedPose2> trajectory;
  for (int i = 0; i < 500; ++i) {
    trajectory.push_back({1.7e9 + 0.1 * i, {random.uniform(-1e4, 1e4), std::pow(10.0, random.uniform(-12.0, 2.0)), random.uniform(-3.15, 3.15)}});
  }
  std::istringstream lines(tum_text(trajectory));
  std::size_t count = 0;
  double last_s = 0.0;
  for (std::string line; std::getline(lines, line); ++count) {
    std::vector<double> entries;
    std::size_t begin = 0;
    while (begin != std::string::npos) {
      const std::size_t end = line.find(' ', begin);
      const std::string entry = line.substr(begin, end == std::string::npos ? end : end - begin);
      REQUIRE(entry.find_first_not_of("0123456789+-.e") == std::string::npos);
      std::size_t read = 0;
      entries.push_back(std::stod(entry, &read));  // throws for an empty entry
      REQUIRE(read == entry.size());
      begin = end == std::string::npos ? end : end + 1;
    }
    REQUIRE(entries.size() == 8);
    REQUIRE(entries[0] > last_s);
    REQUIRE(entries[0] == trajectory[count].time_s);
    REQUIRE(entries[3] == 0.0);
    REQUIRE(std::abs(std::hypot(std::hypot(entries[4], entries[5]), std::hypot(entries[6], entries[7])) - 1.0) < 1e-12);
    REQUIRE(std::abs(angle_between_rad(2.0 * std::atan2(entries[6], entries[7]), trajectory[count].pose.yaw_rad)) < 1e-9);
    last_s = entries[0];
  }
  CHECK(count == trajectory.size());
}

TEST_CASE("TUM: comments, empty lines, tabs and Windows line ends") {
  const auto trajectory = parse_tum(
      "# time x y z ...\n\n  # more\r\n1 2 3 4 0 0 0 1\r\n\t2\t-1  +.5 0 0 0 1 0 \n3 1 2 0 0 0 0 -1", "x");
  REQUIRE(trajectory.size() == 3);
  CHECK(trajectory[0].time_s == 1.0);
  CHECK(trajectory[0].pose.y_m == 3.0);
  CHECK(trajectory[0].pose.yaw_rad == 0.0);
  CHECK(trajectory[1].pose.y_m == 0.5);
  CHECK(trajectory[1].pose.yaw_rad == Approx(std::numbers::pi));
  CHECK(trajectory[2].pose.yaw_rad == Approx(0.0).margin(1e-15));
}

TEST_CASE("TUM: a pose in space is projected onto the plane") {
  // Yaw 0.7 after a pitch of 0.2: the robot's x axis, seen from above, still points along 0.7.
  const double pitch_rad = 0.2;
  const double yaw_rad = 0.7;
  const double cy = std::cos(yaw_rad / 2), sy = std::sin(yaw_rad / 2);
  const double cp = std::cos(pitch_rad / 2), sp = std::sin(pitch_rad / 2);
  const std::string line = "0 1 2 9 " + format_number(-sy * sp) + ' ' + format_number(cy * sp) + ' ' +
                           format_number(sy * cp) + ' ' + format_number(cy * cp);
  CHECK(parse_tum(line, "x").at(0).pose.yaw_rad == Approx(yaw_rad));
}

TEST_CASE("TUM: a bad line is refused with its number") {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  for (const std::string bad : {"1 2 3", "0 0 0 0 0 0 0 1 9", "0 0 x 0 0 0 0 1", "0 nan 0 0 0 0 0 1",
                                "inf 0 0 0 0 0 0 1", "0,0,0,0,0,0,0,1", "0 0 0 0 0 0 0 1e999", "x"}) {
    CAPTURE(bad);
    CHECK_THAT(tum_refusal("# first\n" + good + bad + "\n" + good),
               Contains("a.tum: line 3 is \"" + bad + "\"") && Contains("eight finite numbers"));
  }
  CHECK_THAT(tum_refusal("0 0 0 0 0 0 0 0"), Contains("line 1 has a quaternion of length 0"));
  CHECK_THAT(tum_refusal("0 0 0 0 1 1 1 1"), Contains("line 1 has a quaternion of length 2"));
  CHECK_THAT(tum_refusal("0 0 0 0 1e200 1e200 1e200 1e200"), Contains("quaternion"));
  CHECK_THAT(tum_refusal(std::string("\0\0\0", 3)), Contains("line 1"));
  CHECK_THAT(refusal([] { return read_tum("missing.tum"); }), Contains("no such file"));
}

TEST_CASE("TUM: files cut off or spoilt are read or refused") {
  const std::string good =
      tum_text({{0.0, {1.5, -2.0, 0.3}}, {0.1, {1.6, -2.1, 0.4}}, {0.2, {1.7, -2.2, -0.5}}});
  const auto read = [](const std::string& text) { return parse_tum(text, "x"); };
  const auto whole = read(good);
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    std::vector<TimedPose2> part;
    if (!refusal([&] { return part = read(good.substr(0, size)); }).empty()) continue;
    // What was read before the cut is right.
    for (std::size_t i = 0; i + 1 < part.size(); ++i) CHECK(part[i].pose.x_m == whole[i].pose.x_m);
  }
  CHECK(io_test::refused_when_spoilt(good, 5000, read) > 1000);
}
