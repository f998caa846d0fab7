/// What stands where in a plane that does not change: exact ranges, distances and discs against square cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// The blocked cells of a grid, as squares, with a table of clearances that makes queries fast and leaves them exact.
/// Outside of the grid's box everything is blocked. A byte a cell. Immutable: safe from many threads.
class ObstacleField {
 public:
  /// A cell is blocked when blocks(value) holds. O(cells).
  template <class Value, class Blocks>
  ObstacleField(const Grid<Value, 2>& grid, Blocks&& blocks)
      : box_(grid.box()), gaps_(grid.lattice(), padded(grid.box()), std::uint8_t{0}) {
    // The gap between two squares is the distance between a centre and the other square's centre when that
    // square and its eight neighbours are sources, so transform the blocked cells dilated by one.
    Grid<std::uint8_t, 2> dilated(grid.lattice(), gaps_.box(), std::uint8_t{0});
    Grid<std::uint8_t, 2> blocked(grid.lattice(), gaps_.box(), std::uint8_t{1});
    for (int y = box_.lower.y(); y < box_.upper.y(); ++y) {
      for (int x = box_.lower.x(); x < box_.upper.x(); ++x) {
        blocked.set({x, y}, blocks(grid.value({x, y})) ? std::uint8_t{1} : std::uint8_t{0});
      }
    }
    dilate(blocked, dilated);
    const Grid<float, 2> gap_m = distance_transform_m(dilated, [](std::uint8_t value) { return value != 0; });
    const double per_unit = gap_unit_count / grid.resolution_m();
    for (Offset cell = 0; cell < static_cast<Offset>(gaps_.size()); ++cell) {
      if (blocked[cell] != 0) continue;
      // Rounded down, but not below a whole number that a float has just missed.
      const double gap = std::floor(static_cast<double>(gap_m[cell]) * per_unit + 1e-3);
      gaps_[cell] = static_cast<std::uint8_t>(1.0 + std::min(gap, 254.0));
    }
  }

  [[nodiscard]] const Lattice<2>& lattice() const { return gaps_.lattice(); }
  [[nodiscard]] double resolution_m() const { return gaps_.resolution_m(); }
  /// The box of the grid that the field was made from.
  [[nodiscard]] const IndexBox<2>& box() const { return box_; }

  [[nodiscard]] bool is_blocked(const Index<2>& cell) const { return gaps_.value(cell) == 0; }

  /// The range from a point to the first blocked cell's face: 0 in a blocked cell, range_max_m when nothing is met
  /// within it. `direction` has length 1. The same as cast_ray_m of a grid, but open space is crossed in strides no
  /// longer than the clearance around.
  [[nodiscard]] double cast_ray_m(const Point<2>& origin_m, const Point<2>& direction, double range_max_m) const {
    const Point<2> from = to_table(origin_m);
    if (!in_table(from)) return 0.0;
    const double resolution_m = gaps_.resolution_m();
    const double range_max = range_max_m / resolution_m;
    const double dx = direction.x();
    const double dy = direction.y();
    const double per_x = 1.0 / std::abs(dx);
    const double per_y = 1.0 / std::abs(dy);
    const Offset stride = gaps_.stride(1);
    const std::uint8_t* const gaps = gaps_.values().data();
    int x = static_cast<int>(from.x());
    int y = static_cast<int>(from.y());
    double range = 0.0;  // in cells, as everything here
    for (;;) {
      const std::uint8_t gap = gaps[y * stride + x];
      if (gap >= gap_worth_a_stride) {
        // A little short of the nearest square: the step onto its face is left to the exact walk.
        range += (gap - 1) * (1.0 / gap_unit_count) - 1e-6;
        if (range >= range_max) return range_max_m;
        x = static_cast<int>(from.x() + range * dx);
        y = static_cast<int>(from.y() + range * dy);
        continue;
      }
      if (gap == 0) return std::min(range * resolution_m, range_max_m);
      const double exit_x = dx != 0.0 ? (dx < 0.0 ? from.x() - x : x + 1.0 - from.x()) * per_x : never;
      const double exit_y = dy != 0.0 ? (dy < 0.0 ? from.y() - y : y + 1.0 - from.y()) * per_y : never;
      if (exit_y < exit_x) {
        range = exit_y;
        y += dy < 0.0 ? -1 : 1;
      } else {
        range = exit_x;
        x += dx < 0.0 ? -1 : 1;
      }
      if (range >= range_max) return range_max_m;
    }
  }

