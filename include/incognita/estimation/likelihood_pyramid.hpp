/// Upper bounds of a likelihood grid over squares of cells, for branch and bound.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/estimation/likelihood_grid.hpp"

namespace incognita {

/// Level n >= 3 bounds the grid over any square of 2^n cells, wherever it starts (Hess et al., "Real-time
/// loop closure in 2D lidar SLAM", 2016, section V-B). Starts are rounded down to a multiple of a quarter of
/// the square, so each entry covers a quarter more than the square; for that, level n takes 4^(n-2) times
/// less memory than the grid, all of them together a third of it; building them takes once the grid, which is
/// kept. Reading is safe from many threads.
template <int Dim = 2>
class LikelihoodPyramid {
  static_assert(Dim == 2, "searches are planar");

 public:
  static constexpr int level_min = 3;  ///< squares of 8 cells
  static constexpr int level_max = 7;  ///< squares of 128 cells

  /// Rows of a layer should be a multiple of this: then no entry starts in one layer and serves another.
  [[nodiscard]] static int row_multiple(int top) { return 1 << (top - 2); }

  /// Builds the levels level_min to top <= level_max. O(cells).
  void rebuild(const LikelihoodGrid<Dim>& grid, int top) {
    // Squares of 4, in place: twice the maximum of neighbours 1 and 2 apart, along rows and then along
    // columns. At its ends a row runs into the next, which can only raise a bound.
    squares_.columns = grid.columns();
    squares_.rows = grid.rows() * LikelihoodGrid<Dim>::layer_count;
    std::vector<std::uint8_t>& values = squares_.values;
    values = grid.values();
    const std::ptrdiff_t width = squares_.columns;
    for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{2}, width, 2 * width}) {
      const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(values.size()) - step;
      for (std::ptrdiff_t i = 0; i < count; ++i)
        values[at(i)] = std::max(values[at(i)], values[at(i + step)]);
    }
    const Level* fine = &squares_;
    for (int level = level_min; level <= top; ++level) {
      Level& coarse = levels_[at(level - level_min)];
      halve(*fine, coarse);
      fine = &coarse;
    }
  }

  /// At least the grid's values in columns [column, column + 2^level) and rows [stacked_row, stacked_row +
  /// 2^level), where stacked_row counts the rows of all layers.
  [[nodiscard]] int bound(int level, int column, int stacked_row) const {
    const Level& entries = levels_[at(level - level_min)];
    const int shift = level - 2;
    return entries.values[at((stacked_row >> shift) * std::ptrdiff_t{entries.columns} + (column >> shift))];
  }

  /// As bound(), and the entries of a level as an array with this many columns, for loops over many of them.
  [[nodiscard]] const std::uint8_t* entries(int level) const {
    return levels_[at(level - level_min)].values.data();
  }
  [[nodiscard]] int columns(int level) const { return levels_[at(level - level_min)].columns; }  ///< see entries()

 private:
  struct Level {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint8_t> values;
  };

  [[nodiscard]] static std::size_t at(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

  /// The next level from one whose entries cover w cells and start a quarter of 2^n apart: entries 0, 3 and 5
  /// starts on cover twice the square and a quarter of that, without gaps.
  void halve(const Level& fine, Level& coarse) {
    coarse.columns = (fine.columns + 1) / 2;
    coarse.rows = (fine.rows + 1) / 2;
    coarse.values.resize(at(std::ptrdiff_t{coarse.columns} * coarse.rows));
    row_.resize(at(fine.columns + 5));
    std::fill(row_.end() - 5, row_.end(), std::uint8_t{0});
    for (int row = 0; row < coarse.rows; ++row) {
      const std::uint8_t* source[3];
      for (int k = 0; k < 3; ++k) {
        const int from = std::min(2 * row + (k == 0 ? 0 : 2 * k + 1), fine.rows - 1);
        source[k] = fine.values.data() + std::ptrdiff_t{from} * fine.columns;
      }
      for (int column = 0; column < fine.columns; ++column) {
        row_[at(column)] = std::max(std::max(source[0][column], source[1][column]), source[2][column]);
      }
      std::uint8_t* target = coarse.values.data() + std::ptrdiff_t{row} * coarse.columns;
      for (int column = 0; column < coarse.columns; ++column) {
        const std::uint8_t* from = row_.data() + 2 * column;
        target[column] = std::max(std::max(from[0], from[3]), from[5]);
      }
    }
  }

  std::array<Level, level_max - level_min + 1> levels_;
  Level squares_;  // of 4 cells a side
  std::vector<std::uint8_t> row_;
};

}  // namespace incognita
