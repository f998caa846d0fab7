#include <catch2/catch.hpp>
#include <string>
#include <utility>

#include "incognita/io/robot_log_file.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;

TEST_CASE("robot log file: the name decides what is read") {
  const io_test::TemporaryFolder folder;
  const std::string json = R"({"map": {"5": {"range": [1, 2], "x": 1, "y": 2, "theta": 0}}})";
  const std::string carmen = "FLASER 2 1 2 0 0 0 1 2 0 5";
  RobotLogParams params;
  params.beams = BeamAngles{0.0, 0.1};
  for (const auto& [name, content] :
       {std::pair{"a.json", json}, {"a.log", carmen}, {"a.clf", carmen}, {"a.carmen", carmen}}) {
    const RobotLog log = read_robot_log(folder.with(name, content), params);
    CHECK(log.scans.at(0).T_odom_robot.y_m == 2.0);
    CHECK(log.scans.at(0).time_s == 5.0);
  }
  CHECK_THAT(io_test::refusal([&] { return read_robot_log(folder.with("a.txt", carmen), params); }),
             Contains("a.txt: is not a robot's log") && Contains(".json"));
  CHECK_THAT(io_test::refusal([&] { return read_robot_log(folder.with("b.json", carmen), params); }),
             Contains("not valid JSON"));
}
