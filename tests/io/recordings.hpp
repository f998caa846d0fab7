/// What the tests of recordings share: random ones, their bytes, and what is the same to the bit.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/recording_file.hpp"
#include "support.hpp"

namespace io_test {

/// CRC-32 by its definition, bit by bit.
inline std::uint32_t crc32_by_bits(std::string_view bytes) {
  std::uint32_t rest = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    rest ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~rest;
}

inline std::string little_endian(std::uint32_t value) {
  std::string bytes;
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(static_cast<std::uint8_t>(value >> shift));
  return bytes;
}

/// A record as docs/recording.md says.
inline std::string record(std::uint32_t type, const std::string& payload) {
  const std::string content = little_endian(type) + little_endian(static_cast<std::uint32_t>(payload.size())) + payload;
  return content + little_endian(crc32_by_bits(content));
}

inline std::string recording_head(std::uint32_t version = 1) { return "INCOGREC" + little_endian(version); }

template <class Put, class What>
std::string payload_of(Put&& put, const What& what) {
  incognita::ByteWriter bytes;
  put(bytes, what);
  return bytes.bytes();
}

/// The file that a RecordingWriter would write.
inline std::string bytes_of(const incognita::Recording& recording) {
  using namespace incognita;
  std::string bytes = recording_head() + record(1, payload_of(put_setup, recording.setup));
  for (const RecordedFrame& frame : recording.frames) bytes += record(2, payload_of(put_frame, frame));
  for (const RecordedDecision& decision : recording.decisions) bytes += record(3, payload_of(put_decision, decision));
  if (recording.end) bytes += record(4, payload_of(put_end, *recording.end));
  return bytes;
}

/// Where each record begins, and the end.
inline std::vector<std::size_t> record_places(const std::string& bytes) {
  std::vector<std::size_t> places{12};
  while (places.back() < bytes.size()) {
    std::uint32_t size = 0;
    for (int byte = 3; byte >= 0; --byte) size = size << 8U | static_cast<std::uint8_t>(bytes[places.back() + 4 + static_cast<std::size_t>(byte)]);
    places.push_back(places.back() + 12 + size);
  }
  return places;
}

/// Any finite number, large and small.
inline double any_number(incognita::Random& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(any_bits(random));
    if (std::isfinite(value)) return value;
  }
}

inline std::string any_text(incognita::Random& random, std::size_t length_max) {
  std::string text(random.index(length_max + 1), ' ');
  for (char& letter : text) letter = static_cast<char>(random.index(256));
  return text;
}

inline incognita::Pose2 any_pose(incognita::Random& random) { return {any_number(random), any_number(random), any_number(random)}; }

inline int any_cell(incognita::Random& random, int most) { return static_cast<int>(random.index(2 * static_cast<std::uint64_t>(most) + 1)) - most; }

inline incognita::FloorPlan any_plan(incognita::Random& random) {
  using namespace incognita;
  const Index<2> lower(any_cell(random, 1000), any_cell(random, 1000));
  const IndexBox<2> box{lower, {lower[0] + static_cast<int>(random.index(90)), lower[1] + static_cast<int>(random.index(9))}};
  FloorPlan plan(Lattice<2>(random.uniform(0.01, 1.0), {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)}), box, FloorCell::solid);
  const double change = random.uniform(0.0, 0.3);
  FloorCell kind = FloorCell::floor;
  for (FloorCell& cell : plan.values()) {
    if (random.uniform(0.0, 1.0) < change) kind = static_cast<FloorCell>(random.index(3));
    cell = kind;
  }
  return plan;
}

