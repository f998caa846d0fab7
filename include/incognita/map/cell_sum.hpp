/// The sum of a number of each cell of a map of the plane, followed scan by scan.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "incognita/grid/cell_bits.hpp"
#include "incognita/map/map.hpp"

namespace incognita {

/// Adds up measure(policy, state), which must be 0 for cells that were never measured, so that the sum does not depend on how much
/// room the map has. Kept up to date at the cost of what changes, a tile at a time, in whole units of 2^-32: however it was come
/// by, it is the same to the bit. Holds sums up to 2^31.
template <class Measure>
class CellSum {
 public:
  /// Of a map on this lattice that has no cells yet; rebuild takes one that has.
  explicit CellSum(const Lattice<2>& lattice, Measure measure = Measure{})
      : measure_(std::move(measure)), tiles_(CellBits(lattice, false).tiles().lattice()) {}

  /// Takes over what the map's last update changed, or the whole map when more than one update was missed (rebuild). Another map
  /// must be taken by rebuild. O(tiles changed), amortised.
  template <CellPolicy Cell>
  void follow(const Map<Cell, 2>& map) {
    if (map.update_count() == update_count_) return;
    if (map.update_count() != update_count_ + 1) return rebuild(map);
    update_count_ = map.update_count();
    make_room_for(map);
    for (const Index<2>& tile : map.layers().changed_tiles) take_tile(map, tile);
  }

  /// Takes a map as it is. O(cells).
  template <CellPolicy Cell>
  void rebuild(const Map<Cell, 2>& map) {
    tiles_ = Grid<std::int64_t, 2>(tiles_.lattice());
    total_ = 0;
    update_count_ = map.update_count();
    make_room_for(map);
    for_each_tile_of(map.grid().box(), [&](const Index<2>& tile) { take_tile(map, tile); });
  }

  /// The sum, in the unit of the measure.
  [[nodiscard]] double value() const { return static_cast<double>(total_) / units_per_one; }

 private:
  template <class MapType>
  void make_room_for(const MapType& map) {
    tiles_.grow_to_include(map.layers().changed.tiles().box());
  }

  template <class MapType>
  void take_tile(const MapType& map, const Index<2>& tile) {
    const auto states = map.states_of(tile);
    double sum = 0.0;
    for (CellBits::Word left = cells_of_tile(tile, map.grid().box()); left != 0; left &= left - 1U) {
      sum += measure_(map.cell(), states(std::countr_zero(left)));
    }
    std::int64_t& units = tiles_[tiles_.offset_of(tile)];
    total_ -= units;
    units = std::llround(sum * units_per_one);
    total_ += units;
  }

  static constexpr double units_per_one = 4294967296.0;

  Measure measure_;
  Grid<std::int64_t, 2> tiles_;
  std::int64_t total_ = 0;
  std::uint64_t update_count_ = 0;
};

}  // namespace incognita
