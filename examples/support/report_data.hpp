/// A recording as what the report page needs of it: fewer frames and beams, cells as they are drawn, walls as lines, all compressed.
#pragma once

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "incognita/core/error.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/io/bytes.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/metrics/nees.hpp"
#include "support/outlines.hpp"

namespace examples {

/// How much of a recording is shown.
struct ReportLimits {
  std::size_t frames_max = 4000;  ///< >= 2
  std::size_t beams_max = 180;    ///< >= 1
};

/// A recording and what it is called.
struct ReportRun {
  std::string name;
  incognita::Recording recording;
};

/// What a cell is drawn as: 0 when nothing is known, -1 or 1 between the thresholds, -4 to -2 when free and 2 to 4 when occupied, beyond the
/// threshold once, twice and four times.
[[nodiscard]] inline int shade_of(std::int8_t level, const incognita::RecordingSetup& setup) {
  const double log_odds = level * setup.log_odds_step;
  const auto beyond = [&](double threshold) { return 2 + (log_odds / threshold > 2.0 ? 1 : 0) + (log_odds / threshold > 4.0 ? 1 : 0); };
  if (level == 0) return 0;
  if (log_odds < setup.free_below) return setup.free_below < 0.0 ? -beyond(setup.free_below) : -2;
  if (log_odds > setup.occupied_above) return setup.occupied_above > 0.0 ? beyond(setup.occupied_above) : 2;
  return level < 0 ? -1 : 1;
}

/// Every n-th of `count` frames and the last, `most` or fewer of them.
[[nodiscard]] inline std::vector<std::size_t> shown_frames(std::size_t count, std::size_t most) {
  std::vector<std::size_t> shown;
  if (count == 0) return shown;
  const std::size_t every = std::max<std::size_t>(1, (count - 1 + most - 2) / (most - 1));
  for (std::size_t frame = 0; frame + 1 < count; frame += every) shown.push_back(frame);
  shown.push_back(count - 1);
  return shown;
}

namespace detail {

/// Columns of numbers by name, as the page takes them: an object of JSON that says where each is, then the columns, each at a multiple of 8
/// bytes.
class Columns {
 public:
  template <class Number>
  void add(const char* name, const std::vector<Number>& numbers) {
    while (bytes_.bytes().size() % 8 != 0) bytes_.number(std::uint8_t{0});
    places_[name] = {type_name<Number>(), bytes_.bytes().size(), numbers.size()};
    for (const Number number : numbers) bytes_.number(number);
  }

  /// Text that is not UTF-8 is mended.
  [[nodiscard]] std::string packed(nlohmann::ordered_json about) const {
    about["columns"] = places_;
    std::string head = about.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    while ((head.size() + 4) % 8 != 0) head += ' ';
    incognita::ByteWriter packed;
    packed.number(static_cast<std::uint32_t>(head.size()));
    return packed.bytes() + head + bytes_.bytes();
  }

 private:
  /// The typed array of JavaScript.
  template <class Number>
  static const char* type_name() {
    if constexpr (std::is_same_v<Number, double>) return "Float64Array";
    if constexpr (std::is_same_v<Number, float>) return "Float32Array";
    if constexpr (std::is_same_v<Number, std::uint8_t>) return "Uint8Array";
    if constexpr (std::is_same_v<Number, std::int16_t>) return "Int16Array";
    if constexpr (std::is_same_v<Number, std::int32_t>) return "Int32Array";
    if constexpr (std::is_same_v<Number, std::uint32_t>) return "Uint32Array";
  }

