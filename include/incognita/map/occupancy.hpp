/// What a belief says of a cell in one word; what frontiers and planning read.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "incognita/core/error.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// What a belief is reduced to.
enum class Occupancy : std::uint8_t {
  unknown,  ///< measured too little, or never
  free,     ///< below one threshold of log-odds
  occupied  ///< above another
};

/// A map reduced to what frontiers and planners need. Make it with Occupancy::unknown as the fill value.
template <int Dim>
using OccupancyGrid = Grid<Occupancy, Dim>;

/// Where a cell's log-odds end to be unknown. Reading of Seo et al.: +-1.0 measured best for frontiers.
struct OccupancyThresholds {
  float free_below = -1.0F;     ///< log-odds under which a cell is free, < 0
  float occupied_above = 1.0F;  ///< log-odds over which a cell is occupied, > 0

  /// (1) of Isleyen, van de Molengraft and Arslan: free up to a probability, occupied from another on. Throws std::invalid_argument
  /// unless 0 <= free_max < 0.5 < occupied_min <= 1: what nothing was measured of must be unknown.
  [[nodiscard]] static OccupancyThresholds of_probabilities(double free_max, double occupied_min) {
    require(free_max >= 0.0 && free_max < 0.5, "OccupancyThresholds", "free_max", free_max, "in [0, 0.5)");
    require(occupied_min > 0.5 && occupied_min <= 1.0, "OccupancyThresholds", "occupied_min", occupied_min, "in (0.5, 1]");
    const auto log_odds = [](double p) { return static_cast<float>(std::log(p / (1.0 - p))); };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {std::nextafter(log_odds(free_max), infinity), std::nextafter(log_odds(occupied_min), -infinity)};
  }

  /// Those of OctoMap, by which every node that was measured is free or, from a probability of 0.5 on, occupied. Log-odds of exactly 0,
  /// which OctoMap calls occupied, are unknown here. For what is measured a few times at least: no frontier survives a doubt.
  [[nodiscard]] static OccupancyThresholds octomap() {
    constexpr float least = std::numeric_limits<float>::min();
    return {-least, least};
  }

  /// What log-odds make of a cell.
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

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("free_below, occupied_above", free_below, occupied_above);
  }
};

}  // namespace incognita
