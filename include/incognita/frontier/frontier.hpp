/// Groups of frontier cells: places at which there is more to see.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "incognita/frontier/detection.hpp"
#include "incognita/geometry/principal_axes.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// Frontier cells that belong together.
template <int Dim>
struct Frontier {
  std::vector<Index<Dim>> cells;                   ///< in storage order
  Point<Dim> centroid_m = zero<Point<Dim>>();      ///< of the cells' centres; need not be free
  Index<Dim> representative = zero<Index<Dim>>();  ///< the cell whose centre is nearest to the centroid
};

namespace detail {

template <int Dim>
[[nodiscard]] Frontier<Dim> make_frontier(const Lattice<Dim>& lattice, std::vector<Index<Dim>> cells) {
  Frontier<Dim> frontier;
  for (const Index<Dim>& cell : cells) frontier.centroid_m += lattice.center_m(cell);
  frontier.centroid_m /= static_cast<double>(cells.size());
  const auto distance2 = [&](const Index<Dim>& cell) {
    return (lattice.center_m(cell) - frontier.centroid_m).squaredNorm();
  };
  frontier.representative = *std::min_element(
      cells.begin(), cells.end(), [&](const auto& a, const auto& b) { return distance2(a) < distance2(b); });
  frontier.cells = std::move(cells);
  return frontier;
}

/// Cuts cells into the fewest slabs of equal width across their principal axis that are no wider than
/// length_max_cells.
template <int Dim>
[[nodiscard]] std::vector<std::vector<Index<Dim>>> slabs_along_principal_axis(
    const std::vector<Index<Dim>>& cells, double length_max_cells) {
  Point<Dim> mean = zero<Point<Dim>>();
  for (const Index<Dim>& cell : cells) mean += cell.template cast<double>();
  mean /= static_cast<double>(cells.size());
  Eigen::Matrix<double, Dim, Dim> scatter = zero<Eigen::Matrix<double, Dim, Dim>>();
  for (const Index<Dim>& cell : cells) {
    const Point<Dim> offset = cell.template cast<double>() - mean;
    scatter += offset * offset.transpose();
  }
  Point<Dim> axis = principal_axes<Dim>(scatter).axes.col(Dim - 1);
  Eigen::Index strongest = 0;
  axis.cwiseAbs().maxCoeff(&strongest);
  if (axis[strongest] < 0.0) axis = -axis;  // an eigenvector's sign is free

  double low = 0.0;
  double high = 0.0;
  for (const Index<Dim>& cell : cells) {
    const double along = axis.dot(cell.template cast<double>() - mean);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const double length = high - low + 1.0;
  const double count = std::max(1.0, std::ceil(length / length_max_cells - 1e-9));
  std::vector<std::vector<Index<Dim>>> slabs(static_cast<std::size_t>(count));
  for (const Index<Dim>& cell : cells) {
    const double along = axis.dot(cell.template cast<double>() - mean) - low + 0.5;
    slabs[static_cast<std::size_t>(std::min(count - 1.0, along / length * count))].push_back(cell);
  }
  std::erase_if(slabs, [](const auto& slab) { return slab.empty(); });
  return slabs;
}

/// The groups of cells that touch. `cells` in storage order and each once; each group keeps their order, and
/// so do the first cells of the groups. O(n), whatever lies between the cells: for each way to a neighbour, the cells and their
/// neighbours are in the same order, so one pass over both finds those that are cells too.
template <int Dim>
[[nodiscard]] std::vector<std::vector<Index<Dim>>> touching_groups(const std::vector<Index<Dim>>& cells, Adjacency adjacency) {
  // Each cell points to an earlier one of its group, the first to itself.
  std::vector<std::size_t> earlier(cells.size());
  std::iota(earlier.begin(), earlier.end(), std::size_t{0});
  const auto first_of = [&](std::size_t cell) {
    while (earlier[cell] != cell) cell = earlier[cell] = earlier[earlier[cell]];
    return cell;
  };
  for (const Index<Dim>& step : neighbor_steps<Dim>(adjacency)) {
    if (!is_stored_before<Dim>(zero<Index<Dim>>(), step)) continue;  // the way back
    std::size_t other = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      const Index<Dim> neighbor = cells[cell] + step;
      while (other < cells.size() && is_stored_before<Dim>(cells[other], neighbor)) ++other;
      if (other == cells.size()) break;
      if (!equal(cells[other], neighbor)) continue;
      const auto [first, last] = std::minmax({first_of(cell), first_of(other)});
      earlier[last] = first;
    }
  }
  std::vector<std::vector<Index<Dim>>> groups;
  std::vector<std::size_t> group_of(cells.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::size_t first = first_of(cell);
    if (first == cell) {
      group_of[cell] = groups.size();
      groups.emplace_back();
    }
    groups[group_of[first]].push_back(cells[cell]);
  }
  return groups;
}

/// Appends `group`, cut into touching parts of which none is longer than length_max_cells, to `frontiers`.
template <int Dim>
void split_group(const Lattice<Dim>& lattice, std::vector<Index<Dim>> group, double length_max_cells, Adjacency adjacency,
                 std::vector<Frontier<Dim>>& frontiers) {
  const auto slabs = slabs_along_principal_axis<Dim>(group, length_max_cells);
  if (slabs.size() == 1) {
    frontiers.push_back(make_frontier<Dim>(lattice, std::move(group)));
    return;
  }
  // A bent group falls into pieces, which may be long in another direction.
  for (const auto& slab : slabs) {
    for (auto& piece : touching_groups<Dim>(slab, adjacency)) {
      split_group<Dim>(lattice, std::move(piece), length_max_cells, adjacency, frontiers);
    }
  }
}

}  // namespace detail

/// Groups frontier cells that touch; drops small groups, and splits long ones along their
/// principal axis into parts that touch in themselves (see FrontierParams). `cells` in storage order and each
/// once, as detect_frontier returns them. The groups follow the storage order of their first cells, the parts
/// of a split one its principal axis. Throws std::invalid_argument for bad parameters. O(cells).
template <int Dim>
[[nodiscard]] std::vector<Frontier<Dim>> cluster_frontier(const Lattice<Dim>& lattice,
                                                          const std::vector<Index<Dim>>& cells,
                                                          const FrontierParams& params = {}) {
  params.validate();
  std::vector<Frontier<Dim>> frontiers;
  if (cells.empty()) return frontiers;
  const double length_min_cells = params.length_min_m / lattice.resolution_m() - 1e-9;
  const double length_max_cells = std::max(1.0, params.length_max_m / lattice.resolution_m());
  for (auto& group : detail::touching_groups<Dim>(cells, params.group_adjacency)) {
    if (static_cast<double>(group.size()) < length_min_cells) continue;
    detail::split_group<Dim>(lattice, std::move(group), length_max_cells, params.group_adjacency, frontiers);
  }
  return frontiers;
}

/// The frontiers of a belief: detect_frontier, then cluster_frontier.
template <int Dim>
[[nodiscard]] std::vector<Frontier<Dim>> find_frontiers(const OccupancyGrid<Dim>& occupancy,
                                                        const FrontierParams& params = {}) {
  return cluster_frontier<Dim>(occupancy.lattice(), detect_frontier<Dim>(occupancy, params), params);
}

}  // namespace incognita
