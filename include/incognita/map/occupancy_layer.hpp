/// What is free, occupied and unknown in a map of the plane, followed scan by scan.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/grid/cell_bits.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// Every cell as classify(map) has it, kept up to date at the cost of the cells that change. The box of grid() holds the tiles in
/// which something is or was known, and some room to grow; all else is unknown. Of maps of the plane. Safe to read from many
/// threads.
template <int Dim>
class OccupancyLayer {
  static_assert(Dim == 2);

 public:
  /// Of no cells yet. Throws std::invalid_argument for bad thresholds.
  explicit OccupancyLayer(const Lattice<Dim>& lattice, const OccupancyThresholds& thresholds = {})
      : thresholds_(thresholds), grid_(lattice, {}, Occupancy::unknown), free_(lattice, false), occupied_(lattice, false) {
    thresholds_.validate();
  }

  /// Takes over what the map's last update changed, or the whole map when more than one update was missed (rebuild). Another map
  /// must be taken by rebuild. O(tiles changed), amortised.
  template <CellPolicy Cell>
  void follow(const Map<Cell, Dim>& map) {
    if (map.update_count() != update_count_ + 1) {
      if (map.update_count() != update_count_) rebuild(map);
      else changed_tiles_.clear();
      return;
    }
    changed_tiles_.clear();
    for (const Index<Dim>& tile : map.layers().changed_tiles) {
      classify_tile(map, tile, map.layers().changed.tiles().value(tile));
    }
    update_count_ = map.update_count();
  }

  /// Takes a map as it is. O(cells).
  template <CellPolicy Cell>
  void rebuild(const Map<Cell, Dim>& map) {
    OccupancyLayer anew(map.lattice(), thresholds_);
    anew.classify_all(map);
    // What was known may not be any more.
    for_each_tile_of(grid_.box(), [&](const Index<Dim>& tile) {
      if ((free_.tiles().value(tile) | occupied_.tiles().value(tile)) != 0) anew.changed_tiles_.push_back(tile);
    });
    *this = std::move(anew);
  }

  [[nodiscard]] const OccupancyGrid<Dim>& grid() const { return grid_; }  ///< of all cells of the map
  [[nodiscard]] const CellBits& free() const { return free_; }  ///< a bit for each free cell
  [[nodiscard]] const CellBits& occupied() const { return occupied_; }  ///< likewise

  /// The tiles in which a cell may have become something else by the last follow or rebuild.
  [[nodiscard]] const std::vector<Index<Dim>>& changed_tiles() const { return changed_tiles_; }

  /// For archives of states, see docs/mission_file.md: of a layer that follows `map`, which is there already.
  template <class Archive, CellPolicy Cell>
  void archive_state(Archive& archive, const Map<Cell, Dim>& map) {
    archive_box(archive, grid_);
    if constexpr (Archive::is_loading) {
      const OccupancyGrid<Dim> loaded = grid_;
      *this = OccupancyLayer(grid_.lattice(), thresholds_);
      grid_ = loaded;
      free_.grow_to_include(grid_.box());
      occupied_.grow_to_include(grid_.box());
      classify_all(map);
      changed_tiles_.clear();
    }
  }

 private:
  template <class MapType>
  void classify_all(const MapType& map) {
    const IndexBox<Dim>& box = map.grid().box();
    for_each_tile_of(box, [&](const Index<Dim>& tile) { classify_tile(map, tile, cells_of_tile(tile, box)); });
    update_count_ = map.update_count();
  }

  template <class MapType>
  void classify_tile(const MapType& map, const Index<Dim>& tile, CellBits::Word cells) {
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

  void make_room_for(const Index<Dim>& tile) {
    IndexBox<Dim> cells = box_of_cell<Dim>(CellBits::cell_of(tile, 0));
    for (int axis = 0; axis < Dim; ++axis) cells.upper[axis] = cells.lower[axis] + CellBits::tile_side;
    if (grid_.box().contains(cells)) return;
    // Planners go through the whole box, so little of it should be room.
    grid_.grow_to_include(cells, 16);
    free_.grow_to_include(grid_.box());
    occupied_.grow_to_include(grid_.box());
  }

  OccupancyThresholds thresholds_;
  OccupancyGrid<Dim> grid_;
  CellBits free_;
  CellBits occupied_;
  std::vector<Index<Dim>> changed_tiles_;
  std::uint64_t update_count_ = 0;
};

}  // namespace incognita
