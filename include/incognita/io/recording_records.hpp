/// The records of a recording as bytes: docs/recording.md describes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "incognita/io/bytes.hpp"
#include "incognita/io/recording.hpp"

namespace incognita {

/// What a record holds.
enum class RecordType : std::uint32_t { setup = 1, frame = 2, decision = 3, end = 4 };

namespace detail {

inline void put_pose(ByteWriter& bytes, const Pose2& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.yaw_rad}) bytes.number(value);
}

[[nodiscard]] inline Pose2 take_pose(ByteReader& bytes) {
  Pose2 pose;
  for (double* value : {&pose.x_m, &pose.y_m, &pose.yaw_rad}) *value = bytes.number<double>();
  if (!pose.is_finite()) bytes.fail("a pose that is not finite");
  return pose;
}

/// Indices by their differences.
inline void put_index(ByteWriter& bytes, Index<2>& last, const Index<2>& index) {
  for (int axis = 0; axis < 2; ++axis) bytes.signed_varint(std::int64_t{index[axis]} - last[axis]);
  last = index;
}

/// Cells stay within what a lattice counts, a tile's cells too.
[[nodiscard]] inline Index<2> take_index(ByteReader& bytes, Index<2>& last, int largest) {
  for (int axis = 0; axis < 2; ++axis) {
    const std::int64_t value = std::int64_t{last[axis]} + bytes.small_varint();
    if (value < -largest || value > largest) bytes.fail("an index of " + std::to_string(value) + ", which must be within " + std::to_string(largest));
    last[axis] = static_cast<int>(value);
  }
  return last;
}

inline constexpr int largest_cell = 1 << 28;

[[nodiscard]] inline double take_positive(ByteReader& bytes, const char* name) {
  const auto value = bytes.number<double>();
  if (!(value > 0.0 && value < 1e9)) bytes.fail(std::string(name) + " of " + std::to_string(value) + ", which must be in (0, 1e9)");
  return value;
}

}  // namespace detail

[[nodiscard]] inline std::string setup_record(const RecordingSetup& setup) {
  ByteWriter bytes;
  bytes.text(setup.parameters_json);
  for (const double value : {setup.resolution_m, setup.log_odds_step, setup.free_below, setup.occupied_above, setup.robot_radius_m,
                             setup.range_max_m}) {
    bytes.number(value);
  }
  bytes.varint(setup.beam_angles_rad.size());
  for (const float angle_rad : setup.beam_angles_rad) bytes.number(angle_rad);
  bytes.varint(setup.metric_names.size());
  for (const std::string& name : setup.metric_names) bytes.text(name);
  bytes.number(static_cast<std::uint8_t>(setup.plan.has_value()));
  if (setup.plan) {
    const FloorPlan& plan = *setup.plan;
    detail::put_pose(bytes, setup.T_map_plan);
    bytes.number(plan.resolution_m());
    for (int axis = 0; axis < 2; ++axis) bytes.number(plan.lattice().origin_m()[axis]);
    for (int axis = 0; axis < 2; ++axis) bytes.signed_varint(plan.box().lower[axis]);
    for (int axis = 0; axis < 2; ++axis) bytes.varint(static_cast<std::uint64_t>(plan.box().extent()[axis]));
    // Runs of equal cells, row by row: how long, and of what.
    const auto& cells = plan.values();
    std::size_t runs = 0;
    ByteWriter body;
    for (std::size_t first = 0; first < cells.size(); ++runs) {
      std::size_t last = first;
      while (last < cells.size() && cells[last] == cells[first]) ++last;
      body.varint(last - first);
      body.number(static_cast<std::uint8_t>(cells[first]));
      first = last;
    }
    bytes.varint(runs);
    return bytes.bytes() + body.bytes();
  }
  return bytes.bytes();
}

