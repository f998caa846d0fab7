/// Small floor plans for tests.
#pragma once

#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace incognita::test {

/// A plan from rows of text, the first on top: '#' wall, 'x' solid, anything else floor.
inline FloorPlan plan_from_rows(const std::vector<std::string>& rows, double resolution_m,
                                const Point<2>& origin_m = Point<2>::Zero()) {
  const int height = static_cast<int>(rows.size());
  const int width = static_cast<int>(rows.front().size());
  FloorPlan plan(Lattice<2>(resolution_m, origin_m), {{0, 0}, {width, height}}, FloorCell::solid);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      plan.set({x, y}, c == '#' ? FloorCell::wall : c == 'x' ? FloorCell::solid : FloorCell::floor);
    }
  }
  return plan;
}

/// Floor with a wall around.
inline FloorPlan room(int width_cells, int height_cells, double resolution_m) {
  FloorPlan plan(Lattice<2>(resolution_m), {{0, 0}, {width_cells, height_cells}}, FloorCell::solid);
  for (int y = 0; y < height_cells; ++y) {
    for (int x = 0; x < width_cells; ++x) {
      const bool is_edge = x == 0 || y == 0 || x + 1 == width_cells || y + 1 == height_cells;
      plan.set({x, y}, is_edge ? FloorCell::wall : FloorCell::floor);
    }
  }
  return plan;
}

/// Rooms of random sizes with gaps of random widths in their walls, and some dirt.
inline FloorPlan random_plan(int width_cells, int height_cells, double resolution_m, Random& random) {
  FloorPlan plan = room(width_cells, height_cells, resolution_m);
  const auto draw = [&](int below) {
    return static_cast<int>(random.index(static_cast<std::uint64_t>(below)));
  };
  const int walls = 2 + draw(1 + (width_cells + height_cells) / 8);
  for (int wall = 0; wall < walls; ++wall) {
    const bool is_upright = draw(2) == 0;
    const int length = is_upright ? height_cells : width_cells;
    const int at = draw(is_upright ? width_cells : height_cells);
    const int gap_first = draw(length);
    const int gap_end = gap_first + draw(8);
    for (int i = 0; i < length; ++i) {
      if (i >= gap_first && i < gap_end) continue;
      plan.set(is_upright ? Index<2>(at, i) : Index<2>(i, at), FloorCell::wall);
    }
  }
  for (int dirt = 0; dirt < (width_cells * height_cells) / 100; ++dirt) {
    plan.set({draw(width_cells), draw(height_cells)}, draw(3) == 0 ? FloorCell::solid : FloorCell::wall);
  }
  return plan;
}

}  // namespace incognita::test
