/// What stands where in a plane that does not change: exact ranges, distances and discs against square cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// The blocked cells of a grid, as squares, with a table of clearances that makes queries fast and leaves
/// them exact. Outside of the grid's box everything is blocked. A byte a cell. Immutable: safe from many
/// threads.
class ObstacleField {
 public:
  /// A cell is blocked when blocks(value) holds. O(cells).
  template <class Value, class Blocks>
  ObstacleField(const Grid<Value, 2>& grid, Blocks&& blocks)
      : box_(grid.box()), gaps_(grid.lattice(), grid.box().padded(1), std::uint8_t{0}) {
    Grid<std::uint8_t, 2> blocked(grid.lattice(), gaps_.box(), std::uint8_t{1});
    for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
      if (!blocks(grid[cell])) blocked.set(grid.index_at(cell), std::uint8_t{0});
    }
    const Grid<float, 2> distance_m =
        distance_transform_m(blocked, [](std::uint8_t value) { return value != 0; });
    for (Offset cell = 0; cell < static_cast<Offset>(gaps_.size()); ++cell) {
      if (blocked[cell] != 0) continue;
      // Between centres; each square reaches at most half a diagonal towards the other, and the slack beyond
      // sqrt(2) covers a float's rounding.
      const double gap = static_cast<double>(distance_m[cell]) / grid.resolution_m() - 1.4143;
      gaps_[cell] = static_cast<std::uint8_t>(1.0 + std::clamp(gap * gap_unit_count, 0.0, 254.0));
    }
  }

  [[nodiscard]] const Lattice<2>& lattice() const { return gaps_.lattice(); }  ///< of the grid that it was made from
  [[nodiscard]] double resolution_m() const { return gaps_.resolution_m(); }  ///< the side of a cell
  /// The box of the grid that the field was made from.
  [[nodiscard]] const IndexBox<2>& box() const { return box_; }

  /// Whether a cell blocks; all do beyond the box.
  [[nodiscard]] bool is_blocked(const Index<2>& cell) const { return gaps_.value(cell) == 0; }

  /// The range from a point to the first blocked cell's face: 0 in a blocked cell, range_max_m when nothing is met within it.
  /// `direction` has length 1. The same as cast_ray_m of a grid. O(cells passed), less where there is space around the point.
  [[nodiscard]] double cast_ray_m(const Point<2>& origin_m, const Point<2>& direction, double range_max_m) const {
    const Point<2> from = to_table(origin_m);
    if (!in_table(from)) return 0.0;
    if (!(range_max_m < columns_max * gaps_.resolution_m())) return walk_ray_m(from, direction, range_max_m);
    return std::abs(direction.x()) >= std::abs(direction.y()) ? cast_along<0>(from, direction, range_max_m)
                                                              : cast_along<1>(from, direction, range_max_m);
  }

  /// The distance from a point to the nearest blocked square: 0 in or on one. O(clearance in cells, squared)
  /// near the corners of what is blocked, usually less.
  [[nodiscard]] double clearance_m(const Point<2>& point_m) const {
    const Point<2> at = to_table(point_m);
    if (!in_table(at)) return 0.0;
    const int x = static_cast<int>(at.x());
    const int y = static_cast<int>(at.y());
    const Offset stride = gaps_.stride(1);
    const int width = gaps_.box().extent().x();
    const int height = gaps_.box().extent().y();
    const std::uint8_t* const gaps = gaps_.values().data();
    const std::uint8_t gap = gaps[y * stride + x];
    if (gap == 0) return 0.0;

    double nearest_squared = never;
    const auto meet = [&](int cell_x, int cell_y) {
      if (gaps[cell_y * stride + cell_x] != 0) return;
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
  static constexpr double gap_unit_count = 2.0;  ///< units of the table in a cell
  static constexpr std::uint8_t gap_worth_a_stride = 4;

  /// As cast_ray_m: column by column along the axis Major, which the ray is longer along, with the rows where it leaves them in
  /// 2^-32 of a cell. So a column costs a sum and two looks, of which none waits for the last. `from` lies in the table.
  template <int Major>
  [[nodiscard]] double cast_along(const Point<2>& from, const Point<2>& direction, double range_max_m) const {
    constexpr int minor = 1 - Major;
    constexpr double one = 4294967296.0;
    constexpr std::uint32_t unsure = 1U << 14U;  // so near to a line, the exact walk decides
    const double range_max = range_max_m / gaps_.resolution_m();
    const double along = direction[Major];
    const double across = direction[minor];
    const double per_along = 1.0 / std::abs(along);
    const double slope = across * per_along;
    const std::uint8_t* const gaps = gaps_.values().data();
    const Offset step = along < 0.0 ? -gaps_.stride(Major) : gaps_.stride(Major);
    const Offset across_stride = gaps_.stride(minor);
    const auto first = static_cast<int>(from[Major]);
    const double to_first_line = along < 0.0 ? from[Major] - first : first + 1.0 - from[Major];
    const Offset start = first * gaps_.stride(Major);
    auto row = static_cast<std::int64_t>(from[minor]);
    const std::uint8_t gap = gaps[start + row * across_stride];
    if (gap == 0) return 0.0;

    const auto column_end = static_cast<int>(range_max * std::abs(along) - to_first_line) + 1;  // range_max ends before its far line
    // Nothing is met within the clearance around.
    int column = std::max(0, static_cast<int>((gap - 1) * (1.0 / gap_unit_count) * std::abs(along) - to_first_line));
    const auto per_column = static_cast<std::int64_t>(slope * one);
    auto leaving = static_cast<std::int64_t>((from[minor] + slope * (to_first_line + column)) * one);
    if (column > 0) row = (leaving - per_column) >> 32;
    Offset place = start + column * step;
    for (; column <= column_end; ++column) {
      if (static_cast<std::uint32_t>(leaving) + unsure < 2 * unsure) return walk_ray_m(from, direction, range_max_m);
      const std::int64_t next_row = leaving >> 32;
      const Offset beside = place + next_row * across_stride;
      if ((gaps[beside] == 0) | (gaps[beside + step] == 0)) {
        double range = (to_first_line + column) * per_along;
        if (gaps[beside] == 0) {
          range = (across < 0.0 ? from[minor] - static_cast<double>(row) : static_cast<double>(row) + 1.0 - from[minor]) / std::abs(across);
        }
        return range < range_max ? range * gaps_.resolution_m() : range_max_m;
      }
      row = next_row;
      leaving += per_column;
      place += step;
    }
    return range_max_m;
  }

  /// As cast_ray_m, exactly and from cell to cell, but open space is crossed in strides no longer than the clearance around.
  [[nodiscard]] double walk_ray_m(const Point<2>& from, const Point<2>& direction, double range_max_m) const {
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
        // This ends short of the nearest square: the step onto its face is left to the exact walk.
        range += (gap - 1) * (1.0 / gap_unit_count);
        if (range >= range_max) return range_max_m;
        // Never back over a line that has been crossed, whatever the rounding.
        const auto along_x = static_cast<int>(from.x() + range * dx);
        const auto along_y = static_cast<int>(from.y() + range * dy);
        x = dx < 0.0 ? std::min(x, along_x) : std::max(x, along_x);
        y = dy < 0.0 ? std::min(y, along_y) : std::max(y, along_y);
        continue;
      }
      if (gap == 0) return std::min(range * resolution_m, range_max_m);
      const double exit_x = dx != 0.0 ? (dx < 0.0 ? from.x() - x : x + 1.0 - from.x()) * per_x : never;
      const double exit_y = dy != 0.0 ? (dy < 0.0 ? from.y() - y : y + 1.0 - from.y()) * per_y : never;
      if (exit_y < exit_x) {
        range = std::max(range, exit_y);
        y += dy < 0.0 ? -1 : 1;
      } else {
        range = std::max(range, exit_x);
        x += dx < 0.0 ? -1 : 1;
      }
      if (range >= range_max) return range_max_m;
    }
  }

  static constexpr double columns_max = 8192.0;  ///< beyond, rounding would add up to more than what is unsure

  /// Coordinates in cells from the table's lower corner.
  [[nodiscard]] Point<2> to_table(const Point<2>& point_m) const {
    const Point<2> cells = gaps_.lattice().to_cells(point_m);
    return {cells[0] - gaps_.box().lower[0], cells[1] - gaps_.box().lower[1]};
  }

  /// False for NaN too.
  [[nodiscard]] bool in_table(const Point<2>& at) const {
    const Index<2> extent = gaps_.box().extent();
    return at.x() >= 0.0 && at.y() >= 0.0 && at.x() < extent.x() && at.y() < extent.y();
  }

  IndexBox<2> box_;
  /// 0 in a blocked cell; otherwise 1 + a lower bound of the gap between this cell's square and any blocked
  /// one, in parts of a cell. With a ring of blocked cells around, no walk leaves the table.
  Grid<std::uint8_t, 2> gaps_;
};

