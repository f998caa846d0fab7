/// Distances that matter only up to a bound: faster than the exact transform of a whole grid, and exact below the bound.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/grid.hpp"

namespace incognita {

/// What distances between cells are measured to, from the centre of one.
enum class CellShape {
  centers,  ///< the other's centre
  squares   ///< the nearest point of the other's square
};

/// Squared distances between cells of a plane, up to a bound. A template only so that who includes this and uses it not does not
/// pay for its instances.
template <int Dim>
class BasicNearDistances {
  static_assert(Dim == 2);

 public:
  using Squared = std::uint16_t;  ///< of squares of up to 2 * 90^2
  /// The largest reach: twice the square of its distance fits the type.
  static constexpr int reach_max = 90;

  /// The distance from each cell of `grid` to the nearest one for which is_source(value) holds, where that is at most `reach`
  /// steps away along each axis. Cells outside of the grid's box have its fill value, so they are sources when that is one.
  /// Throws std::invalid_argument unless reach is in 0..90. O(cells * reach), most of it a few operations for eight cells at
  /// once.
  template <class Value, class IsSource>
  BasicNearDistances(const Grid<Value, Dim>& grid, int reach, IsSource&& is_source, CellShape shape = CellShape::centers)
      : squared_(grid.lattice(), grid.box()), shape_(shape) {
    require(reach >= 0 && reach <= reach_max, "NearDistances", "reach", reach, "in 0..90");
    beyond_ = static_cast<Squared>(square_of(reach) + 1);
    if (grid.size() == 0) return;
    const IndexBox<Dim>& box = grid.box();
    const bool is_source_outside = is_source(grid.value({box.lower[0] - 1, box.lower[1]}));
    measure_columns(grid, reach, is_source_outside, is_source);
    measure_rows(reach, is_source_outside);
  }

  /// By cell, in units of unit_cells(), squared; beyond() where nothing is as near as `reach` steps along one axis.
  [[nodiscard]] const Grid<Squared, Dim>& squared() const { return squared_; }
  [[nodiscard]] Squared beyond() const { return beyond_; }  ///< more than any distance that is measured

  /// The sides of squares lie between the centres of cells: distances to them are counted in halves of a cell.
  [[nodiscard]] double unit_cells() const { return shape_ == CellShape::centers ? 1.0 : 0.5; }

 private:
  /// The distance to a cell so many steps along one axis, squared.
  [[nodiscard]] int square_of(int steps) const {
    const int units = shape_ == CellShape::centers ? steps : std::max(0, 2 * steps - 1);
    return units * units;
  }

  /// Steps up and down to the nearest source, at most reach + 1, squared.
  template <class Value, class IsSource>
  void measure_columns(const Grid<Value, Dim>& grid, int reach, bool is_source_outside, IsSource&& is_source) {
    const Offset width = grid.stride(1);
    const Offset size = static_cast<Offset>(grid.size());
    const auto far = static_cast<Squared>(reach + 1);
    const Squared outside = is_source_outside ? Squared{0} : far;
    Squared* const steps = squared_.values().data();
    for (Offset i = 0; i < size; ++i) steps[i] = is_source(grid[i]) ? Squared{0} : far;
    const auto pass_on = [&](Squared* row, const Squared* before) {
      for (Offset i = 0; i < width; ++i) row[i] = std::min(row[i], static_cast<Squared>(before[i] + 1));
    };
    const std::vector<Squared> edge(static_cast<std::size_t>(width), outside);
    pass_on(steps, edge.data());
    for (Offset row = width; row < size; row += width) pass_on(steps + row, steps + row - width);
    pass_on(steps + size - width, edge.data());
    for (Offset row = size - 2 * width; row >= 0; row -= width) pass_on(steps + row, steps + row + width);
    for (Offset i = 0; i < size; ++i) steps[i] = steps[i] == far ? beyond_ : static_cast<Squared>(square_of(steps[i]));
  }

  /// The smallest square of the steps along a row plus that of those up and down from there.
  void measure_rows(int reach, bool is_source_outside) {
    const Offset width = squared_.stride(1);
    const Offset size = static_cast<Offset>(squared_.size());
    const auto margin = static_cast<std::size_t>(reach);
    std::vector<Squared> padded(static_cast<std::size_t>(width) + 2 * margin, is_source_outside ? Squared{0} : beyond_);
    for (Offset first = 0; first < size; first += width) {
      Squared* const row = squared_.values().data() + first;
      const bool is_near = std::any_of(row, row + width, [this](Squared square) { return square != beyond_; });
      if (!is_near && !is_source_outside) continue;
      std::copy_n(row, width, padded.data() + margin);
      for (int step = 1; step <= reach; ++step) {
        const auto square = static_cast<Squared>(square_of(step));
        const Squared* const left = padded.data() + margin - step;
        const Squared* const right = padded.data() + margin + step;
        for (Offset i = 0; i < width; ++i) {
          row[i] = std::min(row[i], static_cast<Squared>(std::min(left[i], right[i]) + square));
        }
      }
      for (Offset i = 0; i < width; ++i) row[i] = std::min(row[i], beyond_);
    }
  }

  Grid<Squared, Dim> squared_;
  CellShape shape_;
  Squared beyond_ = 1;
};

/// Those of a plane.
using NearDistances = BasicNearDistances<2>;

/// The same in metres, and distance_max_m where nothing is nearer: min(distance_max_m, distance), exact up to the rounding of a
/// float. Throws std::invalid_argument unless distance_max_m is finite, > 0 and at most 90 cells.
template <class Value, int Dim, class IsSource>
[[nodiscard]] Grid<float, Dim> near_distance_m(const Grid<Value, Dim>& grid, double distance_max_m, IsSource&& is_source) {
  require_positive("near_distance_m", "distance_max_m", distance_max_m);
  const double reach = std::ceil(distance_max_m / grid.resolution_m());
  require(reach <= BasicNearDistances<Dim>::reach_max, "near_distance_m", "distance_max_m in cells", reach, "<= 90");
  const BasicNearDistances<Dim> near(grid, static_cast<int>(reach), is_source);
  std::vector<float> metres(static_cast<std::size_t>(near.beyond()) + 1);
  for (std::size_t square = 0; square < metres.size(); ++square) {
    const double distance_m = std::sqrt(static_cast<double>(square)) * grid.resolution_m();
    metres[square] = static_cast<float>(std::min(distance_max_m, distance_m));
  }
  metres.back() = static_cast<float>(distance_max_m);
  Grid<float, Dim> result(grid.lattice(), grid.box(), static_cast<float>(distance_max_m));
  for (Offset i = 0; i < static_cast<Offset>(result.size()); ++i) {
    result[i] = metres[static_cast<std::size_t>(near.squared()[i])];
  }
  return result;
}

}  // namespace incognita
