/// The tiles that a segment passes, and which of their cells: how to meet only those cells whose bit is set.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "incognita/grid/cell_bits.hpp"

namespace incognita {

/// A segment between cells within 2^30 of the lattice's origin, made ready to be walked: exactly the cells that traverse_cells
/// visits (but where its ends differ by a subnormal number), a column of tiles at a time. A column of
/// cells shares an index along the axis that the segment is longer along, so it holds one cell of the segment or two; rows
/// are counted across. Coordinates across are integers, in 2^-32 of a cell, so that they are found without walking there.
class SegmentWalk {
 public:
  /// Some cells of a tile; `place` is the offset of its word.
  struct TileCells {
    Offset place;          ///< of the tile's word among the tiles
    Index<2> tile;         ///< its index
    CellBits::Word cells;  ///< the bits of the segment's cells
  };

  /// Between two points in lattice coordinates; the last cell is one of the walk's or not.
  SegmentWalk(const Point<2>& from, const Point<2>& to, bool with_end) {
    is_steep_ = std::abs(to[1] - from[1]) > std::abs(to[0] - from[0]);
    const double from_along = from[is_steep_];
    const double to_along = to[is_steep_];
    const double from_across = from[!is_steep_];
    const double to_across = to[!is_steep_];
    first_index_ = floor_to_int(from_along);
    first_row_ = floor_to_int(from_across);
    const int last_index = floor_to_int(to_along);
    last_row_ = floor_to_int(to_across);
    step_ = last_index < first_index_ ? -1 : 1;
    last_column_ = (last_index - first_index_) * step_;
    phase_ = step_ > 0 ? first_index_ & in_tile : in_tile - (first_index_ & in_tile);
    without_ = with_end ? 0 : CellBits::mask_of(cell_at(last_index, last_row_));
    if (first_row_ == last_row_) {
      from_ = to_ = leaving_ = fixed(first_row_ + 0.5);
      per_column_ = 0;
      return;
    }
    from_ = fixed(from_across);
    to_ = fixed(to_across);
    if (last_column_ == 0) {
      leaving_ = to_;
      per_column_ = to_ - from_;
      return;
    }
    const double slope = (to_across - from_across) / std::abs(to_along - from_along);
    const double to_first_crossing = step_ > 0 ? first_index_ + 1.0 - from_along : from_along - first_index_;
    per_column_ = fixed(slope);
    leaving_ = fixed(from_across + slope * to_first_crossing);
  }

  /// How many columns of tiles the segment passes.
  [[nodiscard]] int tile_columns() const { return ((last_column_ + phase_) >> shift) + 1; }

  /// Calls report(column, may_meet) for each column of tiles in the order of the walk, until it returns false: whether a cell of
  /// the segment there may be set; may_meet false is certain. The tiles of the segment's cells and of those beside them must be
  /// there.
  template <class Report>
  void survey(const CellBits& bits, Report&& report) const {
    const bool is_rising = last_row_ >= first_row_;
    if (is_steep_) {
      is_rising ? survey_in<1, true>(bits, report) : survey_in<1, false>(bits, report);
    } else {
      is_rising ? survey_in<0, true>(bits, report) : survey_in<0, false>(bits, report);
    }
  }

  /// The cells of the segment in a column of tiles that are set: they lie in two tiles, in the order of the walk, of which
  /// either may have none. False, and nothing is found, where rounding might decide: see visit_exactly.
  template <class Bits>
  [[nodiscard]] bool find_set(const Bits& bits, int tile_column, std::array<TileCells, 2>& met) const {
    return is_steep_ ? find_set_in<1>(bits, tile_column, met) : find_set_in<0>(bits, tile_column, met);
  }

  /// Calls visit(TileCells) for tiles with what find_set could not find, with the rows as traverse_cells computes them, in the
  /// order of the walk, until visit returns false; returns whether it never did. `from` and `to` as given to the constructor.
  template <class Visit>
  bool visit_exactly(const CellBits& bits, int tile_column, const Point<2>& from, const Point<2>& to, Visit&& visit) const {
    const Grid<CellBits::Word, 2>& tiles = bits.tiles();
    int column = std::max(tile_column * CellBits::tile_side - phase_, 0);
    const int last = std::min((tile_column + 1) * CellBits::tile_side - phase_ - 1, last_column_);
    const int row_step = last_row_ < first_row_ ? -1 : 1;
    int row = column == 0 ? first_row_ : exact_row_after(column - 1, from, to);
    int last_row = exact_row_after(column, from, to);
    while (column <= last) {
      const Index<2> tile = CellBits::tile_of(cell_at(first_index_ + column * step_, row));
      CellBits::Word cells = 0;
      for (;;) {
        const Index<2> cell = cell_at(first_index_ + column * step_, row);
        if (!equal(CellBits::tile_of(cell), tile)) break;
        if (column != last_column_ || row != last_row_ || without_ == 0) cells |= CellBits::mask_of(cell);
        if (row != last_row) {
          row += row_step;
        } else if (++column > last) {
          break;
        } else {
          last_row = exact_row_after(column, from, to);
        }
      }
      const Offset place = tiles.offset_of(tile);
      cells &= tiles[place];
      if (cells != 0 && !visit(TileCells{place, tile, cells})) return false;
    }
    return true;
  }

