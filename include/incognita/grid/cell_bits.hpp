/// One bit for each cell of a plane, and the walk along a segment over those cells whose bit is set.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// Bits in tiles of 8 x 8 cells, a word each, so that a walk steps over tiles without a set bit at a glance. Safe to read
/// from many threads at once.
class CellBits {
 public:
  static constexpr int tile_shift = 3;
  static constexpr int tile_side = 1 << tile_shift;
  using Word = std::uint64_t;

  /// No cells yet; those that come have their bit set or not, as `fill` says.
  CellBits(const Lattice<2>& lattice, bool fill)
      : tiles_(Lattice<2>(lattice.resolution_m() * tile_side, lattice.origin_m()), {}, fill ? ~Word{0} : Word{0}) {}

  /// The tile that holds a cell.
  [[nodiscard]] static Index<2> tile_of(const Index<2>& cell) { return {cell[0] >> tile_shift, cell[1] >> tile_shift}; }

  /// A cell's bit in the word of its tile.
  [[nodiscard]] static Word mask_of(const Index<2>& cell) {
    constexpr int in_tile = tile_side - 1;
    return Word{1} << (((cell[1] & in_tile) << tile_shift) | (cell[0] & in_tile));
  }

  /// Makes room for the cells of a box.
  void grow_to_include(const IndexBox<2>& cells) {
    if (cells.empty()) return;
    const Index<2> last = tile_of({cells.upper[0] - 1, cells.upper[1] - 1});
    tiles_.grow_to_include({tile_of(cells.lower), {last[0] + 1, last[1] + 1}});
  }

  [[nodiscard]] Word word(const Index<2>& tile) const { return tiles_[tiles_.offset_of(tile)]; }
  [[nodiscard]] bool get(const Index<2>& cell) const { return (word(tile_of(cell)) & mask_of(cell)) != 0; }

  void set(const Index<2>& cell, bool value) {
    Word& word = tiles_[tiles_.offset_of(tile_of(cell))];
    word = value ? word | mask_of(cell) : word & ~mask_of(cell);
  }

  /// Clears the bits of a tile that are set in `mask`.
  void clear(const Index<2>& tile, Word mask) { tiles_[tiles_.offset_of(tile)] &= ~mask; }

  [[nodiscard]] const Grid<Word, 2>& tiles() const { return tiles_; }

 private:
  Grid<Word, 2> tiles_;
};

namespace detail {

/// The crossings of a segment with the lines of one axis, as in traverse: the i-th has the segment parameter
/// first + i * period.
struct AxisCrossings {
  AxisCrossings(double from, double to) {
    index = floor_to_int(from);
    count = floor_to_int(to) - index;
    if (count < 0) {
      step = -1;
      count = -count;
    }
    if (count == 0) return;
    const double delta = to - from;
    first = (index + (step > 0 ? 1.0 : 0.0) - from) / delta;
    frequency = std::abs(delta);
    period = 1.0 / frequency;
  }

  /// std::floor is a call where no option promises SSE 4.1.
  [[nodiscard]] static int floor_to_int(double value) {
    const int truncated = static_cast<int>(value);
    return truncated - static_cast<int>(value < static_cast<double>(truncated));
  }

  int index;
  int step = 1;
  int count;
  double first = 0.0;
  double period = 0.0;
  double frequency = 0.0;
};

/// A walk along a segment that is at least as long along the axis Major as across it, so that a column of cells, which share
/// an index along, holds one cell or two.
template <int Major>
class ColumnWalk {
 public:
  ColumnWalk(const AxisCrossings& along, const AxisCrossings& across, double from_across, double to_across)
      : along_(along), across_(across), unsure_(along.count + 4096) {
    if (across.count == 0) {
      from_ = to_ = end_ = fixed(across.index + 0.5);
      return;
    }
    from_ = fixed(from_across);
    to_ = fixed(to_across);
    if (along.count == 0) {
      end_ = to_;
      per_column_ = to_ - from_;
      set_lanes();
      return;
    }
    const double slope = across.step * across.frequency * along.period;
    per_column_ = fixed(slope);
    end_ = fixed(from_across + slope * along.first * along.frequency);
    set_lanes();
  }

  void set_lanes() {
    for (int lane = 0; lane < CellBits::tile_side; ++lane) per_lane_[lane] = lane * per_column_;
  }

