#include <catch2/catch.hpp>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/io/recording_file.hpp"
#include "incognita/io/recording_records.hpp"
#include "recordings.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::payload_of;
using io_test::refusal;

namespace {

template <class Take>
auto taken(Take&& take, const std::string& bytes) {
  ByteReader reader(bytes, "file");
  auto what = take(reader);
  reader.require_end();
  return what;
}

/// The bytes that docs/recording.md shows: in its block of text, pairs of digits up to where the explanation begins.
std::string bytes_of_page() {
  std::ifstream page(std::filesystem::path(__FILE__).parent_path() / "../../docs/recording.md");
  REQUIRE(page);
  std::string bytes;
  bool is_inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) is_inside = line == "```hexdump";
    if (!is_inside || line.starts_with("```")) continue;
    const std::string digits = line.substr(0, line.find('|'));
    for (std::size_t i = 0; i + 1 < digits.size();) {
      if (std::isxdigit(static_cast<unsigned char>(digits[i])) == 0) {
        ++i;
        continue;
      }
      bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
      i += 2;
    }
  }
  return bytes;
}

/// The run that the page shows.
Recording run_of_page() {
  Recording recording;
  RecordingSetup& setup = recording.setup;
  setup.resolution_m = 0.5;
  setup.log_odds_step = 0.5;
  setup.robot_radius_m = 0.25;
  setup.range_max_m = 4.0;
  setup.beam_angles_rad = {0.0F, 1.5F};
  setup.metric_names = {"area_m2"};
  setup.plan = FloorPlan(Lattice<2>(0.5, {-1.0, 0.0}), {{0, 0}, {3, 2}}, FloorCell::wall);
  setup.plan->set({1, 1}, FloorCell::floor);
  setup.T_map_plan = {0.5, 0.0, 0.0};
  RecordedFrame& frame = recording.frames.emplace_back();
  frame.time_s = 0.5;
  frame.pose = {1.0, -1.0, 0.25};
  frame.covariance = Eigen::Vector3d(0.25, 0.5, 1.0).asDiagonal();
  frame.truth = Pose2{1.0, -1.5, 0.0};
  frame.ranges = {32500, RecordedFrame::range_units};
  frame.metrics = {2.0};
  frame.tiles = {{{0, 0}, 0x0000000000000102, 0}, {{-1, 0}, 0x8000000000000000, 2}};
  frame.levels = {-3, 1, 4};
  RecordedDecision& decision = recording.decisions.emplace_back();
  decision.time_s = 0.5;
  decision.reason = "no_goal";
  decision.candidates = {{{2.0F, 1.0F}, {{1.0F, -1.0F}, {1.5F, 0.5F}}, 8.0F, 8.0F, 2.0F, 4.0F}};
  decision.frontier = {{4, 2}, {4, 3}};
  recording.end = RecordedEnd{"complete", "{}"};
  return recording;
}

}  // namespace

TEST_CASE("the bytes on the page are those of the run that it shows") {
  const std::string bytes = bytes_of_page();
  const Recording run = run_of_page();
  CHECK(io_test::same(parse_recording(bytes, "page"), run));
  const io_test::TemporaryFolder folder;
  {
    RecordingWriter writer(folder / "run", run.setup);
    writer.write(run.frames.front());
    writer.write(run.decisions.front());
    writer.write(*run.end);
    CHECK(writer.size_bytes() == bytes.size());
  }
  CHECK(io_test::content_of(folder / "run") == bytes);
}

TEST_CASE("records come back to the bit, and each is refused when it is cut off") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Recording recording = io_test::any_recording(random, 2);
    const auto check = [&](auto&& put, auto&& take, const auto& what) {
      const std::string bytes = payload_of(put, what);
      REQUIRE(io_test::same(taken(take, bytes), what));
      REQUIRE(refusal([&] { return taken(take, bytes + '\0'); }) != "");
      for (std::size_t size = 0; size < bytes.size(); size += 1 + random.index(8)) {
        REQUIRE_THAT(refusal([&] { return taken(take, bytes.substr(0, size)); }), Contains("file: is damaged at byte "));
      }
    };
    check(put_setup, take_setup, recording.setup);
    for (const RecordedFrame& frame : recording.frames) check(put_frame, take_frame, frame);
    for (const RecordedDecision& decision : recording.decisions) check(put_decision, take_decision, decision);
    if (recording.end) check(put_end, take_end, *recording.end);
  }
}

TEST_CASE("indices that recordings do not reach, and flags that there are none of, are refused") {
  RecordedFrame frame;
  frame.tiles = {{{RecordedFrame::tile_max, 0}, 1, 0}, {{RecordedFrame::tile_max + 1, 0}, 1, 1}};
  frame.levels = {1, 1};
  CHECK_THAT(refusal([&] { return taken(take_frame, payload_of(put_frame, frame)); }), Contains("an index of 33554433, which must be from"));
  RecordedDecision decision;
  decision.frontier = {{0, -recorded_cell_max - 1}};
  CHECK_THAT(refusal([&] { return taken(take_decision, payload_of(put_decision, decision)); }), Contains("an index of -268435457"));
  std::string bytes = payload_of(put_frame, RecordedFrame{});
  bytes[8 + 24 + 48] = 16;
  CHECK_THAT(refusal([&] { return taken(take_frame, bytes); }), Contains("flags of 16, which must be 0 to 15"));
}