  incognita::ByteWriter bytes_;
  nlohmann::ordered_json places_ = nlohmann::ordered_json::object();
};

/// Finer than anyone sees, and shorter when compressed.
[[nodiscard]] inline float rounded_m(double value_m) { return static_cast<float>(std::round(value_m * 128.0) / 128.0); }

/// The number of a text among those that were met.
[[nodiscard]] inline std::uint8_t number_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  // A recording has a dozen; one that has more than fit comes from somewhere else.
  if (found == names.end() && names.size() == 255) return 255;
  const auto number = static_cast<std::uint8_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return number;
}

/// Poses, scans and metrics of the frames that are shown.
inline void add_frames(Columns& columns, nlohmann::ordered_json& about, const incognita::Recording& recording,
                       const std::vector<std::size_t>& shown, std::size_t beams_max) {
  using namespace incognita;
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const RecordingSetup& setup = recording.setup;
  const std::size_t beams = setup.beam_angles_rad.size();
  const std::size_t step = std::max<std::size_t>(1, (beams + beams_max - 1) / beams_max);
  std::vector<float> angles_rad;
  for (std::size_t beam = 0; beam < beams; beam += step) angles_rad.push_back(setup.beam_angles_rad[beam]);

  std::vector<double> times_s;
  std::vector<float> poses, covariances, truths, errors_m, three_sigma_m, nees;
  std::vector<std::uint8_t> flags;
  std::vector<std::int16_t> ranges;
  std::vector<std::vector<float>> metrics(setup.metric_names.size());
  std::size_t next = 0;
  for (const std::size_t last : shown) {
    const RecordedFrame& frame = recording.frames[last];
    times_s.push_back(frame.time_s);
    for (const double value : {frame.pose.x_m, frame.pose.y_m, frame.pose.yaw_rad}) poses.push_back(static_cast<float>(value));
    const auto& covariance = frame.covariance;
    for (const double value : {covariance(0, 0), covariance(0, 1), covariance(1, 1), covariance(2, 2)}) {
      covariances.push_back(static_cast<float>(value));
    }
    three_sigma_m.push_back(static_cast<float>(3.0 * position_sigma_m(covariance)));
    float error_m = none;
    float nees_now = none;
    if (frame.truth) {
      error_m = static_cast<float>((frame.pose.position() - frame.truth->position()).norm());
      // Of a pose that is known there is nothing to say.
      try {
        nees_now = static_cast<float>(position_nees(frame.pose, *frame.truth, covariance));
      } catch (const std::invalid_argument&) {
      }
    }
    errors_m.push_back(error_m);
    nees.push_back(nees_now);
    const Pose2 truth = frame.truth.value_or(Pose2{});
    for (const double value : {truth.x_m, truth.y_m, truth.yaw_rad}) truths.push_back(frame.truth ? static_cast<float>(value) : none);
    // What happened in frames that are not shown is said of the next that is.
    unsigned flag = 0;
    for (; next <= last; ++next) {
      const RecordedFrame& passed = recording.frames[next];
      flag |= (passed.is_trusted ? 0U : 1U) | (passed.is_lost ? 2U : 0U) | (passed.is_redrawn ? 4U : 0U);
    }
    flags.push_back(static_cast<std::uint8_t>(flag));
    // Thousandths of the range, each less the one before: 0 is invalid, 1001 is nothing met.
    int before = 0;
    for (std::size_t beam = 0; beam < beams; beam += step) {
      const std::uint16_t range = frame.ranges.empty() ? RecordedFrame::range_invalid : frame.ranges[beam];
      int thousandths = std::clamp(static_cast<int>(std::lround(range * 1000.0 / RecordedFrame::range_units)), 1, 1000);
      if (range == RecordedFrame::range_invalid) thousandths = 0;
      if (range == RecordedFrame::range_units) thousandths = 1001;
      ranges.push_back(static_cast<std::int16_t>(thousandths - before));
      before = thousandths;
    }
    for (std::size_t i = 0; i < metrics.size(); ++i) metrics[i].push_back(static_cast<float>(frame.metrics[i]));
  }
  about["beam_angles_rad"] = angles_rad;
  about["beams_recorded"] = beams;
  about["metric_names"] = setup.metric_names;
  columns.add("time_s", times_s);
  columns.add("pose", poses);
  columns.add("covariance", covariances);
  columns.add("truth", truths);
  columns.add("error_m", errors_m);
  columns.add("three_sigma_m", three_sigma_m);
  columns.add("nees", nees);
  columns.add("flags", flags);
  columns.add("ranges", ranges);
  for (std::size_t i = 0; i < metrics.size(); ++i) columns.add(("metric" + std::to_string(i)).c_str(), metrics[i]);
}

/// The cells whose shade differs from that in the frame shown before. Throws std::length_error when the belief has more cells than a browser can
/// hold.
inline void add_cells(Columns& columns, nlohmann::ordered_json& about, const incognita::Recording& recording,
                      const std::vector<std::size_t>& shown) {
  using namespace incognita;
  struct Tile {
    std::array<std::int8_t, 64> now{};
    std::array<std::int8_t, 64> drawn{};
  };
  std::map<std::pair<int, int>, Tile> tiles;
  std::map<std::pair<int, int>, Tile*> touched;
  std::vector<std::uint32_t> counts, low, high;
  std::vector<std::int32_t> places;
  std::vector<std::uint8_t> shades;
  std::size_t next = 0;
  for (const std::size_t last : shown) {
    for (; next <= last; ++next) {
      const RecordedFrame& frame = recording.frames[next];
      for (const RecordedTile& changed : frame.tiles) {
        const std::pair key(changed.tile[1], changed.tile[0]);
        Tile& tile = tiles[key];
        touched[key] = &tile;
        std::size_t level = changed.first_level;
        for (std::size_t bit = 0; bit < 64; ++bit) {
          if ((changed.cells >> bit & 1U) != 0) tile.now[bit] = static_cast<std::int8_t>(shade_of(frame.levels[level++], recording.setup));
        }
      }
    }
    std::uint32_t count = 0;
    std::pair<int, int> before{};
    for (const auto& [key, tile] : touched) {
      CellBits::Word changed = 0;
      for (std::size_t bit = 0; bit < 64; ++bit) {
        if (tile->now[bit] == tile->drawn[bit]) continue;
        changed |= CellBits::Word{1} << bit;
        shades.push_back(static_cast<std::uint8_t>(tile->now[bit] + 4));
      }
      if (changed == 0) continue;
      tile->drawn = tile->now;
      ++count;
      places.push_back(key.second - before.second);
      places.push_back(key.first - before.first);
      before = key;
      low.push_back(static_cast<std::uint32_t>(changed));
      high.push_back(static_cast<std::uint32_t>(changed >> 32U));
    }
    touched.clear();
    counts.push_back(count);
  }
  std::int64_t lower[2] = {0, 0};
  std::int64_t upper[2] = {1, 1};
  for (bool is_first = true; const auto& [key, tile] : tiles) {
    const std::int64_t place[2] = {key.second, key.first};
    for (int axis = 0; axis < 2; ++axis) {
      lower[axis] = is_first ? place[axis] : std::min(lower[axis], place[axis]);
      upper[axis] = is_first ? place[axis] + 1 : std::max(upper[axis], place[axis] + 1);
    }
    is_first = false;
  }
  constexpr std::int64_t side = CellBits::tile_side;
  constexpr std::int64_t cells_max = std::int64_t{1} << 26;
  const std::int64_t width = (upper[0] - lower[0]) * side;
  const std::int64_t height = (upper[1] - lower[1]) * side;
  // A browser draws no image with a longer side.
  if (width > 16384 || height > 16384 || width * height > cells_max) {
    throw std::length_error("its belief spreads over " + std::to_string(width) + " x " + std::to_string(height) +
                            " cells, more than a browser draws (16384 a side, " + std::to_string(cells_max) + " in all)");
  }
  about["belief"] = {{"x", lower[0] * side}, {"y", lower[1] * side}, {"width", width}, {"height", height}};
  columns.add("tile_counts", counts);
  columns.add("tile_places", places);
  columns.add("tile_low", low);
  columns.add("tile_high", high);
  columns.add("shades", shades);
}

inline void add_decisions(Columns& columns, nlohmann::ordered_json& about, const incognita::Recording& recording) {
  using namespace incognita;
  std::vector<std::string> reasons, stop_reasons;
  std::vector<double> times_s;
  std::vector<std::uint8_t> why, stops;
  std::vector<std::uint32_t> candidate_starts{0}, path_starts{0}, frontier_starts{0};
  std::vector<float> frontiers_m, gains_nats, information, costs, utilities, paths_m;
  std::vector<std::int32_t> cells;
  for (const RecordedDecision& decision : recording.decisions) {
    times_s.push_back(decision.time_s);
    why.push_back(number_of(reasons, decision.reason));
    stops.push_back(number_of(stop_reasons, decision.stop_reason));
    for (const RecordedCandidate& candidate : decision.candidates) {
      for (const float value_m : candidate.frontier_m) frontiers_m.push_back(rounded_m(value_m));
      gains_nats.push_back(candidate.gain_nats);
      information.push_back(candidate.information);
      costs.push_back(candidate.navigation_cost);
      utilities.push_back(candidate.utility);
      Points path_m;
      for (const auto& [x_m, y_m] : candidate.path_m) path_m.push_back({double{x_m}, double{y_m}});
      for (const auto& point_m : simplified(path_m, 0.5 * recording.setup.resolution_m)) {
        for (int axis = 0; axis < 2; ++axis) paths_m.push_back(rounded_m(point_m[axis]));
      }
      path_starts.push_back(static_cast<std::uint32_t>(paths_m.size() / 2));
    }
    candidate_starts.push_back(static_cast<std::uint32_t>(gains_nats.size()));
    Index<2> before = zero<Index<2>>();
    for (const Index<2>& cell : decision.frontier) {
      for (int axis = 0; axis < 2; ++axis) cells.push_back(cell[axis] - before[axis]);
      before = cell;
    }
    frontier_starts.push_back(static_cast<std::uint32_t>(cells.size() / 2));
  }
  about["reasons"] = reasons;
  about["stop_reasons"] = stop_reasons;
  columns.add("decision_s", times_s);
  columns.add("decision_reason", why);
  columns.add("decision_stop", stops);
  columns.add("candidate_starts", candidate_starts);
  columns.add("candidate_frontier_m", frontiers_m);
  columns.add("candidate_gain_nats", gains_nats);
  columns.add("candidate_information", information);
  columns.add("candidate_cost", costs);
  columns.add("candidate_utility", utilities);
  columns.add("path_starts", path_starts);
  columns.add("path_m", paths_m);
  columns.add("frontier_starts", frontier_starts);
  columns.add("frontier_cells", cells);
}

inline void add_plan(Columns& columns, nlohmann::ordered_json& about, const incognita::RecordingSetup& setup) {
  about["plan"] = nullptr;
  if (!setup.plan || setup.plan->box().empty()) return;
  const incognita::FloorPlan& plan = *setup.plan;
  const auto corner_m = [&](const incognita::Index<2>& corner) {
    return nlohmann::ordered_json::array({plan.lattice().origin_m()[0] + corner[0] * plan.resolution_m(),
                                          plan.lattice().origin_m()[1] + corner[1] * plan.resolution_m()});
  };
  about["plan"] = {{"T_map_plan", {setup.T_map_plan.x_m, setup.T_map_plan.y_m, setup.T_map_plan.yaw_rad}},
                   {"lower_m", corner_m(plan.box().lower)},
                   {"upper_m", corner_m(plan.box().upper)}};
  std::vector<std::uint32_t> starts{0};
  std::vector<float> points_m;
  // Walls at 45 degrees are straight again, and those of one pixel keep their two sides.
  for (const Points& outline : wall_outlines(plan, 0.75 * plan.resolution_m())) {
    for (const auto& point_m : outline) {
      for (int axis = 0; axis < 2; ++axis) points_m.push_back(rounded_m(point_m[axis]));
    }
    starts.push_back(static_cast<std::uint32_t>(points_m.size() / 2));
  }
  columns.add("wall_starts", starts);
  columns.add("wall_m", points_m);
}

}  // namespace detail

