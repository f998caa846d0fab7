/// Sub-cell statistics of surfaces: what registration needs and an occupancy belief cannot give.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/principal_axes.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// The end points that one side of a surface left in one cell, as a running Gaussian.
template <int Dim>
struct Surface {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;  ///< in m^2, in the axes of the map's frame

  int count = 0;                           ///< end points so far
  int piece = 0;                           ///< the piece of the map that it was first seen with, see MapDrift
  Point<Dim> mean_m = zero<Point<Dim>>();  ///< of the end points, in the map's frame
  Matrix scatter_m2 = zero<Matrix>();      ///< the sum of outer products of deviations from the mean
  Point<Dim> view = zero<Point<Dim>>();    ///< the mean direction of the beams that ended here
  Point<Dim> normal = zero<Point<Dim>>();  ///< unit, against the view; valid when planar
  bool planar = false;                     ///< whether the end points lie on a line (plane)

  /// An end point, and the unit direction of its beam, in the map's frame. The normal is not renewed.
  void add(const Point<Dim>& point_m, const Point<Dim>& direction) {
    ++count;
    const Point<Dim> deviation = point_m - mean_m;
    mean_m += deviation / count;
    scatter_m2.noalias() += deviation * (point_m - mean_m).transpose();
    view += (direction - view) / count;
  }

  /// True when a beam of this direction looks at the side that this surface shows. Beams along a wall from its left
  /// and from its right differ by nearly pi and still see one side, so the normal decides where there is one.
  [[nodiscard]] bool faces(const Point<Dim>& direction) const {
    return planar ? dot(normal, direction) < 0.0 : dot(view, direction) > 0.0;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(count, piece, mean_m, scatter_m2, view, normal, planar);
  }
};

