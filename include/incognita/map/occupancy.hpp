/// What a belief says of a cell in one word; what frontiers and planning read.
#pragma once

#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

enum class Occupancy : std::uint8_t { unknown, free, occupied };

/// A map reduced to what frontiers and planners need. Make it with Occupancy::unknown as the fill value.
template <int Dim>
using OccupancyGrid = Grid<Occupancy, Dim>;

/// Where a cell's log-odds end to be unknown. Reading of Seo et al.: +-1.0 measured best for frontiers.
struct OccupancyThresholds {
  float free_below = -1.0F;     ///< log-odds under which a cell is free, < 0
  float occupied_above = 1.0F;  ///< log-odds over which a cell is occupied, > 0

  [[nodiscard]] Occupancy classify(float log_odds) const {
    if (log_odds < free_below) return Occupancy::free;
    return log_odds > occupied_above ? Occupancy::occupied : Occupancy::unknown;
  }

  /// Throws std::invalid_argument when a threshold lies on the wrong side of 0.
  void validate() const {
    require(free_below < 0.0F, "OccupancyThresholds", "free_below", static_cast<double>(free_below), "< 0");
    require(occupied_above > 0.0F, "OccupancyThresholds", "occupied_above", static_cast<double>(occupied_above),
            "> 0");
  }
};

}  // namespace incognita
