/// The records of a recording as bytes: docs/recording.md describes them.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "incognita/io/bytes.hpp"
#include "incognita/io/floor_plan_runs.hpp"
#include "incognita/io/recording.hpp"

namespace incognita {

/// What a record holds.
enum class RecordType : std::uint32_t {
  setup = 1,     ///< a RecordingSetup: the first record, and only there
  frame = 2,     ///< a RecordedFrame
  decision = 3,  ///< a RecordedDecision
  end = 4        ///< a RecordedEnd: the last record of a run that was not cut short
};

namespace detail {

inline void put_pose(ByteWriter& bytes, const Pose2& pose) {
  for (const double value : {pose.x_m, pose.y_m, pose.yaw_rad}) bytes.number(value);
}

[[nodiscard]] inline Pose2 take_pose(ByteReader& bytes) {
  Pose2 pose;
  for (double* value : {&pose.x_m, &pose.y_m, &pose.yaw_rad}) *value = bytes.number<double>();
  return pose;
}

/// Indices by their differences: neighbours are near.
inline void put_index(ByteWriter& bytes, Index<2>& last, const Index<2>& index) {
  for (int axis = 0; axis < 2; ++axis) bytes.signed_varint(std::int64_t{index[axis]} - last[axis]);
  last = index;
}

[[nodiscard]] inline Index<2> take_index(ByteReader& bytes, Index<2>& last, int limit) {
  for (int axis = 0; axis < 2; ++axis) {
    const std::int64_t value = std::int64_t{last[axis]} + bytes.small_varint();
    if (value < -std::int64_t{limit} || value > limit) {
      bytes.fail("an index of " + std::to_string(value) + ", which must be from -" + std::to_string(limit) + " to " + std::to_string(limit));
    }
    last[axis] = static_cast<int>(value);
  }
  return last;
}

inline void put_point(ByteWriter& bytes, const std::array<float, 2>& point_m) {
  for (const float value_m : point_m) bytes.number(value_m);
}

[[nodiscard]] inline std::array<float, 2> take_point(ByteReader& bytes) {
  std::array<float, 2> point_m;
  for (float& value_m : point_m) value_m = bytes.number<float>();
  return point_m;
}

}  // namespace detail

/// Each of put_* appends the payload of a record, each of take_* takes it again and throws InputError when the bytes are none. Whether the values
/// are within their bounds is for validate() of what is put and taken to say.
inline void put_setup(ByteWriter& bytes, const RecordingSetup& setup) {
  bytes.text(setup.parameters_json);
  for (const double value : {setup.resolution_m, setup.log_odds_step, setup.free_below, setup.occupied_above, setup.robot_radius_m,
                             setup.range_max_m}) {
    bytes.number(value);
  }
  bytes.varint(setup.beam_angles_rad.size());
  bytes.numbers(setup.beam_angles_rad);
  bytes.varint(setup.metric_names.size());
  for (const std::string& name : setup.metric_names) bytes.text(name);
  bytes.number(static_cast<std::uint8_t>(setup.plan ? 1 : 0));
  if (!setup.plan) return;
  detail::put_pose(bytes, setup.T_map_plan);
  put_floor_plan(bytes, *setup.plan);
}

/// See put_setup. Throws InputError.
[[nodiscard]] inline RecordingSetup take_setup(ByteReader& bytes) {
  RecordingSetup setup;
  setup.parameters_json = bytes.text();
  for (double* value : {&setup.resolution_m, &setup.log_odds_step, &setup.free_below, &setup.occupied_above, &setup.robot_radius_m,
                        &setup.range_max_m}) {
    *value = bytes.number<double>();
  }
  setup.beam_angles_rad = bytes.numbers<float>(bytes.count(4));
  setup.metric_names.resize(bytes.count(1));
  for (std::string& name : setup.metric_names) name = bytes.text();
  if (!bytes.flag()) return setup;
  setup.T_map_plan = detail::take_pose(bytes);
  setup.plan = take_floor_plan(bytes);
  return setup;
}

/// See put_setup. O(size of the payload), as for the others.
inline void put_frame(ByteWriter& bytes, const RecordedFrame& frame) {
  bytes.number(frame.time_s);
  detail::put_pose(bytes, frame.pose);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) bytes.number(frame.covariance(row, column));
  }
  const unsigned flags = (frame.is_trusted ? 1U : 0U) | (frame.is_lost ? 2U : 0U) | (frame.is_redrawn ? 4U : 0U) | (frame.truth ? 8U : 0U);
  bytes.number(static_cast<std::uint8_t>(flags));
  if (frame.truth) detail::put_pose(bytes, *frame.truth);
  bytes.varint(frame.ranges.size());
  bytes.numbers(frame.ranges);
  bytes.varint(frame.metrics.size());
  bytes.numbers(frame.metrics);
  bytes.varint(frame.tiles.size());
  Index<2> last = zero<Index<2>>();
  for (const RecordedTile& tile : frame.tiles) {
    detail::put_index(bytes, last, tile.tile);
    bytes.number(tile.cells);
  }
  bytes.numbers(frame.levels);
}

