/// What an Explorer is made with.
#pragma once

#include <limits>
#include <optional>
#include <stdexcept>

#include "incognita/exploration/information_gain.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/strategy.hpp"
#include "incognita/frontier/detection.hpp"
#include "incognita/frontier/uncertainty_frontier.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/planning/allowed_area.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/retreat.hpp"
#include "incognita/planning/travel_cost.hpp"

namespace incognita {

/// Parameters of an Explorer.
struct ExplorerParams {
  OccupancyThresholds thresholds;  ///< of what is free and what is occupied
  FrontierParams frontier;         ///< which cells are frontiers, and how they are grouped
  TravelParams travel;             ///< where the robot fits, and what paths like
  FollowParams follow;             ///< how paths are followed
  CollisionGuardParams guard;      ///< how commands are slowed before obstacles
  RetreatParams retreat;           ///< from tight places
  GainParams gain;                 ///< how scans are predicted
  SetAsideParams set_aside;        ///< of goals that were of no use
  /// When set, uncertainty frontiers are gone to as well (Sansoni et al., 3.3): what was seen at a bad moment is seen again. Each is
  /// visited once, until the map around it changes. For maps of a DispersionPolicy, and information that is not of the path, which
  /// knows occupancy alone.
  std::optional<UncertaintyFrontierParams> uncertainty;
  AllowedArea area;                        ///< in the map's frame; the start must lie in it, with clearance. No path leaves it
  Strategy strategy = Strategy::last_mile;  ///< when a goal is reconsidered
  FrontierInformation information = FrontierInformation::big;  ///< what goals are measured by ...
  NavigationCost navigation = NavigationCost::geodesic;  ///< ... and divided by
  double travel_offset_m = 2.0;            ///< added to costs that are ways, so that what is at hand does not always win; >= 0
  int candidates_max = 40;                 ///< so many are compared: by the gain of paths the cheapest to reach that are worth going, >= 1
  double visibility_tolerance_m = 0.05;    ///< frontiers must be seen from all places this near to a viewpoint, > 0
  double information_min_m2 = 0.01;        ///< a viewpoint from where no more of the frontier is seen is not gone to, >= 0
  double gain_min_cells = 7.0;             ///< nor is one, by the gain of paths, for less than the entropy of so many unknown cells
  double decision_interval_s = 1.0;        ///< a goal that still leads somewhere is not reconsidered sooner
  double blocked_max_s = 1.0;              ///< standing before an obstacle for longer, the robot retreats from it
  double position_sigma_max_m = 1.0;       ///< lost beyond
  double lost_max_s = 10.0;                ///< lost when the filter has been lost for longer; the robot stands meanwhile
  double duration_max_s = std::numeric_limits<double>::infinity();  ///< out of time beyond
  int threads = 0;                         ///< for the evaluation of candidates; 0: OpenMP's own number

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    thresholds.validate();
    frontier.validate();
    travel.validate();
    follow.validate();
    guard.validate();
    retreat.validate();
    gain.validate();
    set_aside.validate();
    area.validate();
    if (uncertainty) {
      uncertainty->validate();
      if (is_of_path(information)) {
        throw std::invalid_argument("ExplorerParams: information is one of paths, but uncertainty needs information other than big and log_big");
      }
    }
    require_non_negative("ExplorerParams", "travel_offset_m", travel_offset_m);
    require(candidates_max >= 1, "ExplorerParams", "candidates_max", candidates_max, ">= 1");
    require_positive("ExplorerParams", "visibility_tolerance_m", visibility_tolerance_m);
    const double sight_m = gain.range_max_m - visibility_tolerance_m;
    require(sight_m > travel.clearance_hard_m(), "ExplorerParams", "gain.range_max_m - visibility_tolerance_m", sight_m,
            "> travel.robot_radius_m + travel.margin_m");
    require_non_negative("ExplorerParams", "information_min_m2", information_min_m2);
    require_non_negative("ExplorerParams", "gain_min_cells", gain_min_cells);
    require_non_negative("ExplorerParams", "decision_interval_s", decision_interval_s);
    require_positive("ExplorerParams", "blocked_max_s", blocked_max_s);
    require_positive("ExplorerParams", "position_sigma_max_m", position_sigma_max_m);
    require_positive("ExplorerParams", "lost_max_s", lost_max_s);
    require(duration_max_s > 0.0, "ExplorerParams", "duration_max_s", duration_max_s, "> 0");
    require(threads >= 0, "ExplorerParams", "threads", threads, ">= 0");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "thresholds, frontier, travel, follow, guard, retreat, gain, set_aside, uncertainty, area, strategy, information, navigation, "
        "travel_offset_m, candidates_max, visibility_tolerance_m, information_min_m2, gain_min_cells, decision_interval_s, "
        "blocked_max_s, position_sigma_max_m, lost_max_s",
        thresholds, frontier, travel, follow, guard, retreat, gain, set_aside, uncertainty, area, strategy, information, navigation,
        travel_offset_m, candidates_max, visibility_tolerance_m, information_min_m2, gain_min_cells, decision_interval_s, blocked_max_s,
        position_sigma_max_m, lost_max_s);
  }
};

}  // namespace incognita
