/// Where the cells of a grid lie in the world, in two and three dimensions.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/core/floor.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// Coordinates in metres.
template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

/// The integer coordinates of a cell; any sign.
template <int Dim>
using Index = Eigen::Matrix<int, Dim, 1>;

/// Whether a cell comes before another where grids store them: x fastest, the last axis slowest.
template <int Dim>
[[nodiscard]] bool is_stored_before(const Index<Dim>& a, const Index<Dim>& b) {
  int axis = Dim - 1;
  while (axis > 0 && a[axis] == b[axis]) --axis;
  return a[axis] < b[axis];
}

/// The cell that holds a point given in lattice coordinates, within 2^31 cells of the origin.
template <int Dim>
[[nodiscard]] Index<Dim> cell_holding(const Point<Dim>& at) {
  Index<Dim> index;
  for (int axis = 0; axis < Dim; ++axis) index[axis] = floor_to_int(at[axis]);
  return index;
}

/// A box of cells, half open.
template <int Dim>
using IndexBox = Box<Index<Dim>>;

/// The box that holds one cell.
template <int Dim>
[[nodiscard]] IndexBox<Dim> box_of_cell(const Index<Dim>& index) {
  IndexBox<Dim> box{index, index};
  for (int axis = 0; axis < Dim; ++axis) ++box.upper[axis];
  return box;
}

/// An endless lattice of square (cubic) cells: cell i covers [origin + i res, origin + (i + 1) res) on each axis.
template <int Dim>
class Lattice {
 public:
  static constexpr int dimension = Dim;  ///< 2 or 3

  /// Throws std::invalid_argument unless resolution_m is finite and > 0 and the origin is finite.
  explicit Lattice(double resolution_m, const Point<Dim>& origin_m = zero<Point<Dim>>())
      : resolution_m_(resolution_m), per_m_(1.0 / resolution_m), origin_m_(origin_m) {
    require_positive("Lattice", "resolution_m", resolution_m);
    for (int axis = 0; axis < Dim; ++axis) {
      require(std::isfinite(origin_m[axis]), "Lattice", "origin_m", origin_m[axis], "finite");
    }
  }

  [[nodiscard]] double resolution_m() const { return resolution_m_; }  ///< the side of a cell
  [[nodiscard]] const Point<Dim>& origin_m() const { return origin_m_; }  ///< the lower corner of cell 0

  /// Lattice coordinates: cell i covers [i, i + 1).
  [[nodiscard]] Point<Dim> to_cells(const Point<Dim>& point_m) const {
    return scaled(difference(point_m, origin_m_), per_m_);
  }

  /// The cell that holds a point. The point must lie within 2^31 cells of the origin.
  [[nodiscard]] Index<Dim> index_of(const Point<Dim>& point_m) const {
    return cell_holding<Dim>(to_cells(point_m));
  }

  /// The centre of a cell, in the lattice's frame.
  [[nodiscard]] Point<Dim> center_m(const Index<Dim>& index) const {
    Point<Dim> center;
    for (int axis = 0; axis < Dim; ++axis) center[axis] = origin_m_[axis] + (index[axis] + 0.5) * resolution_m_;
    return center;
  }

  /// The smallest box of cells that holds a box of points (upper face included).
  [[nodiscard]] IndexBox<Dim> cells_of(const Box<Point<Dim>>& box_m) const {
    IndexBox<Dim> cells{index_of(box_m.lower), index_of(box_m.upper)};
    for (int axis = 0; axis < Dim; ++axis) ++cells.upper[axis];
    return cells;
  }

 private:
  double resolution_m_;
  double per_m_;
  Point<Dim> origin_m_;
};

}  // namespace incognita
