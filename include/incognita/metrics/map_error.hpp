/// How far a belief is from the true map, and how much uncertainty it has lost.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// Seo et al., section VI-A, "Map error": sqrt(mean of (1 - p)^2 over the occupied cells + mean of p^2 over
/// the free ones), p the probability of being occupied. In [0, sqrt 2]; the paper's formula has a factor 100
/// that its tables leave out, as here. A plain accumulator: add the cells in a fixed order and the sum is the
/// same to the bit.
class MapError {
 public:
  /// One cell with natural log-odds. Log-odds of exactly 0 mean that the cell was never touched: it is left
  /// out.
  void add(double log_odds, bool truly_occupied) {
    if (log_odds == 0.0) return;
    const double wrong = 1.0 / (1.0 + std::exp(truly_occupied ? log_odds : -log_odds));
    Class& cells = truly_occupied ? occupied_ : free_;
    cells.squares += wrong * wrong;
    ++cells.count;
  }

  [[nodiscard]] std::size_t occupied_count() const { return occupied_.count; }  ///< the truly occupied cells that were added
  [[nodiscard]] std::size_t free_count() const { return free_.count; }  ///< the truly free ones

  /// Without a unit, in [0, sqrt(2)]. A class without cells adds 0.
  [[nodiscard]] double value() const { return std::sqrt(occupied_.mean() + free_.mean()); }

 private:
  struct Class {
    double squares = 0.0;
    std::size_t count = 0;
    [[nodiscard]] double mean() const { return count == 0 ? 0.0 : squares / static_cast<double>(count); }
  };

  Class occupied_;
  Class free_;
};

/// The error of a whole map (a grid() and log_odds(offset)) against truly_occupied_cells on the same lattice.
/// O(cells).
template <class Map>
[[nodiscard]] MapError map_error(const Map& map, const Grid<std::uint8_t, Map::dimension>& truly_occupied) {
  MapError error;
  for (Offset cell = 0; cell < static_cast<Offset>(map.grid().size()); ++cell) {
    const double log_odds = static_cast<double>(map.log_odds(cell));
    if (log_odds != 0.0) error.add(log_odds, truly_occupied.value(map.grid().index_at(cell)) != 0);
  }
  return error;
}

/// Seo et al., section VI-A, "Map uncertainty": the mean loss of Shannon entropy a step of 0.02 s, which
/// telescopes to (first - last) / steps. Entropies in nats over the same cells; the result in bits. 0 for no
/// steps.
[[nodiscard]] inline double map_uncertainty_bits_per_step(double first_entropy, double last_entropy,
                                                          std::size_t steps) {
  if (steps == 0) return 0.0;
  return (first_entropy - last_entropy) / (std::numbers::ln2 * static_cast<double>(steps));
}

}  // namespace incognita
