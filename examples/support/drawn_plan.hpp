/// Floor plans drawn by hand at 0.05 m a pixel: walls of one thickness with doors of one width, and furniture, in metres.
#pragma once

#include <vector>

#include "incognita/simulation/plan_drawing.hpp"

namespace examples {

using incognita::Along;
using incognita::draw_blocks;

/// A rectangle on the floor.
using Area = incognita::Box<incognita::Point<2>>;

inline constexpr double pixel_m = 0.05;
inline constexpr incognita::WallParams thin_wall{.wall_m = 0.1, .door_m = 1.1};

/// Makes the pixels whose centres lie in a rectangle that of `cell`.
inline void draw(incognita::FloorPlan& plan, const Area& area, incognita::FloorCell cell) { incognita::fill_area(plan, area, cell); }

/// A building's floor from (0, 0), walls around it.
[[nodiscard]] inline incognita::FloorPlan walled_floor(double width_m, double height_m) {
  return incognita::walled_floor({width_m, height_m}, pixel_m, thin_wall.wall_m);
}

/// A wall as incognita::draw_wall draws it.
inline void draw_wall(incognita::FloorPlan& plan, Along along, double across_m, double from_m, double to_m,
                      const std::vector<double>& doors_m) {
  incognita::draw_wall(plan, thin_wall, along, across_m, from_m, to_m, doors_m);
}

}  // namespace examples