TEST_CASE("setups out of bounds are refused by name and value") {
  const auto refused = [](auto change, const char* field, const char* value) {
    RecordingSetup setup;
    setup.plan = FloorPlan(Lattice<2>(0.1), {{0, 0}, {1, 1}}, FloorCell::floor);
    CHECK_NOTHROW(setup.validate());
    change(setup);
    CHECK_THROWS_WITH(setup.validate(), Contains("RecordingSetup") && Contains(field) && Contains(value));
    CHECK_THROWS_AS(setup.validate(), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](auto& s) { s.resolution_m = 0.0; }, "resolution_m", "0");
  refused([&](auto& s) { s.log_odds_step = nan; }, "log_odds_step", "nan");
  refused([](auto& s) { s.free_below = 0.0; }, "free_below", "0");
  refused([](auto& s) { s.free_below = -63.5; }, "free_below", "-63.5");
  refused([](auto& s) { s.occupied_above = -0.25; }, "occupied_above", "-0.25");
  refused([](auto& s) { s.occupied_above = 63.5; }, "occupied_above", "63.5");
  refused([](auto& s) { s.robot_radius_m = -0.5; }, "robot_radius_m", "-0.5");
  refused([](auto& s) { s.range_max_m = 0.0; }, "range_max_m", "0");
  refused([&](auto& s) { s.beam_angles_rad = {0.0F, static_cast<float>(nan)}; }, "beam_angles_rad", "nan");
  refused([&](auto& s) { s.T_map_plan.x_m = nan; }, "T_map_plan", "not finite");
  refused([](auto& s) { s.plan = FloorPlan(Lattice<2>(0.1), {{-300000000, 0}, {-299999999, 1}}); }, "plan's box", "-3e+08");
}

TEST_CASE("frames and decisions out of bounds are refused by name and value") {
  const auto refused = [](auto change, const char* field, const char* value) {
    RecordedFrame frame;
    frame.tiles = {{{0, 0}, 3, 0}, {{1, 0}, 1, 2}};
    frame.levels = {1, 2, 3};
    frame.metrics = {1.0};
    CHECK_NOTHROW(frame.validate(2, 1));
    change(frame);
    CHECK_THROWS_WITH(frame.validate(2, 1), Contains("RecordedFrame") && Contains(field) && Contains(value));
    CHECK_THROWS_AS(frame.validate(2, 1), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](auto& f) { f.time_s = nan; }, "time_s", "nan");
  refused([&](auto& f) { f.pose.y_m = nan; }, "pose", "not finite");
  refused([&](auto& f) { f.truth = Pose2{nan, 0.0, 0.0}; }, "pose", "not finite");
  refused([&](auto& f) { f.covariance(2, 1) = nan; }, "covariance", "nan");
  refused([](auto& f) { f.ranges = {1, 2, 3}; }, "number of ranges", "3");
  refused([](auto& f) { f.metrics.clear(); }, "number of metrics", "0");
  refused([](auto& f) { f.tiles[1].tile[1] = std::numeric_limits<int>::min(); }, "index of a tile", "-2.14748e+09");
  refused([](auto& f) { f.tiles[1].cells = 0; }, "tile", "no cells");
  refused([](auto& f) { f.tiles[1].first_level = 1; }, "first level", "1");
  refused([](auto& f) { f.levels.push_back(0); }, "number of levels", "4");
  RecordedFrame with_ranges;
  with_ranges.ranges = {1, 2};
  CHECK_NOTHROW(with_ranges.validate(2, 0));

  const auto undecided = [](auto change, const char* field, const char* value) {
    RecordedDecision decision;
    decision.candidates.resize(1);
    CHECK_NOTHROW(decision.validate());
    change(decision);
    CHECK_THROWS_WITH(decision.validate(), Contains("RecordedDecision") && Contains(field) && Contains(value));
  };
  undecided([&](auto& d) { d.time_s = nan; }, "time_s", "nan");
  undecided([&](auto& d) { d.candidates[0].frontier_m[1] = static_cast<float>(nan); }, "a place", "nan");
  undecided([&](auto& d) { d.candidates[0].path_m = {{0.0F, static_cast<float>(nan)}}; }, "a place", "nan");
  undecided([](auto& d) { d.frontier = {{0, 300000000}}; }, "index of a cell", "3e+08");
}

TEST_CASE("changed cells are those of the bits, the lowest first") {
  const RecordedFrame frame = run_of_page().frames.front();
  std::vector<std::pair<Index<2>, int>> seen;
  for_each_changed_cell(frame, [&](const Index<2>& cell, std::int8_t level) { seen.emplace_back(cell, level); });
  CHECK(seen == std::vector<std::pair<Index<2>, int>>{{{1, 0}, -3}, {{0, 1}, 1}, {{-1, 7}, 4}});
}
