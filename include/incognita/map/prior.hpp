/// Maps that start from what is known already: a floor plan, or the map of an earlier run.
#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/map/map.hpp"

namespace incognita {

/// How a prior is taken.
struct PriorParams {
  /// Takes the prior's frame to the map's. An explorer's map has its origin where the robot starts, so there: the inverse of where the
  /// robot stands in the prior.
  Pose2 T_map_prior = {};
  /// What is surer than this is taken as no surer, so that scans can say otherwise: a map_server map in trinary mode knows 0 and 1 alone.
  double probability_min = 0.02;  ///< in (0, 0.5)
  double probability_max = 0.98;  ///< in (0.5, 1)

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require(probability_min > 0.0 && probability_min < 0.5, "PriorParams", "probability_min", probability_min, "in (0, 0.5)");
    require(probability_max > 0.5 && probability_max < 1.0, "PriorParams", "probability_max", probability_max, "in (0.5, 1)");
    if (!T_map_prior.is_finite()) throw std::invalid_argument("PriorParams: T_map_prior is not finite");
  }
};

/// The log-odds of a map's cells, of side resolution_m on a lattice with its origin at 0, that a grid of probabilities tells: NaN where
/// it does not know, which gives 0, as 0.5 does. The grid may have any resolution and origin and may be turned. A cell takes the most
/// occupied of what is known at its centre and of the prior's cells with their centres in it, so that no wall gets lost, be it thinner
/// than a cell; a prior on the same lattice comes over as it is. Throws std::invalid_argument for bad parameters and probabilities
/// outside of 0..1, and std::length_error for a grid that is too large or too far away. O(cells of both).
template <int Dim>
[[nodiscard]] Grid<float, Dim> prior_log_odds(const Grid<float, Dim>& probabilities, double resolution_m, const PriorParams& params = {}) {
  static_assert(Dim == 2, "priors are of the plane");
  params.validate();
  const Lattice<2> lattice(resolution_m);
  const Lattice<2>& from = probabilities.lattice();
  const IndexBox<2>& cells = probabilities.box();
  if (cells.empty()) return Grid<float, 2>(lattice);

  // From the middle of one corner's cell to that of the other, less a little for rounding, so that equal lattices give equal boxes.
  constexpr double inset_cells = 1e-6;
  Box<Point<2>> box_m;
  bool is_first = true;
  for (const int x : {cells.lower[0], cells.upper[0]}) {
    for (const int y : {cells.lower[1], cells.upper[1]}) {
      const Point<2> inset((x == cells.lower[0] ? inset_cells : -inset_cells), (y == cells.lower[1] ? inset_cells : -inset_cells));
      const Point<2> corner(x + inset[0], y + inset[1]);
      const Point<2> corner_m = params.T_map_prior * sum(from.origin_m(), scaled(corner, from.resolution_m()));
      if (!(std::abs(corner_m[0]) < 1e9 * resolution_m && std::abs(corner_m[1]) < 1e9 * resolution_m)) {
        throw std::length_error("prior_log_odds: the prior lies more than 1e9 cells from the map's origin");
      }
      if (is_first) box_m = {corner_m, corner_m};
      is_first = false;
      box_m.stretch_to(corner_m);
    }
  }

  Grid<float, 2> log_odds(lattice, lattice.cells_of(box_m), 0.0F);
  const auto log_odds_of = [&](float probability) {
    const auto p = static_cast<double>(probability);
    require(p >= 0.0 && p <= 1.0, "prior_log_odds", "a probability", p, "in 0..1, or NaN");
    const double held = std::clamp(p, params.probability_min, params.probability_max);
    return static_cast<float>(std::log(held / (1.0 - held)));
  };
  const Pose2 T_prior_map = params.T_map_prior.inverse();
  for (Offset offset = 0; offset < static_cast<Offset>(log_odds.size()); ++offset) {
    const Index<2> at = from.index_of(T_prior_map * lattice.center_m(log_odds.index_at(offset)));
    if (!probabilities.contains(at)) continue;
    const float probability = probabilities[probabilities.offset_of(at)];
    if (!std::isnan(probability)) log_odds[offset] = log_odds_of(probability);
  }
  for (Offset offset = 0; offset < static_cast<Offset>(probabilities.size()); ++offset) {
    if (std::isnan(probabilities[offset])) continue;
    const float given = log_odds_of(probabilities[offset]);
    const Index<2> to = lattice.index_of(params.T_map_prior * from.center_m(probabilities.index_at(offset)));
    if (!log_odds.contains(to)) continue;
    float& held = log_odds[log_odds.offset_of(to)];
    held = held == 0.0F ? given : std::max(held, given);
  }
  return log_odds;
}

/// A map that believes a grid of probabilities before its first scan; see prior_log_odds for what is thrown and what it costs. Frontiers,
/// planning and information gain take it as what was measured. A filter that registers scans with surfaces (DvlEkf) finds its first
/// surfaces in its first scans, not in the prior, but holds its scans against the prior: where it is wrong about the place around
/// the start, scans are not trusted.
template <class Cell = TBayes>
[[nodiscard]] Map<Cell, 2> map_with_prior(const Grid<float, 2>& probabilities, const MapParams& map_params = {},
                                          const PriorParams& prior = {}, Cell cell = Cell{}) {
  static_assert(CellPolicy<Cell>, "map_with_prior: Cell is no cell policy, see CellPolicy in map/cell_policy.hpp");
  static_assert(PriorPolicy<Cell>,
                "map_with_prior: this cell policy cannot start from log-odds; give it State state_of_log_odds(float) const, see PriorPolicy "
                "in map/cell_policy.hpp");
  if constexpr (PriorPolicy<Cell>) {
    return Map<Cell, 2>(prior_log_odds(probabilities, map_params.resolution_m, prior), map_params, std::move(cell));
  }
}

}  // namespace incognita
