/// Clearance around a robot alone, for controllers that look no further than a few metres.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/core/floor.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// How far the cells around a place are from obstacles. What it costs depends on the reach, not on the map. A template only so that who
/// includes this and uses it not does not pay for its instances.
template <int Dim>
class BasicClearanceWindow {
  static_assert(Dim == 2);

 public:
  /// On a map's lattice.
  explicit BasicClearanceWindow(const Lattice<Dim>& lattice)
      : obstacles_(lattice), clearance_m_(lattice, {}, std::numeric_limits<float>::infinity()) {}

  /// The distance in metres from the centre of each cell up to reach_m from a place, along both axes, to the centre of the nearest of them
  /// for which is_obstacle(index) holds; infinity where there is none, and outside. Valid until the next call. Throws
  /// std::invalid_argument unless reach_m is finite and >= 0 and the place, in the lattice's frame, within 2^30 cells of its origin.
  /// O(cells).
  template <class IsObstacle>
  const Grid<float, Dim>& measure(const Eigen::Vector2d& center_m, double reach_m, IsObstacle&& is_obstacle) {
    require_non_negative("ClearanceWindow", "reach_m", reach_m);
    const Lattice<Dim>& lattice = obstacles_.lattice();
    const Box<Eigen::Vector2d> around{center_m, center_m};
    const Box<Eigen::Vector2d> reached = around.padded(reach_m);
    for (const Eigen::Vector2d& corner_m : {reached.lower, reached.upper}) {
      const Eigen::Vector2d at = lattice.to_cells(corner_m);
      for (int axis = 0; axis < Dim; ++axis) {
        require(at[axis] > -0x1p30 && at[axis] < 0x1p30, "ClearanceWindow", "a coordinate in cells", at[axis], "within 2^30 of the origin");
      }
    }
    obstacles_.clear_to(lattice.cells_of(reached));
    const IndexBox<Dim> cells = obstacles_.box();
    Offset cell = 0;
    for (int y = cells.lower[1]; y < cells.upper[1]; ++y) {
      for (int x = cells.lower[0]; x < cells.upper[0]; ++x) obstacles_[cell++] = is_obstacle(Index<Dim>(x, y)) ? 1 : 0;
    }
    distance_transform_m(obstacles_, [](unsigned char is_one) { return is_one != 0; }, clearance_m_);
    return clearance_m_;
  }

  /// Lowers it to the distance in metres from the centre of each cell to the nearest of some points, where that is less than
  /// distance_max_m: to what a scan shows just now, which is known to a centimetre, while an occupied cell's centre lies up to a cell behind
  /// the surface. The points are in the lattice's frame, as near_hits_m has them; those that are not finite or far outside of the window say
  /// nothing. Returns what measure() returned. Throws std::invalid_argument unless distance_max_m is finite and >= 0.
  /// O(points * cells within distance_max_m).
  const Grid<float, Dim>& lower_to(const std::vector<Eigen::Vector2d>& points_m, double distance_max_m) {
    require_non_negative("ClearanceWindow", "distance_max_m", distance_max_m);
    const Lattice<Dim>& lattice = clearance_m_.lattice();
    const IndexBox<Dim>& window = clearance_m_.box();
    const double reach_cells = distance_max_m / lattice.resolution_m();
    for (const Eigen::Vector2d& point_m : points_m) {
      // Of cells whose centres lie within reach, in lattice coordinates.
      const Eigen::Vector2d at = lattice.to_cells(point_m);
      IndexBox<Dim> cells = window;
      for (int axis = 0; axis < Dim; ++axis) {
        const double lower = std::max(at[axis] - reach_cells, static_cast<double>(window.lower[axis]));
        const double upper = std::min(at[axis] + reach_cells + 1.0, static_cast<double>(window.upper[axis]));
        cells.lower[axis] = lower < upper ? floor_to_int(lower) : 0;
        cells.upper[axis] = lower < upper ? floor_to_int(upper) : 0;
      }
      for (int y = cells.lower[1]; y < cells.upper[1]; ++y) {
        const double up_m = lattice.center_m({cells.lower[0], y})[1] - point_m[1];
        Offset cell = clearance_m_.offset_of({cells.lower[0], y});
        for (int x = cells.lower[0]; x < cells.upper[0]; ++x, ++cell) {
          const double right_m = (x + 0.5 - at[0]) * lattice.resolution_m();
          const double squared_m2 = right_m * right_m + up_m * up_m;
          if (squared_m2 < distance_max_m * distance_max_m) clearance_m_[cell] = std::min(clearance_m_[cell], static_cast<float>(std::sqrt(squared_m2)));
        }
      }
    }
    return clearance_m_;
  }

 private:
  Grid<unsigned char, Dim> obstacles_;
  Grid<float, Dim> clearance_m_;
};

/// Of a map of the plane.
using ClearanceWindow = BasicClearanceWindow<2>;

}  // namespace incognita
