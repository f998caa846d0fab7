/// Where what is known to be free ends.
#pragma once

#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// What counts as a frontier and how its cells are grouped.
struct FrontierParams {
  /// An unknown cell counts only when none of the 8 (26) cells around it is occupied. Updates near a surface
  /// are weak, so thin slivers of unknown stay between what is free and its wall: there is nothing to see
  /// there.
  bool ignore_unknown_near_walls = true;
  Adjacency unknown_adjacency = Adjacency::faces;   ///< which cells beside a free one make it a frontier when unknown
  Adjacency group_adjacency = Adjacency::corners;   ///< which frontier cells belong together
  double length_min_m = 0.3;  ///< a group with fewer cells than fill this length in a row is dropped, >= 0
  double length_max_m = 3.0;  ///< a group longer than this is split along its principal axis, > 0

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_non_negative("FrontierParams", "length_min_m", length_min_m);
    require_positive("FrontierParams", "length_max_m", length_max_m);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "ignore_unknown_near_walls, unknown_adjacency, group_adjacency, length_min_m, length_max_m",
        ignore_unknown_near_walls, unknown_adjacency, group_adjacency, length_min_m, length_max_m);
  }
};

namespace detail {

/// Whether a cell of the 3^Dim around `center` is occupied.
template <int Dim>
[[nodiscard]] bool is_near_occupied(const OccupancyGrid<Dim>& occupancy, const Index<Dim>& center) {
  const IndexBox<Dim>& box = occupancy.box();
  const Index<Dim> lower = (center.array() - 1).matrix().cwiseMax(box.lower);
  const Index<Dim> upper = (center.array() + 2).matrix().cwiseMin(box.upper);
  if (!(lower.array() < upper.array()).all()) return false;
  Index<Dim> row = lower;
  while (true) {
    const Offset first = occupancy.offset_of(row);
    for (Offset offset = first; offset < first + upper[0] - lower[0]; ++offset) {
      if (occupancy[offset] == Occupancy::occupied) return true;
    }
    int axis = 1;
    while (axis < Dim && ++row[axis] == upper[axis]) {
      row[axis] = lower[axis];
      ++axis;
    }
    if (axis == Dim) return false;
  }
}

}  // namespace detail

/// The free cells with an unknown neighbour (see FrontierParams), in storage order. Cells outside of the grid's box are unknown.
/// Throws std::invalid_argument for bad parameters. O(cells); little but the result is allocated.
template <int Dim>
[[nodiscard]] std::vector<Index<Dim>> detect_frontier(const OccupancyGrid<Dim>& occupancy,
                                                      const FrontierParams& params = {}) {
  params.validate();
  std::vector<Index<Dim>> frontier;
  if (occupancy.size() == 0) return frontier;
  const IndexBox<Dim>& box = occupancy.box();

  const auto opens = [&](const Index<Dim>& unknown) {
    return !params.ignore_unknown_near_walls || !detail::is_near_occupied<Dim>(occupancy, unknown);
  };
  const std::vector<Index<Dim>> steps = neighbor_steps<Dim>(params.unknown_adjacency);
  std::vector<Offset> offset_steps;
  for (const Index<Dim>& step : steps) {
    Offset offset = 0;
    for (int axis = 0; axis < Dim; ++axis) offset += step[axis] * occupancy.stride(axis);
    offset_steps.push_back(offset);
  }
  const auto is_frontier = [&](const Index<Dim>& index) {
    for (const Index<Dim>& step : steps) {
      const Index<Dim> neighbor = index + step;
      const bool unknown =
          !box.contains(neighbor) || occupancy[occupancy.offset_of(neighbor)] == Occupancy::unknown;
      if (unknown && opens(neighbor)) return true;
    }
    return false;
  };

  // Most cells are seen in a glance at their row and its neighbours to be none.
  const Occupancy* const cells = occupancy.values().data();
  const int count = box.upper[0] - box.lower[0];
  const Offset size = static_cast<Offset>(occupancy.size());
  for (Offset first = 0; first < size; first += count) {
    Index<Dim> index = occupancy.index_at(first);
    bool inner = true;
    for (int axis = 1; axis < Dim; ++axis) {
      inner = inner && index[axis] > box.lower[axis] && index[axis] + 1 < box.upper[axis];
    }
    const Occupancy* const row = cells + first;
    for (int i = 0; i < count; ++i) {
      if (row[i] != Occupancy::free) continue;
      if (inner && i > 0 && i + 1 < count) {
        bool any_unknown = false;
        for (const Offset step : offset_steps) any_unknown |= row[i + step] == Occupancy::unknown;
        if (!any_unknown) continue;
      }
      index[0] = box.lower[0] + i;
      if (is_frontier(index)) frontier.push_back(index);
    }
  }
  return frontier;
}

}  // namespace incognita
