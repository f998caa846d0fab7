/// The frontier of a map of the plane, followed scan by scan.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "incognita/frontier/detection.hpp"
#include "incognita/grid/tile_neighbors.hpp"
#include "incognita/map/occupancy_layer.hpp"

namespace incognita {

/// The same cells as detect_frontier, kept up to date at the cost of what changes. Of maps of the plane. Safe to read from many
/// threads.
template <int Dim>
class FrontierLayer {
  static_assert(Dim == 2);

 public:
  /// Throws std::invalid_argument for bad parameters.
  explicit FrontierLayer(const Lattice<Dim>& lattice, const FrontierParams& params = {})
      : params_(params), frontier_(lattice, false), listed_(frontier_.tiles().lattice(), false) {
    params_.validate();
  }

  /// Takes over what the last follow or rebuild of the layer changed; to be called after each. A cell belongs to the frontier by
  /// the cells up to two away. `closed` has a bit for each cell that does not count, neither as free nor as unknown: the same at
  /// each call, null when all count. O(tiles changed).
  void follow(const OccupancyLayer<Dim>& occupancy, const CellBits* closed = nullptr) {
    make_room_for(occupancy);
    for (const Index<Dim>& tile : occupancy.changed_tiles()) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) find_in(occupancy, closed, {tile[0] + dx, tile[1] + dy});
      }
    }
    drop_emptied();
  }

  /// Takes a layer as it is. O(tiles).
  void rebuild(const OccupancyLayer<Dim>& occupancy, const CellBits* closed = nullptr) {
    *this = FrontierLayer(occupancy.grid().lattice(), params_);
    make_room_for(occupancy);
    for_each_tile_of(occupancy.grid().box(), [&](const Index<Dim>& tile) { find_in(occupancy, closed, tile); });
  }

  /// Whether a cell is one of the frontier's.
  [[nodiscard]] bool contains(const Index<Dim>& cell) const { return frontier_.get(cell); }

  /// The cells of the frontier in storage order, as detect_frontier has them. O(n log n) for n of them.
  [[nodiscard]] std::vector<Index<Dim>> cells() const {
    std::vector<Index<Dim>> cells;
    for (const Index<Dim>& tile : tiles_) {
      for (CellBits::Word left = frontier_.tiles().value(tile); left != 0; left &= left - 1U) {
        cells.push_back(CellBits::cell_of(tile, std::countr_zero(left)));
      }
    }
    std::sort(cells.begin(), cells.end(), is_stored_before<Dim>);
    return cells;
  }

 private:
  void make_room_for(const OccupancyLayer<Dim>& occupancy) {
    frontier_.grow_to_include(occupancy.grid().box());
    listed_.grow_to_include(frontier_.tiles().box());
  }

  void find_in(const OccupancyLayer<Dim>& occupancy, const CellBits* closed, const Index<Dim>& tile) {
    if (!frontier_.tiles().contains(tile)) return;
    const auto is_open = [&](const Index<Dim>& at) { return closed == nullptr ? ~CellBits::Word{0} : ~closed->tiles().value(at); };
    const CellBits::Word free = occupancy.free().tiles().value(tile) & is_open(tile);
    CellBits::Word& frontier = frontier_.tiles()[frontier_.tiles().offset_of(tile)];
    frontier = 0;
    if (free == 0) return;
    const auto is_occupied = [&](const Index<Dim>& at) { return occupancy.occupied().tiles().value(at); };
    const TileNeighbors open(tile, [&](const Index<Dim>& at) {
      const CellBits::Word unknown = ~(occupancy.free().tiles().value(at) | is_occupied(at)) & is_open(at);
      if (unknown == 0 || !params_.ignore_unknown_near_walls) return unknown;
      return unknown & ~TileNeighbors(at, is_occupied).dilated();
    });
    frontier = free & (params_.unknown_adjacency == Adjacency::faces ? open.beside() : open.dilated());
    if (frontier == 0 || listed_.get(tile)) return;
    listed_.set(tile, true);
    tiles_.push_back(tile);
  }

  /// Tiles stay in the list for a while after their last frontier cell, so that dropping them costs little a scan.
  void drop_emptied() {
    if (tiles_.size() < 2 * dropped_at_size_ + 64) return;
    std::erase_if(tiles_, [this](const Index<Dim>& tile) {
      const bool is_empty = frontier_.tiles().value(tile) == 0;
      if (is_empty) listed_.set(tile, false);
      return is_empty;
    });
    dropped_at_size_ = tiles_.size();
  }

  FrontierParams params_;
  CellBits frontier_;
  CellBits listed_;              // a bit a tile
  std::vector<Index<Dim>> tiles_;  // those with frontier cells, and some that had
  std::size_t dropped_at_size_ = 0;
};

}  // namespace incognita
