/// Groups of frontier cells: places at which there is more to see.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/frontier/detection.hpp"
#include "incognita/geometry/principal_axes.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// Frontier cells that belong together.
template <int Dim>
struct Frontier {
  std::vector<Index<Dim>> cells;                   ///< in storage order
  Point<Dim> centroid_m = Point<Dim>::Zero();      ///< of the cells' centres; need not be free
  Index<Dim> representative = Index<Dim>::Zero();  ///< the cell whose centre is nearest to the centroid
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
  Point<Dim> mean = Point<Dim>::Zero();
  for (const Index<Dim>& cell : cells) mean += cell.template cast<double>();
  mean /= static_cast<double>(cells.size());
  Eigen::Matrix<double, Dim, Dim> scatter = Eigen::Matrix<double, Dim, Dim>::Zero();
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

/// Groups cells of a box by contact. Keeps its scratch from one call to the next.
template <int Dim>
class CellGrouping {
 public:
  CellGrouping(const Lattice<Dim>& lattice, const IndexBox<Dim>& box)
      : place_(lattice, box, none), flood_(place_, Adjacency::corners) {}

  /// The groups of cells that touch, corners included; each keeps the order of `cells`, and so do their first
  /// cells.
  [[nodiscard]] std::vector<std::vector<Index<Dim>>> touching(const std::vector<Index<Dim>>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) place_.set(cells[i], static_cast<std::int32_t>(i));
    std::vector<std::vector<Index<Dim>>> groups;
    for (const Index<Dim>& seed : cells) {
      members_.clear();
      flood_(seed, [&](Offset offset) {
        if (place_[offset] == none) return false;
        members_.push_back(place_[offset]);
        place_[offset] = none;
        return true;
      });
      if (members_.empty()) continue;
      std::sort(members_.begin(), members_.end());
      auto& group = groups.emplace_back();
      group.reserve(members_.size());
      for (const std::int32_t member : members_) group.push_back(cells[static_cast<std::size_t>(member)]);
    }
    return groups;
  }

  /// Appends `group`, cut into touching parts of which none is longer than length_max_cells, to `frontiers`.
  void split(std::vector<Index<Dim>> group, double length_max_cells, std::vector<Frontier<Dim>>& frontiers) {
    const auto slabs = slabs_along_principal_axis<Dim>(group, length_max_cells);
    if (slabs.size() == 1) {
      frontiers.push_back(make_frontier<Dim>(place_.lattice(), std::move(group)));
      return;
    }
    // A bent group falls into pieces, which may be long in another direction.
    for (const auto& slab : slabs) {
      for (auto& piece : touching(slab)) split(std::move(piece), length_max_cells, frontiers);
    }
  }

 private:
  static constexpr std::int32_t none = -1;
  Grid<std::int32_t, Dim> place_;  ///< in the list of cells to be grouped, until grouped
  Flood<Dim> flood_;
  std::vector<std::int32_t> members_;
};

}  // namespace detail

/// Groups frontier cells that touch, corners included; drops small groups, and splits long ones along their
/// principal axis into parts that touch in themselves (see FrontierParams). `cells` in storage order and each
/// once, as detect_frontier returns them. The groups follow the storage order of their first cells, the parts
/// of a split one its principal axis. Throws std::invalid_argument for bad parameters. O(cells of the box
/// around them).
template <int Dim>
[[nodiscard]] std::vector<Frontier<Dim>> cluster_frontier(const Lattice<Dim>& lattice,
                                                          const std::vector<Index<Dim>>& cells,
                                                          const FrontierParams& params = {}) {
  params.validate();
  std::vector<Frontier<Dim>> frontiers;
  if (cells.empty()) return frontiers;
  IndexBox<Dim> box{cells.front(), cells.front()};
  for (const Index<Dim>& cell : cells) {
    box.lower = box.lower.cwiseMin(cell);
    box.upper = box.upper.cwiseMax((cell.array() + 1).matrix());
  }
  detail::CellGrouping<Dim> grouping(lattice, box);
  const double length_min_cells = params.length_min_m / lattice.resolution_m() - 1e-9;
  const double length_max_cells = std::max(1.0, params.length_max_m / lattice.resolution_m());
  for (auto& group : grouping.touching(cells)) {
    if (static_cast<double>(group.size()) < length_min_cells) continue;
    grouping.split(std::move(group), length_max_cells, frontiers);
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
