/// How much of a workspace is known.
#pragma once

#include <cstddef>

#include "incognita/core/error.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// MapPct of Isleyen, van de Molengraft and Arslan, (29): the share of the cells of `workspace` that are free or occupied; what lies
/// outside of the belief's box is not. Throws std::invalid_argument for an empty workspace. O(cells of both).
template <int Dim>
[[nodiscard]] double mapped_fraction(const OccupancyGrid<Dim>& occupancy, const IndexBox<Dim>& workspace) {
  if (workspace.empty()) throw_invalid("mapped_fraction", "the workspace", box_text(workspace), "a box that holds cells");
  double cells = 1.0;
  for (int axis = 0; axis < Dim; ++axis) cells *= workspace.upper[axis] - workspace.lower[axis];
  std::size_t known = 0;
  for (Offset i = 0; i < static_cast<Offset>(occupancy.size()); ++i) {
    if (occupancy[i] != Occupancy::unknown && workspace.contains(occupancy.index_at(i))) ++known;
  }
  return static_cast<double>(known) / cells;
}

}  // namespace incognita
