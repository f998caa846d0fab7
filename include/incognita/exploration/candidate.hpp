/// Ways to go and see: candidate paths to frontiers and what each is worth.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/parallel.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/travel_cost.hpp"

namespace incognita {

/// A path from the robot to a place from which a frontier is seen.
struct Candidate {
  Eigen::Vector2d frontier_m{0.0, 0.0};  ///< a cell of the frontier, near its middle
  std::vector<Index<2>> sought;                          ///< the unknown cells beside the frontier
  Polyline path;                                         ///< from the robot to the goal
  double gain_nats = 0.0;  ///< what the path is predicted to tell; BIG with a behavioral entropy
  double utility = 0.0;    ///< what candidates are ranked by

  [[nodiscard]] const Eigen::Vector2d& goal_m() const { return path.points_m().back(); }
};

/// The reachable cell nearest to `target` within radius_m from which the straight line to the target meets no occupied
/// cell; among equals the one cheapest to reach. None when there is no such cell.
[[nodiscard]] inline std::optional<Index<2>> find_viewpoint(const OccupancyGrid<2>& occupancy,
                                                            const TravelCostField& field, const Index<2>& target,
                                                            double radius_m) {
  const Lattice<2>& lattice = occupancy.lattice();
  const double radius_cells = radius_m / lattice.resolution_m();
  constexpr double rounding = 1e-9;  // 0.3 m of 0.1 m cells are 3
  const int reach = static_cast<int>(radius_cells + rounding);
  const auto sees_target = [&](const Index<2>& from) {
    bool clear = true;
    traverse<2>(lattice, lattice.center_m(from), lattice.center_m(target), [&](const Index<2>& index) {
      clear = occupancy.value(index) != Occupancy::occupied;
      return clear;
    });
    return clear;
  };
  std::optional<Index<2>> best;
  int best_distance2 = static_cast<int>(radius_cells * radius_cells + rounding);
  float best_cost_m = std::numeric_limits<float>::infinity();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const int distance2 = dx * dx + dy * dy;
      if (distance2 > best_distance2) continue;
      const Index<2> index(target[0] + dx, target[1] + dy);
      if (!field.reaches(index)) continue;
      const float cost_m = field.cost_m(index);
      if (distance2 == best_distance2 && cost_m >= best_cost_m) continue;
      if (!sees_target(index)) continue;
      best = index;
      best_distance2 = distance2;
      best_cost_m = cost_m;
    }
  }
  return best;
}

/// The unknown cells that share a face with a cell of the frontier, each once, in storage order.
template <int Dim>
[[nodiscard]] std::vector<Index<Dim>> unknown_beside(const OccupancyGrid<Dim>& occupancy,
                                                     const Frontier<Dim>& frontier) {
  std::vector<Index<Dim>> unknown;
  for (const Index<Dim>& cell : frontier.cells) {
    for (int axis = 0; axis < Dim; ++axis) {
      for (const int side : {-1, 1}) {
        Index<Dim> beside = cell;
        beside[axis] += side;
        if (occupancy.value(beside) == Occupancy::unknown) unknown.push_back(beside);
      }
    }
  }
  std::sort(unknown.begin(), unknown.end(), is_stored_before<Dim>);
  unknown.erase(std::unique(unknown.begin(), unknown.end(), equal<Index<Dim>>), unknown.end());
  return unknown;
}

/// Scratch of evaluate_candidates, kept from one call to the next.
template <CellPolicy Cell>
struct CandidateScratch {
  struct Worker {
    GainWorkspace<Cell> workspace;
    bool has_looked = false;  // at the map of this call
  };
  std::vector<Worker> workers;
  std::vector<std::size_t> order;
};

/// The information gain of every candidate, into its gain_nats, over `threads` threads (0: OpenMP's own number). Each
/// candidate is evaluated by itself, so the result does not depend on the number of threads. The longest paths come first, so that
/// no thread is left with one in the end.
template <CellPolicy Cell, class Filter>
void evaluate_candidates(const Map<Cell, 2>& map, const EntropyTable& entropy, const Filter& filter,
                         std::vector<Candidate>& candidates, const GainParams& params, int threads,
                         CandidateScratch<Cell>& scratch) {
  using Worker = typename CandidateScratch<Cell>::Worker;
  scratch.workers.resize(std::max(scratch.workers.size(), static_cast<std::size_t>(worker_count(threads))));
  for (Worker& worker : scratch.workers) worker.has_looked = false;
  scratch.order.resize(candidates.size());
  std::iota(scratch.order.begin(), scratch.order.end(), std::size_t{0});
  std::sort(scratch.order.begin(), scratch.order.end(), [&](std::size_t a, std::size_t b) {
    return candidates[a].path.length_m() > candidates[b].path.length_m();
  });
  for_each_index(candidates.size(), threads, [&](std::size_t place, int number) {
    Candidate& candidate = candidates[scratch.order[place]];
    Worker& worker = scratch.workers[static_cast<std::size_t>(number)];
    if (!std::exchange(worker.has_looked, true)) worker.workspace.overlay.look_at(map);
    candidate.gain_nats = information_gain(entropy, filter, candidate.path, params, worker.workspace);
  });
}

}  // namespace incognita
