/// Records a run of an explorer from beside it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/exploration/decision_reason.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/io/recording_file.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// The levels of cells that a recording holds, followed from one frame to the next.
class RecordedLevels {
 public:
  /// Levels are log-odds by `step`, rounded away from 0 and cut at 127: thresholds that are multiples of the step tell the same of a level
  /// as of its log-odds.
  RecordedLevels(double resolution_m, double step)
      : per_step_(static_cast<float>(1.0 / step)),
        levels_(CellBits(Lattice<2>(resolution_m), false).tiles().lattice()),
        is_due_(levels_.lattice()) {}

  /// Takes note of what the map's last update changed, or, when the map was drawn again or an update was missed, of the whole map. O(tiles
  /// changed), amortised.
  template <class Map>
  void note(const Map& map, bool is_redrawn) {
    if (!is_redrawn && map.update_count() == update_count_) return;
    const IndexBox<2>& tiles = map.layers().changed.tiles().box();
    levels_.grow_to_include(tiles);
    is_due_.grow_to_include(tiles);
    if (is_redrawn || map.update_count() != update_count_ + 1) {
      for_each_tile_of(map.grid().box(), [&](const Index<2>& tile) { mark(tile); });
    } else {
      for (const Index<2>& tile : map.layers().changed_tiles) mark(tile);
    }
    update_count_ = map.update_count();
  }

  /// Moves the cells whose level has changed since it was last called into a frame. O(tiles noted).
  template <class Map>
  void take(const Map& map, RecordedFrame& frame) {
    frame.tiles.clear();
    frame.levels.clear();
    for (const Index<2>& index : due_) {
      const Offset offset = levels_.offset_of(index);
      is_due_[offset] = 0;
      Levels& levels = levels_[offset];
      RecordedTile tile{index, 0, frame.levels.size()};
      const auto states = map.states_of(index);
      for (CellBits::Word left = cells_of_tile(index, map.grid().box()); left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        const std::int8_t level = level_of(Map::CellType::log_odds(states(bit)));
        std::int8_t& before = levels[static_cast<std::size_t>(bit)];
        if (level == before) continue;
        before = level;
        tile.cells |= CellBits::Word{1} << bit;
        frame.levels.push_back(level);
      }
      if (tile.cells != 0) frame.tiles.push_back(tile);
    }
    due_.clear();
  }

 private:
  using Levels = std::array<std::int8_t, 64>;

  void mark(const Index<2>& tile) {
    std::uint8_t& is_due = is_due_[is_due_.offset_of(tile)];
    if (is_due == 0) due_.push_back(tile);
    is_due = 1;
  }

  [[nodiscard]] std::int8_t level_of(float log_odds) const {
    const float steps = std::clamp(log_odds * per_step_, -127.0F, 127.0F);
    return static_cast<std::int8_t>(steps < 0.0F ? std::floor(steps) : std::ceil(steps));
  }

  float per_step_;
  Grid<Levels, 2> levels_;
  Grid<std::uint8_t, 2> is_due_;
  std::vector<Index<2>> due_;
  std::uint64_t update_count_ = 0;
};

/// Watches an explorer of the plane and writes what it does into a file. Call observed() after each Explorer::observe and decided()
/// after each Explorer::decide that decided; who does not call them pays for nothing. The explorer is not changed, so that a run is the same with
/// a recorder and without. Not thread safe.
class RunRecorder {
 public:
  struct Params {
    /// Between frames, in the explorer's time, >= 0; 0 records each scan. What happens in between is in the next frame.
    double interval_s = 0.5;
    bool with_scans = true;

    /// Throws std::invalid_argument for an interval that is not finite and >= 0.
    void validate() const { require_non_negative("RunRecorder", "interval_s", interval_s); }
  };

  /// Creates the file, see RecordingWriter. Of the setup, what the explorer and its scans know themselves is taken from them: the resolution, the
  /// thresholds, the robot's radius, the beams. Throws std::invalid_argument for a bad setup or bad parameters, InputError when the
  /// file cannot be written.
  template <class Explorer>
  RunRecorder(const std::filesystem::path& file, const Explorer& explorer, const Scan<2>& scan, RecordingSetup setup, const Params& params)
      : params_(params), setup_(completed(std::move(setup), explorer, scan, params)), writer_(file, setup_),
        levels_(setup_.resolution_m, setup_.log_odds_step) {}

  template <class Explorer>
  RunRecorder(const std::filesystem::path& file, const Explorer& explorer, const Scan<2>& scan, RecordingSetup setup = {})
      : RunRecorder(file, explorer, scan, std::move(setup), Params{}) {}

  /// The explorer has observed a scan. `truth` is the robot's pose in the map's frame, where that is known; metrics() gives one number for each
  /// name of the setup, and is called only when a frame is due. Throws InputError when the file cannot be written, std::invalid_argument for
  /// another number of metrics or beams. O(tiles that the scan changed).
  template <class Explorer, class Metrics>
  void observed(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth, Metrics&& metrics) {
    note(explorer);
    if (explorer.time_s() >= next_s_ - 1e-9) record(explorer, scan, truth, std::forward<Metrics>(metrics));
  }