  template <class Words, class Visit>
  void operator()(Words& words, Visit&& visit) const {
    int row = across_.index;
    for (int column = 0; column <= along_.count;) {
      // The columns up to the edge of the tile.
      const int a = along_.index + column * along_.step;
      const int left = along_.step > 0 ? in_tile - (a & in_tile) : (a & in_tile);
      int last = std::min(column + left, along_.count);
      int row_last = row_after(last);
      if (std::abs((row_last >> shift) - (row >> shift)) > 1) {  // eight columns at 45 degrees, and rounding
        last = column;
        row_last = row_after(last);
      }
      const int near = row >> shift;
      const int far = row_last >> shift;
      const Index<2> near_tile = at(a >> shift, near);
      const Index<2> far_tile = at(a >> shift, far);
      const CellBits::Word near_word = words.word(near_tile) & rows_between(row, far == near ? row_last : edge(row));
      const CellBits::Word far_word =
          far == near ? 0 : words.word(far_tile) & rows_between(edge_before(row_last), row_last);
      if ((near_word | far_word) != 0) {
        CellBits::Word near_path = 0;
        CellBits::Word far_path = 0;
        if (!find_path(column, last, near, near_path, far_path)) find_path_exactly(column, last, row, near, near_path, far_path);
        visit_all(words, near_tile, near_path & near_word, visit);
        visit_all(words, far_tile, far_path & far_word, visit);
      }
      row = row_last;
      column = last + 1;
    }
  }

 private:
  static constexpr int shift = CellBits::tile_shift;
  static constexpr int in_tile = CellBits::tile_side - 1;
  // Coordinates across are in 2^-32 of a cell.
  static constexpr std::int64_t one = std::int64_t{1} << 32;

  static constexpr std::uint64_t tile_bits = (std::uint64_t{1} << (32 - shift)) - 1U;
  // One lane a column of a tile.
  using Fixed [[gnu::vector_size(64)]] = std::int64_t;
  using Bits [[gnu::vector_size(64)]] = std::uint64_t;

  [[nodiscard]] static std::int64_t fixed(double cells) { return static_cast<std::int64_t>(cells * static_cast<double>(one)); }
  [[nodiscard]] bool is_unsure(std::int64_t at) const { return ((at + unsure_) & (one - 1)) < 2 * unsure_; }
  [[nodiscard]] static Index<2> at(int along, int across) {
    return Major == 0 ? Index<2>(along, across) : Index<2>(across, along);
  }

  /// Where the segment is across when it leaves a column.
  [[nodiscard]] std::int64_t after(int column) const {
    return std::clamp(end_ + column * per_column_, std::min(from_, to_), std::max(from_, to_));
  }

  [[nodiscard]] int row_after(int column) const {
    if (column >= along_.count) return across_.index + across_.count * across_.step;
    const std::int64_t at = after(column);
    return is_unsure(at) ? row_exactly_after(column) : static_cast<int>(at >> 32);
  }

  /// As traverse has it: where both axes cross at once the lower one does first.
  [[nodiscard]] int row_exactly_after(int column) const {
    if (column >= along_.count) return across_.index + across_.count * across_.step;
    const double end = along_.first + column * along_.period;
    const auto is_before = [end](double crossing) { return Major == 1 ? crossing <= end : crossing < end; };
    int crossed = std::clamp(static_cast<int>((end - across_.first) * across_.frequency + 1.0), 0, across_.count);
    crossed += static_cast<int>(crossed < across_.count && is_before(across_.first + crossed * across_.period));
    crossed -= static_cast<int>(crossed > 0 && !is_before(across_.first + (crossed - 1) * across_.period));
    return across_.index + crossed * across_.step;
  }

  /// The last row of a row's tile in the direction of the walk, and the first.
  [[nodiscard]] int edge(int row) const { return across_.step > 0 ? row | in_tile : row & ~in_tile; }
  [[nodiscard]] int edge_before(int row) const { return across_.step > 0 ? row & ~in_tile : row | in_tile; }

  /// The cells of a tile in the rows from one to another.
  [[nodiscard]] static CellBits::Word rows_between(int one_row, int other_row) {
    const int low = std::min(one_row, other_row) & in_tile;
    const int high = std::max(one_row, other_row) & in_tile;
    if constexpr (Major == 0) return (~CellBits::Word{0} << (8 * low)) & (~CellBits::Word{0} >> (8 * (in_tile - high)));
    constexpr CellBits::Word each_byte = 0x0101010101010101ULL;
    return ((0xFFU << low) & (0xFFU >> (in_tile - high))) * each_byte;
  }

