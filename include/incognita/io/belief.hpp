/// What a map believes, as grids that files are made of.
#pragma once

#include "incognita/grid/grid.hpp"
#include "incognita/io/map_server.hpp"
#include "incognita/map/map.hpp"

namespace incognita {

/// The smallest box with all cells that say something: whose log-odds are not 0. Empty when none does. O(cells).
template <class Cell, int Dim>
[[nodiscard]] IndexBox<Dim> believed_cells(const Map<Cell, Dim>& map) {
  IndexBox<Dim> believed;
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    if (map.log_odds(offset) != 0.0F) {
      believed = enclosing_box(believed, box_of_cell<Dim>(map.grid().index_at(offset)));
    }
  }
  return believed;
}

/// The log-odds of those cells; 0 is unknown.
template <class Cell, int Dim>
[[nodiscard]] Grid<float, Dim> belief_log_odds(const Map<Cell, Dim>& map) {
  Grid<float, Dim> log_odds(map.lattice(), believed_cells(map), 0.0F);
  for (Offset offset = 0; offset < static_cast<Offset>(log_odds.size()); ++offset) {
    log_odds[offset] = map.log_odds(log_odds.index_at(offset));
  }
  return log_odds;
}

/// The probabilities of those cells that they are occupied; unknown_probability where nothing is known.
template <class Cell>
[[nodiscard]] ProbabilityGrid belief_probabilities(const Map<Cell, 2>& map) {
  const Grid<float, 2> log_odds = belief_log_odds(map);
  ProbabilityGrid probabilities(log_odds.lattice(), log_odds.box(), unknown_probability);
  for (Offset offset = 0; offset < static_cast<Offset>(log_odds.size()); ++offset) {
    if (log_odds[offset] == 0.0F) continue;
    probabilities[offset] = static_cast<float>(probability_of_log_odds(static_cast<double>(log_odds[offset])));
  }
  return probabilities;
}

/// Those cells in one word each. Throws std::invalid_argument for bad thresholds. O(cells).
template <class Cell, int Dim>
[[nodiscard]] OccupancyGrid<Dim> belief_occupancy(const Map<Cell, Dim>& map,
                                                  const OccupancyThresholds& thresholds = {}) {
  thresholds.validate();
  OccupancyGrid<Dim> occupancy(map.lattice(), believed_cells(map), Occupancy::unknown);
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    occupancy[offset] = thresholds.classify(map.log_odds(occupancy.index_at(offset)));
  }
  return occupancy;
}

}  // namespace incognita
