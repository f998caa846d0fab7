/// The cells that a segment passes, in order (Amanatides and Woo 1987), in two and three dimensions.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "incognita/grid/lattice.hpp"

namespace incognita {

/// Calls visit(index) for each cell that the segment between two points in lattice coordinates passes, see traverse.
template <int Dim, class Visit>
void traverse_cells(const Point<Dim>& from, const Point<Dim>& to, Visit&& visit) {
  constexpr double never = std::numeric_limits<double>::infinity();
  Index<Dim> index = cell_holding<Dim>(from);
  const Index<Dim> last = cell_holding<Dim>(to);

  // The segment parameter of the next crossing is first + crossed * period: computed anew from the integer count at
  // each step, so rounding does not add up along the ray.
  std::array<double, static_cast<std::size_t>(Dim)> first;
  std::array<double, static_cast<std::size_t>(Dim)> period;
  std::array<double, static_cast<std::size_t>(Dim)> next;
  std::array<int, static_cast<std::size_t>(Dim)> step;
  std::array<double, static_cast<std::size_t>(Dim)> crossed{};
  std::array<double, static_cast<std::size_t>(Dim)> crossings;
  int steps = 0;
  for (int a = 0; a < Dim; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const double delta = to[a] - from[a];
    step[axis] = last[a] > index[a] ? 1 : -1;
    crossings[axis] = std::abs(last[a] - index[a]);
    steps += std::abs(last[a] - index[a]);
    const double boundary = index[a] + (step[axis] > 0 ? 1.0 : 0.0);
    first[axis] = (boundary - from[a]) / delta;
    period[axis] = 1.0 / std::abs(delta);
    next[axis] = crossings[axis] > 0 ? first[axis] : never;
  }

  for (int taken = 0;; ++taken) {
    if constexpr (std::is_same_v<std::invoke_result_t<Visit&, const Index<Dim>&>, bool>) {
      if (!visit(index)) return;
    } else {
      visit(index);
    }
    if (taken == steps) return;
    std::size_t chosen = 0;
    for (std::size_t axis = 1; axis < static_cast<std::size_t>(Dim); ++axis) {
      if (next[axis] < next[chosen]) chosen = axis;
    }
    // All axes are computed anew, so that nothing is addressed by the axis chosen and all stays in registers. An axis
    // that has reached its last cell never steps again, whatever the rounding.
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(Dim); ++axis) {
      const bool steps_here = axis == chosen;
      index[static_cast<int>(axis)] += steps_here ? step[axis] : 0;
      crossed[axis] += steps_here ? 1.0 : 0.0;
      next[axis] = crossed[axis] < crossings[axis] ? first[axis] + crossed[axis] * period[axis] : never;
    }
  }
}

/// Calls visit(index) for each cell that the segment passes, from the cell that holds `from_m` to the cell that holds
/// `to_m`, both included: exactly 1 + |i_to - i_from|_1 cells, each a face neighbour of the last. A visit that returns
/// bool ends the walk by returning false. Where the segment meets an edge of the lattice exactly, the lower axis steps
/// first. Both points must be finite and within 2^31 cells of the origin. O(cells passed), no allocation.
template <int Dim, class Visit>
void traverse(const Lattice<Dim>& lattice, const Point<Dim>& from_m, const Point<Dim>& to_m, Visit&& visit) {
  traverse_cells<Dim>(lattice.to_cells(from_m), lattice.to_cells(to_m), visit);
}

}  // namespace incognita
