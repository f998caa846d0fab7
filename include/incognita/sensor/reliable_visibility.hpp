/// What is seen from a place, and from all places near to it: visibility that survives a small error of the pose.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "incognita/core/error.hpp"
#include "incognita/geometry/disc_hull.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/sensor/field_of_view.hpp"

namespace incognita {

/// One bit a cell: what is known to be free.
template <int Dim>
[[nodiscard]] BasicCellBits<Dim> free_cells(const OccupancyGrid<Dim>& occupancy) {
  BasicCellBits<Dim> bits(occupancy.lattice(), false);
  const IndexBox<Dim>& box = occupancy.box();
  bits.grow_to_include(box);
  for_each_tile_of(box, [&](const Index<2>& tile) {
    CellBits::Word free = 0;
    for (CellBits::Word left = cells_of_tile(tile, box); left != 0; left &= left - 1U) {
      const int bit = std::countr_zero(left);
      const bool is_free = occupancy[occupancy.offset_of(CellBits::cell_of(tile, bit))] == Occupancy::free;
      free |= static_cast<CellBits::Word>(is_free) << bit;
    }
    bits.tiles()[bits.tiles().offset_of(tile)] = free;
  });
  return bits;
}

/// How far a robot sees and how surely.
struct VisibilityParams {
  /// r_max, > tolerance_m. A frontier's unknown neighbour lies a cell further than the frontier: plan with a cell's diagonal less than
  /// the sensor's range, or a frontier at its very end may never clear.
  double range_max_m = 10.0;
  double tolerance_m = 0.1;   ///< eta: from all places this near to where the robot should stand; > 0

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("VisibilityParams", "tolerance_m", tolerance_m);
    require(std::isfinite(range_max_m) && range_max_m > tolerance_m, "VisibilityParams", "range_max_m", range_max_m,
            "finite and > tolerance_m");
  }
};

/// Whether a cell's centre is reliably seen from another's, as (20) and (22) of Isleyen et al. ask: from every point within
/// tolerance_m of it, within range_max_m and through free cells alone. On the lattice: the two are at most
/// range_max_m - tolerance_m apart, and the convex hull of the one and of the disc around the other overlaps no cell that is
/// not free. A view of a belief and its bits, which must outlive it. Safe to use from many threads.
class ReliableVisibility {
 public:
  /// `free`: the free cells of `occupancy`, see free_cells, or OccupancyLayer::free. Throws std::invalid_argument for parameters
  /// outside of their bounds.
  ReliableVisibility(const OccupancyGrid<2>& occupancy, const CellBits& free, const VisibilityParams& params)
      : occupancy_(&occupancy), free_(&free) {
    params.validate();
    tolerance_ = params.tolerance_m / occupancy.resolution_m();
    range_ = (params.range_max_m - params.tolerance_m) / occupancy.resolution_m();
  }

  ReliableVisibility(const OccupancyGrid<2>&, CellBits&&, const VisibilityParams&) = delete;  ///< the bits must outlive it

  [[nodiscard]] const OccupancyGrid<2>& occupancy() const { return *occupancy_; }  ///< by which it sees

  /// How far a cell may be seen, in cells.
  [[nodiscard]] double range_cells() const { return range_; }

  /// Calls visit(index) for each cell in the line of sight of `cell`, within range: all that it may be reliably seen from, and that
  /// may be from it, perhaps twice. A visit that returns bool ends everything by returning false. O(cells in sight).
  template <class Visit>
  void visit_in_sight(const Index<2>& cell, FieldOfView& scratch, Visit&& visit) const {
    const auto blocks = [](Occupancy occupancy) { return occupancy != Occupancy::free; };
    scratch.visit_visible(*occupancy_, cell, (range_ + 1e-9) * occupancy_->resolution_m(), blocks, visit);
  }

  /// O(cells between them / 8).
  [[nodiscard]] bool sees(const Index<2>& from, const Index<2>& cell) const {
    constexpr double rounding = 1e-9;  // 1.4 m of 0.1 m cells are 14
    const double dx = cell[0] - from[0];
    const double dy = cell[1] - from[1];
    if (dx * dx + dy * dy > range_ * range_ + rounding) return false;
    const Point<2> apex(cell[0] + 0.5, cell[1] + 0.5);
    const Point<2> center(from[0] + 0.5, from[1] + 0.5);
    return DiscHull(apex, center, tolerance_).for_each_row([&](int row, int first, int last) {
      return is_free(row, first, last);
    });
  }

 private:
  [[nodiscard]] bool is_free(int row, int first, int last) const {
    constexpr int in_tile = CellBits::tile_side - 1;
    const int row_shift = CellBits::tile_side * (row & in_tile);
    for (int tile = first >> CellBits::tile_shift; tile <= last >> CellBits::tile_shift; ++tile) {
      const auto free = static_cast<unsigned>(free_->tiles().value({tile, row >> CellBits::tile_shift}) >> row_shift);
      const int begin = std::max(first - tile * CellBits::tile_side, 0);
      const int end = std::min(last - tile * CellBits::tile_side, in_tile);
      if ((~free & (0xFFU << begin) & (0xFFU >> (in_tile - end))) != 0) return false;
    }
    return true;
  }

  const OccupancyGrid<2>* occupancy_;
  const CellBits* free_;
  double tolerance_;  // in cells, as is the next
  double range_;
};

}  // namespace incognita
