/// Other measures of a whole map, to compare signed relative entropy with (Sansoni et al., section 2).
#pragma once

#include <cmath>
#include <numbers>

#include "incognita/core/error.hpp"

namespace incognita {

/// (2): the Shannon entropy of all cells of a map's box in nats, times the size of a cell (m^2 in a plane). Cells that were never
/// measured count as much as the map has room for. A map is what has a grid() of states, CellType::log_odds(state) and
/// resolution_m(). O(cells).
template <class Map>
[[nodiscard]] double map_entropy_nats_by_size(const Map& map) {
  double sum_nats = 0.0;
  for (const auto& state : map.grid().values()) {
    // H(p) = ln(1 + e^l) - p l, of the smaller of p and 1 - p.
    const double l = -std::abs(static_cast<double>(Map::CellType::log_odds(state)));
    sum_nats += std::log1p(std::exp(l)) - l * std::exp(l) / (1.0 + std::exp(l));
  }
  return sum_nats * std::pow(map.resolution_m(), Map::dimension);
}

/// (3) as printed, in bits: log2 of the sum of p^alpha over all cells of a map's box, by 1 - alpha. The probabilities of cells do not
/// add up to 1, so this is not the entropy of a distribution. Throws std::invalid_argument unless alpha is finite, > 0 and not 1.
/// O(cells).
template <class Map>
[[nodiscard]] double map_renyi_bits(const Map& map, double alpha) {
  require_positive("map_renyi_bits", "alpha", alpha);
  require(alpha != 1.0, "map_renyi_bits", "alpha", alpha, "other than 1");
  double sum = 0.0;
  for (const auto& state : map.grid().values()) {
    sum += std::pow(1.0 + std::exp(-static_cast<double>(Map::CellType::log_odds(state))), -alpha);
  }
  return std::log2(sum) / (1.0 - alpha);
}

/// (4), in bits: the Shannon entropy of a map, cell by cell and whatever their size, less (3). Throws as map_renyi_bits. O(cells).
template <class Map>
[[nodiscard]] double map_information_difference_bits(const Map& map, double alpha) {
  const double renyi_bits = map_renyi_bits(map, alpha);
  const double cell_size = std::pow(map.resolution_m(), Map::dimension);
  return map_entropy_nats_by_size(map) / (cell_size * std::numbers::ln2) - renyi_bits;
}

}  // namespace incognita
