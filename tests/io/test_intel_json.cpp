#include <catch2/catch.hpp>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/io/intel_json.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

RobotLogParams three_beams() {
  RobotLogParams params;
  params.beams = BeamAngles{0.0, 0.1};
  return params;
}

RobotLog parse_intel(const std::string& text) { return parse_intel_json(text, "a.json", three_beams()); }

std::string intel_refusal(const std::string& text) {
  return refusal([&] { return parse_intel(text); });
}

/// A log of one scan with these fields.
std::string with_scan(const std::string& fields) { return R"({"map": {"1.5": {)" + fields + "}}}"; }

const std::string good_fields = R"("range": [1, 2.5, 3], "x": 1, "y": -2, "theta": 0.5)";

}  // namespace

TEST_CASE("Intel JSON: scans, poses and times are read") {
  const RobotLog log = parse_intel(R"({"version": 2, "map": {
    "976052890.244111": {"range": [1, 2.5, 3e0], "x": 1.25, "y": -2, "theta": 3.5},
    "976052889.5": {"theta": 0, "y": 0, "x": 0, "range": [4, null, 6], "note": "a", "more": [1, [2, null]]}}})");
  REQUIRE(log.scans.size() == 2);
  CHECK(log.scans[0].time_s == 976052889.5);
  CHECK(log.scans[1].time_s == 976052890.244111);
  CHECK(log.scans[1].T_odom_robot.x_m == 1.25);
  CHECK(log.scans[1].T_odom_robot.y_m == -2.0);
  CHECK(log.scans[1].T_odom_robot.yaw_rad == Approx(3.5 - 2.0 * std::numbers::pi));
  CHECK(log.scans[1].ranges_m == std::vector<double>{1.0, 2.5, 3.0});
  const Scan<2> scan(log.beams, log.scans[0].ranges_m);
  CHECK(scan.reading(0) == Reading::hit);
  CHECK(scan.reading(1) == Reading::invalid);
  CHECK(scan.reading(2) == Reading::hit);
}

TEST_CASE("Intel JSON: a bad file is refused with the scan and the cause") {
  CHECK(intel_refusal(with_scan(good_fields)).empty());
  CHECK_THAT(intel_refusal(""), Contains("a.json: not valid JSON") && Contains("byte 1"));
  CHECK_THAT(intel_refusal("{}"), Contains("holds no scans"));
  CHECK_THAT(intel_refusal("[]"), Contains("an array where the scans must be"));
  CHECK_THAT(intel_refusal("3"), Contains("has 3 where an object must be"));
  CHECK_THAT(intel_refusal(R"({"scans": {}})"), Contains("\"scans\" where \"map\" must be"));
  CHECK_THAT(intel_refusal(R"({"map": 7})"), Contains("7 where an object must be"));
  CHECK_THAT(intel_refusal(R"({"map": {"1": null}})"), Contains("null where an object must be"));
  CHECK_THAT(intel_refusal(R"({"map": {"noon": {}}})"), Contains("\"noon\" must be named by its time"));
  CHECK_THAT(intel_refusal(R"({"map": {"nan": {}}})"), Contains("\"nan\" must be named by its time"));
  CHECK_THAT(intel_refusal(with_scan(R"("range": [1, 2, 3], "x": 1, "y": 1)")),
             Contains("the scan \"1.5\" lacks \"theta\""));
  CHECK_THAT(intel_refusal(with_scan(R"("x": 1, "y": 1, "theta": 0)")), Contains("lacks \"range\""));
  CHECK_THAT(intel_refusal(with_scan(R"("range": [], "x": 1, "y": 1, "theta": 0)")),
             Contains("lacks \"range\""));
  CHECK_THAT(intel_refusal(with_scan(R"("range": 3)")) + intel_refusal(with_scan(R"("range": "a")")),
             Contains("\"range\" \"a\", which must be an array of numbers"));
  CHECK_THAT(intel_refusal(with_scan(R"("range": [1, "a"])")),
             Contains("a reading \"a\", but it must be a number"));
  CHECK_THAT(intel_refusal(with_scan(R"("range": [1, [2]])")), Contains("an array among the readings"));
  CHECK_THAT(intel_refusal(with_scan(R"("range": [1], "range": [2])")), Contains("two fields \"range\""));
  CHECK_THAT(intel_refusal(with_scan(R"("x": {"y": 1})")), Contains("an object too many"));
  CHECK_THAT(intel_refusal(with_scan(R"("x": true)")), Contains("\"x\" true, which must be a number"));
  CHECK_THAT(intel_refusal(with_scan(R"("x": 1e7)")), Contains("\"x\" is 1e+07, but must be within 1e+06"));
  CHECK_THAT(intel_refusal(with_scan(R"("x": 1e999)")), Contains("a number is out of range"));
  CHECK_THAT(intel_refusal(R"({"map": {"1": {)" + good_fields +
                           R"(}, "2": {"range": [1], "x": 1, "y": 1, "theta": 0}}})"),
             Contains("the scan \"2\" has 1 readings, but must have 3"));
  CHECK_THAT(intel_refusal(with_scan(good_fields) + "x"), Contains("not valid JSON"));
  CHECK_THAT(intel_refusal(R"({"map": {"1)" + std::string("\n") + R"(": {}}})"), Contains("not valid JSON"));
  CHECK_THAT(refusal([] { return read_intel_json("missing.json"); }), Contains("no such file"));
}

TEST_CASE("Intel JSON: depth and size are bounded") {
  CHECK_THAT(intel_refusal(std::string(1 << 20, '[')), Contains("an array where the scans must be"));
  CHECK_THAT(intel_refusal(with_scan("\"deep\": " + std::string(1 << 20, '['))), Contains("not valid JSON"));
  std::string many = "\"range\": [0";
  for (std::size_t i = 0; i < log_beams_max; ++i) many += ",0";
  CHECK_THAT(intel_refusal(with_scan(many + "]")), Contains("more than 10000 readings"));
}

TEST_CASE("Intel JSON: files cut off or spoilt are read or refused") {
  const std::string good = R"({"map": {"1": {)" + good_fields + R"(}, "2": {)" + good_fields + "}}}";
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    CHECK_THAT(intel_refusal(good.substr(0, size)), Contains("a.json: "));
  }
  CHECK(io_test::refused_when_spoilt(good, 5000, parse_intel) > 1000);
}

TEST_CASE("Intel JSON: the Intel Research Lab") {
  const std::filesystem::path file =
      std::filesystem::path(INCOGNITA_DATA_DIR) / "intel" / "raw_odometry.json";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is not there");
    return;
  }
  const RobotLog log = read_intel_json(file);
  CHECK(log.scans.size() == 910);
  CHECK(log.beams.directions.size() == 180);
  CHECK(log.beams.directions[0].y() == Approx(-1.0));
  CHECK(log.limits.no_return_m == 81.83);
  CHECK(log.limits.usable_m == Approx(25.38));
  CHECK(log.duration_s() == Approx(2650.858978));
}
