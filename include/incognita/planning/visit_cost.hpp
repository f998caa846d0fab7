/// What it costs to be somewhere: near to what is unknown is good, near to what is in the way is bad (Isleyen et al., III-A).
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "incognita/core/error.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/grid/near_distance.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/planning/safe_space.hpp"

namespace incognita {

/// Table III. The inverse entropy is another grid, see inverse_entropy.
enum class DistanceMeasure {
  uniform,   ///< 1 everywhere
  euclidean  ///< in metres, cut off at a bound
};

/// How (11) is measured.
struct VisitCostParams {
  DistanceMeasure to_unknown = DistanceMeasure::euclidean;    ///< uniform takes 1 for it
  DistanceMeasure to_collision = DistanceMeasure::euclidean;  ///< likewise
  double unknown_max_m = 2.0;                                 ///< alpha_max, > 0; visit_cost refuses more than 90 cells
  double collision_max_m = 1.0;                               ///< beta_max, > 0; likewise

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("VisitCostParams", "unknown_max_m", unknown_max_m);
    require_positive("VisitCostParams", "collision_max_m", collision_max_m);
  }
};

/// (12): the distance to the centre of the nearest unknown cell, at most unknown_max_m. What lies outside of the box is unknown.
template <int Dim>
[[nodiscard]] Grid<float, Dim> distance_to_unknown_m(const OccupancyGrid<Dim>& occupancy, double unknown_max_m) {
  return near_distance_m(occupancy, unknown_max_m, [](Occupancy cell) { return cell == Occupancy::unknown; });
}

/// (13): the distance to the centre of the nearest cell out of the planning space, at most collision_max_m.
template <int Dim>
[[nodiscard]] Grid<float, Dim> distance_to_collision_m(const Grid<std::uint8_t, Dim>& plan, double collision_max_m) {
  return near_distance_m(plan, collision_max_m, [](std::uint8_t is_inside) { return is_inside == 0; });
}

/// Table III's other distance to the unknown: the inverse of a cell's entropy, log_odds_of(offset) being what the belief says of
/// a cell of `occupancy` and `entropy` a measure of log-odds in nats (EntropyTable). Cells free beyond doubt have hardly any
/// entropy, so it is taken to be entropy_min_nats at least, > 0, which also bounds what a path pays for a detour. Throws
/// std::invalid_argument for another. O(cells).
template <class LogOddsOf, class Entropy>
[[nodiscard]] Grid<float, 2> inverse_entropy(const OccupancyGrid<2>& occupancy, LogOddsOf&& log_odds_of, const Entropy& entropy,
                                             double entropy_min_nats = 1e-3) {
  require_positive("inverse_entropy", "entropy_min_nats", entropy_min_nats);
  Grid<float, 2> inverse(occupancy.lattice(), occupancy.box(), 0.0F);
  for (Offset i = 0; i < static_cast<Offset>(inverse.size()); ++i) {
    const double nats = static_cast<double>(entropy(log_odds_of(i)));
    inverse[i] = static_cast<float>(1.0 / (nats > entropy_min_nats ? nats : entropy_min_nats));
  }
  return inverse;
}

/// (11) of the cells of the planning space: `to_unknown` over the distance to collision; infinity of all others. Throws
/// std::invalid_argument when the two differ in their boxes.
template <int Dim>
[[nodiscard]] Grid<float, Dim> visit_cost(const Grid<std::uint8_t, Dim>& plan, const Grid<float, Dim>& to_unknown,
                                         const VisitCostParams& params) {
  params.validate();
  require_equal_boxes("visit_cost", "to_unknown", to_unknown.box(), "plan", plan.box());
  const bool is_measured = params.to_collision == DistanceMeasure::euclidean;
  const Grid<float, Dim> to_collision =
      is_measured ? distance_to_collision_m(plan, params.collision_max_m) : Grid<float, Dim>(plan.lattice(), plan.box(), 1.0F);
  Grid<float, Dim> cost(plan.lattice(), plan.box(), std::numeric_limits<float>::infinity());
  for (Offset i = 0; i < static_cast<Offset>(cost.size()); ++i) {
    if (plan[i] != 0) cost[i] = to_unknown[i] / to_collision[i];
  }
  return cost;
}

/// (11) with the distance to the unknown that `params` name. Throws std::invalid_argument for bad parameters. O(cells).
template <int Dim>
[[nodiscard]] Grid<float, Dim> visit_cost(const OccupancyGrid<Dim>& occupancy, const Grid<std::uint8_t, Dim>& plan,
                                         const VisitCostParams& params = {}) {
  params.validate();
  return visit_cost<Dim>(plan,
                    params.to_unknown == DistanceMeasure::euclidean
                        ? distance_to_unknown_m(occupancy, params.unknown_max_m)
                        : Grid<float, Dim>(occupancy.lattice(), occupancy.box(), 1.0F),
                    params);
}

}  // namespace incognita
