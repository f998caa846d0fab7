/// Where a disc-shaped body fits: the planning and control spaces of Isleyen, van de Molengraft and Arslan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/grid/near_distance.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// A set of cells: 1 for those that belong, 0 for all others.
using CellSet = Grid<std::uint8_t, 2>;

namespace detail {

/// The cells whose distance exceeds `radius_m`, or to squares, whose inner points a disc may touch but not enter, is at least
/// that.
template <int Dim>
[[nodiscard]] Grid<std::uint8_t, Dim> cells_beyond(const BasicNearDistances<Dim>& distances, double radius_m) {
  constexpr double rounding = 1e-9;  // 0.3 m of 0.1 m cells are 3
  using Squared = typename BasicNearDistances<Dim>::Squared;
  const Grid<Squared, Dim>& squared = distances.squared();
  const double units = radius_m / (squared.resolution_m() * distances.unit_cells());
  const bool is_to_centers = distances.unit_cells() == 1.0;
  const double bound = is_to_centers ? units * units + rounding : units * units - rounding;
  // The smallest square that belongs.
  const double smallest = is_to_centers ? std::floor(bound) + 1.0 : std::max(1.0, std::ceil(bound));
  const auto least = static_cast<Squared>(std::min(smallest, 65535.0));
  Grid<std::uint8_t, Dim> cells(squared.lattice(), squared.box(), 0);
  for (Offset i = 0; i < static_cast<Offset>(squared.size()); ++i) cells[i] = squared[i] >= least ? 1 : 0;
  return cells;
}

[[nodiscard]] inline int steps_to_reach(double radius_m, double resolution_m, const char* who) {
  require_non_negative(who, "radius_m", radius_m);
  const double steps = std::ceil(radius_m / resolution_m) + 1.0;
  constexpr int reach_max = NearDistances::reach_max;
  require(steps <= reach_max, who, "the radius in cells, and one more,", steps, "<= 90");
  return static_cast<int>(steps);
}

}  // namespace detail

/// erode(A, radius), (7): the cells of A, those for which is_inside(value) holds, around which a closed disc keeps to A. What
/// lies outside of the grid's box has its fill value. By CellShape::centers a disc leaves A when it holds the centre of another
/// cell; by squares, when it overlaps one. Throws std::invalid_argument unless the radius is finite, >= 0 and at most 89
/// cells. O(cells * radius in cells), vectorised.
template <class Value, class IsInside>
[[nodiscard]] CellSet erode(const Grid<Value, 2>& grid, double radius_m, IsInside&& is_inside,
                            CellShape shape = CellShape::centers) {
  const int reach = detail::steps_to_reach(radius_m, grid.resolution_m(), "erode");
  return detail::cells_beyond(BasicNearDistances<2>(grid, reach, [&](const Value& value) { return !is_inside(value); }, shape), radius_m);
}

/// A robot's body, and how far its centre keeps away from what is not known to be free.
struct BodyParams {
  double radius_m = 0.2;                    ///< rho, >= 0
  double margin_m = 0.0;                    ///< epsilon, what a path leaves to the controller; >= 0
  /// To centres, doors keep their width in a belief, and the body may overlap occupied squares by a cell's diagonal at most where the
  /// robot stands at the edge of its own cell; to squares, by half a diagonal.
  CellShape measured_to = CellShape::centers;

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_non_negative("BodyParams", "radius_m", radius_m);
    require_non_negative("BodyParams", "margin_m", margin_m);
  }
};

/// (5) and (6). plan is a subset of control, and control of the free cells.
struct SafeSpaces {
  CellSet plan;     ///< paths run here: the free cells eroded by radius + margin
  CellSet control;  ///< the robot's centre stays here: eroded by the radius
};

/// The safe spaces of a belief, in its box; cells outside of it count as unknown, so not as free. Throws std::invalid_argument
/// for bad parameters and for a body of more than 89 cells. O(cells * radius in cells), vectorised.
template <int Dim>
[[nodiscard]] SafeSpaces safe_spaces(const OccupancyGrid<Dim>& occupancy, const BodyParams& body) {
  body.validate();
  const double plan_m = body.radius_m + body.margin_m;
  const int reach = detail::steps_to_reach(plan_m, occupancy.resolution_m(), "safe_spaces");
  const BasicNearDistances<Dim> distances(occupancy, reach, [](Occupancy cell) { return cell != Occupancy::free; }, body.measured_to);
  return {detail::cells_beyond(distances, plan_m), detail::cells_beyond(distances, body.radius_m)};
}

}  // namespace incognita