  /// As observed, whether a frame is due or not: so that the last moment of a run is recorded.
  template <class Explorer, class Metrics>
  void record(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth, Metrics&& metrics) {
    if (explorer.time_s() == last_s_) return;
    frame_.time_s = last_s_ = explorer.time_s();
    next_s_ = frame_.time_s + params_.interval_s;
    frame_.pose = explorer.belief().pose;
    frame_.covariance = explorer.belief().covariance;
    frame_.truth = truth;
    frame_.is_trusted = explorer.correction().trusted;
    frame_.is_lost = explorer.correction().lost;
    frame_.is_redrawn = std::exchange(is_redrawn_, false);
    frame_.ranges.clear();
    if (params_.with_scans) take_ranges(scan);
    const auto values = metrics();
    frame_.metrics.assign(values.begin(), values.end());
    require(frame_.metrics.size() == setup_.metric_names.size(), "RunRecorder", "the number of metrics",
            static_cast<double>(frame_.metrics.size()), "that of the names in the setup");
    levels_.take(explorer.map(), frame_);
    writer_.write(frame_);
  }

  /// The explorer has decided, or has ended. Throws InputError when the file cannot be written. O(candidates, their paths, and cells of frontiers).
  template <class Explorer>
  void decided(const Explorer& explorer) {
    RecordedDecision recorded;
    const auto& decision = explorer.decision();
    recorded.time_s = decision.time_s;
    recorded.reason = to_string(decision.reason);
    if (decision.stopped) recorded.stop_reason = to_string(*decision.stopped);
    for (const auto& candidate : decision.candidates) {
      RecordedCandidate& one = recorded.candidates.emplace_back();
      one.frontier_m = {static_cast<float>(candidate.frontier_m[0]), static_cast<float>(candidate.frontier_m[1])};
      for (const Eigen::Vector2d& point_m : candidate.path.points_m()) {
        one.path_m.push_back({static_cast<float>(point_m[0]), static_cast<float>(point_m[1])});
      }
      one.gain_nats = static_cast<float>(candidate.gain_nats);
      one.information = static_cast<float>(candidate.information);
      one.navigation_cost = static_cast<float>(candidate.navigation_cost);
      one.utility = static_cast<float>(candidate.utility);
    }
    for (const auto& frontier : explorer.frontiers()) {
      recorded.frontier.insert(recorded.frontier.end(), frontier.cells.begin(), frontier.cells.end());
    }
    writer_.write(recorded);
  }

  /// The last record. Throws InputError when the file cannot be written.
  void ended(const RecordedEnd& end) { writer_.write(end); }

  [[nodiscard]] const std::filesystem::path& file() const { return writer_.path(); }
  [[nodiscard]] std::size_t size_bytes() const { return writer_.size_bytes(); }

 private:
  template <class Explorer>
  [[nodiscard]] static RecordingSetup completed(RecordingSetup setup, const Explorer& explorer, const Scan<2>& scan, const Params& params) {
    params.validate();
    require_positive("RecordingSetup", "log_odds_step", setup.log_odds_step);
    setup.resolution_m = explorer.map().resolution_m();
    setup.free_below = static_cast<double>(explorer.params().thresholds.free_below);
    setup.occupied_above = static_cast<double>(explorer.params().thresholds.occupied_above);
    setup.robot_radius_m = explorer.params().travel.robot_radius_m;
    setup.range_max_m = scan.range_max_m();
    setup.beam_angles_rad.clear();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      setup.beam_angles_rad.push_back(static_cast<float>(std::atan2(scan.direction(beam)[1], scan.direction(beam)[0])));
    }
    return setup;
  }

  template <class Explorer>
  void note(const Explorer& explorer) {
    const bool is_redrawn = explorer.last_scan().is_redrawn;
    is_redrawn_ = is_redrawn_ || is_redrawn;
    levels_.note(explorer.map(), is_redrawn);
  }

  void take_ranges(const Scan<2>& scan) {
    require(scan.size() == setup_.beam_angles_rad.size(), "RunRecorder", "the number of beams", static_cast<double>(scan.size()),
            "that of the first scan");
    const double units_per_m = RecordedFrame::range_units / setup_.range_max_m;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const bool is_valid = scan.reading(beam) != Reading::invalid;
      frame_.ranges.push_back(is_valid ? static_cast<std::uint16_t>(std::lround(scan.range_m(beam) * units_per_m)) : RecordedFrame::range_invalid);
    }
  }

  Params params_;
  RecordingSetup setup_;
  RecordingWriter writer_;
  RecordedLevels levels_;
  RecordedFrame frame_;  // kept for its storage
  bool is_redrawn_ = false;  // since the last frame
  double last_s_ = -std::numeric_limits<double>::infinity();
  double next_s_ = 0.0;
};

}  // namespace incognita
