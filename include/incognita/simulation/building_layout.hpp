/// What a generated building consists of, in cells, and the floor plan that shows it.
#pragma once

#include <vector>

#include "incognita/grid/floor_plan.hpp"
#include "incognita/simulation/plan_drawing.hpp"

namespace incognita {

/// A room with what stands in it.
struct BuildingRoom {
  IndexBox<2> floor;                   ///< without its walls
  bool is_hall = false;                ///< a large room with columns, whose doors are wide
  std::vector<IndexBox<2>> doors;      ///< gaps in its walls; one between two rooms belongs to both
  std::vector<IndexBox<2>> obstacles;  ///< furniture and columns, each a box on the floor
};

/// A building; what is neither floor of a room or corridor nor a door is wall.
struct BuildingLayout {
  Lattice<2> lattice;                  ///< of the cells
  IndexBox<2> outline;                 ///< with the outer walls
  std::vector<IndexBox<2>> corridors;  ///< they overlap nowhere and meet face to face
  std::vector<BuildingRoom> rooms;     ///< they overlap nowhere
};

/// The floor plan of a building. A byte a cell. O(cells). Throws std::length_error for an outline of more than FloorPlan::cell_count_max
/// cells.
[[nodiscard]] inline FloorPlan draw_layout(const BuildingLayout& layout) {
  FloorPlan plan(layout.lattice, layout.outline, FloorCell::solid);
  fill_cells(plan, layout.outline, FloorCell::wall);
  for (const IndexBox<2>& corridor : layout.corridors) fill_cells(plan, corridor, FloorCell::floor);
  for (const BuildingRoom& room : layout.rooms) {
    fill_cells(plan, room.floor, FloorCell::floor);
    for (const IndexBox<2>& door : room.doors) fill_cells(plan, door, FloorCell::floor);
    for (const IndexBox<2>& obstacle : room.obstacles) fill_cells(plan, obstacle, FloorCell::wall);
  }
  return plan;
}

}  // namespace incognita
