/// Floor plans drawn by hand: walls with doors, and furniture, in metres.
#pragma once

#include <cmath>
#include <vector>

#include "incognita/grid/floor_plan.hpp"

namespace office_exploration {

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

/// A wall along x from x_from_m to x_to_m whose middle is at y_m, with doors in it whose middles are at doors_x_m.
inline void draw_wall_along_x(incognita::FloorPlan& plan, double y_m, double x_from_m, double x_to_m,
                              const std::vector<double>& doors_x_m) {
  const double low_m = y_m - 0.5 * wall_m;
  const double high_m = y_m + 0.5 * wall_m;
  draw(plan, {{x_from_m, low_m}, {x_to_m, high_m}}, incognita::FloorCell::wall);
  for (const double x_m : doors_x_m) {
    draw(plan, {{x_m - 0.5 * door_m, low_m}, {x_m + 0.5 * door_m, high_m}}, incognita::FloorCell::floor);
  }
}

/// The same along y.
inline void draw_wall_along_y(incognita::FloorPlan& plan, double x_m, double y_from_m, double y_to_m,
                              const std::vector<double>& doors_y_m) {
  const double low_m = x_m - 0.5 * wall_m;
  const double high_m = x_m + 0.5 * wall_m;
  draw(plan, {{low_m, y_from_m}, {high_m, y_to_m}}, incognita::FloorCell::wall);
  for (const double y_m : doors_y_m) {
    draw(plan, {{low_m, y_m - 0.5 * door_m}, {high_m, y_m + 0.5 * door_m}}, incognita::FloorCell::floor);
  }
}

/// Desks, shelves, boxes.
inline void draw_blocks(incognita::FloorPlan& plan, const std::vector<Area>& blocks) {
  for (const Area& block : blocks) draw(plan, block, incognita::FloorCell::wall);
}

}  // namespace office_exploration