/// See put_setup. Throws InputError.
[[nodiscard]] inline RecordedFrame take_frame(ByteReader& bytes) {
  RecordedFrame frame;
  frame.time_s = bytes.number<double>();
  frame.pose = detail::take_pose(bytes);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) frame.covariance(row, column) = frame.covariance(column, row) = bytes.number<double>();
  }
  const auto flags = bytes.number<std::uint8_t>();
  if (flags > 15) bytes.fail("flags of " + std::to_string(flags) + ", which must be 0 to 15");
  frame.is_trusted = (flags & 1U) != 0;
  frame.is_lost = (flags & 2U) != 0;
  frame.is_redrawn = (flags & 4U) != 0;
  if ((flags & 8U) != 0) frame.truth = detail::take_pose(bytes);
  frame.ranges = bytes.numbers<std::uint16_t>(bytes.count(2));
  frame.metrics = bytes.numbers<double>(bytes.count(8));
  frame.tiles.resize(bytes.count(2 + 8 + 1));
  Index<2> last = zero<Index<2>>();
  std::size_t cells = 0;
  for (RecordedTile& tile : frame.tiles) {
    tile = {detail::take_index(bytes, last, RecordedFrame::tile_max), bytes.number<CellBits::Word>(), cells};
    cells += static_cast<std::size_t>(std::popcount(tile.cells));
  }
  frame.levels = bytes.numbers<std::int8_t>(cells);
  return frame;
}

/// See put_setup.
inline void put_decision(ByteWriter& bytes, const RecordedDecision& decision) {
  bytes.number(decision.time_s);
  bytes.text(decision.reason);
  bytes.text(decision.stop_reason);
  bytes.varint(decision.candidates.size());
  for (const RecordedCandidate& candidate : decision.candidates) {
    detail::put_point(bytes, candidate.frontier_m);
    for (const float value : {candidate.gain_nats, candidate.information, candidate.navigation_cost, candidate.utility}) bytes.number(value);
    bytes.varint(candidate.path_m.size());
    for (const std::array<float, 2>& point_m : candidate.path_m) detail::put_point(bytes, point_m);
  }
  bytes.varint(decision.frontier.size());
  Index<2> last = zero<Index<2>>();
  for (const Index<2>& cell : decision.frontier) detail::put_index(bytes, last, cell);
}

/// See put_setup. Throws InputError.
[[nodiscard]] inline RecordedDecision take_decision(ByteReader& bytes) {
  RecordedDecision decision;
  decision.time_s = bytes.number<double>();
  decision.reason = bytes.text();
  decision.stop_reason = bytes.text();
  decision.candidates.resize(bytes.count(6 * 4 + 1));
  for (RecordedCandidate& candidate : decision.candidates) {
    candidate.frontier_m = detail::take_point(bytes);
    for (float* value : {&candidate.gain_nats, &candidate.information, &candidate.navigation_cost, &candidate.utility}) {
      *value = bytes.number<float>();
    }
    candidate.path_m.resize(bytes.count(8));
    for (std::array<float, 2>& point_m : candidate.path_m) point_m = detail::take_point(bytes);
  }
  decision.frontier.resize(bytes.count(2));
  Index<2> last = zero<Index<2>>();
  for (Index<2>& cell : decision.frontier) cell = detail::take_index(bytes, last, recorded_cell_max);
  return decision;
}

/// See put_setup.
inline void put_end(ByteWriter& bytes, const RecordedEnd& end) {
  bytes.text(end.stop_reason);
  bytes.text(end.metrics_json);
}

/// See put_setup. Throws InputError.
[[nodiscard]] inline RecordedEnd take_end(ByteReader& bytes) {
  RecordedEnd end;
  end.stop_reason = bytes.text();
  end.metrics_json = bytes.text();
  return end;
}

}  // namespace incognita