  /// The cells of the tiles that the segment passes in these columns; false when it passes too near to a corner to be sure.
  [[nodiscard]] bool find_path(int column, int last, int near, CellBits::Word& near_path, CellBits::Word& far_path) const {
    const Bits near_tile = Bits{} + (static_cast<std::uint64_t>(static_cast<std::int64_t>(near)) & tile_bits);
    const Fixed low = Fixed{} + std::min(from_, to_);
    const Fixed high = Fixed{} + std::max(from_, to_);
    constexpr Fixed lanes{0, 1, 2, 3, 4, 5, 6, 7};
    const Fixed leaving = per_lane_ + (end_ + column * per_column_);
    const Fixed is_valid = lanes <= Fixed{} + (last - column);
    const Fixed along = (lanes * along_.step + (along_.index + column * along_.step)) & (Fixed{} + in_tile);
    Bits near_cells{};
    Bits far_cells{};
    Bits unsure_lanes{};
    const auto add = [&](const Fixed& unbounded) {
      const Fixed above = unbounded < low ? low : unbounded;
      const Fixed at = above > high ? high : above;
      const Bits bits = reinterpret_cast<const Bits&>(at);
      const Bits row = (bits >> 32U) & (Bits{} + in_tile);
      const Bits column_bit = reinterpret_cast<const Bits&>(along);
      const Bits bit = Major == 0 ? (row << CellBits::tile_shift) | column_bit : (column_bit << CellBits::tile_shift) | row;
      const Bits cell = ((Bits{} + 1U) << bit) & reinterpret_cast<const Bits&>(is_valid);
      const auto is_near = ((bits >> (32U + shift)) & (Bits{} + tile_bits)) == near_tile;
      near_cells |= cell & reinterpret_cast<const Bits&>(is_near);
      far_cells |= cell & ~reinterpret_cast<const Bits&>(is_near);
      const auto is_unsure = ((bits + static_cast<std::uint64_t>(unsure_)) & (Bits{} + 0xFFFFFFFFU)) < (Bits{} + static_cast<std::uint64_t>(2 * unsure_));
      unsure_lanes |= reinterpret_cast<const Bits&>(is_unsure) & reinterpret_cast<const Bits&>(is_valid);
    };
    add(leaving - per_column_);
    add(leaving);
    near_path = any_of(near_cells);
    far_path = any_of(far_cells);
    return any_of(unsure_lanes) == 0;
  }

  [[nodiscard]] static std::uint64_t any_of(const Bits& words) {
    const auto four = __builtin_shufflevector(words, words, 0, 1, 2, 3) | __builtin_shufflevector(words, words, 4, 5, 6, 7);
    const auto two = __builtin_shufflevector(four, four, 0, 1) | __builtin_shufflevector(four, four, 2, 3);
    return two[0] | two[1];
  }

  void find_path_exactly(int column, int last, int row, int near, CellBits::Word& near_path, CellBits::Word& far_path) const {
    near_path = far_path = 0;
    for (; column <= last; ++column) {
      const int end = row_exactly_after(column);
      for (;; row += across_.step) {
        const CellBits::Word cell = CellBits::mask_of(at(along_.index + column * along_.step, row));
        ((row >> shift) == near ? near_path : far_path) |= cell;
        if (row == end) break;
      }
    }
  }

  template <class Words, class Visit>
  static void visit_all(Words& words, const Index<2>& tile, CellBits::Word cells, Visit&& visit) {
    CellBits::Word cleared = 0;
    for (CellBits::Word left = cells; left != 0; left &= left - 1U) {
      const int bit = std::countr_zero(left);
      const bool stays = visit(Index<2>((tile[0] << shift) + (bit & in_tile), (tile[1] << shift) + (bit >> shift)));
      cleared |= stays ? 0 : left & -left;
    }
    if (cleared != 0) words.clear(tile, cleared);
  }

  const AxisCrossings& along_;
  const AxisCrossings& across_;
  std::int64_t from_ = 0;
  std::int64_t to_ = 0;
  std::int64_t end_ = 0;  // of the first column
  std::int64_t per_column_ = 0;
  std::int64_t unsure_;  // nearer to a line than this, rows are computed anew in full: rounding adds up along the way
  Fixed per_lane_{};
};

}  // namespace detail

/// Calls visit(cell) for those of the cells that traverse visits whose bit is set, tile by tile, and clears the bit where it
/// returns false. `words` has the tiles on the way, as CellBits: word(tile) gives one, clear(tile, mask) clears bits of one.
/// O(tiles passed without a set bit, and cells passed in the others), no allocation.
template <class Words, class Visit>
void traverse_set(const Lattice<2>& lattice, const Point<2>& from_m, const Point<2>& to_m, Words& words, Visit&& visit) {
  const Point<2> from = lattice.to_cells(from_m);
  const Point<2> to = lattice.to_cells(to_m);
  const detail::AxisCrossings x(from[0], to[0]);
  const detail::AxisCrossings y(from[1], to[1]);
  if (std::abs(to[0] - from[0]) >= std::abs(to[1] - from[1])) {
    detail::ColumnWalk<0>(x, y, from[1], to[1])(words, visit);
  } else {
    detail::ColumnWalk<1>(y, x, from[0], to[0])(words, visit);
  }
}

}  // namespace incognita
