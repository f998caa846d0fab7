/// Floor plans drawn by hand: walls with doors, and furniture, in metres.
#pragma once

#include <cmath>
#include <vector>

#include "incognita/grid/floor_plan.hpp"

namespace examples {

/// A rectangle on the floor.
using Area = incognita::Box<incognita::Point<2>>;

inline constexpr double pixel_m = 0.05;
inline constexpr double wall_m = 0.1;  ///< how thick walls are
inline constexpr double door_m = 1.1;  ///< how wide doors are

/// Makes the pixels whose centres lie in a rectangle that of `cell`.
inline void draw(incognita::FloorPlan& plan, const Area& area, incognita::FloorCell cell) {
  const auto pixel = [](double at_m) { return static_cast<int>(std::lround(at_m / pixel_m)); };
  for (int y = pixel(area.lower.y()); y < pixel(area.upper.y()); ++y) {
    for (int x = pixel(area.lower.x()); x < pixel(area.upper.x()); ++x) {
      if (plan.contains({x, y})) plan.set({x, y}, cell);
    }
  }
}

/// A building's floor from (0, 0), walls around it.
[[nodiscard]] inline incognita::FloorPlan walled_floor(double width_m, double height_m) {
  using namespace incognita;
  const Index<2> pixels(static_cast<int>(std::lround(width_m / pixel_m)), static_cast<int>(std::lround(height_m / pixel_m)));
  FloorPlan plan(Lattice<2>(pixel_m), {{0, 0}, pixels}, FloorCell::solid);
  draw(plan, {{0.0, 0.0}, {width_m, height_m}}, FloorCell::wall);
  draw(plan, {{wall_m, wall_m}, {width_m - wall_m, height_m - wall_m}}, FloorCell::floor);
  return plan;
}

/// The axis that a wall runs along.
enum class Along { x, y };

/// A wall from from_m to to_m along an axis, its middle at across_m on the other, with doors in it whose middles are at doors_m.
inline void draw_wall(incognita::FloorPlan& plan, Along along, double across_m, double from_m, double to_m,
                      const std::vector<double>& doors_m) {
  const auto piece = [&](double low_m, double high_m) {
    const incognita::Point<2> low(low_m, across_m - 0.5 * wall_m);
    const incognita::Point<2> high(high_m, across_m + 0.5 * wall_m);
    return along == Along::x ? Area{low, high} : Area{{low.y(), low.x()}, {high.y(), high.x()}};
  };
  draw(plan, piece(from_m, to_m), incognita::FloorCell::wall);
  for (const double door : doors_m) draw(plan, piece(door - 0.5 * door_m, door + 0.5 * door_m), incognita::FloorCell::floor);
}

/// Desks, shelves, boxes.
inline void draw_blocks(incognita::FloorPlan& plan, const std::vector<Area>& blocks) {
  for (const Area& block : blocks) draw(plan, block, incognita::FloorCell::wall);
}

}  // namespace examples
