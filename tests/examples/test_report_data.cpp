#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "support/report_data.hpp"

using namespace incognita;
using namespace examples;

namespace {

/// What report_data packed, read as the page reads it.
struct Unpacked {
  nlohmann::json about;
  std::string bytes;

  explicit Unpacked(const std::string& packed) {
    std::uint32_t size = 0;
    std::memcpy(&size, packed.data(), 4);
    REQUIRE((size + 4) % 8 == 0);
    about = nlohmann::json::parse(packed.substr(4, size));
    bytes = packed.substr(4 + size);
  }

  template <class Number>
  [[nodiscard]] std::vector<Number> column(const std::string& name) const {
    const auto& place = about.at("columns").at(name);
    const auto offset = place[1].get<std::size_t>();
    std::vector<Number> numbers(place[2].get<std::size_t>());
    REQUIRE(offset % 8 == 0);
    REQUIRE(offset + numbers.size() * sizeof(Number) <= bytes.size());
    if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data() + offset, numbers.size() * sizeof(Number));
    return numbers;
  }
};

FloorPlan random_plan(Random& random, double part_of_walls) {
  FloorPlan plan(Lattice<2>(0.25, {3.0, -2.0}), IndexBox<2>{{-4, 2}, {11, 13}}, FloorCell::solid);
  for (FloorCell& cell : plan.values()) cell = random.uniform(0.0, 1.0) < part_of_walls ? FloorCell::wall : FloorCell::floor;
  return plan;
}

/// Counts from 0 to most.
int below(Random& random, int most) { return static_cast<int>(random.uniform(0.0, static_cast<double>(most))); }

Recording random_recording(Random& random, int frames) {
  Recording recording;
  recording.setup.parameters_json = R"({"mission": {"seed": 1}})";
  for (int beam = 0; beam < 7; ++beam) recording.setup.beam_angles_rad.push_back(0.5F * static_cast<float>(beam));
  recording.setup.metric_names = {"explored_fraction", "distance_m"};
  for (int i = 0; i < frames; ++i) {
    RecordedFrame frame;
    frame.time_s = 0.5 * i;
    frame.pose = {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.0, 3.0)};
    frame.covariance = Pose2::Covariance::Identity() * 0.01;
    frame.truth = Pose2{frame.pose.x_m + 0.03, frame.pose.y_m - 0.04, frame.pose.yaw_rad};
    frame.is_trusted = i != 5;
    frame.is_redrawn = i == 7;
    for (int beam = 0; beam < 7; ++beam) frame.ranges.push_back(static_cast<std::uint16_t>(below(random, 65000)));
    frame.ranges[2] = RecordedFrame::range_units;
    frame.ranges[4] = RecordedFrame::range_invalid;
    frame.metrics = {0.01 * i, std::numeric_limits<double>::quiet_NaN()};
    std::set<std::pair<int, int>> places;
    for (int tile = below(random, 6); tile > 0; --tile) places.insert({below(random, 8) - 4, below(random, 5) - 2});
    for (const auto& [x, y] : places) {
      RecordedTile tile{{x, y}, 0, frame.levels.size()};
      for (int bit = 0; bit < 64; ++bit) {
        if (random.uniform(0.0, 1.0) < 0.7) continue;
        tile.cells |= CellBits::Word{1} << bit;
        frame.levels.push_back(static_cast<std::int8_t>(below(random, 31) - 15));
      }
      if (tile.cells != 0) frame.tiles.push_back(tile);
    }
    recording.frames.push_back(frame);
  }
  return recording;
}

}  // namespace

TEST_CASE("outlines enclose the walls and nothing else") {
  Random random(11);
  for (int trial = 0; trial < 40; ++trial) {
    const FloorPlan plan = random_plan(random, 0.1 + 0.02 * trial);
    double area_m2 = 0.0;
    double length_m = 0.0;
    for (const Points& outline : wall_outlines(plan, 0.0)) {
      REQUIRE(equal(outline.front(), outline.back()));
      for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const Point<2>& a = outline[i];
        const Point<2>& b = outline[i + 1];
        area_m2 += 0.5 * (a[0] * b[1] - b[0] * a[1]);
        length_m += distance(a, b);
        REQUIRE(((a[0] == b[0]) != (a[1] == b[1])));
      }
    }
    int walls = 0;
    int sides = 0;
    const IndexBox<2>& box = plan.box();
    for (int y = box.lower[1]; y < box.upper[1]; ++y) {
      for (int x = box.lower[0]; x < box.upper[0]; ++x) {
        if (plan.value({x, y}) != FloorCell::wall) continue;
        ++walls;
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          if (plan.value({x + dx, y + dy}) != FloorCell::wall) ++sides;
        }
      }
    }
    CHECK(area_m2 == Approx(walls * 0.0625).margin(1e-9));
    CHECK(length_m == Approx(sides * 0.25).margin(1e-9));
  }
  CHECK(wall_outlines(FloorPlan(Lattice<2>(0.1)), 0.1).empty());
}