[[nodiscard]] inline RecordingSetup parse_setup_record(ByteReader bytes) {
  RecordingSetup setup;
  setup.parameters_json = bytes.text();
  setup.resolution_m = detail::take_positive(bytes, "a resolution");
  setup.log_odds_step = detail::take_positive(bytes, "a step of log-odds");
  setup.free_below = bytes.number<double>();
  setup.occupied_above = bytes.number<double>();
  if (!(setup.free_below < setup.occupied_above)) bytes.fail("a threshold of free cells that is not below that of occupied ones");
  setup.robot_radius_m = detail::take_positive(bytes, "a radius");
  setup.range_max_m = detail::take_positive(bytes, "a range");
  setup.beam_angles_rad.resize(bytes.count(4));
  for (float& angle_rad : setup.beam_angles_rad) angle_rad = bytes.number<float>();
  setup.metric_names.resize(bytes.count(1));
  for (std::string& name : setup.metric_names) name = bytes.text();
  if (bytes.flag()) {
    setup.T_map_plan = detail::take_pose(bytes);
    const double resolution_m = detail::take_positive(bytes, "a resolution");
    Eigen::Vector2d origin_m;
    for (int axis = 0; axis < 2; ++axis) origin_m[axis] = bytes.number<double>();
    if (!origin_m.allFinite()) bytes.fail("an origin that is not finite");
    IndexBox<2> box;
    for (int axis = 0; axis < 2; ++axis) box.lower[axis] = bytes.small_varint();
    for (int axis = 0; axis < 2; ++axis) {
      const std::uint64_t extent = bytes.varint();
      const bool fits = extent <= detail::largest_cell && std::abs(std::int64_t{box.lower[axis]}) <= detail::largest_cell;
      if (!fits) bytes.fail("a floor plan that is too large");
      box.upper[axis] = box.lower[axis] + static_cast<int>(extent);
    }
    // A plan may be all of one kind, so its size is bounded by itself and not by the bytes there are.
    const std::uint64_t cells = static_cast<std::uint64_t>(box.extent()[0]) * static_cast<std::uint64_t>(box.extent()[1]);
    constexpr std::uint64_t most = std::uint64_t{1} << 27;
    if (cells > most) bytes.fail("a floor plan of " + std::to_string(cells) + " cells, more than " + std::to_string(most));
    std::size_t runs = bytes.count(2);
    // What the runs hold is counted before there is room made for it.
    ByteReader counting = bytes;
    std::uint64_t total = 0;
    for (std::size_t run = 0; run < runs; ++run) {
      const std::uint64_t length = counting.varint();
      if (length > cells - total) counting.fail("a run of " + std::to_string(length) + " cells beyond the end of the floor plan");
      total += length;
      if (counting.number<std::uint8_t>() > static_cast<std::uint8_t>(FloorCell::solid)) counting.fail("a cell of no known kind");
    }
    if (total != cells) counting.fail("the end of a floor plan that lacks " + std::to_string(cells - total) + " cells");
    FloorPlan plan(Lattice<2>(resolution_m, origin_m), box, FloorCell::solid);
    std::size_t offset = 0;
    for (; runs > 0; --runs) {
      const std::uint64_t length = bytes.varint();
      const auto kind = static_cast<FloorCell>(bytes.number<std::uint8_t>());
      for (std::uint64_t i = 0; i < length; ++i) plan.values()[offset++] = kind;
    }
    setup.plan = std::move(plan);
  }
  bytes.require_end();
  return setup;
}

[[nodiscard]] inline std::string frame_record(const RecordedFrame& frame) {
  ByteWriter bytes;
  bytes.number(frame.time_s);
  detail::put_pose(bytes, frame.pose);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) bytes.number(frame.covariance(row, column));
  }
  const unsigned flags = (frame.is_trusted ? 1U : 0U) | (frame.is_lost ? 2U : 0U) | (frame.is_redrawn ? 4U : 0U) | (frame.truth ? 8U : 0U);
  bytes.number(static_cast<std::uint8_t>(flags));
  if (frame.truth) detail::put_pose(bytes, *frame.truth);
  bytes.varint(frame.ranges.size());
  for (const std::uint16_t range : frame.ranges) bytes.number(range);
  bytes.varint(frame.metrics.size());
  for (const double metric : frame.metrics) bytes.number(metric);
  bytes.varint(frame.tiles.size());
  Index<2> last = zero<Index<2>>();
  for (const RecordedTile& tile : frame.tiles) {
    detail::put_index(bytes, last, tile.tile);
    bytes.number(tile.cells);
  }
  for (const std::int8_t level : frame.levels) bytes.number(level);
  return bytes.bytes();
}

