/// From a travel cost field to a path that a robot can follow, and whether a path is still clear.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/planning/polyline.hpp"
#include "incognita/planning/travel_cost.hpp"

namespace incognita {

/// The cheapest path from the field's start to the centre of `goal`, from cell centre to cell centre after
/// the start itself. Empty when the goal cannot be reached.
[[nodiscard]] inline std::vector<Eigen::Vector2d> find_path(const TravelCostField& field,
                                                            const Index<2>& goal) {
  std::vector<Eigen::Vector2d> path_m;
  for (const Index<2>& cell : field.cells_to(goal)) path_m.push_back(field.lattice().center_m(cell));
  if (path_m.empty()) return path_m;
  if (path_m.size() == 1 && !equal(path_m.front(), field.start_m())) path_m.insert(path_m.begin(), field.start_m());
  path_m.front() = field.start_m();
  return path_m;
}

/// The cost in metres of driving straight from one place to another; infinity when a cell on the way is not
/// passable. Sampled every half cell.
[[nodiscard]] inline double straight_cost_m(const TravelCostField& field, const Eigen::Vector2d& from_m,
                                            const Eigen::Vector2d& to_m) {
  bool passable = true;
  traverse<2>(field.lattice(), from_m, to_m, [&](const Index<2>& index) {
    passable = field.is_passable(index);
    return passable;
  });
  if (!passable) return std::numeric_limits<double>::infinity();
  const Eigen::Vector2d way_m = difference(to_m, from_m);
  const double length_m = norm(way_m);
  const double samples = std::max(1.0, std::ceil(2.0 * length_m / field.lattice().resolution_m()));
  const Eigen::Vector2d from = field.lattice().to_cells(from_m);
  const Eigen::Vector2d step = scaled(difference(field.lattice().to_cells(to_m), from), 1.0 / samples);
  double cost_per_m = 0.0;
  for (double sample = 0.5; sample < samples; sample += 1.0) {
    cost_per_m += static_cast<double>(field.cost_per_m(cell_holding<2>(sum(from, scaled(step, sample)))));
  }
  return length_m * cost_per_m / samples;
}

/// The path with fewer corners: straight wherever that keeps to passable cells and costs at most 1 +
/// `slack`, a fraction, times what the path itself does. Places are in the map's frame. Its ends stay, and
/// so do steps where the robot lacks clearance (see TravelCostField). Throws std::invalid_argument unless
/// slack is finite and >= 0. O(corners x the longest straight part).
[[nodiscard]] inline std::vector<Eigen::Vector2d> shorten_path(const TravelCostField& field,
                                                               const std::vector<Eigen::Vector2d>& path_m,
                                                               double slack = 0.02) {
  require_non_negative("shorten_path", "slack", slack);
  if (path_m.size() < 3) return path_m;
  std::vector<Eigen::Vector2d> shorter_m{path_m.front()};
  std::size_t anchor = 0;
  while (anchor + 1 < path_m.size()) {
    std::size_t end = anchor + 1;
    double along_cost_m = straight_cost_m(field, path_m[anchor], path_m[end]);
    for (std::size_t next = end + 1; next < path_m.size() && std::isfinite(along_cost_m); ++next) {
      along_cost_m += straight_cost_m(field, path_m[next - 1], path_m[next]);
      const double straight_m = straight_cost_m(field, path_m[anchor], path_m[next]);
      if (!(straight_m <= (1.0 + slack) * along_cost_m)) break;
      end = next;
    }
    shorter_m.push_back(path_m[end]);
    anchor = end;
  }
  return shorter_m;
}

/// Whether no cell for which is_occupied(index) holds has its centre within `radius_m` of the path, from
/// `from_m` along it to its end. O(path length x radius / cell area).
template <class IsOccupied>
[[nodiscard]] bool path_is_clear(const Polyline& path, const Lattice<2>& lattice, double radius_m,
                                 IsOccupied&& is_occupied, double from_m = 0.0) {
  if (path.empty()) return true;
  constexpr double piece_m = 1.0;  // in pieces, since the box around a long diagonal is mostly far from it
  const double reach_m = radius_m + lattice.resolution_m();
  double along_m = std::clamp(from_m, 0.0, path.length_m());
  Eigen::Vector2d begin_m = path.point_at(along_m);
  do {
    const std::size_t corner = path.corner_after(along_m);
    along_m = std::min(along_m + piece_m, std::max(along_m, path.arc_m(corner)));
    const Eigen::Vector2d end_m = path.point_at(along_m);
    const Eigen::Vector2d piece = difference(end_m, begin_m);
    const double length2 = dot(piece, piece);
    Box<Point<2>> around{begin_m, begin_m};
    around.stretch_to(end_m);
    const IndexBox<2> cells = lattice.cells_of(around.padded(reach_m));
    for (int y = cells.lower[1]; y < cells.upper[1]; ++y) {
      for (int x = cells.lower[0]; x < cells.upper[0]; ++x) {
        const Eigen::Vector2d offset = difference(lattice.center_m({x, y}), begin_m);
        const double share = length2 > 0.0 ? std::clamp(dot(offset, piece) / length2, 0.0, 1.0) : 0.0;
        const Eigen::Vector2d aside = difference(offset, scaled(piece, share));
        if (dot(aside, aside) < radius_m * radius_m && is_occupied(Index<2>(x, y))) return false;
      }
    }
    begin_m = end_m;
  } while (along_m < path.length_m());
  return true;
}

}  // namespace incognita
