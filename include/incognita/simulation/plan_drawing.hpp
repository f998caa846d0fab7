/// Floor plans drawn in metres or in cells: floor with walls around it, walls with doors, blocks.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace incognita {

/// Makes the cells of a box `cell`; what lies outside of the plan is left out. O(cells of the box).
inline void fill_cells(FloorPlan& plan, const IndexBox<2>& box, FloorCell cell) {
  const Index<2> lower = box.lower.cwiseMax(plan.box().lower);
  const Index<2> upper = box.upper.cwiseMin(plan.box().upper);
  if (IndexBox<2>{lower, upper}.empty()) return;
  for (int y = lower.y(); y < upper.y(); ++y) {
    std::fill_n(plan.values().begin() + plan.offset_of({lower.x(), y}), upper.x() - lower.x(), cell);
  }
}

/// Makes the cells whose centres lie in a rectangle, in metres in the plan's frame, `cell`; what lies outside of the plan is left out. Throws
/// std::invalid_argument for a corner that is not finite. O(cells of the rectangle).
inline void fill_area(FloorPlan& plan, const Box<Point<2>>& area_m, FloorCell cell) {
  const auto line = [&](const Point<2>& corner_m) {
    Index<2> index;
    for (int axis = 0; axis < 2; ++axis) {
      require(std::isfinite(corner_m[axis]), "fill_area", "a corner's coordinate in m", corner_m[axis], "finite");
      const double nearest = std::round((corner_m[axis] - plan.lattice().origin_m()[axis]) / plan.resolution_m());
      index[axis] = static_cast<int>(std::clamp<double>(nearest, plan.box().lower[axis], plan.box().upper[axis]));
    }
    return index;
  };
  fill_cells(plan, {line(area_m.lower), line(area_m.upper)}, cell);
}

/// A building's floor from (0, 0) to `size_m`, with walls within its edges. Throws std::invalid_argument for lengths that are not finite
/// and > 0, and std::length_error above FloorPlan::cell_count_max cells.
[[nodiscard]] inline FloorPlan walled_floor(const Point<2>& size_m, double resolution_m, double wall_m) {
  require_positive("walled_floor", "resolution_m", resolution_m);
  require_positive("walled_floor", "wall_m", wall_m);
  Index<2> cells;
  for (int axis = 0; axis < 2; ++axis) {
    require_positive("walled_floor", "size_m", size_m[axis]);
    cells[axis] = static_cast<int>(std::lround(std::min(size_m[axis] / resolution_m, double{FloorPlan::cell_count_max})));
  }
  FloorPlan plan(Lattice<2>(resolution_m), {{0, 0}, cells}, FloorCell::solid);
  fill_cells(plan, plan.box(), FloorCell::wall);
  fill_area(plan, {{wall_m, wall_m}, {size_m.x() - wall_m, size_m.y() - wall_m}}, FloorCell::floor);
  return plan;
}

/// The axis that a wall runs along.
enum class Along {
  x,  ///< from left to right
  y   ///< upwards
};

/// How thick walls are, and how wide the doors in them. Both are rounded to whole cells, one at least.
struct WallParams {
  double wall_m = 0.1;  ///< > 0
  double door_m = 1.1;  ///< > 0
};

/// A wall from from_m to to_m along an axis, its middle at across_m on the other, with doors in it whose middles are at doors_m, to the nearest
/// cell. Throws std::invalid_argument for a number that is not finite, or a width that is not > 0.
inline void draw_wall(FloorPlan& plan, const WallParams& params, Along along, double across_m, double from_m, double to_m,
                      const std::vector<double>& doors_m) {
  require_positive("draw_wall", "wall_m", params.wall_m);
  require_positive("draw_wall", "door_m", params.door_m);
  for (const double at_m : {across_m, from_m, to_m}) require(std::isfinite(at_m), "draw_wall", "where the wall lies, in m,", at_m, "finite");
  for (const double door : doors_m) require(std::isfinite(door), "draw_wall", "where a door lies, in m,", door, "finite");
  // As many cells wherever it lies: no wall is lost where its faces are rounded to the same line.
  const double cell_m = plan.resolution_m();
  const auto wide_m = [&](double width_m) { return cell_m * std::max(1.0, std::round(width_m / cell_m)); };
  const auto low_m = [&](double middle_m, double width_m, int axis) {
    const double origin_m = plan.lattice().origin_m()[axis];
    return origin_m + cell_m * std::round((middle_m - 0.5 * width_m - origin_m) / cell_m);
  };
  const int axis = along == Along::x ? 0 : 1;
  const double lower_m = low_m(across_m, params.wall_m, 1 - axis);
  const auto piece = [&](double begin_m, double end_m) {
    Box<Point<2>> area_m;
    area_m.lower[axis] = begin_m;
    area_m.upper[axis] = end_m;
    area_m.lower[1 - axis] = lower_m;
    area_m.upper[1 - axis] = lower_m + wide_m(params.wall_m);
    return area_m;
  };
  fill_area(plan, piece(from_m, to_m), FloorCell::wall);
  for (const double door : doors_m) {
    const double begin_m = low_m(door, params.door_m, axis);
    fill_area(plan, piece(begin_m, begin_m + wide_m(params.door_m)), FloorCell::floor);
  }
}

/// Desks, shelves, boxes: rectangles in metres that a robot cannot enter. Throws as fill_area does.
inline void draw_blocks(FloorPlan& plan, const std::vector<Box<Point<2>>>& blocks_m) {
  for (const Box<Point<2>>& block_m : blocks_m) fill_area(plan, block_m, FloorCell::wall);
}

}  // namespace incognita
