/// Where the uncertainty of what was measured leaps: places to explore or to look at again (Sansoni et al., 3.3).
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "incognita/frontier/frontier.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/uncertainty_map.hpp"

namespace incognita {

/// What counts as an uncertainty frontier and how its cells are grouped.
struct UncertaintyFrontierParams {
  double gradient_min_m = 0.2;           ///< T_h, per step of one cell, > 0
  double obstacle_distance_min_m = 0.5;  ///< leaps nearer to an obstacle are what it hides, >= 0
  FrontierParams groups;                 ///< how cells are grouped; what it says of unknown cells does not matter

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("UncertaintyFrontierParams", "gradient_min_m", gradient_min_m);
    require_non_negative("UncertaintyFrontierParams", "obstacle_distance_min_m", obstacle_distance_min_m);
    groups.validate();
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("gradient_min_m, obstacle_distance_min_m, groups", gradient_min_m, obstacle_distance_min_m, groups);
  }
};

/// The cells with U < U_beta at which the gradient of min(U, U_beta) is longer than gradient_min_m, that are not near an
/// obstacle; in storage order. Cells out of the grid's box count as U_beta. Along each axis the gradient is the greater of the
/// differences to the two neighbours, so that a cell before a leap counts whichever way the leap is. So a norm may be sqrt(2) U_beta: a
/// threshold above U_beta may still find frontiers, against the text. Throws std::invalid_argument for bad parameters or an
/// occupancy with another box. O(cells).
template <class Real>
[[nodiscard]] std::vector<Index<2>> detect_uncertainty_frontier(const Grid<Real, 2>& uncertainty_m, double tolerated_m,
                                                                const OccupancyGrid<2>& occupancy,
                                                                const UncertaintyFrontierParams& params = {}) {
  params.validate();
  require_positive("detect_uncertainty_frontier", "tolerated_m", tolerated_m);
  require_equal_boxes("detect_uncertainty_frontier", "occupancy", occupancy.box(), "uncertainty_m", uncertainty_m.box());
  const auto limit_m = static_cast<Real>(tolerated_m);
  const auto clipped_m = [&](int x, int y) {
    const Index<2> cell(x, y);
    return uncertainty_m.contains(cell) ? std::min(limit_m, uncertainty_m[uncertainty_m.offset_of(cell)]) : limit_m;
  };
  const Grid<float, 2> clearance_m =
      distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; });
  const auto gradient_min_m = static_cast<Real>(params.gradient_min_m);
  const auto clearance_min_m = static_cast<float>(params.obstacle_distance_min_m);
  std::vector<Index<2>> cells;
  const IndexBox<2>& box = uncertainty_m.box();
  for (int y = box.lower[1]; y < box.upper[1]; ++y) {
    for (int x = box.lower[0]; x < box.upper[0]; ++x) {
      const Real here_m = clipped_m(x, y);
      if (!(here_m < limit_m)) continue;
      const Real along_x_m = std::max(std::abs(clipped_m(x + 1, y) - here_m), std::abs(clipped_m(x - 1, y) - here_m));
      const Real along_y_m = std::max(std::abs(clipped_m(x, y + 1) - here_m), std::abs(clipped_m(x, y - 1) - here_m));
      if (!(std::hypot(along_x_m, along_y_m) > gradient_min_m)) continue;
      if (clearance_m[clearance_m.offset_of({x, y})] < clearance_min_m) continue;
      cells.emplace_back(x, y);
    }
  }
  return cells;
}

/// The same of a map whose cells are a policy such as Dispersion. O(cells).
template <class Map>
[[nodiscard]] std::vector<Index<2>> detect_uncertainty_frontier(const Map& map, const OccupancyThresholds& thresholds = {},
                                                                const UncertaintyFrontierParams& params = {},
                                                                UncertaintyScale scale = UncertaintyScale::calibrated) {
  const double tolerated_m = UncertaintyOfDispersion(map.cell(), scale).tolerated_m();
  return detect_uncertainty_frontier(uncertainty_map(map, scale), tolerated_m, classify(map, thresholds), params);
}

/// The uncertainty frontiers of such a map. There are none where all that is known and
/// tolerated goes over smoothly into the rest: nothing is left to explore with what is tolerated. O(cells).
template <class Map>
[[nodiscard]] std::vector<Frontier<2>> find_uncertainty_frontiers(const Map& map, const OccupancyThresholds& thresholds = {},
                                                                  const UncertaintyFrontierParams& params = {},
                                                                  UncertaintyScale scale = UncertaintyScale::calibrated) {
  return cluster_frontier<2>(map.lattice(), detect_uncertainty_frontier(map, thresholds, params, scale), params.groups);
}

}  // namespace incognita
