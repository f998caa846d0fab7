/// The part of a belief's lattice on which a raster of the world lies.
#pragma once

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// A box of belief cells that holds every point of the world grid's box. Empty for an empty grid.
template <class Value>
[[nodiscard]] IndexBox<2> belief_box(const Grid<Value, 2>& world, const Pose2& T_belief_world,
                                     const Lattice<2>& belief_lattice) {
  if (world.box().empty()) return {};
  const Point<2> origin_m = world.lattice().origin_m();
  const Point<2> lower_m = origin_m + world.box().lower.template cast<double>() * world.resolution_m();
  const Point<2> upper_m = origin_m + world.box().upper.template cast<double>() * world.resolution_m();
  const Point<2> first_m = T_belief_world * lower_m;
  Box<Point<2>> reach_m{first_m, first_m};
  for (const Point<2>& corner_m :
       {upper_m, Point<2>(lower_m.x(), upper_m.y()), Point<2>(upper_m.x(), lower_m.y())}) {
    const Point<2> moved_m = T_belief_world * corner_m;
    reach_m = {reach_m.lower.cwiseMin(moved_m), reach_m.upper.cwiseMax(moved_m)};
  }
  return belief_lattice.cells_of(reach_m);
}

}  // namespace incognita
