/// What a map of the plane knows of its cells in one bit each, kept up to date with every cell that is written.
#pragma once

#include <utility>
#include <vector>

#include "incognita/grid/cell_bits.hpp"

namespace incognita {

/// Bits over the cells of a map. All layers have the same tiles, so the offset of a tile's word in one is its offset in all.
template <int Dim>
struct CellLayers {
  static_assert(Dim == 2);

  /// Of a map that has no cells yet.
  explicit CellLayers(const Lattice<Dim>& lattice)
      : heeding(lattice, true), blocked(lattice, false), written(lattice, false), changed(lattice, false) {}

  CellBits heeding;                     ///< a pass may change the cell, or it is blocked; most cells of most scans are neither
  CellBits blocked;                     ///< predicted rays end here
  CellBits written;                     ///< by any scan; the states of the others are as they were made
  CellBits changed;                     ///< written since changes were last forgotten
  std::vector<Index<Dim>> changed_tiles;  ///< the tiles with a cell in `changed`, in the order of their first change

  /// Makes room for the cells of a box.
  void grow_to_include(const IndexBox<Dim>& cells) {
    if (changed.has_room_for(cells)) return;
    CellLayers grown = *this;  // so that all grow or none
    for (CellBits* layer : {&grown.heeding, &grown.blocked, &grown.written, &grown.changed}) layer->grow_to_include(cells);
    *this = std::move(grown);
  }

  /// Marks cells of a tile as changed.
  void mark_changed(Offset place, const Index<Dim>& tile, CellBits::Word cells) {
    CellBits::Word& word = changed.tiles()[place];
    if (word == 0) changed_tiles.push_back(tile);
    word |= cells;
    written.tiles()[place] |= cells;
  }

  /// Says of some cells of a tile which of them are blocked and which ignore passes.
  void assign(Offset place, CellBits::Word cells, CellBits::Word are_blocked, CellBits::Word ignore_passes) {
    CellBits::Word& heeds = heeding.tiles()[place];
    CellBits::Word& blocks = blocked.tiles()[place];
    heeds = (heeds & ~cells) | (cells & (are_blocked | ~ignore_passes));
    blocks = (blocks & ~cells) | are_blocked;
  }

  /// For archives of states, see docs/mission_file.md: what of the cells of `box` was written and changed. Which of them are blocked or
  /// ignore passes is for the map to find again. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive, const IndexBox<Dim>& box) {
    archive(written, changed_tiles);
    if constexpr (Archive::is_loading) {
      archive.require(written.has_room_for(box), "the bits of a map are not of its cells");
      archive.claim(written.tiles().size(), 3 * sizeof(CellBits::Word));
      for (CellBits* layer : {&heeding, &blocked, &changed}) layer->tiles().clear_to(written.tiles().box());
    }
    for (const Index<Dim>& tile : changed_tiles) {
      if constexpr (Archive::is_loading) archive.require(changed.tiles().contains(tile), "a change lies outside of the map");
      archive(changed.tiles()[changed.tiles().offset_of(tile)]);
    }
    if constexpr (!Archive::is_loading) return;
    const auto is_in_box = [&](const CellBits& layer) {
      for (Offset place = 0; place < static_cast<Offset>(layer.tiles().size()); ++place) {
        if ((layer.tiles()[place] & ~cells_of_tile(layer.tiles().index_at(place), box)) != 0) return false;
      }
      return true;
    };
    archive.require(is_in_box(written) && is_in_box(changed), "bits are set outside of the map");
  }

  /// Nothing is changed any more. O(tiles changed).
  void forget_changes() {
    for (const Index<Dim>& tile : changed_tiles) changed.tiles()[changed.tiles().offset_of(tile)] = 0;
    changed_tiles.clear();
  }
};

}  // namespace incognita
