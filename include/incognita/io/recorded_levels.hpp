/// The log-odds of a map in coarse steps, followed from one frame of a recording to the next.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "incognita/grid/cell_bits.hpp"
#include "incognita/io/recording.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// Levels are log-odds by log_odds_step, rounded away from 0 and cut at 127, but for those that would be on another side of a threshold than their
/// log-odds: levels are free, unknown and occupied where the cells are.
class RecordedLevels {
 public:
  /// For a setup that is valid, and the thresholds that it was made with.
  RecordedLevels(const RecordingSetup& setup, const OccupancyThresholds& thresholds)
      : thresholds_(thresholds),
        per_step_(static_cast<float>(1.0 / setup.log_odds_step)),
        levels_(CellBits(Lattice<2>(setup.resolution_m), false).tiles().lattice()),
        due_in_(levels_.lattice()) {
    constexpr int most = RecordingSetup::level_max;
    free_last_ = -most;
    while (free_last_ + 1 < 0 && (free_last_ + 1) * setup.log_odds_step < setup.free_below) ++free_last_;
    occupied_first_ = most;
    while (occupied_first_ - 1 > 0 && (occupied_first_ - 1) * setup.log_odds_step > setup.occupied_above) --occupied_first_;
  }

  /// Takes note of what the map's last update changed, or of the whole map: the first time, when it was drawn again, and when an update was missed.
  /// O(cells changed), amortised.
  template <class Map>
  void note(const Map& map, bool is_redrawn) {
    if (!is_redrawn && map.update_count() == update_count_) return;
    const IndexBox<2>& tiles = map.layers().changed.tiles().box();
    levels_.grow_to_include(tiles);
    due_in_.grow_to_include(tiles);
    if (!is_redrawn && update_count_ && map.update_count() == *update_count_ + 1) {
      const Grid<CellBits::Word, 2>& changed = map.layers().changed.tiles();
      for (const Index<2>& tile : map.layers().changed_tiles) mark(tile, changed[changed.offset_of(tile)]);
    } else {
      for_each_tile_of(map.grid().box(), [&](const Index<2>& tile) { mark(tile, cells_of_tile(tile, map.grid().box())); });
    }
    update_count_ = map.update_count();
  }

  /// Moves the cells whose level has changed since it was last called into a frame. O(cells noted).
  template <class Map>
  void take(const Map& map, RecordedFrame& frame) {
    frame.tiles.clear();
    frame.levels.clear();
    for (const Index<2>& index : due_) {
      const Offset offset = levels_.offset_of(index);
      Levels& levels = levels_[offset];
      RecordedTile tile{index, 0, frame.levels.size()};
      const auto states = map.states_of(index);
      for (CellBits::Word left = due_in_[offset]; left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        const std::int8_t level = level_of(Map::CellType::log_odds(states(bit)));
        std::int8_t& before = levels[static_cast<std::size_t>(bit)];
        if (level == before) continue;
        before = level;
        tile.cells |= CellBits::Word{1} << bit;
        frame.levels.push_back(level);
      }
      if (tile.cells != 0) frame.tiles.push_back(tile);
      due_in_[offset] = 0;
    }
    due_.clear();
  }

 private:
  using Levels = std::array<std::int8_t, 64>;

  void mark(const Index<2>& tile, CellBits::Word cells) {
    CellBits::Word& due = due_in_[due_in_.offset_of(tile)];
    if (due == 0) due_.push_back(tile);
    due |= cells;
  }

  [[nodiscard]] std::int8_t level_of(float log_odds) const {
    constexpr auto most = static_cast<float>(RecordingSetup::level_max);
    const float steps = std::clamp(log_odds * per_step_, -most, most);
    const int away = static_cast<int>(steps < 0.0F ? std::floor(steps) : std::ceil(steps));
    switch (thresholds_.classify(log_odds)) {
      case Occupancy::free: return static_cast<std::int8_t>(std::min(away, free_last_));
      case Occupancy::occupied: return static_cast<std::int8_t>(std::max(away, occupied_first_));
      case Occupancy::unknown: break;
    }
    return static_cast<std::int8_t>(std::clamp(away, free_last_ + 1, occupied_first_ - 1));
  }

  OccupancyThresholds thresholds_;
  float per_step_;
  int free_last_ = 0;       // the highest level of a free cell
  int occupied_first_ = 0;  // the lowest level of an occupied one
  Grid<Levels, 2> levels_;
  Grid<CellBits::Word, 2> due_in_;  // the cells that were noted
  std::vector<Index<2>> due_;       // the tiles that have any
  std::optional<std::uint64_t> update_count_;
};

}  // namespace incognita