TEST_CASE("a wall that is drawn askew has a straight outline") {
  // Its pixels leave a straight line by less than one, but a wall of one pixel must not become a line.
  FloorPlan plan(Lattice<2>(1.0), IndexBox<2>{{0, 0}, {60, 80}}, FloorCell::floor);
  for (int x = 0; x < 60; ++x) {
    for (int y = x; y < x + 4; ++y) plan.set({x, y}, FloorCell::wall);
  }
  const std::vector<Points> outlines = wall_outlines(plan, 0.75);
  REQUIRE(outlines.size() == 1);
  CHECK(outlines.front().size() <= 8);

  FloorPlan thin(Lattice<2>(1.0), IndexBox<2>{{0, 0}, {60, 3}}, FloorCell::floor);
  for (int x = 5; x < 50; ++x) thin.set({x, 1}, FloorCell::wall);
  REQUIRE(wall_outlines(thin, 0.75).size() == 1);
  CHECK(wall_outlines(thin, 0.75).front().size() == 5);
}

TEST_CASE("a simplified line stays near all points that it leaves out, and has no point to spare") {
  Random random(12);
  for (int trial = 0; trial < 50; ++trial) {
    Points points_m{{0.0, 0.0}};
    for (int i = 0; i < 60; ++i) points_m.push_back({points_m.back()[0] + random.uniform(-0.3, 1.0), points_m.back()[1] + random.uniform(-0.5, 0.5)});
    const Points kept = simplified(points_m, 0.4);
    REQUIRE(equal(kept.front(), points_m.front()));
    REQUIRE(equal(kept.back(), points_m.back()));
    CHECK(kept.size() < points_m.size());
    for (const auto& point_m : points_m) {
      double nearest_m = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
        // Brute force along the piece.
        for (int step = 0; step <= 1000; ++step) {
          nearest_m = std::min(nearest_m, distance(point_m, sum(kept[i], scaled(difference(kept[i + 1], kept[i]), step / 1000.0))));
        }
      }
      REQUIRE(nearest_m < 0.405);
    }
  }
  Points straight_m;
  for (int i = 0; i < 30; ++i) straight_m.push_back({0.1 * i, 0.2 * i});
  CHECK(simplified(straight_m, 1e-6).size() == 2);
}

TEST_CASE("every n-th frame is shown, and the last") {
  CHECK(shown_frames(0, 2).empty());
  CHECK(shown_frames(1, 2) == std::vector<std::size_t>{0});
  CHECK(shown_frames(7, 4) == std::vector<std::size_t>{0, 2, 4, 6});
  for (std::size_t count = 1; count < 60; ++count) {
    for (std::size_t most = 2; most < 20; ++most) {
      const std::vector<std::size_t> shown = shown_frames(count, most);
      REQUIRE(shown.size() <= most);
      REQUIRE(shown.front() == 0);
      REQUIRE(shown.back() == count - 1);
      if (count <= most) REQUIRE(shown.size() == count);
      for (std::size_t i = 0; i + 2 < shown.size(); ++i) REQUIRE(shown[i + 1] - shown[i] == shown[1] - shown[0]);
    }
  }
}