/// All that the page shows of a run, as examples/report/page/recording.js reads it. Throws std::invalid_argument for limits out of their bounds and
/// std::length_error for a belief that is too large. O(bytes of the recording).
[[nodiscard]] inline std::string report_data(const ReportRun& run, const ReportLimits& limits = {}) {
  incognita::require(limits.frames_max >= 2, "ReportLimits", "frames_max", static_cast<double>(limits.frames_max), ">= 2");
  incognita::require(limits.beams_max >= 1, "ReportLimits", "beams_max", static_cast<double>(limits.beams_max), ">= 1");
  const incognita::Recording& recording = run.recording;
  const incognita::RecordingSetup& setup = recording.setup;
  const std::vector<std::size_t> shown = shown_frames(recording.frames.size(), limits.frames_max);
  nlohmann::ordered_json about;
  about["name"] = run.name;
  about["is_whole"] = recording.end.has_value();
  about["torn_bytes"] = recording.torn_bytes;
  about["stop_reason"] = recording.end ? recording.end->stop_reason : "";
  about["metrics_json"] = recording.end ? recording.end->metrics_json : "{}";
  about["parameters_json"] = setup.parameters_json;
  about["frames_recorded"] = recording.frames.size();
  about["resolution_m"] = setup.resolution_m;
  about["robot_radius_m"] = setup.robot_radius_m;
  about["range_max_m"] = setup.range_max_m;
  about["free_below"] = setup.free_below;
  about["occupied_above"] = setup.occupied_above;
  detail::Columns columns;
  detail::add_frames(columns, about, recording, shown, limits.beams_max);
  detail::add_cells(columns, about, recording, shown);
  detail::add_decisions(columns, about, recording);
  detail::add_plan(columns, about, setup);
  return columns.packed(std::move(about));
}

/// Bytes in the format of zlib, as small as it makes them.
[[nodiscard]] inline std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()),
                Z_BEST_COMPRESSION) != Z_OK) {
    throw std::runtime_error("zlib cannot compress " + std::to_string(bytes.size()) + " bytes");
  }
  packed.resize(size);
  return packed;
}

/// Bytes as letters, RFC 4648.
[[nodiscard]] inline std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    std::uint32_t word = 0;
    for (std::size_t i = first; i < first + 3; ++i) word = word << 8U | (i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : 0U);
    for (std::size_t i = 0; i < 4; ++i) text += first + i > bytes.size() ? '=' : letters[word >> (18U - 6U * i) & 63U];
  }
  return text;
}

}  // namespace examples
