/// Floor plans as rasters: what a building is made of, at the plan's own resolution.
#pragma once

#include <cstdint>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// What one pixel of a floor plan is.
enum class FloorCell : std::uint8_t {
  floor,  ///< a robot can stand here, light passes
  wall,   ///< drawn as a wall or another obstacle
  solid   ///< neither: outside of the building or sealed; blocks robots and light as a wall does
};

/// A floor plan in its file's frame (x right, y up, metres). Outside of its box everything is solid:
/// make it with FloorCell::solid as the fill value.
using FloorPlan = Grid<FloorCell, 2>;

}  // namespace incognita
