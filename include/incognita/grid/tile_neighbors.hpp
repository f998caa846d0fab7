/// The bits around those of a tile, sixty-four cells at a time.
#pragma once

#include <array>

#include "incognita/grid/cell_bits.hpp"

namespace incognita {

/// The words of a tile and of those around it, and what lies one step from each of its cells, in the places of those.
class TileNeighbors {
 public:
  using Word = CellBits::Word;  ///< a tile's bits, see BasicCellBits

  /// word_at(tile) gives the word of a tile.
  template <class WordAt>
  TileNeighbors(const Index<2>& tile, WordAt&& word_at) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) word(dx, dy) = word_at(Index<2>(tile[0] + dx, tile[1] + dy));
    }
  }

  [[nodiscard]] Word center() const { return word(0, 0); }  ///< the tile itself
  /// Of each cell the one to its left, dy tiles up.
  [[nodiscard]] Word left(int dy = 0) const { return (word(0, dy) << 1U & ~first_column) | (word(-1, dy) >> 7U & first_column); }
  /// Of each cell the one to its right, dy tiles up.
  [[nodiscard]] Word right(int dy = 0) const { return (word(0, dy) >> 1U & ~last_column) | (word(1, dy) << 7U & last_column); }
  [[nodiscard]] Word below() const { return word(0, 0) << 8U | word(0, -1) >> 56U; }  ///< of each cell the one below
  [[nodiscard]] Word above() const { return word(0, 0) >> 8U | word(0, 1) << 56U; }  ///< of each cell the one above

  /// The cells of the tile that have a set cell beside them, across a side.
  [[nodiscard]] Word beside() const { return left() | right() | below() | above(); }

  /// The cells of the tile that are set, or one of the eight cells around them is.
  [[nodiscard]] Word dilated() const {
    const auto in_row = [this](int dy) { return word(0, dy) | left(dy) | right(dy); };
    const Word middle = in_row(0);
    return middle | middle << 8U | middle >> 8U | in_row(-1) >> 56U | in_row(1) << 56U;
  }

 private:
  static constexpr Word first_column = 0x0101010101010101ULL;
  static constexpr Word last_column = first_column << 7U;

  [[nodiscard]] Word word(int dx, int dy) const { return words_[static_cast<std::size_t>(4 + dx + 3 * dy)]; }
  [[nodiscard]] Word& word(int dx, int dy) { return words_[static_cast<std::size_t>(4 + dx + 3 * dy)]; }

  std::array<Word, 9> words_;
};

}  // namespace incognita