  /// Of some cells of a tile that the segment passes, the one it passes first.
  [[nodiscard]] Index<2> first_of(const TileCells& met) const {
    const auto first_bit = [](CellBits::Word word, bool lowest) {
      return lowest ? std::countr_zero(word) : 63 - std::countl_zero(word);
    };
    const bool is_rising = last_row_ >= first_row_;
    if (is_steep_) {
      const int column = first_bit(met.cells, step_ > 0) >> shift;
      return CellBits::cell_of(met.tile, first_bit(met.cells & (CellBits::Word{0xFF} << (8 * column)), is_rising));
    }
    CellBits::Word columns = met.cells | (met.cells >> 32);
    columns |= columns >> 16;
    columns |= columns >> 8;
    const int column = first_bit(columns & 0xFF, step_ > 0);
    return CellBits::cell_of(met.tile, first_bit(met.cells & (each_byte << column), is_rising));
  }

  /// Of some cells of a tile that the segment passes, those that it passes before one of them.
  [[nodiscard]] CellBits::Word cells_before(const TileCells& met, const Index<2>& cell) const {
    const auto columns_up_to = [this](int at) { return is_steep_ ? rows_up_to<0>(at) : rows_up_to<1>(at); };
    const auto columns_from = [this](int at) { return is_steep_ ? rows_from<0>(at) : rows_from<1>(at); };
    const int column = cell[is_steep_];
    const CellBits::Word in_column = columns_up_to(column) & columns_from(column);
    const int row = cell[!is_steep_];
    const CellBits::Word rows = last_row_ >= first_row_ ? (is_steep_ ? rows_up_to<1>(row) : rows_up_to<0>(row))
                                                        : (is_steep_ ? rows_from<1>(row) : rows_from<0>(row));
    const CellBits::Word up_to = ((step_ > 0 ? columns_up_to(column) : columns_from(column)) & ~in_column) | (in_column & rows);
    return met.cells & up_to & ~CellBits::mask_of(cell);
  }

 private:
  static constexpr int shift = CellBits::tile_shift;
  static constexpr int in_tile = CellBits::tile_side - 1;
  static constexpr CellBits::Word each_byte = 0x0101010101010101ULL;
  static constexpr std::array<CellBits::Word, 8> each_byte_from{0xFF * each_byte, 0xFE * each_byte, 0xFC * each_byte,
                                                                0xF8 * each_byte, 0xF0 * each_byte, 0xE0 * each_byte,
                                                                0xC0 * each_byte, 0x80 * each_byte};
  static constexpr std::array<CellBits::Word, 8> each_byte_up_to{0x01 * each_byte, 0x03 * each_byte, 0x07 * each_byte,
                                                                 0x0F * each_byte, 0x1F * each_byte, 0x3F * each_byte,
                                                                 0x7F * each_byte, 0xFF * each_byte};
  static constexpr std::int64_t one = std::int64_t{1} << 32;

  [[nodiscard]] static std::int64_t fixed(double cells) { return static_cast<std::int64_t>(cells * static_cast<double>(one)); }

  [[nodiscard]] Index<2> cell_at(int along, int across) const {
    return is_steep_ ? Index<2>(across, along) : Index<2>(along, across);
  }

  /// Nearer to a line of the lattice than this it is not certain on which side of it: rounding adds up along the way.
  [[nodiscard]] std::int64_t unsure() const { return last_column_ + 4096; }

  [[nodiscard]] int tile_along(int tile_column) const { return (first_index_ >> shift) + tile_column * step_; }

  /// The offset of the tile of a column of tiles that would lie in row 0.
  template <int Major>
  [[nodiscard]] Offset place_of(const Grid<CellBits::Word, 2>& tiles, int tile_column) const {
    return (tile_along(tile_column) - tiles.box().lower[Major]) * tiles.stride(Major) -
           tiles.box().lower[1 - Major] * tiles.stride(1 - Major);
  }

