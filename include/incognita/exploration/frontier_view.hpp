/// Frontiers as goals: from where each is seen, what it costs to get there, and which to choose (Isleyen, van de Molengraft and
/// Arslan, IV-A).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "incognita/exploration/viewpoints.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/travel_cost.hpp"

namespace incognita {

/// Table IV: what it costs to get somewhere.
enum class NavigationCost {
  uniform,    ///< 1: as if the robot were there at once
  euclidean,  ///< the straight line
  geodesic    ///< the travel cost of the cheapest path, (14)
};

/// navcost(x, v) of a cell that the field reaches, in metres, or 1 where it is uniform.
[[nodiscard]] inline double navigation_cost(NavigationCost kind, const TravelCostField& field, const Index<2>& goal) {
  switch (kind) {
    case NavigationCost::uniform: return 1.0;
    case NavigationCost::euclidean: return distance(field.start_m(), field.lattice().center_m(goal));
    case NavigationCost::geodesic: return static_cast<double>(field.cost_m(goal));
  }
  return 1.0;
}

/// Information per cost, each of any unit: infinite where something is learned for nothing, 0 where nothing is.
[[nodiscard]] inline double information_per_cost(double information, double cost) {
  if (!(information > 0.0)) return 0.0;
  return cost > 0.0 ? information / cost : std::numeric_limits<double>::infinity();
}

/// isNear, (25).
[[nodiscard]] inline bool is_near(const Eigen::Vector2d& a_m, const Eigen::Vector2d& b_m, double tolerance_m) {
  return distance(a_m, b_m) <= tolerance_m;
}

/// The least number of cells that cover more than an area: what (26) to (28) compare volumes by, so that rounding decides nothing.
[[nodiscard]] inline std::size_t least_cells_above(double area_m2, double resolution_m) {
  constexpr double rounding = 1e-9;  // 0.02 m^2 are two cells of 0.1 m
  return static_cast<std::size_t>(std::min(1e15, area_m2 / (resolution_m * resolution_m) + rounding)) + 1;
}

/// isInformative, (27): whether more than information_min_m2 of some frontier cells is reliably seen from a cell. Asks no further
/// than that.
[[nodiscard]] inline bool is_informative(const Index<2>& from, const std::vector<Index<2>>& frontier,
                                         const ReliableVisibility& visibility, double information_min_m2) {
  return sees_at_least(least_cells_above(information_min_m2, visibility.occupancy().resolution_m()), visibility, from, frontier);
}

/// A frontier that can be seen from somewhere that can be reached.
struct FrontierView {
  std::size_t region = 0;                ///< which of the frontiers
  Index<2> viewpoint = zero<Index<2>>();  ///< (21)
  std::size_t seen_cells = 0;            ///< how many cells of all frontiers are seen from there
  double actionable_m2 = 0.0;            ///< the same as an area, (23)
};

/// The views of those frontiers that are seen from a cell that is_eligible(index) holds for, in the order of the frontiers.
/// is_frontier(index) says which cells are frontiers. (26) may choose those whose actionable information is above
/// information_min_m2; when none is, the exploration is complete, (28). Where less is seen from the viewpoint of (21), beside a
/// frontier that it looks along, the best of those takes its place from where enough of the frontier is seen, if there is one:
/// the paper would give the frontier up.
template <class IsFrontier, class IsEligible>
[[nodiscard]] std::vector<FrontierView> find_views(const std::vector<Frontier<2>>& frontiers, IsFrontier&& is_frontier,
                                                   IsEligible&& is_eligible, const ReliableVisibility& visibility,
                                                   double information_min_m2, ViewpointSearch& search) {
  const double resolution_m = visibility.occupancy().resolution_m();
  const std::size_t least_cells = least_cells_above(information_min_m2, resolution_m);
  std::vector<FrontierView> views;
  for (std::size_t region = 0; region < frontiers.size(); ++region) {
    const std::vector<Index<2>>& cells = frontiers[region].cells;
    std::optional<Index<2>> viewpoint = search.best(cells, is_eligible, visibility);
    if (!viewpoint) continue;
    std::size_t seen = search.visible(*viewpoint, is_frontier, visibility).size();
    if (seen < least_cells) {
      if (const auto better = search.best(cells, is_eligible, visibility, least_cells)) {
        viewpoint = better;
        seen = search.visible(*viewpoint, is_frontier, visibility).size();
      }
    }
    views.push_back({region, *viewpoint, seen, resolution_m * resolution_m * static_cast<double>(seen)});
  }
  return views;
}

/// i* of (26), of views that are informative enough: the one with the most information per cost, the first of equals; null when
/// there are none. information(view) is a measure of Table II of its frontier, or any other.
template <class Information>
[[nodiscard]] const FrontierView* choose_view(const std::vector<FrontierView>& views, const TravelCostField& field,
                                              NavigationCost navigation, Information&& information) {
  const FrontierView* best = nullptr;
  double most = -std::numeric_limits<double>::infinity();
  for (const FrontierView& view : views) {
    const double utility = information_per_cost(information(view), navigation_cost(navigation, field, view.viewpoint));
    if (!(utility > most)) continue;
    most = utility;
    best = &view;
  }
  return best;
}

}  // namespace incognita
