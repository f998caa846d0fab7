/// The belief that the frames of a recording show.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "incognita/io/recording.hpp"
#include "incognita/map/occupancy.hpp"

namespace io_test {

/// Cells by their indices, one by one.
class LevelMap {
 public:
  void take(const incognita::RecordedFrame& frame) {
    incognita::for_each_changed_cell(frame, [&](const incognita::Index<2>& cell, std::int8_t level) { levels_[{cell[0], cell[1]}] = level; });
  }

  [[nodiscard]] int level(const incognita::Index<2>& cell) const {
    const auto found = levels_.find({cell[0], cell[1]});
    return found == levels_.end() ? 0 : found->second;
  }

  [[nodiscard]] std::size_t size() const { return levels_.size(); }

  /// How many cells of the map's box are free, occupied or unknown here and not there, and how many lie outside of it.
  template <class MapType>
  [[nodiscard]] std::size_t count_wrong(const MapType& map, const incognita::RecordingSetup& setup,
                                        const incognita::OccupancyThresholds& thresholds) const {
    using namespace incognita;
    std::size_t wrong = 0;
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      const double shown = level(map.grid().index_at(offset)) * setup.log_odds_step;
      const Occupancy is = shown < setup.free_below ? Occupancy::free : shown > setup.occupied_above ? Occupancy::occupied : Occupancy::unknown;
      if (is != thresholds.classify(map.log_odds(offset))) ++wrong;
    }
    for (const auto& [cell, level] : levels_) {
      if (!map.grid().contains({cell.first, cell.second})) ++wrong;
    }
    return wrong;
  }

 private:
  std::map<std::pair<int, int>, std::int8_t> levels_;
};

}  // namespace io_test