/// Surfaces on a lattice of their own, apart from the belief's, kept only where beams ended. At most `sides_max` of
/// them a cell, each frozen after count_max points: what was measured first, with the least drift, stays.
/// Reading is safe from many threads; adding is not.
template <int Dim = 2>
class SurfaceMap {
 public:
  /// Which end points make one surface, and which surfaces are walls.
  struct Params {
    double cell_m = 0.1;               ///< no larger than the jambs of doors: along a corridor they alone are seen
    int count_max = 50;                ///< a surface is frozen at this many points
    double pool_radius_m = 0.2;        ///< a normal pools the surfaces of the neighbourhood this near ...
    double pool_offset_m = 0.06;       ///< ... and this near to their common line (plane)
    int planar_count_min = 4;          ///< planar: end points in the pool, >= 2
    double flatness = 0.03;            ///< planar: smallest eigenvalue <= this ratio * next + roughness_m2
    double roughness_m2 = 4e-5;        ///< allows for the noise of ranges
    double spread_min_m = 0.02;        ///< planar: sqrt of the next eigenvalue at least this

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields(
          "cell_m, count_max, pool_radius_m, pool_offset_m, planar_count_min, flatness, roughness_m2, spread_min_m",
          cell_m, count_max, pool_radius_m, pool_offset_m, planar_count_min, flatness, roughness_m2, spread_min_m);
    }
  };
  static constexpr int sides_max = 3;  ///< a cell, as a wall may be seen from both

  /// Throws std::invalid_argument for values that are not finite and positive.
  explicit SurfaceMap(const Params& params = {}) : params_(params), slots_(Lattice<Dim>(params.cell_m), {}, -1) {
    require(params.count_max >= 1, "SurfaceMap", "count_max", params.count_max, ">= 1");
    require_positive("SurfaceMap", "pool_radius_m", params.pool_radius_m);
    require_positive("SurfaceMap", "pool_offset_m", params.pool_offset_m);
    require(params.planar_count_min >= 2, "SurfaceMap", "planar_count_min", params.planar_count_min, ">= 2");
    require_non_negative("SurfaceMap", "flatness", params.flatness);
    require_non_negative("SurfaceMap", "roughness_m2", params.roughness_m2);
    require_positive("SurfaceMap", "spread_min_m", params.spread_min_m);
  }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given

  /// The number of surfaces held.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Makes room for points in `box_m`, so that add() there does not move storage.
  void reserve(const Box<Point<Dim>>& box_m) { slots_.grow_to_include(slots_.lattice().cells_of(box_m)); }

  /// Adds the end point of a beam of the given unit direction. The point must be finite and within the lattice's
  /// reach. A surface keeps the `piece` it was first seen with, and all its points are moved back by shift_m(its piece,
  /// point). Normals are brought up to date by refresh_normals.
  template <class Shift>
  void add(const Point<Dim>& point_m, const Point<Dim>& direction, int piece, Shift&& shift_m) {
    const Index<Dim> index = slots_.lattice().index_of(point_m);
    Cell& cell = cell_at(index);
    Surface<Dim>* surface = side_of(cell, direction);
    if (surface == nullptr || surface->count >= params_.count_max) return;
    if (surface->count == 0) {
      ++size_;
      surface->piece = piece;
    }
    surface->add(difference(point_m, Point<Dim>(shift_m(surface->piece, point_m))), direction);
    changed_.push_back({index, static_cast<int>(surface - cell.sides.data())});
  }

  /// The same of a map that does not drift: all surfaces belong to piece 0.
  void add(const Point<Dim>& point_m, const Point<Dim>& direction) {
    add(point_m, direction, 0, [](int /*piece*/, const Point<Dim>& /*at*/) { return zero<Point<Dim>>(); });
  }

  /// Moves every surface by shift_m(its piece, its mean), into the cell where it then lies, and recomputes all normals. A
  /// surface that finds no side free in that cell is left out. Shifts must be small against the distance to the lattice's
  /// reach, and turn no surface noticeably. O(surfaces).
  template <class Shift>
  void rearrange(Shift&& shift_m) {
    SurfaceMap moved(params_);
    moved.slots_.grow_to_include(slots_.box());
    for (const Cell& cell : cells_) {
      for (Surface<Dim> surface : cell.sides) {
        if (surface.count == 0) break;
        surface.mean_m = sum(surface.mean_m, Point<Dim>(shift_m(surface.piece, surface.mean_m)));
        moved.place(surface);
      }
    }
    moved.refresh_normals();
    *this = std::move(moved);
  }

  /// Recomputes the normals of the surfaces that grew since the last call.
  void refresh_normals() {
    for (const Changed& changed : changed_) {
      Cell& cell = cells_[static_cast<std::size_t>(slots_.value(changed.index))];
      Surface<Dim>& surface = cell.sides[static_cast<std::size_t>(changed.side)];
      if (surface.count == cell.refreshed_at[static_cast<std::size_t>(changed.side)]) continue;
      cell.refreshed_at[static_cast<std::size_t>(changed.side)] = surface.count;
      refresh_normal(changed.index, surface);
    }
    changed_.clear();
  }

  /// Calls visit(surface) for each surface in the cell that holds the point and in all its neighbours.
  template <class Visit>
  void for_each_near(const Point<Dim>& point_m, Visit&& visit) const {
    for_each_around(slots_.lattice().index_of(point_m), visit);
  }

  /// Calls visit(surface) for each surface in the cells that a box touches (upper face included), x fastest. The box
  /// must be within the lattice's reach.
  template <class Visit>
  void for_each_in(const Box<Point<Dim>>& box_m, Visit&& visit) const {
    IndexBox<Dim> cells = slots_.lattice().cells_of(box_m);
    for (int axis = 0; axis < Dim; ++axis) {
      cells.lower[axis] = std::max(cells.lower[axis], slots_.box().lower[axis]);
      cells.upper[axis] = std::min(cells.upper[axis], slots_.box().upper[axis]);
    }
    if (cells.empty()) return;
    Index<Dim> index = cells.lower;
    while (index[Dim - 1] < cells.upper[Dim - 1]) {
      if (const std::int32_t slot = slots_[slots_.offset_of(index)]; slot >= 0) {
        for (const Surface<Dim>& surface : cells_[static_cast<std::size_t>(slot)].sides) {
          if (surface.count == 0) break;
          visit(surface);
        }
      }
      for (int axis = 0; axis < Dim && ++index[axis] == cells.upper[axis] && axis + 1 < Dim; ++axis) {
        index[axis] = cells.lower[axis];
      }
    }
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. Surfaces must be of one of `pieces` pieces of the map.
  template <class Archive>
  void archive_state(Archive& archive, std::size_t pieces = 1) {
    archive.check("surfaces", params_);
    archive_box(archive, slots_);
    std::vector<Index<Dim>> places(cells_.size());
    for (Offset at = 0; at < static_cast<Offset>(slots_.size()); ++at) {
      if (slots_[at] >= 0) places[static_cast<std::size_t>(slots_[at])] = slots_.index_at(at);
    }
    archive(places, cells_, changed_);
    if constexpr (Archive::is_loading) {
      archive.require(places.size() == cells_.size(), "there are not as many surfaces as places of them");
      size_ = 0;
      for (std::size_t slot = 0; slot < cells_.size(); ++slot) {
        archive.require(slots_.contains(places[slot]) && slots_.value(places[slot]) < 0, "a surface has no place of its own");
        slots_.set(places[slot], static_cast<std::int32_t>(slot));
        for (const Surface<Dim>& surface : cells_[slot].sides) {
          if (surface.count == 0) break;
          ++size_;
          archive.require(surface.count > 0 && surface.piece >= 0 && static_cast<std::size_t>(surface.piece) < pieces,
                          "a surface is of no piece of the map");
        }
      }
      for (const Changed& changed : changed_) {
        archive.require(slots_.value(changed.index) >= 0 && changed.side >= 0 && changed.side < sides_max, "a surface that grew is not there");
      }
    }
  }

 private:
  struct Cell {
    std::array<Surface<Dim>, sides_max> sides;
    std::array<int, sides_max> refreshed_at{};

    template <class Archive>
    void archive_state(Archive& archive) {
      int used = 0;
      while (used < sides_max && sides[static_cast<std::size_t>(used)].count != 0) ++used;
      archive(used);
      archive.require(used >= 0 && used <= sides_max, "a cell has too many surfaces");
      for (int side = 0; side < used; ++side) {
        archive(sides[static_cast<std::size_t>(side)], refreshed_at[static_cast<std::size_t>(side)]);
      }
    }
  };
  struct Changed {
    Index<Dim> index;
    int side;

    template <class Archive>
    void archive_state(Archive& archive) {
      archive(index, side);
    }
  };

  /// The cell, made if it is not there.
  [[nodiscard]] Cell& cell_at(const Index<Dim>& index) {
    if (!slots_.contains(index)) slots_.grow_to_include(box_of_cell<Dim>(index));
    std::int32_t& slot = slots_[slots_.offset_of(index)];
    if (slot < 0) {
      slot = static_cast<std::int32_t>(cells_.size());
      cells_.emplace_back();
    }
    return cells_[static_cast<std::size_t>(slot)];
  }

  void place(const Surface<Dim>& surface) {
    const Index<Dim> index = slots_.lattice().index_of(surface.mean_m);
    Cell& cell = cell_at(index);
    for (int side = 0; side < sides_max; ++side) {
      if (cell.sides[static_cast<std::size_t>(side)].count > 0) continue;
      cell.sides[static_cast<std::size_t>(side)] = surface;
      changed_.push_back({index, side});
      ++size_;
      return;
    }
  }

  template <class Visit>
  void for_each_around(const Index<Dim>& center, Visit&& visit) const {
    constexpr int neighbours = Dim == 2 ? 9 : 27;
    for (int n = 0; n < neighbours; ++n) {
      Index<Dim> index = center;
      for (int axis = 0, rest = n; axis < Dim; ++axis, rest /= 3) index[axis] += rest % 3 - 1;
      const std::int32_t slot = slots_.value(index);
      if (slot < 0) continue;
      for (const Surface<Dim>& surface : cells_[static_cast<std::size_t>(slot)].sides) {
        if (surface.count == 0) break;
        visit(surface);
      }
    }
  }

  /// The side a beam belongs to, or a free one; null when the cell has no room for another side.
  [[nodiscard]] static Surface<Dim>* side_of(Cell& cell, const Point<Dim>& direction) {
    for (Surface<Dim>& surface : cell.sides) {
      if (surface.count == 0 || surface.faces(direction)) return &surface;
    }
    return nullptr;
  }

  struct Pool {
    double count = 0.0;
    Point<Dim> sum = zero<Point<Dim>>();
    typename Surface<Dim>::Matrix moment = zero<typename Surface<Dim>::Matrix>();  // about the origin of the pool

    void add(const Surface<Dim>& surface, const Point<Dim>& origin) {
      const Point<Dim> mean = surface.mean_m - origin;
      count += surface.count;
      sum += surface.count * mean;
      moment += surface.scatter_m2 + surface.count * mean * mean.transpose();
    }
  };

  struct Fit {
    Point<Dim> mean;
    Point<Dim> normal;
    double thickness_m2;
    double spread_m2;
  };

  [[nodiscard]] static Fit fit(const Pool& pool) {
    const Point<Dim> mean = pool.sum / pool.count;
    const typename Surface<Dim>::Matrix covariance = pool.moment / pool.count - mean * mean.transpose();
    const PrincipalAxes<Dim> principal = principal_axes<Dim>(covariance);
    return {mean, principal.axes.col(0), std::max(0.0, principal.values[0]), principal.values[1]};
  }

  void refresh_normal(const Index<Dim>& index, Surface<Dim>& surface) {
    const Point<Dim> origin = surface.mean_m;
    const auto belongs = [&](const Surface<Dim>& other) {
      return surface.view.dot(other.view) > 0.0 && (other.mean_m - origin).norm() <= params_.pool_radius_m;
    };
    Pool all;
    for_each_around(index, [&](const Surface<Dim>& other) {
      if (belongs(other)) all.add(other, origin);
    });
    const Fit rough = fit(all);
    Pool near;
    for_each_around(index, [&](const Surface<Dim>& other) {
      const double offset_m = rough.normal.dot(other.mean_m - origin - rough.mean);
      if (belongs(other) && std::abs(offset_m) <= params_.pool_offset_m) near.add(other, origin);
    });
    if (near.count < params_.planar_count_min) {
      surface.planar = false;
      return;
    }
    const Fit fine = fit(near);
    surface.planar = fine.thickness_m2 <= params_.flatness * fine.spread_m2 + params_.roughness_m2 &&
                     fine.spread_m2 >= params_.spread_min_m * params_.spread_min_m;
    surface.normal = fine.normal.dot(surface.view) > 0.0 ? Point<Dim>(-fine.normal) : fine.normal;
  }

  Params params_;
  Grid<std::int32_t, Dim> slots_;
  std::vector<Cell> cells_;
  std::vector<Changed> changed_;
  std::size_t size_ = 0;
};

}  // namespace incognita
