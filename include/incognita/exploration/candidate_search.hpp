/// Ways from where a robot is, and what of all that can be seen from their ends is most worth going to.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/exploration/candidate.hpp"
#include "incognita/exploration/explorer_params.hpp"
#include "incognita/exploration/frontier_information.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/planning/closed_cells.hpp"
#include "incognita/planning/path.hpp"

namespace incognita {

/// The search of an Explorer for candidates, with the storage that is kept from one to the next. Its parameters are the
/// Explorer's. Not thread safe; uses threads of its own.
template <CellPolicy Cell>
class CandidateSearch {
 public:
  /// On the lattice of the map.
  explicit CandidateSearch(const Lattice<2>& lattice)
      : clearance_m_(lattice, {}, std::numeric_limits<float>::infinity()), ways_(lattice) {}

  /// Makes ways() those from a place. Where the robot has been, on the cells of its trail, its body fits, however tight the belief
  /// draws the place: no door closes behind it. Where it stands is left as drawn: from a tight place the search knows a way out,
  /// from one with room that has none around it does not. A shut place lets nothing pass but along the trail and where there is
  /// room; if the robot stands in one and no way leads out, shut places are as others. O(cells).
  void search_ways(const OccupancyGrid<2>& occupancy, const std::vector<Index<2>>& trail, const ClosedCells<2>& closed,
                   const SetAsidePlaces& shut, const Eigen::Vector2d& from_m, const TravelParams& params) {
    search_ways_past(shut, occupancy, trail, closed, from_m, params);
    if (!shut.empty() && !ways_.reaches_any()) search_ways_past(SetAsidePlaces(), occupancy, trail, closed, from_m, params);
  }

  [[nodiscard]] const TravelCostField& ways() const { return ways_; }  ///< from the place that they were last made from

  /// The way to a cell that is reached, with few corners.
  [[nodiscard]] Polyline path_to(const Index<2>& cell) const { return Polyline(shorten_path(ways_, find_path(ways_, cell))); }

  /// The cell within a distance of a place that is nearest to it of those that are reached; the first in storage order of equals.
  [[nodiscard]] std::optional<Index<2>> nearest_reached(const Eigen::Vector2d& place_m, double within_m) const {
    const Lattice<2>& lattice = ways_.lattice();
    if (const Index<2> cell = lattice.index_of(place_m); ways_.reaches(cell)) return cell;
    const Box<Eigen::Vector2d> around{place_m, place_m};
    const IndexBox<2> box = lattice.cells_of(around.padded(within_m));
    std::optional<Index<2>> nearest;
    double nearest_m = within_m;
    for (int y = box.lower[1]; y < box.upper[1]; ++y) {
      for (int x = box.lower[0]; x < box.upper[0]; ++x) {
        const double away_m = distance(lattice.center_m({x, y}), place_m);
        if (away_m > nearest_m || (nearest && away_m == nearest_m) || !ways_.reaches({x, y})) continue;
        nearest = Index<2>(x, y);
        nearest_m = away_m;
      }
    }
    return nearest;
  }

  /// The candidates that views of frontiers make, the highest utility first, at most candidates_max unless none of these is worth
  /// going to. By the gain of paths those that gain too little are left out.
  template <class Filter>
  [[nodiscard]] std::vector<Candidate> candidates(std::vector<FrontierView> views, const std::vector<Frontier<2>>& frontiers,
                                                  const Map<Cell, 2>& map, const EntropyTable& entropy, const Filter& filter,
                                                  const ExplorerParams& params) {
    std::vector<Candidate> candidates = is_of_path(params.information)
                                            ? first_gainful(views, frontiers, map, entropy, filter, params)
                                            : most_useful(views, frontiers, map, entropy, params);
    sort_by_utility(candidates);
    return candidates;
  }

  /// For archives of states, see docs/mission_file.md: what ways() knows when no search is under way, see TravelCostField.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(ways_);
  }

