/// One plan of an exploration: where to go and see, and by which way (Isleyen, van de Molengraft and Arslan, Algorithm 1).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/safe_space.hpp"
#include "incognita/planning/travel_cost.hpp"
#include "incognita/planning/visit_cost.hpp"

namespace incognita {

/// What an exploration is planned by.
struct ActionAwareParams {
  BodyParams body;              ///< the robot's disc
  VisibilityParams visibility;  ///< what counts as seen
  /// Which cells are frontiers, and how they are grouped.
  FrontierParams frontier{false, Adjacency::faces, Adjacency::corners, 0.0, std::numeric_limits<double>::max()};
  VisitCostParams visit;                                 ///< what paths like
  Adjacency steps = Adjacency::corners;                  ///< how paths go from cell to cell; no corner is cut
  NavigationCost navigation = NavigationCost::geodesic;  ///< what information is divided by
  double information_min_m2 = 0.0;                       ///< mu, >= 0

  /// Throws std::invalid_argument for values outside of their bounds, and when the robot could see no frontier from where its
  /// body fits: the frontier's cells lie further than radius_m + margin_m from there.
  void validate() const {
    body.validate();
    visibility.validate();
    frontier.validate();
    visit.validate();
    require_non_negative("ActionAwareParams", "information_min_m2", information_min_m2);
    const double sight_m = visibility.range_max_m - visibility.tolerance_m;
    require(sight_m > body.radius_m + body.margin_m, "ActionAwareParams",
            "visibility.range_max_m - visibility.tolerance_m", sight_m, "> body.radius_m + body.margin_m");
  }
};

/// A path to the best viewpoint, or why there is none.
struct ExplorationPlan {
  Polyline path;                        ///< from the start to the viewpoint's centre, cell by cell
  std::optional<FrontierView> chosen;   ///< by (26); none when ended is set
  std::vector<Frontier<2>> frontiers;   ///< all of them, informative or not
  std::vector<FrontierView> views;      ///< between which it was chosen
  std::optional<StopReason> ended;      ///< set when there is nothing to choose
};

/// explorationPlan(M, x), Algorithm 1, with information(frontier) a measure of Table II or any other. The same belief and
/// start give the same plan: a loop must set aside a frontier that its viewpoint did not help to see (SetAsidePlaces). Ends,
/// with the reason, when there is no frontier (complete), when no frontier's viewpoint can be reached, as from a start out of
/// the planning space or in a belief without free cells (nothing_reachable), and when none that can be reached is informative
/// (nothing_informative, (28)). Throws std::invalid_argument for bad parameters and for a start that is not finite.
template <class Information>
[[nodiscard]] ExplorationPlan plan_exploration(const OccupancyGrid<2>& occupancy, const Eigen::Vector2d& start_m,
                                               const ActionAwareParams& params, Information&& information) {
  params.validate();
  ExplorationPlan plan;
  const std::vector<Index<2>> cells = detect_frontier<2>(occupancy, params.frontier);
  plan.frontiers = cluster_frontier<2>(occupancy.lattice(), cells, params.frontier);
  TravelCostField field(occupancy.lattice());
  const SafeSpaces spaces = safe_spaces(occupancy, params.body);
  field.restart(visit_cost(occupancy, spaces.plan, params.visit), start_m, params.steps);
  if (plan.frontiers.empty()) {
    const std::vector<Occupancy>& all = occupancy.values();
    const bool is_anything_free = std::find(all.begin(), all.end(), Occupancy::free) != all.end();
    plan.ended = is_anything_free ? StopReason::complete : StopReason::nothing_reachable;
    return plan;
  }
  const CellBits free = free_cells(occupancy);
  const ReliableVisibility visibility(occupancy, free, params.visibility);
  const auto is_frontier = [&](const Index<2>& cell) {
    return std::binary_search(cells.begin(), cells.end(), cell, is_stored_before<2>);
  };
  const auto is_reached = [&](const Index<2>& cell) { return field.reaches(cell); };
  ViewpointSearch search;
  plan.views = find_views(plan.frontiers, is_frontier, is_reached, visibility, params.information_min_m2, search);
  if (plan.views.empty()) {
    plan.ended = StopReason::nothing_reachable;
    return plan;
  }
  const std::size_t least_cells = least_cells_above(params.information_min_m2, occupancy.resolution_m());
  std::erase_if(plan.views, [=](const FrontierView& view) { return view.seen_cells < least_cells; });
  const FrontierView* chosen = choose_view(plan.views, field, params.navigation,
                                           [&](const FrontierView& view) { return information(plan.frontiers[view.region]); });
  if (chosen == nullptr) {
    plan.ended = StopReason::nothing_informative;
    return plan;
  }
  plan.chosen = *chosen;
  plan.path = Polyline(find_path(field, chosen->viewpoint));
  return plan;
}

}  // namespace incognita