TEST_CASE("cells have the shade that their level has at each frame that is shown") {
  Random random(13);
  for (const std::size_t most : {std::size_t{100}, std::size_t{40}, std::size_t{9}, std::size_t{2}}) {
    const ReportRun run{"a run", random_recording(random, 40)};
    const Unpacked data(report_data(run, {most, 4}));
    const std::vector<std::size_t> shown = shown_frames(40, most);
    const auto counts = data.column<std::uint32_t>("tile_counts");
    const auto places = data.column<std::int32_t>("tile_places");
    const auto low = data.column<std::uint32_t>("tile_low");
    const auto high = data.column<std::uint32_t>("tile_high");
    const auto shades = data.column<std::uint8_t>("shades");
    REQUIRE(counts.size() == shown.size());
    std::map<std::pair<int, int>, int> levels;
    std::map<std::pair<int, int>, int> drawn;
    std::size_t tile = 0;
    std::size_t shade = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      for (; next <= shown[i]; ++next) {
        const RecordedFrame& frame = run.recording.frames[next];
        for (const RecordedTile& changed : frame.tiles) {
          std::size_t level = changed.first_level;
          for (int bit = 0; bit < 64; ++bit) {
            if ((changed.cells >> bit & 1U) == 0) continue;
            const Index<2> cell = CellBits::cell_of(changed.tile, bit);
            levels[{cell[0], cell[1]}] = frame.levels[level++];
          }
        }
      }
      Index<2> place(0, 0);
      for (std::uint32_t k = 0; k < counts[i]; ++k, ++tile) {
        place[0] += places[2 * tile];
        place[1] += places[2 * tile + 1];
        const std::uint64_t cells = low[tile] | std::uint64_t{high[tile]} << 32U;
        for (int bit = 0; bit < 64; ++bit) {
          if ((cells >> bit & 1U) == 0) continue;
          const Index<2> cell = CellBits::cell_of(place, bit);
          int& before = drawn[{cell[0], cell[1]}];
          const int now = shades.at(shade++) - 4;
          REQUIRE(now != before);
          before = now;
        }
      }
      for (const auto& [cell, level] : levels) {
        // Thresholds of -1 and 1, half a nat a level: free is below -2 levels, occupied above 2.
        const int size = std::abs(level);
        const int expected = (level < 0 ? -1 : 1) * (size == 0 ? 0 : size <= 2 ? 1 : size <= 4 ? 2 : size <= 8 ? 3 : 4);
        const auto found = drawn.find(cell);
        REQUIRE((found == drawn.end() ? 0 : found->second) == expected);
      }
    }
    CHECK(tile == low.size());
    CHECK(shade == shades.size());
    const auto& belief = data.about.at("belief");
    for (const auto& [cell, ignored] : drawn) {
      REQUIRE(cell.first >= belief.at("x").get<int>());
      REQUIRE(cell.second >= belief.at("y").get<int>());
      REQUIRE(cell.first < belief.at("x").get<int>() + belief.at("width").get<int>());
      REQUIRE(cell.second < belief.at("y").get<int>() + belief.at("height").get<int>());
    }
  }
}

TEST_CASE("frames that are shown keep their poses, scans and metrics, and what happened between them") {
  Random random(14);
  ReportRun run{"a run", random_recording(random, 10)};
  run.recording.frames[4].ranges.clear();
  const Unpacked data(report_data(run, {4, 4}));  // frames 0, 3, 6, 9; every second beam
  CHECK(data.column<double>("time_s") == std::vector<double>{0.0, 1.5, 3.0, 4.5});
  CHECK(data.column<std::uint8_t>("flags") == std::vector<std::uint8_t>{0, 0, 1, 4});
  const auto poses = data.column<float>("pose");
  REQUIRE(poses.size() == 12);
  CHECK(poses[3] == static_cast<float>(run.recording.frames[3].pose.x_m));
  const auto errors_m = data.column<float>("error_m");
  const auto nees = data.column<float>("nees");
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(errors_m[i] == Approx(0.05));
    CHECK(nees[i] == Approx(0.05 * 0.05 / 0.01));
    CHECK(data.column<float>("three_sigma_m")[i] == Approx(0.3));
    CHECK(data.column<float>("metric0")[i] == Approx(0.03 * static_cast<double>(i)));
    CHECK(std::isnan(data.column<float>("metric1")[i]));
  }
  auto ranges = data.column<std::int16_t>("ranges");
  REQUIRE(ranges.size() == 16);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t beam = 1; beam < 4; ++beam) ranges[4 * i + beam] = static_cast<std::int16_t>(ranges[4 * i + beam] + ranges[4 * i + beam - 1]);
    CHECK(std::abs(ranges[4 * i] - run.recording.frames[3 * i].ranges[0] / 65.0) <= 1.0);
    CHECK(ranges[4 * i + 1] == 1001);
    CHECK(ranges[4 * i + 2] == 0);
  }
  CHECK(data.about.at("beam_angles_rad").size() == 4);

  run.recording.frames[3].covariance.setZero();
  run.recording.frames[6].truth.reset();
  const Unpacked known(report_data(run, {4, 4}));
  CHECK(std::isnan(known.column<float>("nees")[1]));
  CHECK(known.column<float>("error_m")[1] == Approx(0.05));
  CHECK(std::isnan(known.column<float>("error_m")[2]));
  CHECK(std::isnan(known.column<float>("truth")[6]));
}

