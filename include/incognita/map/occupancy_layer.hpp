/// What is free, occupied and unknown in a map of the plane, followed scan by scan.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "incognita/grid/cell_bits.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// The same as classify(map), kept up to date at the cost of the cells that change. Its box holds the tiles in which something is
/// known, or was; all else is unknown. Safe to read from many threads.
class OccupancyLayer {
 public:
  /// Of no cells yet. Throws std::invalid_argument for bad thresholds.
  explicit OccupancyLayer(const Lattice<2>& lattice, const OccupancyThresholds& thresholds = {})
      : thresholds_(thresholds), grid_(lattice, {}, Occupancy::unknown), free_(lattice, false), occupied_(lattice, false) {
    thresholds_.validate();
  }

  /// Takes over what the map's last update changed. To be called once after each update; a map that was changed otherwise, or is
  /// another one, must be taken anew (rebuild). O(tiles changed).
  template <CellPolicy Cell>
  void follow(const Map<Cell, 2>& map) {
    changed_tiles_.clear();
    for (const Index<2>& tile : map.layers().changed_tiles) {
      classify_tile(map, tile, map.layers().changed.tiles().value(tile));
    }
  }

  /// Takes a map as it is. O(cells).
  template <CellPolicy Cell>
  void rebuild(const Map<Cell, 2>& map) {
    *this = OccupancyLayer(map.lattice(), thresholds_);
    const IndexBox<2>& box = map.grid().box();
    for_each_tile_of(box, [&](const Index<2>& tile) { classify_tile(map, tile, cells_of_tile(tile, box)); });
  }

  [[nodiscard]] const OccupancyGrid<2>& grid() const { return grid_; }
  [[nodiscard]] const CellBits& free() const { return free_; }
  [[nodiscard]] const CellBits& occupied() const { return occupied_; }

  /// The tiles in which a cell was found to be something else by the last follow or rebuild.
  [[nodiscard]] const std::vector<Index<2>>& changed_tiles() const { return changed_tiles_; }

 private:
  template <class MapType>
  void classify_tile(const MapType& map, const Index<2>& tile, CellBits::Word cells) {
    const auto states = map.states_of(tile);
    CellBits::Word free = 0;
    CellBits::Word occupied = 0;
    for (CellBits::Word left = cells; left != 0; left &= left - 1U) {
      const int bit = std::countr_zero(left);
      const Occupancy occupancy = thresholds_.classify(MapType::CellType::log_odds(states(bit)));
      free |= static_cast<CellBits::Word>(occupancy == Occupancy::free) << bit;
      occupied |= static_cast<CellBits::Word>(occupancy == Occupancy::occupied) << bit;
    }
    if ((free | occupied) != 0) make_room_for(tile);
    if (!free_.tiles().contains(tile)) return;
    const Offset place = free_.tiles().offset_of(tile);
    CellBits::Word& was_free = free_.tiles()[place];
    CellBits::Word& was_occupied = occupied_.tiles()[place];
    const CellBits::Word changed = ((was_free ^ free) | (was_occupied ^ occupied)) & cells;
    if (changed == 0) return;
    was_free ^= (was_free ^ free) & cells;
    was_occupied ^= (was_occupied ^ occupied) & cells;
    for (CellBits::Word left = changed; left != 0; left &= left - 1U) {
      const CellBits::Word cell = left & -left;
      grid_[grid_.offset_of(CellBits::cell_of(tile, std::countr_zero(left)))] =
          (free & cell) != 0 ? Occupancy::free : (occupied & cell) != 0 ? Occupancy::occupied : Occupancy::unknown;
    }
    changed_tiles_.push_back(tile);
  }

  void make_room_for(const Index<2>& tile) {
    IndexBox<2> cells = box_of_cell<2>(CellBits::cell_of(tile, 0));
    for (int axis = 0; axis < 2; ++axis) cells.upper[axis] = cells.lower[axis] + CellBits::tile_side;
    grid_.grow_just_to_include(cells);
    free_.grow_to_include(cells);
    occupied_.grow_to_include(cells);
  }

  OccupancyThresholds thresholds_;
  OccupancyGrid<2> grid_;
  CellBits free_;
  CellBits occupied_;
  std::vector<Index<2>> changed_tiles_;
};

}  // namespace incognita
