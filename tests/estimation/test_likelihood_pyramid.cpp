#include <algorithm>
#include <catch2/catch.hpp>

#include "incognita/core/random.hpp"
#include "incognita/estimation/likelihood_pyramid.hpp"

using namespace incognita;

namespace {

/// The largest value in rows and columns [row, row + side), [column, column + side) of the stacked layers.
int largest(const LikelihoodGrid<2>& grid, int column, int row, int side) {
  int value = 0;
  const int rows = grid.rows() * LikelihoodGrid<2>::layer_count;
  for (int y = row; y < std::min(row + side, rows); ++y) {
    for (int x = column; x < std::min(column + side, grid.columns()); ++x) {
      value = std::max(value, grid.value(y / grid.rows(), x, y % grid.rows()));
    }
  }
  return value;
}

/// A grid with a few peaks, some of them at its corners.
LikelihoodGrid<2> peaks(Random& random, int columns, int rows) {
  SurfaceMap<2> surfaces;
  surfaces.add({0.01, 0.01}, {1.0, 0.0});
  surfaces.add({columns * 0.1 - 0.01, rows * 0.1 - 0.01}, {0.0, 1.0});
  for (int n = 0; n < 12; ++n) {
    surfaces.add({random.uniform(0.0, columns * 0.1), random.uniform(0.0, rows * 0.1)},
                 {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)});
  }
  LikelihoodGrid<2> grid;
  grid.rebuild(surfaces, Lattice<2>(0.1), columns, rows, 0.06);
  return grid;
}

}  // namespace

TEST_CASE("No value exceeds its bound, and bounds are tight but for their quarter", "[estimation]") {
  Random random(1);
  LikelihoodPyramid<2> pyramid;
  for (const int columns : {97, 64, 33}) {
    const int top = columns == 33 ? 4 : 6;
    const LikelihoodGrid<2> grid = peaks(random, columns, 5 * LikelihoodPyramid<2>::row_multiple(top));
    pyramid.rebuild(grid, top);
    const int rows = grid.rows() * LikelihoodGrid<2>::layer_count;
    for (int level = LikelihoodPyramid<2>::level_min; level <= top; ++level) {
      const int side = 1 << level;
      const int quarter = side / 4;
      for (int row = 0; row < rows; row += 3) {
        for (int column = 0; column < columns; ++column) {
          const int bound = pyramid.bound(level, column, row);
          REQUIRE(bound >= largest(grid, column, row, side));
          // Rows run into the next at the right end; elsewhere an entry holds nothing beyond what it covers.
          const int start_x = column / quarter * quarter;
          const int start_y = row / quarter * quarter;
          const int covered = 5 * quarter - 1;
          if (start_x + covered <= columns) REQUIRE(bound == largest(grid, start_x, start_y, covered));
        }
      }
    }
  }
}
