/// The exact range from a point to the first blocking cell of a grid, in two and three dimensions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "incognita/grid/grid.hpp"

namespace incognita {

/// How far a ray runs before it meets the face of a cell for which blocks(value) holds: 0 when it starts in
/// one, range_max_m when it meets none within that range. `direction` has length 1; cells outside of the
/// grid's box hold its fill value. Where the ray meets an edge of the lattice exactly, the lower axis steps
/// first. The ray's ends must be finite and within 2^31 cells of the lattice's origin. Exact up to the
/// rounding of one product: each crossing is computed from the origin, so errors do not add up along the ray.
/// O(cells passed), no allocation.
template <class Value, int Dim, class Blocks>
[[nodiscard]] double cast_ray_m(const Grid<Value, Dim>& grid, const Point<Dim>& origin_m,
                                const Point<Dim>& direction, double range_max_m, Blocks&& blocks) {
  using Axes = std::array<double, static_cast<std::size_t>(Dim)>;
  const Point<Dim> from = grid.lattice().to_cells(origin_m);
  Index<Dim> index = cell_holding<Dim>(from);
  if (blocks(grid.value(index))) return 0.0;

  // Metres along the ray for one cell along the axis, and until it leaves the present cell by that axis.
  Axes metres_per_cell;
  Axes next_m;
  const auto exit_m = [&](int axis) {
    const double cells = direction[axis] < 0.0 ? from[axis] - index[axis] : (index[axis] + 1.0) - from[axis];
    return cells * metres_per_cell[static_cast<std::size_t>(axis)];
  };
  for (int axis = 0; axis < Dim; ++axis) {
    metres_per_cell[static_cast<std::size_t>(axis)] = grid.resolution_m() / std::abs(direction[axis]);
    next_m[static_cast<std::size_t>(axis)] = exit_m(axis);
    // 0 cells to go times infinity: the ray starts on a face and runs along it.
    if (direction[axis] == 0.0)
      next_m[static_cast<std::size_t>(axis)] = metres_per_cell[static_cast<std::size_t>(axis)];
  }

  for (;;) {
    int axis = 0;
    for (int other = 1; other < Dim; ++other) {
      if (next_m[static_cast<std::size_t>(other)] < next_m[static_cast<std::size_t>(axis)]) axis = other;
    }
    const double range_m = next_m[static_cast<std::size_t>(axis)];
    if (!(range_m < range_max_m)) return range_max_m;
    index[axis] += direction[axis] < 0.0 ? -1 : 1;
    if (blocks(grid.value(index))) return range_m;
    next_m[static_cast<std::size_t>(axis)] = exit_m(axis);
  }
}

}  // namespace incognita
