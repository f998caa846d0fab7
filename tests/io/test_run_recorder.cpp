#include <array>
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

#include "../exploration/small_office.hpp"
#include "../loops/ring.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/io/run_recorder.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "levels.hpp"
#include "recordings.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;

namespace {

using OfficeExplorer = Explorer<Map<TBayes>, Behavioral, DvlEkf>;

ExplorerParams quick_params() {
  ExplorerParams params;
  params.gain.beams = 30;
  params.threads = 1;
  return params;
}

/// What is to be in a recording, kept from beside it.
struct Kept {
  std::vector<double> times_s;
  std::vector<PoseBelief> beliefs;
  std::vector<Pose2> truths;
  std::vector<Scan<2>> scans;
  std::vector<Decision> decisions;
};

/// Drives as test::run_mission does, with a recorder or without.
template <class ExplorerType>
Kept run(ExplorerType& explorer, Simulator& simulator, double duration_s, RunRecorder* recorder) {
  Kept kept;
  Twist2 command;
  for (bool first = true; first || (!explorer.stopped() && simulator.time_s() < duration_s - 1e-9); first = false) {
    if (!first) explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    const auto metrics = [&] { return std::array<double, 1>{simulator.distance_m()}; };
    if (recorder != nullptr) recorder->observed(explorer, simulator.scan(), simulator.T_start_robot(), metrics);
    kept.times_s.push_back(explorer.time_s());
    kept.beliefs.push_back(explorer.belief());
    kept.truths.push_back(simulator.T_start_robot());
    kept.scans.push_back(simulator.scan());
    if (explorer.decide()) {
      if (recorder != nullptr) recorder->decided(explorer);
      kept.decisions.push_back(explorer.decision());
    }
    command = explorer.command(simulator.scan());
  }
  return kept;
}

RecordingSetup with_distance() {
  RecordingSetup setup;
  setup.parameters_json = "{\"seed\": 1}";
  setup.metric_names = {"distance_m"};
  return setup;
}

/// How many cells of the explorer's map the recording shows as something else in the end.
template <class ExplorerType>
std::size_t wrong_cells(const Recording& recording, const ExplorerType& explorer) {
  io_test::LevelMap levels;
  for (const RecordedFrame& frame : recording.frames) levels.take(frame);
  CHECK(levels.size() > 300);
  return levels.count_wrong(explorer.map(), recording.setup, explorer.params().thresholds);
}

template <class MapType>
bool same_cells(const MapType& a, const MapType& b) {
  if (a.grid().box() != b.grid().box()) return false;
  for (Offset offset = 0; offset < static_cast<Offset>(a.grid().size()); ++offset) {
    if (a.log_odds(offset) != b.log_odds(offset)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("a recorded run is the run that is not, to the bit, and what is recorded is what happened", "[recording]") {
  const io_test::TemporaryFolder folder;
  const double interval_s = GENERATE(0.0, 0.5);
  Simulator alone = test::office_simulator(0.9, 7);
  ExplorerParams often = quick_params();
  often.strategy = Strategy::online;
  OfficeExplorer unwatched(often);
  const Kept kept = run(unwatched, alone, 12.0, nullptr);

  Simulator simulator = test::office_simulator(0.9, 7);
  OfficeExplorer explorer(often);
  RecordingSetup setup = with_distance();
  setup.plan = simulator.world().plan();
  setup.T_map_plan = simulator.T_start_world();
  RunRecorder::Params params;
  params.interval_s = interval_s;
  RunRecorder recorder(folder / "run", explorer, simulator.scan(), setup, params);
  const Kept again = run(explorer, simulator, 12.0, &recorder);

  CHECK(again.times_s == kept.times_s);
  REQUIRE(again.beliefs.size() == kept.beliefs.size());
  for (std::size_t i = 0; i < kept.beliefs.size(); ++i) {
    REQUIRE(io_test::same(again.beliefs[i].pose, kept.beliefs[i].pose));
    REQUIRE(again.beliefs[i].covariance == kept.beliefs[i].covariance);
  }
  REQUIRE(same_cells(explorer.map(), unwatched.map()));
  REQUIRE(again.decisions.size() == kept.decisions.size());
  REQUIRE(kept.decisions.size() > 3);

  const Recording recording = read_recording(recorder.file());
  CHECK(recorder.size_bytes() == io_test::content_of(folder / "run").size());
  CHECK_FALSE(recording.end);
  CHECK(recording.torn_bytes == 0);
  CHECK(recording.setup.parameters_json == "{\"seed\": 1}");
  CHECK(recording.setup.resolution_m == 0.1);
  CHECK(recording.setup.robot_radius_m == explorer.params().travel.robot_radius_m);
  CHECK(recording.setup.range_max_m == 10.0);
  CHECK(recording.setup.beam_angles_rad.size() == 180);
  CHECK(recording.setup.beam_angles_rad[45] == Approx(0.5 * std::numbers::pi));
  CHECK(recording.setup.plan->values() == simulator.world().plan().values());

  // A frame each scan, or each fifth.
  const std::size_t every = interval_s == 0.0 ? 1 : 5;
  REQUIRE(recording.frames.size() == (kept.times_s.size() + every - 1) / every);
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    const RecordedFrame& frame = recording.frames[i];
    const std::size_t scan = i * every;
    REQUIRE(frame.time_s == kept.times_s[scan]);
    REQUIRE(io_test::same(frame.pose, kept.beliefs[scan].pose));
    REQUIRE((frame.covariance - kept.beliefs[scan].covariance).cwiseAbs().maxCoeff() < 1e-12);
    REQUIRE(io_test::same(frame.truth.value(), kept.truths[scan]));
    REQUIRE(frame.metrics.size() == 1);
    REQUIRE(frame.ranges.size() == 180);
    for (std::size_t beam = 0; beam < 180; ++beam) {
      const double range_m = frame.ranges[beam] * 10.0 / RecordedFrame::range_units;
      REQUIRE(std::abs(range_m - kept.scans[scan].range_m(beam)) < 1e-4);
    }
  }
  REQUIRE(recording.decisions.size() == kept.decisions.size());
  for (std::size_t i = 0; i < kept.decisions.size(); ++i) {
    const Decision& decision = kept.decisions[i];
    const RecordedDecision& recorded = recording.decisions[i];
    REQUIRE(recorded.time_s == decision.time_s);
    REQUIRE(recorded.reason == to_string(decision.reason));
    REQUIRE(recorded.stop_reason == (decision.stopped ? to_string(*decision.stopped) : ""));
    REQUIRE(recorded.candidates.size() == decision.candidates.size());
    REQUIRE((decision.candidates.empty() || !recorded.frontier.empty()));
    for (std::size_t j = 0; j < decision.candidates.size(); ++j) {
      const Candidate& candidate = decision.candidates[j];
      REQUIRE(recorded.candidates[j].gain_nats == static_cast<float>(candidate.gain_nats));
      REQUIRE(recorded.candidates[j].utility == static_cast<float>(candidate.utility));
      REQUIRE(recorded.candidates[j].path_m.size() == candidate.path.points_m().size());
      REQUIRE(recorded.candidates[j].path_m.back()[0] == static_cast<float>(candidate.goal_m()[0]));
    }
  }
  if (interval_s == 0.0) CHECK(wrong_cells(recording, explorer) == 0);
}

TEST_CASE("frames show the map cell by cell, with any cells and thresholds, and the end is recorded", "[recording]") {
  const io_test::TemporaryFolder folder;
  const double resolution_m = GENERATE(0.1, 0.25);
  ExplorerParams params = quick_params();
  params.duration_max_s = 3.25;
  if (resolution_m > 0.2) params.thresholds = OccupancyThresholds::of_probabilities(0.2, 0.65);
  MapParams cells;
  cells.resolution_m = resolution_m;
  Simulator simulator = test::office_simulator(0.9, 8);
  Explorer<Map<LogOdds>, Behavioral, DvlEkf> explorer(params, Map<LogOdds>(cells));
  RunRecorder recorder(folder / "run", explorer, simulator.scan(), with_distance());
  run(explorer, simulator, 20.0, &recorder);
  REQUIRE(explorer.stopped() == StopReason::out_of_time);
  const auto metrics = [&] { return std::vector<double>{simulator.distance_m()}; };
  for (int twice = 0; twice < 2; ++twice) recorder.record(explorer, simulator.scan(), simulator.T_start_robot(), metrics);
  recorder.ended({std::string(to_string(*explorer.stopped())), "{\"distance_m\": 1.0}"});

  const Recording recording = read_recording(folder / "run");
  CHECK(recording.setup.resolution_m == resolution_m);
  CHECK(recording.setup.free_below == static_cast<double>(params.thresholds.free_below));
  CHECK(wrong_cells(recording, explorer) == 0);
  CHECK(recording.frames.back().time_s == explorer.time_s());
  CHECK(recording.frames.back().metrics[0] == simulator.distance_m());
  CHECK(recording.frames[recording.frames.size() - 2].time_s < explorer.time_s());
  REQUIRE_FALSE(recording.decisions.empty());
  CHECK(recording.decisions.back().reason == "ended");
  CHECK(recording.decisions.back().stop_reason == "out_of_time");
  CHECK(recording.decisions.back().candidates.empty());
  CHECK(recording.end->stop_reason == "out_of_time");
  CHECK(recording.end->metrics_json == "{\"distance_m\": 1.0}");
}

TEST_CASE("a map that is drawn again is recorded again", "[recording]") {
  const io_test::TemporaryFolder folder;
  const std::vector<room::Wall> walls = test::ring();
  const std::vector<Pose2> way = test::way_around(1.2);
  LoopClosingDvlEkf::Params filter;
  filter.loops.solution_shift_m = filter.loops.redraw_shift_m = 1e-6;  // whatever moves
  filter.start.pose = way.front();
  ExplorerParams params = quick_params();
  params.gain.range_max_m = 5.0;
  Explorer<Map<>, Behavioral, LoopClosingDvlEkf> explorer(params, Map<>{}, Behavioral{}, LoopClosingDvlEkf(filter));
  Random random(1);
  std::optional<RunRecorder> recorder;
  int redraws = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    explorer.move(way[i - 1].inverse() * way[i] * Pose2{0.0, 0.0, random.normal(0.0, 0.002)}, 0.1);
    const Scan<2> scan = room::scan_of(walls, way[i], circular_beams(90, 5.0));
    explorer.observe(scan);
    if (!recorder) recorder.emplace(folder / "run", explorer, scan);
    recorder->observed(explorer, scan, way[i]);
    if (!explorer.last_scan().is_redrawn) continue;
    recorder->record(explorer, scan, way[i]);
    if (++redraws > 3) continue;
    const Recording recording = read_recording(folder / "run");
    CHECK(recording.frames.back().is_redrawn);
    CHECK(wrong_cells(recording, explorer) == 0);
  }
  REQUIRE(redraws > 0);
  int marked = 0;
  const Recording recording = read_recording(folder / "run");
  for (const RecordedFrame& frame : recording.frames) marked += frame.is_redrawn ? 1 : 0;
  CHECK(marked == redraws);
  CHECK(recording.frames.front().metrics.empty());
}

TEST_CASE("what is met just within the range is not nothing, and bad readings are told apart", "[recording]") {
  const io_test::TemporaryFolder folder;
  OfficeExplorer explorer(quick_params());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Scan<2> scan(circular_beams(5, 10.0), {10.0, 9.99999, nan, 12.0, 1e-9});
  explorer.observe(scan);
  RunRecorder recorder(folder / "run", explorer, scan);
  recorder.observed(explorer, scan);
  const Recording recording = read_recording(folder / "run");
  CHECK(recording.frames.front().ranges == std::vector<std::uint16_t>{65000, 64999, 65535, 65535, 0});
  CHECK_FALSE(recording.frames.front().truth);
}

TEST_CASE("a recorder refuses what cannot be recorded, and goes on", "[recording]") {
  const io_test::TemporaryFolder folder;
  OfficeExplorer explorer(quick_params());
  const Scan<2> scan(circular_beams(90, 10.0));
  RunRecorder::Params params;
  params.interval_s = -0.5;
  CHECK_THROWS_WITH(RunRecorder(folder / "run", explorer, scan, {}, params), Contains("interval_s is -0.5"));
  RecordingSetup setup = with_distance();
  setup.log_odds_step = 0.0;
  CHECK_THROWS_WITH(RunRecorder(folder / "run", explorer, scan, setup), Contains("log_odds_step is 0"));
  CHECK(folder.names().empty());
  CHECK_THAT(io_test::refusal([&] { return RunRecorder(folder / "missing/run", explorer, scan).size_bytes(); }), Contains("cannot be written"));

  RunRecorder recorder(folder / "run", explorer, scan, with_distance());
  const std::size_t before = recorder.size_bytes();
  explorer.observe(scan);
  const std::array<double, 1> metrics{1.0};
  const auto one = [&] { return metrics; };
  CHECK_THROWS_WITH(recorder.observed(explorer, scan), Contains("number of metrics is 0, but must be that of the names"));
  CHECK_THROWS_WITH(recorder.observed(explorer, Scan<2>(circular_beams(91, 10.0)), std::nullopt, one), Contains("beams are not those"));
  CHECK_THROWS_WITH(recorder.observed(explorer, scan, Pose2{std::nan(""), 0.0, 0.0}, one), Contains("truth is not finite"));
  CHECK(recorder.size_bytes() == before);
  recorder.observed(explorer, scan, std::nullopt, one);
  const Recording recording = read_recording(folder / "run");
  REQUIRE(recording.frames.size() == 1);
  CHECK(wrong_cells(recording, explorer) == 0);

  // Other beams are as good where scans are not recorded.
  params = {0.0, false};
  RunRecorder without(folder / "without", explorer, scan, {}, params);
  without.observed(explorer, Scan<2>(circular_beams(91, 10.0)));
  CHECK(read_recording(folder / "without").frames.front().ranges.empty());
}
