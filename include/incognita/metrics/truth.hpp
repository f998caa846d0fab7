/// Which cells of a belief are truly occupied.
#pragma once

#include <cstdint>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/metrics/belief_box.hpp"

namespace incognita {

/// The belief cells that hold the centre of a pixel drawn as a wall: 1 for them, 0 elsewhere, on the belief's
/// lattice. What is merely solid does not count. O(pixels + belief cells under the plan).
[[nodiscard]] inline Grid<std::uint8_t, 2> truly_occupied_cells(const FloorPlan& plan,
                                                                const Pose2& T_belief_world,
                                                                const Lattice<2>& belief_lattice) {
  Grid<std::uint8_t, 2> occupied(belief_lattice, belief_box(plan, T_belief_world, belief_lattice), 0);
  for (Offset pixel = 0; pixel < static_cast<Offset>(plan.size()); ++pixel) {
    if (plan[pixel] != FloorCell::wall) continue;
    const Point<2> center_m = T_belief_world * plan.lattice().center_m(plan.index_at(pixel));
    occupied[occupied.offset_of(belief_lattice.index_of(center_m))] = 1;
  }
  return occupied;
}

}  // namespace incognita