 private:
  void search_ways_past(const SetAsidePlaces& shut, const OccupancyGrid<2>& occupancy, const std::vector<Index<2>>& trail,
                        const ClosedCells<2>& closed, const Eigen::Vector2d& from_m, const TravelParams& params) {
    distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; }, clearance_m_);
    const Index<2> here = occupancy.lattice().index_of(from_m);
    const float clearance_here_m = clearance_m_.value(here);
    if (!shut.empty()) shut_passages(shut, occupancy, params);
    for (const Index<2>& cell : trail) {
      if (!clearance_m_.contains(cell)) continue;
      float& clearance_m = clearance_m_[clearance_m_.offset_of(cell)];
      clearance_m = std::max(clearance_m, static_cast<float>(params.clearance_hard_m()));
    }
    if (clearance_m_.contains(here)) clearance_m_.set(here, clearance_here_m);
    if (!closed.none()) keep_off(closed, params);
    ways_.restart(occupancy, clearance_m_, from_m, params);
  }

  /// None of their cells but those with room has any clearance, so that no escape leads across either.
  void shut_passages(const SetAsidePlaces& shut, const OccupancyGrid<2>& occupancy, const TravelParams& params) {
    const auto roomy_m = static_cast<float>(params.clearance_roomy_m(clearance_m_.resolution_m()));
    for (Offset cell = 0; cell < static_cast<Offset>(clearance_m_.size()); ++cell) {
      float& clearance_m = clearance_m_[cell];
      if (clearance_m == 0.0F || clearance_m >= roomy_m) continue;
      if (shut.contains(occupancy.lattice().center_m(clearance_m_.index_at(cell)), occupancy)) clearance_m = 0.0F;
    }
  }

  /// Too little for any passage, yet more than where there is no clearance at all.
  [[nodiscard]] float hardly_m() const { return static_cast<float>(0.25 * clearance_m_.resolution_m()); }

  /// Unlike a wall, what is not allowed lies where it is drawn: nobody squeezes past it. Too near to it a cell has hardly any
  /// clearance, but some, so that an escape from there does not lead across.
  void keep_off(const ClosedCells<2>& closed, const TravelParams& params) {
    const auto hard_m = static_cast<float>(params.clearance_hard_m());
    for (Offset cell = 0; cell < static_cast<Offset>(clearance_m_.size()); ++cell) {
      const float to_closed_m = closed.clearance_m(clearance_m_.index_at(cell));
      const float keeps_m = to_closed_m < hard_m ? std::min(to_closed_m, hardly_m()) : to_closed_m;
      clearance_m_[cell] = std::min(clearance_m_[cell], keeps_m);
    }
  }

  /// Without its path.
  [[nodiscard]] Candidate candidate_for(const FrontierView& view, const Frontier<2>& frontier, const Map<Cell, 2>& map,
                                        const EntropyTable& entropy, const ExplorerParams& params) const {
    Candidate candidate;
    candidate.frontier_m = map.lattice().center_m(frontier.representative);
    candidate.frontier = frontier.cells;
    candidate.viewpoint = view.viewpoint;
    candidate.navigation_cost = navigation_cost(params.navigation, ways_, view.viewpoint);
    switch (params.information) {
      case FrontierInformation::uniform: candidate.information = 1.0; break;
      case FrontierInformation::size: candidate.information = frontier_size_m2(frontier.cells, map.resolution_m()); break;
      case FrontierInformation::entropy: candidate.information = frontier_entropy_nats_m2(frontier.cells, map, entropy); break;
      case FrontierInformation::big:
      case FrontierInformation::log_big: break;  // told by its path
    }
    rate(candidate, params);
    return candidate;
  }

  static void rate(Candidate& candidate, const ExplorerParams& params) {
    const double offset_m = params.navigation == NavigationCost::uniform ? 0.0 : params.travel_offset_m;
    candidate.utility = information_per_cost(candidate.information, candidate.navigation_cost + offset_m);
  }

  static void sort_by_utility(std::vector<Candidate>& candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.utility > b.utility; });
  }

  /// The candidates_max of the most information per cost.
  [[nodiscard]] std::vector<Candidate> most_useful(const std::vector<FrontierView>& views,
                                                   const std::vector<Frontier<2>>& frontiers, const Map<Cell, 2>& map,
                                                   const EntropyTable& entropy, const ExplorerParams& params) const {
    std::vector<Candidate> candidates;
    for (const FrontierView& view : views) {
      candidates.push_back(candidate_for(view, frontiers[view.region], map, entropy, params));
    }
    sort_by_utility(candidates);
    if (candidates.size() > static_cast<std::size_t>(params.candidates_max)) {
      candidates.erase(candidates.begin() + params.candidates_max, candidates.end());
    }
    for (Candidate& candidate : candidates) candidate.path = path_to(candidate.viewpoint);
    return candidates;
  }

  /// Those that gain enough of the candidates_max that are cheapest to reach; when there are none, of the next, and so on.
  template <class Filter>
  [[nodiscard]] std::vector<Candidate> first_gainful(std::vector<FrontierView>& views, const std::vector<Frontier<2>>& frontiers,
                                                     const Map<Cell, 2>& map, const EntropyTable& entropy, const Filter& filter,
                                                     const ExplorerParams& params) {
    std::stable_sort(views.begin(), views.end(), [&](const FrontierView& a, const FrontierView& b) {
      return ways_.cost_m(a.viewpoint) < ways_.cost_m(b.viewpoint);
    });
    const double gain_min_nats = params.gain_min_cells * entropy(0.0F);
    std::vector<Candidate> gainful;
    std::size_t next = 0;
    while (gainful.empty() && next < views.size()) {
      const std::size_t end = std::min(views.size(), next + static_cast<std::size_t>(params.candidates_max));
      for (; next < end; ++next) {
        gainful.push_back(candidate_for(views[next], frontiers[views[next].region], map, entropy, params));
        gainful.back().path = path_to(views[next].viewpoint);
      }
      evaluate_candidates(map, entropy, filter, gainful, params.gain, params.threads, scratch_);
      std::erase_if(gainful, [&](const Candidate& candidate) { return candidate.gain_nats < gain_min_nats; });
    }
    const double unit_nats = gain_min_nats > 0.0 ? gain_min_nats : entropy(0.0F);
    for (Candidate& candidate : gainful) {
      const bool is_log = params.information == FrontierInformation::log_big;
      candidate.information = is_log ? std::log1p(candidate.gain_nats / unit_nats) : candidate.gain_nats;
      rate(candidate, params);
    }
    return gainful;
  }

  Grid<float, 2> clearance_m_;
  TravelCostField ways_;
  CandidateScratch<Cell> scratch_;
};

}  // namespace incognita