inline incognita::RecordedFrame any_frame(incognita::Random& random, double time_s, std::size_t beams, std::size_t names) {
  using namespace incognita;
  RecordedFrame frame;
  frame.time_s = time_s;
  frame.pose = any_pose(random);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) frame.covariance(row, column) = frame.covariance(column, row) = any_number(random);
  }
  if (random.index(2) == 0) frame.truth = any_pose(random);
  frame.is_trusted = random.index(2) == 0;
  frame.is_lost = random.index(2) == 0;
  frame.is_redrawn = random.index(2) == 0;
  if (random.index(3) > 0) {
    for (std::size_t beam = 0; beam < beams; ++beam) frame.ranges.push_back(static_cast<std::uint16_t>(random.index(65536)));
  }
  for (std::size_t name = 0; name < names; ++name) frame.metrics.push_back(std::bit_cast<double>(any_bits(random)));
  for (std::uint64_t tiles = random.index(5); tiles > 0; --tiles) {
    const int most = random.index(2) == 0 ? 3 : RecordedFrame::tile_max;
    RecordedTile tile{{any_cell(random, most), any_cell(random, most)}, any_bits(random) | 1U, frame.levels.size()};
    for (int cell = 0; cell < std::popcount(tile.cells); ++cell) frame.levels.push_back(static_cast<std::int8_t>(random.index(256)));
    frame.tiles.push_back(tile);
  }
  return frame;
}

inline incognita::RecordedDecision any_decision(incognita::Random& random, double time_s) {
  using namespace incognita;
  RecordedDecision decision;
  decision.time_s = time_s;
  decision.reason = any_text(random, 20);
  decision.stop_reason = any_text(random, 3);
  const auto any_float = [&] { return static_cast<float>(random.uniform(-1e6, 1e6)); };
  for (std::uint64_t candidates = random.index(4); candidates > 0; --candidates) {
    RecordedCandidate& candidate = decision.candidates.emplace_back();
    candidate.frontier_m = {any_float(), any_float()};
    for (std::uint64_t points = random.index(4); points > 0; --points) candidate.path_m.push_back({any_float(), any_float()});
    for (float* value : {&candidate.gain_nats, &candidate.information, &candidate.navigation_cost, &candidate.utility}) {
      *value = std::bit_cast<float>(static_cast<std::uint32_t>(any_bits(random)));
    }
  }
  for (std::uint64_t cells = random.index(9); cells > 0; --cells) {
    const int most = random.index(4) > 0 ? 50 : recorded_cell_max;
    decision.frontier.emplace_back(any_cell(random, most), any_cell(random, most));
  }
  return decision;
}

/// Of up to `records_max` frames, and decisions.
inline incognita::Recording any_recording(incognita::Random& random, std::size_t records_max) {
  using namespace incognita;
  Recording recording;
  RecordingSetup& setup = recording.setup;
  setup.parameters_json = any_text(random, 40);
  for (double* value : {&setup.resolution_m, &setup.robot_radius_m, &setup.range_max_m}) *value = random.uniform(0.01, 20.0);
  setup.log_odds_step = random.uniform(0.05, 1.0);
  setup.free_below = -random.uniform(0.01, 5.0);
  setup.occupied_above = random.uniform(0.01, 5.0);
  for (std::uint64_t beams = random.index(6); beams > 0; --beams) setup.beam_angles_rad.push_back(static_cast<float>(random.uniform(-4.0, 4.0)));
  for (std::uint64_t names = random.index(4); names > 0; --names) setup.metric_names.push_back(any_text(random, 12));
  if (random.index(2) == 0) {
    setup.plan = any_plan(random);
    setup.T_map_plan = any_pose(random);
  }
  double time_s = random.uniform(-1.0, 1.0);
  for (std::uint64_t frames = random.index(records_max + 1); frames > 0; --frames, time_s += static_cast<double>(random.index(3))) {
    recording.frames.push_back(any_frame(random, time_s, setup.beam_angles_rad.size(), setup.metric_names.size()));
  }
  for (std::uint64_t decisions = random.index(records_max + 1); decisions > 0; --decisions, time_s += static_cast<double>(random.index(3))) {
    recording.decisions.push_back(any_decision(random, time_s));
  }
  if (random.index(2) == 0) recording.end = RecordedEnd{any_text(random, 9), any_text(random, 30)};
  return recording;
}

template <class Number>
bool same_bits(const Number& a, const Number& b) {
  return std::memcmp(&a, &b, sizeof(Number)) == 0;
}