  /// The cells of a tile from a row on, and up to one.
  template <int Major>
  [[nodiscard]] static CellBits::Word rows_from(int row) {
    if constexpr (Major == 0) return ~CellBits::Word{0} << (8 * (row & in_tile));
    return each_byte_from[static_cast<std::size_t>(row & in_tile)];
  }
  template <int Major>
  [[nodiscard]] static CellBits::Word rows_up_to(int row) {
    if constexpr (Major == 0) return ~CellBits::Word{0} >> (8 * (~row & in_tile));
    return each_byte_up_to[static_cast<std::size_t>(row & in_tile)];
  }

  /// The cells of a tile in those of its columns that the segment passes.
  template <int Major>
  [[nodiscard]] CellBits::Word columns_from_first() const {
    return step_ > 0 ? rows_from<1 - Major>(phase_) : rows_up_to<1 - Major>(in_tile - phase_);
  }
  template <int Major>
  [[nodiscard]] CellBits::Word columns_up_to_last() const {
    const int last = (last_column_ + phase_) & in_tile;
    return step_ > 0 ? rows_up_to<1 - Major>(last) : rows_from<1 - Major>(in_tile - last);
  }

  template <int Major, bool Rising, class Report>
  void survey_in(const CellBits& bits, Report&& report) const {
    const Grid<CellBits::Word, 2>& tiles = bits.tiles();
    const CellBits::Word* const words = tiles.values().data();
    const Offset along_stride = tiles.stride(Major) * step_;
    const Offset across_stride = tiles.stride(1 - Major);
    const std::int64_t slack = Rising ? unsure() : -unsure();
    const int last = tile_columns() - 1;
    const Offset end_tile = last_row_ >> shift;
    Offset place = place_of<Major>(tiles, 0);
    // Whether cells are set between the rows in which the segment enters and leaves a column of tiles, give or take what is
    // unsure. More than nine rows are not looked at.
    const auto may_meet = [=](Offset at, std::int64_t entering, std::int64_t leaving, CellBits::Word columns,
                              CellBits::Word without) {
      const std::int64_t low = (Rising ? entering - slack : leaving + slack) >> 32;
      const std::int64_t high = (Rising ? leaving + slack : entering - slack) >> 32;
      const Offset low_tile = low >> shift;
      const Offset high_tile = high >> shift;
      CellBits::Word low_word = words[at + low_tile * across_stride] & rows_from<Major>(static_cast<int>(low));
      CellBits::Word high_word = words[at + high_tile * across_stride] & rows_up_to<Major>(static_cast<int>(high));
      if (without != 0) {
        low_word &= ~(low_tile == end_tile ? without : 0);
        high_word &= ~(high_tile == end_tile ? without : 0);
      }
      const CellBits::Word set = low_tile == high_tile ? low_word & high_word : low_word | high_word;
      return ((set & columns) != 0) | (high - low > CellBits::tile_side);
    };
    if (last == 0) {
      report(0, may_meet(place, from_, to_, columns_from_first<Major>() & columns_up_to_last<Major>(), without_));
      return;
    }
    const std::int64_t per_tile = CellBits::tile_side * per_column_;
    std::int64_t leaving = leaving_ + (in_tile - phase_) * per_column_;
    if (!report(0, may_meet(place, from_, leaving, columns_from_first<Major>(), 0))) return;
    for (int tile_column = 1; tile_column < last; ++tile_column) {
      place += along_stride;
      leaving += per_tile;
      if (!report(tile_column, may_meet(place, leaving - per_tile, leaving, ~CellBits::Word{0}, 0))) return;
    }
    report(last, may_meet(place + along_stride, leaving, to_, columns_up_to_last<Major>(), without_));
  }