/// The cells on whose centre a disc is clear: 1 there, 0 elsewhere. O(cells), more near what is blocked.
[[nodiscard]] inline Grid<std::uint8_t, 2> disc_positions(const ObstacleField& obstacles, double radius_m) {
  Grid<std::uint8_t, 2> positions(obstacles.lattice(), obstacles.box(), std::uint8_t{0});
  for (Offset cell = 0; cell < static_cast<Offset>(positions.size()); ++cell) {
    const Point<2> center_m = obstacles.lattice().center_m(positions.index_at(cell));
    if (obstacles.disc_is_clear(center_m, radius_m)) positions[cell] = 1;
  }
  return positions;
}

/// How far along a curve a disc can go before it would overlap something, at most length_m; position_at(s) is
/// the centre after s metres along the curve. 0 when it is not clear to begin with, and the result is always
/// a clear position. Clearance is looked at no farther apart than 1 mm where it is short, so a corner that
/// the disc grazes in passing can reach (1 mm)^2 / (8 radius) into it, 0.6 um at 0.2 m; a contact is found to
/// 1 um.
template <class PositionAt>
[[nodiscard]] double clear_length_m(const ObstacleField& obstacles, double radius_m, double length_m,
                                    PositionAt&& position_at) {
  constexpr double stride_m = 1e-3;
  constexpr double accuracy_m = 1e-6;
  double clear_m = 0.0;
  double spare_m = obstacles.clearance_m(position_at(0.0)) - radius_m;
  if (spare_m < 0.0) return 0.0;
  while (clear_m < length_m) {
    const double next_m = std::min(clear_m + std::max(spare_m, stride_m), length_m);
    spare_m = obstacles.clearance_m(position_at(next_m)) - radius_m;
    if (spare_m < 0.0) {
      double overlapping_m = next_m;
      while (overlapping_m - clear_m > accuracy_m) {
        const double middle_m = 0.5 * (clear_m + overlapping_m);
        (obstacles.disc_is_clear(position_at(middle_m), radius_m) ? clear_m : overlapping_m) = middle_m;
      }
      return clear_m;
    }
    clear_m = next_m;
  }
  return length_m;
}

}  // namespace incognita
