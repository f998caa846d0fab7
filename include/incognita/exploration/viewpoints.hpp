/// From where a frontier is seen, and what of the frontier is seen from somewhere (Isleyen et al., IV-A).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

#include "incognita/frontier/frontier.hpp"
#include "incognita/sensor/reliable_visibility.hpp"

namespace incognita {

/// The sum of the distances from a cell to the cells of a frontier, centre to centre, in cells: what (21) minimises.
[[nodiscard]] inline double summed_distance_cells(const Index<2>& from, const std::vector<Index<2>>& frontier) {
  double sum = 0.0;
  for (const Index<2>& cell : frontier) {
    const double dx = cell[0] - from[0];
    const double dy = cell[1] - from[1];
    sum += std::sqrt(dx * dx + dy * dy);
  }
  return sum;
}

/// Whether so many cells of a frontier, at least 1, are reliably seen from a place. Asks no further than that.
[[nodiscard]] inline bool sees_at_least(std::size_t count, const ReliableVisibility& visibility, const Index<2>& from,
                                        const std::vector<Index<2>>& frontier) {
  for (const Index<2>& cell : frontier) {
    if (visibility.sees(from, cell) && --count == 0) return true;
  }
  return false;
}

/// Searches of one thread, whose storage is kept from one to the next.
class ViewpointSearch {
 public:
  /// V(FR_i), (20), of the cells for which is_eligible(index) holds, such as the planning space: those from which a cell of the
  /// frontier is reliably seen; in storage order. O(frontier cells * cells in their sight).
  template <class IsEligible>
  [[nodiscard]] std::vector<Index<2>> all(const std::vector<Index<2>>& frontier, IsEligible&& is_eligible,
                                          const ReliableVisibility& visibility) {
    std::vector<Index<2>> viewpoints;
    for_each_in_sight(frontier, visibility, [&](const Index<2>& at) {
      if (is_eligible(at) && sees_at_least(1, visibility, at, frontier)) viewpoints.push_back(at);
    });
    std::sort(viewpoints.begin(), viewpoints.end(), is_stored_before<2>);
    return viewpoints;
  }

  /// view(FR_i), (21): of the viewpoint set's cells the one with the least sum of distances to the frontier's cells, the first in
  /// storage order of equals; none when the set is empty. With seen_min > 1 only of those from which so many of the frontier's
  /// cells are seen.
  template <class IsEligible>
  [[nodiscard]] std::optional<Index<2>> best(const std::vector<Index<2>>& frontier, IsEligible&& is_eligible,
                                             const ReliableVisibility& visibility, std::size_t seen_min = 1) {
    Best best;
    const auto is_viewpoint = [&](const Index<2>& at) { return sees_at_least(seen_min, visibility, at, frontier); };
    if (frontier.size() < seen_min || search_around(frontier, is_eligible, is_viewpoint, visibility, best)) return best.cell;
    // Most cells around do not see the frontier: ask which ones may.
    ranked_.clear();
    for_each_in_sight(frontier, visibility, [&](const Index<2>& at) {
      if (!is_eligible(at)) return;
      const double sum = summed_distance_cells(at, frontier);
      if (sum <= best.sum) ranked_.push_back({at, sum});
    });
    std::sort(ranked_.begin(), ranked_.end(), [](const Ranked& a, const Ranked& b) {
      return a.sum != b.sum ? a.sum < b.sum : is_stored_before<2>(a.cell, b.cell);
    });
    const auto found =
        std::find_if(ranked_.begin(), ranked_.end(), [&](const Ranked& ranked) { return is_viewpoint(ranked.cell); });
    return found == ranked_.end() ? best.cell : std::optional<Index<2>>(found->cell);
  }

  /// Lambda(v), (22): of the cells for which is_frontier(index) holds those that are reliably seen from a place; in storage order.
  /// O(cells in sight).
  template <class IsFrontier>
  [[nodiscard]] std::vector<Index<2>> visible(const Index<2>& from, IsFrontier&& is_frontier, const ReliableVisibility& visibility) {
    std::vector<Index<2>> cells;
    visibility.visit_in_sight(from, field_of_view_, [&](const Index<2>& cell) {
      if (is_frontier(cell) && visibility.sees(from, cell)) cells.push_back(cell);
    });
    std::sort(cells.begin(), cells.end(), is_stored_before<2>);
    cells.erase(std::unique(cells.begin(), cells.end(), equal<Index<2>>), cells.end());
    return cells;
  }

