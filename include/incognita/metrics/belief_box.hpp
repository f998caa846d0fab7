/// The part of a belief's lattice on which a raster of the world lies.
#pragma once

#include <algorithm>
#include <limits>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// A box of belief cells that holds the centre of every cell of the world grid's box. Empty for an empty
/// grid.
template <class Value>
[[nodiscard]] IndexBox<2> belief_box(const Grid<Value, 2>& world, const Pose2& T_belief_world,
                                     const Lattice<2>& belief_lattice) {
  if (world.box().empty()) return {};
  // The corners, half a cell beyond the outermost centres.
  const double half_m = 0.5 * world.resolution_m();
  const Point<2> first_m = world.lattice().center_m(world.box().lower);
  const Point<2> last_m = world.lattice().center_m(world.box().upper);
  constexpr double far = std::numeric_limits<double>::infinity();
  Point<2> lower_m(far, far);
  Point<2> upper_m(-far, -far);
  for (const double x_m : {first_m.x() - half_m, last_m.x() - half_m}) {
    for (const double y_m : {first_m.y() - half_m, last_m.y() - half_m}) {
      const Point<2> corner_m = T_belief_world * Point<2>(x_m, y_m);
      for (int axis = 0; axis < 2; ++axis) {
        lower_m[axis] = std::min(lower_m[axis], corner_m[axis]);
        upper_m[axis] = std::max(upper_m[axis], corner_m[axis]);
      }
    }
  }
  return belief_lattice.cells_of({lower_m, upper_m});
}

}  // namespace incognita
