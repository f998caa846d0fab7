/// The floor that a robot can get to see from where it starts. `Obstacles` is an ObstacleField or a World;
/// templates, so that who does not call them does not compile them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/sensor/field_of_view.hpp"
#include "incognita/sensor/obstacle_field.hpp"

namespace incognita {

/// The cells on whose centre a disc can stand after driving there from `start_m`: those on whose centre it is
/// clear, joined by their faces, from the nearest to the start (of 3 x 3 cells) that it reaches in a straight
/// line. 1 for them, 0 elsewhere. Throws std::invalid_argument for a negative radius, when the disc is not
/// clear at the start, or when it can reach no centre from there. O(cells).
template <class Obstacles>
[[nodiscard]] Grid<std::uint8_t, 2> reachable_positions(const Obstacles& obstacles, const Point<2>& start_m,
                                                        double radius_m) {
  require_non_negative("reachable_positions", "radius_m", radius_m);
  require(obstacles.disc_is_clear(start_m, radius_m), "reachable_positions",
          "the clearance in m at the start", obstacles.clearance_m(start_m),
          "at least the radius of the disc");

  const Index<2> middle = obstacles.lattice().index_of(start_m);
  double nearest_m = std::numeric_limits<double>::infinity();
  Index<2> nearest;
  for (int i = 0; i < 9; ++i) {
    const Index<2> cell(middle[0] + i % 3 - 1, middle[1] + i / 3 - 1);
    const Point<2> center_m = obstacles.lattice().center_m(cell);
    const Point<2> way_m = difference(center_m, start_m);
    const double length_m = norm(way_m);
    const auto position_at = [&](double s_m) -> Point<2> {
      return s_m < length_m ? sum(start_m, scaled(way_m, s_m / length_m)) : center_m;
    };
    if (length_m >= nearest_m || !obstacles.disc_is_clear(position_at(length_m), radius_m)) continue;
    if (clear_length_m(obstacles, radius_m, length_m, position_at) < length_m) continue;
    nearest_m = length_m;
    nearest = cell;
  }
  if (!std::isfinite(nearest_m)) {
    throw_invalid("reachable_positions", "the start", tuple_text(start_m),
                  "where a disc of " + std::to_string(radius_m) + " m can reach the centre of a cell");
  }
  return flood_fill(disc_positions(obstacles, radius_m), nearest, Adjacency::faces,
                    [](std::uint8_t is_clear) { return is_clear != 0; });
}

namespace detail {

enum class FloorView : std::uint8_t {
  blocked,
  hidden,   ///< not seen, or not yet
  seen,     ///< from a position, but none itself
  position  ///< where the disc can stand
};

/// Boxes of cells, for each hidden region those that all light into it passes.
template <int Dim>
using Portals = std::vector<std::vector<IndexBox<Dim>>>;

/// Light enters a region of hidden cells only through the cells around it that are not hidden: these, put
/// together in square tiles. Regions are joined by corners, as lines of sight pass from cell to cell.
template <class View, int Dim>
[[nodiscard]] Portals<Dim> portals_of(const Grid<View, Dim>& cells, const Components<Dim>& hidden) {
  constexpr int tile_cells = 16;
  const std::vector<Index<Dim>> steps = neighbor_steps<Dim>(Adjacency::corners);
  std::vector<std::map<std::array<int, static_cast<std::size_t>(Dim)>, IndexBox<Dim>>> tiles(hidden.sizes.size());
  for (Offset cell = 0; cell < static_cast<Offset>(cells.size()); ++cell) {
    if (cells[cell] != View::hidden) continue;
    for (const Index<Dim>& step : steps) {
      const Index<Dim> beside = sum(cells.index_at(cell), step);
      const View view = cells.value(beside);
      if (view != View::seen && view != View::position) continue;
      std::array<int, static_cast<std::size_t>(Dim)> tile;
      for (int axis = 0; axis < Dim; ++axis) {
        tile[static_cast<std::size_t>(axis)] = (beside[axis] - cells.box().lower[axis]) / tile_cells;
      }
      IndexBox<Dim>& box = tiles[static_cast<std::size_t>(hidden.labels[cell])][tile];
      box = enclosing_box(box, box_of_cell<Dim>(beside));
    }
  }
  Portals<Dim> portals(tiles.size());
  for (std::size_t region = 0; region < tiles.size(); ++region) {
    for (const auto& [tile, box] : tiles[region]) portals[region].push_back(box);
  }
  return portals;
}

}  // namespace detail

/// The floor that can be seen on a drive from `start_m`: the cells whose centre lies within range_max_m and
/// in sight (FieldOfView) of the centre of a cell that a disc can reach (reachable_positions). 1 for them, 0
/// elsewhere. Throws as reachable_positions does, and for a range that is not finite and >= 0. O(cells), and
/// for each cell that no near position sees a walk towards every gap by which light enters its region.
template <class Obstacles>
[[nodiscard]] Grid<std::uint8_t, 2> visible_floor(const Obstacles& obstacles, const Point<2>& start_m,
                                                  double radius_m, double range_max_m) {
  require_non_negative("visible_floor", "range_max_m", range_max_m);
  using detail::FloorView;
  Grid<std::uint8_t, 2> visible = reachable_positions(obstacles, start_m, radius_m);
  Grid<FloorView, 2> cells(visible.lattice(), visible.box(), FloorView::blocked);
  for (Offset cell = 0; cell < static_cast<Offset>(cells.size()); ++cell) {
    if (visible[cell] != 0) {
      cells[cell] = FloorView::position;
    } else if (!obstacles.is_blocked(cells.index_at(cell))) {
      cells[cell] = FloorView::hidden;
    }
  }

  // Sight is symmetric: look from the floor for a position. Most floor beyond the positions lies along walls
  // and sees one near by; where the disc has room but never comes, none is that near.
  FieldOfView view;
  const auto blocks = [](FloorView cell) { return cell == FloorView::blocked; };
  const double near_m = std::min(2.0 * (radius_m + obstacles.resolution_m()), range_max_m);
  for (Offset cell = 0; cell < static_cast<Offset>(cells.size()); ++cell) {
    const Index<2> index = cells.index_at(cell);
    if (cells[cell] != FloorView::hidden) continue;
    if (obstacles.disc_is_clear(cells.lattice().center_m(index), radius_m)) continue;
    view.visit_visible(cells, index, near_m, blocks, [&](const Index<2>& other) {
      if (cells.value(other) != FloorView::position) return true;
      cells[cell] = FloorView::seen;
      return false;
    });
  }

  // The rest sees a position only through a portal of its region.
  const Components<2> hidden = connected_components(cells, Adjacency::corners,
                                                    [](FloorView cell) { return cell == FloorView::hidden; });
  const detail::Portals<2> portals = detail::portals_of(cells, hidden);
  const double range_cells = range_max_m / obstacles.resolution_m();
  for (Offset cell = 0; cell < static_cast<Offset>(cells.size()); ++cell) {
    visible[cell] = cells[cell] == FloorView::seen || cells[cell] == FloorView::position ? 1 : 0;
    if (cells[cell] != FloorView::hidden) continue;
    const Index<2> index = cells.index_at(cell);
    for (const IndexBox<2>& portal : portals[static_cast<std::size_t>(hidden.labels[cell])]) {
      const auto gap = [&](int axis) {
        return static_cast<double>(std::clamp(index[axis], portal.lower[axis], portal.upper[axis] - 1) - index[axis]);
      };
      if (norm(Point<2>(gap(0), gap(1))) > range_cells + 1.0) continue;
      view.visit_visible_toward(cells, index, portal, range_max_m, blocks, [&](const Index<2>& other) {
        if (cells.value(other) != FloorView::position) return true;
        visible[cell] = 1;
        return false;
      });
      if (visible[cell] != 0) break;
    }
  }
  return visible;
}

}  // namespace incognita