  template <int Major>
  [[nodiscard]] bool find_set_in(const CellBits& bits, int tile_column, std::array<TileCells, 2>& met) const {
    const int before_first = tile_column * CellBits::tile_side - phase_;
    const bool is_last = last_column_ - before_first < CellBits::tile_side;
    const int first = std::max(before_first, 0);
    const int last = is_last ? last_column_ : before_first + in_tile;
    const std::int64_t leaving_first = leaving_ + first * per_column_;
    const std::int64_t entering = tile_column == 0 ? from_ : leaving_first - per_column_;
    const std::int64_t leaving = is_last ? to_ : leaving_ + last * per_column_;
    const auto enter_row = static_cast<int>(entering >> 32);
    const auto leave_row = static_cast<int>(leaving >> 32);
    const int enter_tile = enter_row >> shift;
    const int leave_tile = leave_row >> shift;

    // Column by column the row in which it is entered and the one in which it is left, in the bits of rows modulo 8.
    constexpr int row_shift = Major == 0 ? shift : 0;
    constexpr int column_shift = shift - row_shift;
    const auto unsure_by = static_cast<std::uint32_t>(unsure());
    const auto is_near_a_line = [unsure_by](std::int64_t across) {
      return static_cast<std::uint32_t>(across) + unsure_by < 2 * unsure_by;
    };
    const auto bits_of_row = [](std::int64_t across) { return ((across >> 32) & in_tile) << row_shift; };
    if (is_near_a_line(entering) || is_near_a_line(leaving)) return false;
    CellBits::Word cells = 0;
    auto row = bits_of_row(entering);
    std::int64_t across = leaving_first;
    CellBits::Word column_bit = CellBits::Word{1} << (((first_index_ + first * step_) & in_tile) << column_shift);
    for (int column = first; column < last; ++column) {
      const auto next_row = bits_of_row(across);
      cells |= column_bit << row | column_bit << next_row;
      if (is_near_a_line(across)) return false;
      row = next_row;
      across += per_column_;
      column_bit = std::rotl(column_bit, step_ << column_shift);
    }
    cells |= column_bit << row | column_bit << bits_of_row(leaving);
    if (std::abs(leave_row - enter_row) > CellBits::tile_side) return false;
    // The cells of the tile that is left, if it is another one.
    CellBits::Word left = 0;
    if (leave_tile != enter_tile) {
      left = last_row_ > first_row_ ? rows_up_to<Major>(leave_row) : rows_from<Major>(leave_row);
      // Of nine rows the first and the last share their bits; half of the columns belong to each.
      if (((enter_row ^ leave_row) & in_tile) == 0) {
        const CellBits::Word shared = rows_from<Major>(leave_row) & rows_up_to<Major>(leave_row);
        const CellBits::Word first_half = step_ > 0 ? rows_up_to<1 - Major>(3) : rows_from<1 - Major>(4);
        left &= ~(shared & first_half);
      }
    }
    const Grid<CellBits::Word, 2>& tiles = bits.tiles();
    const Offset place = place_of<Major>(tiles, tile_column);
    const auto in = [&](int tile_across, CellBits::Word of_tile) {
      const Offset at = place + tile_across * tiles.stride(1 - Major);
      const CellBits::Word without = is_last && tile_across == last_row_ >> shift ? without_ : 0;
      return TileCells{at, cell_at(tile_along(tile_column), tile_across), tiles[at] & cells & of_tile & ~without};
    };
    met[0] = in(enter_tile, ~left);
    met[1] = in(leave_tile, left);
    return true;
  }

  /// Where both axes cross at once the lower one does first.
  [[nodiscard]] int exact_row_after(int column, const Point<2>& from, const Point<2>& to) const {
    if (column >= last_column_) return last_row_;
    const int row_count = std::abs(last_row_ - first_row_);
    if (row_count == 0) return first_row_;
    const Point<2> delta = difference(to, from);
    const double along_first = (first_index_ + (step_ > 0 ? 1.0 : 0.0) - from[is_steep_]) / delta[is_steep_];
    const double along_period = 1.0 / std::abs(delta[is_steep_]);
    const bool is_rising = last_row_ > first_row_;
    const double across_first = (first_row_ + (is_rising ? 1.0 : 0.0) - from[!is_steep_]) / delta[!is_steep_];
    const double across_period = 1.0 / std::abs(delta[!is_steep_]);
    const double end = along_first + column * along_period;
    const auto is_before = [&](double crossing) { return is_steep_ ? crossing <= end : crossing < end; };
    int crossed = std::clamp(static_cast<int>((end - across_first) / across_period + 1.0), 0, row_count);
    crossed += static_cast<int>(crossed < row_count && is_before(across_first + crossed * across_period));
    crossed -= static_cast<int>(crossed > 0 && !is_before(across_first + (crossed - 1) * across_period));
    return is_rising ? first_row_ + crossed : first_row_ - crossed;
  }

  std::int64_t from_;
  std::int64_t to_;
  std::int64_t leaving_;  // the first column
  std::int64_t per_column_;
  CellBits::Word without_;
  int first_index_;  // of the column
  int first_row_;
  int last_row_;
  int step_;
  int last_column_;  // counted from the first
  int phase_;        // columns of the first column of tiles before the first
  bool is_steep_;
};

/// Calls visit(SegmentWalk::TileCells) for each tile with cells of `walk`, between two points in lattice coordinates, that
/// are set, in the order of the walk, until visit returns false. The tiles of the segment's cells and of those beside them
/// must be there. No allocation.
template <class Visit>
void visit_set(const CellBits& bits, const SegmentWalk& walk, const Point<2>& from, const Point<2>& to, Visit&& visit) {
  walk.survey(bits, [&](int column, bool may_meet) {
    if (!may_meet) return true;
    std::array<SegmentWalk::TileCells, 2> met;
    if (!walk.find_set(bits, column, met)) return walk.visit_exactly(bits, column, from, to, visit);
    return (met[0].cells == 0 || visit(met[0])) && (met[1].cells == 0 || visit(met[1]));
  });
}

}  // namespace incognita