  /// The distance from a point to the nearest blocked square: 0 in or on one. O(clearance in cells, squared) near the
  /// corners of what is blocked, usually less.
  [[nodiscard]] double clearance_m(const Point<2>& point_m) const {
    const Point<2> at = to_table(point_m);
    if (!in_table(at)) return 0.0;
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    const int width = static_cast<int>(gaps_.stride(1));
    const int height = gaps_.box().extent().y();
    const std::uint8_t* const gaps = gaps_.values().data();
    const std::uint8_t gap = gaps[y * width + x];
    if (gap == 0) return 0.0;

    double nearest_squared = never;
    const auto meet = [&](int cell_x, int cell_y) {
      if (gaps[cell_y * width + cell_x] != 0) return;
      const double across = std::max({cell_x - at.x(), at.x() - (cell_x + 1.0), 0.0});
      const double up = std::max({cell_y - at.y(), at.y() - (cell_y + 1.0), 0.0});
      nearest_squared = std::min(nearest_squared, across * across + up * up);
    };
    // Square rings of cells around the point's own; no blocked one is nearer than the table says.
    const double depth = std::min({at.x() - x, x + 1.0 - at.x(), at.y() - y, y + 1.0 - at.y()});
    int ring = 1 + static_cast<int>((gap - 1) * (std::numbers::sqrt2 / 2.0 / gap_unit_count));
    for (; (ring - 1 + depth) * (ring - 1 + depth) < nearest_squared; ++ring) {
      const int left = std::max(x - ring, 0);
      const int right = std::min(x + ring, width - 1);
      const int low = std::max(y - ring + 1, 0);
      const int high = std::min(y + ring - 1, height - 1);
      for (const int row : {y - ring, y + ring}) {
        if (row < 0 || row >= height) continue;
        for (int column = left; column <= right; ++column) meet(column, row);
      }
      for (const int column : {x - ring, x + ring}) {
        if (column < 0 || column >= width) continue;
        for (int row = low; row <= high; ++row) meet(column, row);
      }
    }
    return std::sqrt(nearest_squared) * gaps_.resolution_m();
  }

  /// True when a disc overlaps no blocked square; it may touch one.
  [[nodiscard]] bool disc_is_clear(const Point<2>& center_m, double radius_m) const {
    const Point<2> at = to_table(center_m);
    if (!in_table(at)) return false;
    const std::uint8_t gap = gaps_[static_cast<int>(at.y()) * gaps_.stride(1) + static_cast<int>(at.x())];
    if (gap == 0) return false;
    if ((gap - 1) * gaps_.resolution_m() >= radius_m * gap_unit_count) return true;
    return clearance_m(center_m) >= radius_m;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  /// The table counts clearance in this part of a cell.
  static constexpr double gap_unit_count = 2.0;
  static constexpr std::uint8_t gap_worth_a_stride = 4;

  /// With a ring of blocked cells around, no walk leaves the table.
  [[nodiscard]] static IndexBox<2> padded(const IndexBox<2>& box) {
    return {(box.lower.array() - 1).matrix(), (box.upper.array() + 1).matrix()};
  }

  static void dilate(const Grid<std::uint8_t, 2>& blocked, Grid<std::uint8_t, 2>& dilated) {
    const IndexBox<2>& box = blocked.box();
    Grid<std::uint8_t, 2> rows = dilated;
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        const int any = blocked.value({x - 1, y}) | blocked.value({x, y}) | blocked.value({x + 1, y});
        rows.set({x, y}, static_cast<std::uint8_t>(any));
      }
    }
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        const int any = rows.value({x, y - 1}) | rows.value({x, y}) | rows.value({x, y + 1});
        dilated.set({x, y}, static_cast<std::uint8_t>(any));
      }
    }
  }

  /// Coordinates in cells from the table's lower corner.
  [[nodiscard]] Point<2> to_table(const Point<2>& point_m) const {
    return gaps_.lattice().to_cells(point_m) - gaps_.box().lower.cast<double>();
  }

  /// False for NaN too.
  [[nodiscard]] bool in_table(const Point<2>& at) const {
    const Index<2> extent = gaps_.box().extent();
    return at.x() >= 0.0 && at.y() >= 0.0 && at.x() < extent.x() && at.y() < extent.y();
  }

  IndexBox<2> box_;
  /// 0 in a blocked cell; otherwise 1 + the gap between this cell's square and the nearest blocked one in
  /// units of the cell, rounded down, at most 255.
  Grid<std::uint8_t, 2> gaps_;
};

}  // namespace incognita
