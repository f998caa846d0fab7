/// Ways to go and see: candidate paths to frontiers and what each is worth.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/parallel.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/polyline.hpp"

namespace incognita {

/// A way to go and see a frontier.
struct Candidate {
  Eigen::Vector2d frontier_m{0.0, 0.0};     ///< a cell of the frontier, near its middle
  std::vector<Index<2>> frontier;           ///< its cells
  Index<2> viewpoint = zero<Index<2>>();    ///< from where it is seen
  Polyline path;                            ///< from the robot to there
  double gain_nats = 0.0;                   ///< what the path is predicted to tell, BIG with a behavioral entropy; 0 where it was not asked
  double information = 0.0;                 ///< what the frontier is measured by, in the unit of the FrontierInformation
  double navigation_cost = 0.0;             ///< of getting there, in metres, or 1 (NavigationCost::uniform)
  double utility = 0.0;                     ///< what candidates are ranked by: information per cost, in their units' ratio

  /// Where the path ends, in the map's frame. The path must not be empty.
  [[nodiscard]] const Eigen::Vector2d& goal_m() const { return path.points_m().back(); }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(frontier_m, frontier, viewpoint, path, gain_nats, information, navigation_cost, utility);
    archive.require(!path.empty(), "a candidate has no path");
  }
};

/// Scratch of evaluate_candidates, kept from one call to the next.
template <CellPolicy Cell>
struct CandidateScratch {
  /// What one thread needs.
  struct Worker {
    GainWorkspace<Cell> workspace;  ///< its own
    bool has_looked = false;        ///< at the map of this call
  };
  std::vector<Worker> workers;     ///< one a thread
  std::vector<std::size_t> order;  ///< in which candidates are evaluated
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