[[nodiscard]] inline RecordedFrame parse_frame_record(ByteReader bytes) {
  RecordedFrame frame;
  frame.time_s = bytes.number<double>();
  if (!std::isfinite(frame.time_s)) bytes.fail("a time that is not finite");
  frame.pose = detail::take_pose(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) frame.covariance(row, column) = frame.covariance(column, row) = bytes.number<double>();
  }
  if (!frame.covariance.allFinite()) bytes.fail("a covariance that is not finite");
  const auto flags = bytes.number<std::uint8_t>();
  if (flags > 15) bytes.fail("flags of " + std::to_string(flags) + ", which must be 0 to 15");
  frame.is_trusted = (flags & 1U) != 0;
  frame.is_lost = (flags & 2U) != 0;
  frame.is_redrawn = (flags & 4U) != 0;
  if ((flags & 8U) != 0) frame.truth = detail::take_pose(bytes);
  frame.ranges.resize(bytes.count(2));
  for (std::uint16_t& range : frame.ranges) range = bytes.number<std::uint16_t>();
  frame.metrics.resize(bytes.count(8));
  for (double& metric : frame.metrics) metric = bytes.number<double>();
  frame.tiles.resize(bytes.count(2 + 8 + 1));
  Index<2> last = zero<Index<2>>();
  std::size_t levels = 0;
  for (RecordedTile& tile : frame.tiles) {
    tile.tile = detail::take_index(bytes, last, detail::largest_cell / CellBits::tile_side);
    tile.cells = bytes.number<CellBits::Word>();
    if (tile.cells == 0) bytes.fail("the end of a tile without cells");
    tile.first_level = levels;
    levels += static_cast<std::size_t>(std::popcount(tile.cells));
  }
  if (levels != bytes.left()) bytes.fail("room for " + std::to_string(bytes.left()) + " levels, but " + std::to_string(levels) + " cells");
  frame.levels.resize(levels);
  for (std::int8_t& level : frame.levels) level = bytes.number<std::int8_t>();
  return frame;
}

[[nodiscard]] inline std::string decision_record(const RecordedDecision& decision) {
  ByteWriter bytes;
  bytes.number(decision.time_s);
  bytes.text(decision.reason);
  bytes.text(decision.stop_reason);
  bytes.varint(decision.candidates.size());
  for (const RecordedCandidate& candidate : decision.candidates) {
    for (const float value : {candidate.frontier_m[0], candidate.frontier_m[1], candidate.gain_nats, candidate.information,
                              candidate.navigation_cost, candidate.utility}) {
      bytes.number(value);
    }
    bytes.varint(candidate.path_m.size());
    for (const auto& [x_m, y_m] : candidate.path_m) {
      bytes.number(x_m);
      bytes.number(y_m);
    }
  }
  bytes.varint(decision.frontier.size());
  Index<2> last = zero<Index<2>>();
  for (const Index<2>& cell : decision.frontier) detail::put_index(bytes, last, cell);
  return bytes.bytes();
}

[[nodiscard]] inline RecordedDecision parse_decision_record(ByteReader bytes) {
  RecordedDecision decision;
  decision.time_s = bytes.number<double>();
  if (!std::isfinite(decision.time_s)) bytes.fail("a time that is not finite");
  decision.reason = bytes.text();
  decision.stop_reason = bytes.text();
  decision.candidates.resize(bytes.count(6 * 4 + 1));
  for (RecordedCandidate& candidate : decision.candidates) {
    for (float* value : {&candidate.frontier_m[0], &candidate.frontier_m[1], &candidate.gain_nats, &candidate.information,
                         &candidate.navigation_cost, &candidate.utility}) {
      *value = bytes.number<float>();
    }
    candidate.path_m.resize(bytes.count(8));
    for (auto& [x_m, y_m] : candidate.path_m) {
      x_m = bytes.number<float>();
      y_m = bytes.number<float>();
    }
  }
  decision.frontier.resize(bytes.count(2));
  Index<2> last = zero<Index<2>>();
  for (Index<2>& cell : decision.frontier) cell = detail::take_index(bytes, last, detail::largest_cell);
  bytes.require_end();
  return decision;
}

[[nodiscard]] inline std::string end_record(const RecordedEnd& end) {
  ByteWriter bytes;
  bytes.text(end.stop_reason);
  bytes.text(end.metrics_json);
  return bytes.bytes();
}

[[nodiscard]] inline RecordedEnd parse_end_record(ByteReader bytes) {
  RecordedEnd end;
  end.stop_reason = bytes.text();
  end.metrics_json = bytes.text();
  bytes.require_end();
  return end;
}

}  // namespace incognita