TEST_CASE("decisions keep their candidates, and paths their shape") {
  ReportRun run{"a run", {}};
  RecordedDecision decision;
  decision.time_s = 3.0;
  decision.reason = "arrived";
  RecordedCandidate candidate;
  candidate.frontier_m = {2.0F, 1.0F};
  candidate.gain_nats = 12.5F;
  for (int i = 0; i <= 20; ++i) candidate.path_m.push_back({0.1F * static_cast<float>(i), 0.0F});
  for (int i = 1; i <= 10; ++i) candidate.path_m.push_back({2.0F, 0.1F * static_cast<float>(i)});
  decision.candidates = {candidate, candidate};
  decision.frontier = {{3, -2}, {4, -2}, {-7, 5}};
  run.recording.decisions = {decision, {}};
  run.recording.decisions[1].reason = "ended";
  run.recording.decisions[1].stop_reason = "complete";
  const Unpacked data(report_data(run));
  CHECK(data.about.at("reasons") == nlohmann::json({"arrived", "ended"}));
  CHECK(data.column<std::uint8_t>("decision_reason") == std::vector<std::uint8_t>{0, 1});
  CHECK(data.about.at("stop_reasons") == nlohmann::json({"", "complete"}));
  CHECK(data.column<std::uint32_t>("candidate_starts") == std::vector<std::uint32_t>{0, 2, 2});
  CHECK(data.column<std::uint32_t>("path_starts") == std::vector<std::uint32_t>{0, 3, 6});
  CHECK(data.column<float>("path_m") == std::vector<float>{0, 0, 2, 0, 2, 1, 0, 0, 2, 0, 2, 1});
  CHECK(data.column<float>("candidate_gain_nats") == std::vector<float>{12.5F, 12.5F});
  CHECK(data.column<std::uint32_t>("frontier_starts") == std::vector<std::uint32_t>{0, 3, 3});
  CHECK(data.column<std::int32_t>("frontier_cells") == std::vector<std::int32_t>{3, -2, 1, 0, -11, 7});
}

TEST_CASE("a run that was cut short, or has nothing in it, is shown all the same") {
  ReportRun run{"a run", {}};
  run.recording.torn_bytes = 17;
  run.recording.setup.parameters_json = "not UTF-8: \xff\xfe";
  const Unpacked data(report_data(run));
  CHECK_FALSE(data.about.at("is_whole").get<bool>());
  CHECK(data.about.at("torn_bytes") == 17);
  CHECK(data.column<double>("time_s").empty());
  CHECK(data.about.at("plan").is_null());
  run.recording.end = RecordedEnd{"lost", R"({"scans": 3})"};
  const Unpacked whole(report_data(run));
  CHECK(whole.about.at("is_whole").get<bool>());
  CHECK(whole.about.at("stop_reason") == "lost");
  CHECK(whole.about.at("metrics_json") == R"({"scans": 3})");
}

TEST_CASE("a belief that no browser draws, and limits that make no sense, are refused") {
  ReportRun run{"a run", {}};
  run.recording.frames.resize(1);
  for (const int x : {0, 3000}) {
    run.recording.frames[0].tiles.push_back({{x, 0}, 1, run.recording.frames[0].levels.size()});
    run.recording.frames[0].levels.push_back(5);
  }
  CHECK_THROWS_AS(report_data(run), std::length_error);
  run.recording.frames[0].tiles.back().tile = {2000, 0};
  CHECK_NOTHROW(report_data(run));
  CHECK_THROWS_AS(report_data(run, {1, 180}), std::invalid_argument);
  CHECK_THROWS_AS(report_data(run, {4000, 0}), std::invalid_argument);
}

TEST_CASE("bytes as letters, and compressed") {
  // RFC 4648, 10.
  CHECK(base64("").empty());
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foo") == "Zm9v");
  CHECK(base64("foob") == "Zm9vYg==");
  CHECK(base64("fooba") == "Zm9vYmE=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64("\xff\xfe\xfd") == "//79");
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i % 7 * i);
  const std::string packed = deflated(bytes);
  CHECK(packed.size() < bytes.size());
  std::string again(bytes.size(), '\0');
  uLongf size = again.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(again.data()), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
  CHECK(again == bytes);
}
