/// One bit for each cell of a plane.
#pragma once

#include <algorithm>
#include <cstdint>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// Bits in tiles of 8 x 8 cells, a word each, so that walks step over tiles without a set bit at a glance and neighbours
/// are compared 64 at a time. Safe to read from many threads at once. A template only so that who includes this and uses it not
/// does not pay for its instances.
template <int Dim>
class BasicCellBits {
  static_assert(Dim == 2);

 public:
  static constexpr int tile_shift = 3;               ///< tiles are 2 to this many cells wide
  static constexpr int tile_side = 1 << tile_shift;  ///< in cells
  using Word = std::uint64_t;                        ///< a tile's bits, the lowest that of its lower left cell, rows upwards

  /// No cells yet; those that come have their bit set or not, as `fill` says.
  BasicCellBits(const Lattice<Dim>& lattice, bool fill)
      : tiles_(Lattice<Dim>(lattice.resolution_m() * tile_side, lattice.origin_m()), {}, fill ? ~Word{0} : Word{0}) {}

  /// The tile that holds a cell.
  [[nodiscard]] static Index<Dim> tile_of(const Index<Dim>& cell) { return {cell[0] >> tile_shift, cell[1] >> tile_shift}; }

  /// A cell's bit in the word of its tile.
  [[nodiscard]] static Word mask_of(const Index<Dim>& cell) {
    constexpr int in_tile = tile_side - 1;
    return Word{1} << (((cell[1] & in_tile) << tile_shift) | (cell[0] & in_tile));
  }

  /// The cell of a bit: 0 to 63, from the lowest, in a tile.
  [[nodiscard]] static Index<Dim> cell_of(const Index<Dim>& tile, int bit) {
    return {(tile[0] << tile_shift) + (bit & (tile_side - 1)), (tile[1] << tile_shift) + (bit >> tile_shift)};
  }

  /// The tiles with cells of a box that is not empty.
  [[nodiscard]] static IndexBox<Dim> tiles_of(const IndexBox<Dim>& cells) {
    const Index<Dim> last = tile_of({cells.upper[0] - 1, cells.upper[1] - 1});
    return {tile_of(cells.lower), {last[0] + 1, last[1] + 1}};
  }

  /// Whether each cell of a box has a bit that can be set.
  [[nodiscard]] bool has_room_for(const IndexBox<Dim>& cells) const {
    return cells.empty() || tiles_.box().contains(tiles_of(cells));
  }

  /// Makes room for the cells of a box.
  void grow_to_include(const IndexBox<Dim>& cells) {
    if (!has_room_for(cells)) tiles_.grow_to_include(tiles_of(cells));
  }

  /// A cell's bit; the fill beyond what there is room for.
  [[nodiscard]] bool get(const Index<Dim>& cell) const { return (tiles_.value(tile_of(cell)) & mask_of(cell)) != 0; }

  /// The cell must lie within what there is room for.
  void set(const Index<Dim>& cell, bool value) {
    Word& word = tiles_[tiles_.offset_of(tile_of(cell))];
    word = value ? word | mask_of(cell) : word & ~mask_of(cell);
  }

  /// The words, one a tile.
  [[nodiscard]] const Grid<Word, Dim>& tiles() const { return tiles_; }
  [[nodiscard]] Grid<Word, Dim>& tiles() { return tiles_; }  ///< to be written by whoever knows their layout

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(tiles_);
  }

 private:
  Grid<Word, Dim> tiles_;
};

/// The bits of a plane.
using CellBits = BasicCellBits<2>;

/// The cells of a tile that lie in a box.
[[nodiscard]] inline CellBits::Word cells_of_tile(const Index<2>& tile, const IndexBox<2>& box) {
  constexpr int last = CellBits::tile_side - 1;
  const auto first_in = [&](int axis) { return std::max(box.lower[axis] - tile[axis] * CellBits::tile_side, 0); };
  const auto last_in = [&](int axis) { return std::min(box.upper[axis] - 1 - tile[axis] * CellBits::tile_side, last); };
  if (first_in(0) > last_in(0) || first_in(1) > last_in(1)) return 0;
  constexpr CellBits::Word all = ~CellBits::Word{0};
  const CellBits::Word row = (0xFFU << first_in(0)) & (0xFFU >> (last - last_in(0)));
  return (row * 0x0101010101010101ULL) & (all << (8 * first_in(1))) & (all >> (8 * (last - last_in(1))));
}

/// Calls visit(tile) for each tile with cells of a box.
template <class Visit>
void for_each_tile_of(const IndexBox<2>& box, Visit&& visit) {
  if (box.empty()) return;
  const Index<2> first = CellBits::tile_of(box.lower);
  const Index<2> last = CellBits::tile_of({box.upper[0] - 1, box.upper[1] - 1});
  for (int y = first[1]; y <= last[1]; ++y) {
    for (int x = first[0]; x <= last[0]; ++x) visit(Index<2>(x, y));
  }
}

}  // namespace incognita