template <class Number>
bool same_bits(const std::vector<Number>& a, const std::vector<Number>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Number)) == 0);
}

inline bool same(const incognita::Pose2& a, const incognita::Pose2& b) {
  return same_bits(a.x_m, b.x_m) && same_bits(a.y_m, b.y_m) && same_bits(a.yaw_rad, b.yaw_rad);
}

inline bool same(const incognita::RecordingSetup& a, const incognita::RecordingSetup& b) {
  bool is_same = a.parameters_json == b.parameters_json && same_bits(a.resolution_m, b.resolution_m) && same_bits(a.log_odds_step, b.log_odds_step) &&
                 same_bits(a.free_below, b.free_below) && same_bits(a.occupied_above, b.occupied_above) &&
                 same_bits(a.robot_radius_m, b.robot_radius_m) && same_bits(a.range_max_m, b.range_max_m) &&
                 same_bits(a.beam_angles_rad, b.beam_angles_rad) && a.metric_names == b.metric_names && a.plan.has_value() == b.plan.has_value();
  if (is_same && a.plan) {
    is_same = same(a.T_map_plan, b.T_map_plan) && a.plan->box() == b.plan->box() && a.plan->values() == b.plan->values() &&
              same_bits(a.plan->resolution_m(), b.plan->resolution_m()) && a.plan->lattice().origin_m() == b.plan->lattice().origin_m();
  }
  return is_same;
}

inline bool same(const incognita::RecordedFrame& a, const incognita::RecordedFrame& b) {
  bool is_same = same_bits(a.time_s, b.time_s) && same(a.pose, b.pose) && a.truth.has_value() == b.truth.has_value() &&
                 (!a.truth || same(*a.truth, *b.truth)) && a.is_trusted == b.is_trusted && a.is_lost == b.is_lost && a.is_redrawn == b.is_redrawn &&
                 a.ranges == b.ranges && same_bits(a.metrics, b.metrics) && a.levels == b.levels && a.tiles.size() == b.tiles.size();
  for (int i = 0; i < 9; ++i) is_same = is_same && same_bits(a.covariance(i), b.covariance(i));
  for (std::size_t i = 0; is_same && i < a.tiles.size(); ++i) {
    is_same = a.tiles[i].tile == b.tiles[i].tile && a.tiles[i].cells == b.tiles[i].cells && a.tiles[i].first_level == b.tiles[i].first_level;
  }
  return is_same;
}

inline bool same(const incognita::RecordedDecision& a, const incognita::RecordedDecision& b) {
  bool is_same = same_bits(a.time_s, b.time_s) && a.reason == b.reason && a.stop_reason == b.stop_reason && a.frontier == b.frontier &&
                 a.candidates.size() == b.candidates.size();
  for (std::size_t i = 0; is_same && i < a.candidates.size(); ++i) {
    const auto& [frontier_m, path_m, gain_nats, information, navigation_cost, utility] = a.candidates[i];
    const auto& other = b.candidates[i];
    is_same = same_bits(frontier_m, other.frontier_m) && same_bits(path_m, other.path_m) && same_bits(gain_nats, other.gain_nats) &&
              same_bits(information, other.information) && same_bits(navigation_cost, other.navigation_cost) && same_bits(utility, other.utility);
  }
  return is_same;
}

inline bool same(const incognita::RecordedEnd& a, const incognita::RecordedEnd& b) {
  return a.stop_reason == b.stop_reason && a.metrics_json == b.metrics_json;
}

template <class What>
bool same(const std::vector<What>& a, const std::vector<What>& b) {
  bool is_same = a.size() == b.size();
  for (std::size_t i = 0; is_same && i < a.size(); ++i) is_same = same(a[i], b[i]);
  return is_same;
}

inline bool same(const incognita::Recording& a, const incognita::Recording& b) {
  return same(a.setup, b.setup) && same(a.frames, b.frames) && same(a.decisions, b.decisions) && a.end.has_value() == b.end.has_value() &&
         (!a.end || same(*a.end, *b.end)) && a.torn_bytes == b.torn_bytes;
}

}  // namespace io_test
