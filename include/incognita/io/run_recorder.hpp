/// Records a run of an explorer from beside it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/exploration/decision_reason.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/io/recorded_levels.hpp"
#include "incognita/io/recording_file.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Watches an explorer of the plane and writes what it does into a file. Call observed() after each Explorer::observe and decided()
/// after each Explorer::decide that decided; who does not call them pays for nothing. The explorer is not changed, so that a run is the same with
/// a recorder and without. Not thread safe.
class RunRecorder {
 public:
  /// What is recorded.
  struct Params {
    /// Between frames, in the explorer's time, >= 0; 0 records each scan. What happens in between is in the next frame.
    double interval_s = 0.5;
    bool with_scans = true;  ///< scans must then all have the beams of the first

    /// Throws std::invalid_argument for an interval that is not finite and >= 0.
    void validate() const { require_non_negative("RunRecorder", "interval_s", interval_s); }
  };

  /// Creates the file, see RecordingWriter. Of the setup, what the explorer and its scans know themselves is taken from them: the resolution, the
  /// thresholds, the robot's radius, the beams. Throws std::invalid_argument for a bad setup or bad parameters, InputError when the
  /// file cannot be written.
  template <class Explorer>
  RunRecorder(const std::filesystem::path& file, const Explorer& explorer, const Scan<2>& scan, RecordingSetup setup, const Params& params)
      : RunRecorder(file, completed(std::move(setup), explorer, scan), explorer.params().thresholds, scan, params) {}

  /// With default parameters. Throws as above.
  template <class Explorer>
  RunRecorder(const std::filesystem::path& file, const Explorer& explorer, const Scan<2>& scan, RecordingSetup setup = {})
      : RunRecorder(file, explorer, scan, std::move(setup), Params{}) {}

  /// The explorer has observed a scan. `truth` is the robot's pose in the map's frame, where that is known; metrics() gives a range of numbers, one
  /// for each name of the setup, and is called only when a frame is due. Throws std::invalid_argument for another number of them, other beams or
  /// a truth that is not finite: the frame is then not written. Throws InputError when the file cannot be written. O(cells that the scan changed).
  template <class Explorer, class Metrics>
  void observed(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth, Metrics&& metrics) {
    const bool is_redrawn = explorer.last_scan().is_redrawn;
    is_redrawn_ = is_redrawn_ || is_redrawn;
    levels_.note(explorer.map(), is_redrawn);
    if (explorer.time_s() >= next_s_ - 1e-9) record(explorer, scan, truth, std::forward<Metrics>(metrics));
  }

  /// Without metrics, of a setup without names of them.
  template <class Explorer>
  void observed(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth = std::nullopt) {
    observed(explorer, scan, truth, no_metrics);
  }

  /// After observed(), a frame of the same moment unless there is one already: so that the end of a run is recorded. Throws as observed() does.
  template <class Explorer, class Metrics>
  void record(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth, Metrics&& metrics) {
    if (explorer.time_s() == last_s_) return;
    if (truth && !truth->is_finite()) throw std::invalid_argument("RunRecorder: the truth is not finite");
    const auto values = metrics();
    require(values.size() == metric_count_, "RunRecorder", "number of metrics", static_cast<double>(values.size()), "that of the names in the setup");
    if (params_.with_scans && !scan.has_beams_of(first_scan_)) throw std::invalid_argument("RunRecorder: the beams are not those of the first scan");
    frame_.time_s = explorer.time_s();
    frame_.pose = explorer.belief().pose;
    frame_.covariance = explorer.belief().covariance;
    frame_.truth = truth;
    frame_.is_trusted = explorer.correction().trusted;
    frame_.is_lost = explorer.correction().lost;
    frame_.is_redrawn = is_redrawn_;
    if (params_.with_scans) take_ranges(scan);
    frame_.metrics.assign(values.begin(), values.end());
    levels_.take(explorer.map(), frame_);
    writer_.write(frame_);
    is_redrawn_ = false;
    last_s_ = frame_.time_s;
    next_s_ = last_s_ + params_.interval_s;
  }

  /// Without metrics, of a setup without names of them. Throws as observed() does.
  template <class Explorer>
  void record(const Explorer& explorer, const Scan<2>& scan, const std::optional<Pose2>& truth = std::nullopt) {
    record(explorer, scan, truth, no_metrics);
  }

  /// The explorer has decided, or has ended. Throws InputError when the file cannot be written. O(n log n) for n cells of frontiers, see
  /// Explorer::frontiers, and O(points of the candidates' paths).
  template <class Explorer>
  void decided(const Explorer& explorer) {
    const auto& decision = explorer.decision();
    RecordedDecision recorded;
    recorded.time_s = decision.time_s;
    recorded.reason = to_string(decision.reason);
    if (decision.stopped) recorded.stop_reason = to_string(*decision.stopped);
    recorded.candidates.reserve(decision.candidates.size());
    for (const auto& candidate : decision.candidates) {
      RecordedCandidate& one = recorded.candidates.emplace_back();
      one.frontier_m = to_floats(candidate.frontier_m);
      one.path_m.reserve(candidate.path.points_m().size());
      for (const Point<2>& point_m : candidate.path.points_m()) one.path_m.push_back(to_floats(point_m));
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

  /// The last record; the file is closed. Throws InputError when it cannot be written.
  void ended(const RecordedEnd& end) { writer_.write(end); }

  [[nodiscard]] const std::filesystem::path& file() const { return writer_.path(); }  ///< that is written
  [[nodiscard]] std::size_t size_bytes() const { return writer_.size_bytes(); }  ///< of the file so far

 private:
  RunRecorder(const std::filesystem::path& file, const RecordingSetup& setup, const OccupancyThresholds& thresholds, const Scan<2>& scan,
              const Params& params)
      : params_((params.validate(), params)),
        first_scan_(scan),
        metric_count_(setup.metric_names.size()),
        range_units_per_m_(RecordedFrame::range_units / setup.range_max_m),
        writer_(file, setup),
        levels_(setup, thresholds) {}

  template <class Explorer>
  [[nodiscard]] static RecordingSetup completed(RecordingSetup setup, const Explorer& explorer, const Scan<2>& scan) {
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

  [[nodiscard]] static std::array<float, 2> to_floats(const Point<2>& point_m) {
    return {static_cast<float>(point_m[0]), static_cast<float>(point_m[1])};
  }

  void take_ranges(const Scan<2>& scan) {
    frame_.ranges.clear();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) frame_.ranges.push_back(range_of(scan, beam));
  }

  /// What is met just within the range must not look as if nothing was.
  [[nodiscard]] std::uint16_t range_of(const Scan<2>& scan, std::size_t beam) const {
    switch (scan.reading(beam)) {
      case Reading::clear: return RecordedFrame::range_units;
      case Reading::invalid: return RecordedFrame::range_invalid;
      case Reading::hit: break;
    }
    const long units = std::lround(scan.range_m(beam) * range_units_per_m_);
    return static_cast<std::uint16_t>(std::min<long>(units, RecordedFrame::range_units - 1));
  }

  static constexpr auto no_metrics = [] { return std::array<double, 0>{}; };

  Params params_;
  Scan<2> first_scan_;
  std::size_t metric_count_;
  double range_units_per_m_;
  RecordingWriter writer_;
  RecordedLevels levels_;
  RecordedFrame frame_;      // kept for its storage
  bool is_redrawn_ = false;  // since the last frame
  double last_s_ = -std::numeric_limits<double>::infinity();
  double next_s_ = 0.0;
};

}  // namespace incognita
