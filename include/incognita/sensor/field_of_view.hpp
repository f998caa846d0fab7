/// Which cells are in line of sight of a cell, exactly.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// Two cells see one another when the segment between their centres touches no blocking cell, edges and
/// corners included; so light does not pass between two that touch in a corner. All comparisons are of whole
/// numbers, so the relation is exact and symmetric. Holds scratch memory: one for each thread.
class FieldOfView {
 public:
  /// Calls visit(index) for each cell of the grid's box whose centre is within range_max_m and in sight of
  /// the centre of `from`: `from` itself first, then octant by octant from near to far; cells on axes and
  /// diagonals come twice. A visit that returns bool ends everything by returning false. Nothing is seen from
  /// a blocking cell or from outside of the box, and blocking cells are not seen. The box and the range may
  /// be 10^4 cells wide at most. O(cells seen + those that limit the sight).
  template <class Value, class Blocks, class Visit>
  void visit_visible(const Grid<Value, 2>& grid, const Index<2>& from, double range_max_m, Blocks&& blocks,
                     Visit&& visit) {
    visit_visible_toward(grid, from, grid.box(), range_max_m, blocks, visit);
  }

  /// As visit_visible, but of the cells other than `from` perhaps only those on a ray that meets the box of
  /// cells `target`, before or behind it; all of those. Cheap where the target looks small.
  template <class Value, class Blocks, class Visit>
  void visit_visible_toward(const Grid<Value, 2>& grid, const Index<2>& from, const IndexBox<2>& target,
                            double range_max_m, Blocks&& blocks, Visit&& visit) {
    if (!grid.contains(from) || blocks(grid.value(from)) || !show(visit, from)) return;
    for (int octant = 0; octant < 8; ++octant) {
      const bool is_steep = (octant & 1) != 0;
      const int forward = (octant & 2) != 0 ? -1 : 1;
      const int sideways = (octant & 4) != 0 ? -1 : 1;
      const Index<2> ahead(is_steep ? 0 : forward, is_steep ? forward : 0);
      const Index<2> across(is_steep ? sideways : 0, is_steep ? 0 : sideways);
      const Sector sector = sector_of(from, target, ahead, across);
      if (!(sector.low < sector.high)) continue;
      lit_.assign(1, sector);
      if (!visit_octant(grid, from, ahead, across, range_max_m / grid.resolution_m(), blocks, visit)) return;
    }
  }

 private:
  /// Across over ahead, up > 0. Terms below 2^31 keep every product below 2^62.
  struct Slope {
    std::int64_t across;
    std::int64_t ahead;
    friend bool operator<(const Slope& a, const Slope& b) { return a.across * b.ahead < b.across * a.ahead; }
  };

  /// The open interval of slopes between two shadows.
  struct Sector {
    Slope low;
    Slope high;
  };

  template <class Visit>
  static bool show(Visit& visit, const Index<2>& cell) {
    if constexpr (std::is_same_v<std::invoke_result_t<Visit&, const Index<2>&>, bool>) {
      return visit(cell);
    } else {
      visit(cell);
      return true;
    }
  }

  /// The slopes of an octant under which a box of cells is seen, or more: the box is taken half a cell
  /// larger, and the octant a little, so that slopes 0 and 1 are inside of it. Empty when the box lies
  /// elsewhere.
  static Sector sector_of(const Index<2>& from, const IndexBox<2>& box, const Index<2>& ahead,
                          const Index<2>& across) {
    const Slope least{-1, 1 << 16};
    const Slope most{(1 << 16) + 1, 1 << 16};
    const auto along = [&](const Index<2>& axis, int x, int y) {
      return (x - from[0]) * axis[0] + (y - from[1]) * axis[1];
    };
    const int ahead_a = along(ahead, box.lower[0] - 1, box.lower[1] - 1);
    const int ahead_b = along(ahead, box.upper[0], box.upper[1]);
    const int across_a = along(across, box.lower[0] - 1, box.lower[1] - 1);
    const int across_b = along(across, box.upper[0], box.upper[1]);
    const int near = std::min(ahead_a, ahead_b);
    const int far = std::max(ahead_a, ahead_b);
    const int low = std::min(across_a, across_b);
    const int high = std::max(across_a, across_b);
    if (far <= 0) return {most, least};
    Sector sector{least, most};
    if (near > 0 || low > 0) sector.low = {low, low > 0 ? far : near};
    if (near > 0 || high < 0) sector.high = {high, high < 0 ? far : near};
    return {std::max(sector.low, least), std::min(sector.high, most)};
  }

  /// Visits what is seen within the sectors `lit_` of one octant. Its cell (row, column) lies `row` cells
  /// ahead and 0 <= column <= row across. A segment from the apex to a centre passes, in the row of that
  /// centre, no other cell; so what a row blocks counts for the rows after it. The one exception is a segment
  /// along the diagonal, which touches the cell before in its own row.
  template <class Value, class Blocks, class Visit>
  bool visit_octant(const Grid<Value, 2>& grid, const Index<2>& from, const Index<2>& ahead,
                    const Index<2>& across, double range_cells, Blocks& blocks, Visit& visit) {
    const auto blocked = [&](const Index<2>& cell) {
      return !grid.contains(cell) || blocks(grid.value(cell));
    };
    const auto cell_at = [&](int row, int column) {
      return Index<2>(from[0] + row * ahead[0] + column * across[0], from[1] + row * ahead[1] + column * across[1]);
    };
    // The one cell beside the apex that a segment along the diagonal touches.
    if (blocked(cell_at(0, 1))) lit_.front().high = std::min(lit_.front().high, Slope{1, 1});
    const double range_squared = range_cells * range_cells * (1.0 + 1e-12);
    for (int row = 1; row <= range_cells && !lit_.empty(); ++row) {
      next_lit_.clear();
      for (const Sector& sector : lit_) {
        Slope low = sector.low;
        // The columns whose squares this sector meets.
        const int first =
            std::max(0, static_cast<int>(ceil_div(low.across * (2 * row - 1) - low.ahead, 2 * low.ahead)));
        const int last = static_cast<int>(
            floor_div(sector.high.across * (2 * row + 1) + sector.high.ahead, 2 * sector.high.ahead));
        for (int column = first; column <= std::min(last, row + 1); ++column) {
          const Index<2> cell = cell_at(row, column);
          if (blocked(cell)) {
            // The corners that look outermost. (Straight ahead the low one lies below the octant anyway.)
            const Slope shadow_low{2 * column - 1, 2 * row + 1};
            const Slope shadow_high{2 * column + 1, 2 * row - 1};
            if (low < shadow_low) next_lit_.push_back({low, std::min(shadow_low, sector.high)});
            if (low < shadow_high) low = shadow_high;
            continue;
          }
          const Slope center{column, row};
          if (column > row || !(sector.low < center && center < sector.high)) continue;
          if (static_cast<double>(row) * row + static_cast<double>(column) * column > range_squared) continue;
          if (column == row && blocked(cell_at(row, column - 1))) continue;
          if (!show(visit, cell)) return false;
        }
        if (low < sector.high && low < Slope{1, 1}) next_lit_.push_back({low, sector.high});
      }
      lit_.swap(next_lit_);
    }
    return true;
  }

  static std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }
  static std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return -floor_div(-a, b); }

  std::vector<Sector> lit_;
  std::vector<Sector> next_lit_;
};

}  // namespace incognita