  /// Footnote 4: of the viewpoint set's cells the one from which the most frontier cells are seen, the first in storage order of
  /// equals. Much dearer than (21).
  template <class IsFrontier, class IsEligible>
  [[nodiscard]] std::optional<Index<2>> most_seeing(const std::vector<Index<2>>& frontier, IsFrontier&& is_frontier,
                                                    IsEligible&& is_eligible, const ReliableVisibility& visibility) {
    std::optional<Index<2>> best;
    std::size_t most = 0;
    for (const Index<2>& at : all(frontier, is_eligible, visibility)) {
      const std::size_t seen = visible(at, is_frontier, visibility).size();
      if (seen <= most) continue;
      most = seen;
      best = at;
    }
    return best;
  }

 private:
  struct Best {
    std::optional<Index<2>> cell;
    double sum = std::numeric_limits<double>::infinity();
  };
  struct Ranked {
    Index<2> cell;
    double sum;
  };

  /// So many pairs of cells may be asked in vain.
  static constexpr std::size_t misses_max = 400;

  /// Outwards from the frontier's centroid, from where the sum of distances is at least the cells times the distance from there, so
  /// that far places are not looked at once a near one is found. False when that takes too long.
  template <class IsEligible, class IsViewpoint>
  [[nodiscard]] static bool search_around(const std::vector<Index<2>>& frontier, IsEligible&& is_eligible,
                                          IsViewpoint&& is_viewpoint, const ReliableVisibility& visibility, Best& best) {
    const auto count = static_cast<double>(frontier.size());
    Point<2> centroid(0.0, 0.0);
    for (const Index<2>& cell : frontier) centroid = sum(centroid, Point<2>(cell[0] / count, cell[1] / count));
    const Index<2> middle(static_cast<int>(std::lround(centroid[0])), static_cast<int>(std::lround(centroid[1])));
    int reach = 0;
    for (const Index<2>& cell : frontier) {
      reach = std::max({reach, std::abs(cell[0] - middle[0]), std::abs(cell[1] - middle[1])});
    }
    // No further than the belief's box.
    const IndexBox<2>& box = visibility.occupancy().box();
    int farthest = 0;
    for (int axis = 0; axis < 2; ++axis) {
      farthest = std::max({farthest, middle[axis] - box.lower[axis], box.upper[axis] - middle[axis]});
    }
    reach = static_cast<int>(std::min(reach + std::ceil(visibility.range_cells()), static_cast<double>(farthest)));
    std::size_t misses = 0;
    const auto look_at = [&](const Index<2>& at) {
      if (!is_eligible(at)) return;
      const double sum = summed_distance_cells(at, frontier);
      if (sum > best.sum || (sum == best.sum && !is_stored_before<2>(at, *best.cell))) return;
      if (is_viewpoint(at)) {
        best = {at, sum};
      } else {
        misses += frontier.size();
      }
    };
    // The middle is at most half a cell along each axis from the centroid.
    for (int ring = 0; ring <= reach && count * (ring - 0.5) <= best.sum; ++ring) {
      if (misses > misses_max) return false;
      for (int x = middle[0] - ring; x <= middle[0] + ring; ++x) {
        look_at({x, middle[1] - ring});
        if (ring > 0) look_at({x, middle[1] + ring});
      }
      for (int y = middle[1] - ring + 1; y < middle[1] + ring; ++y) {
        look_at({middle[0] - ring, y});
        look_at({middle[0] + ring, y});
      }
    }
    return true;
  }

  /// Calls visit(index) once for each cell in the sight of any of the frontier's cells.
  template <class Visit>
  void for_each_in_sight(const std::vector<Index<2>>& frontier, const ReliableVisibility& visibility, Visit&& visit) {
    const Grid<Occupancy, 2>& occupancy = visibility.occupancy();
    if (marked_.size() < occupancy.size()) marked_.resize(occupancy.size());
    marks_.clear();
    for (const Index<2>& cell : frontier) {
      visibility.visit_in_sight(cell, field_of_view_, [&](const Index<2>& at) {
        std::uint8_t& mark = marked_[static_cast<std::size_t>(occupancy.offset_of(at))];
        if (mark != 0) return;
        mark = 1;
        marks_.push_back(occupancy.offset_of(at));
        visit(at);
      });
    }
    for (const Offset offset : marks_) marked_[static_cast<std::size_t>(offset)] = 0;
  }

  FieldOfView field_of_view_;
  std::vector<Ranked> ranked_;
  std::vector<std::uint8_t> marked_;  // all 0 between searches
  std::vector<Offset> marks_;
};

}  // namespace incognita
