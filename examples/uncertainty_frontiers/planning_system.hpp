/// The four planning systems of section 5.2.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "incognita/frontier/uncertainty_frontier.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/planning/landmark_cost.hpp"
#include "incognita/planning/random_tree.hpp"
#include "uncertainty_frontiers/robot.hpp"

namespace uncertainty_frontiers {

/// How a robot chooses where to go, and its way there.
struct PlanningSystem {
  const char* name;
  bool by_uncertainty;  ///< uncertainty frontiers, else classical ones
  bool by_landmarks;    ///< RRT* with (A.15), else RRT
  double sigma_max_m;
};

inline constexpr std::array<PlanningSystem, 4> planning_systems{
    {{"PPS1", false, false, 1.0}, {"PPS2", false, true, 1.0}, {"PPS3", true, true, 0.6}, {"PPS4", true, true, 1.0}}};

inline constexpr double obstacle_distance_m = 0.5;  ///< d_min: objectives nearer to an obstacle are discarded
inline constexpr double arrival_m = 1.0;            ///< an objective is reached from here on

/// What a robot knows of where it can drive.
class KnownFloor {
 public:
  /// Where its body stands nothing else does, whatever the map says.
  KnownFloor(const Belief& map, const Eigen::Vector2d& robot_m) : occupancy_(incognita::classify(map)) {
    for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(occupancy_.size()); ++offset) {
      const Eigen::Vector2d cell_m = occupancy_.lattice().center_m(occupancy_.index_at(offset));
      if ((cell_m - robot_m).norm() <= clearance_needed_m) occupancy_[offset] = incognita::Occupancy::free;
    }
    clearance_m_ = incognita::distance_transform_m(occupancy_, [](incognita::Occupancy cell) { return cell == incognita::Occupancy::occupied; });
  }

  [[nodiscard]] const incognita::OccupancyGrid<2>& occupancy() const { return occupancy_; }

  /// From the nearest obstacle that is known.
  [[nodiscard]] double clearance_m(const incognita::Index<2>& cell) const { return static_cast<double>(clearance_m_.value(cell)); }

  /// Whether a body may drive straight from one place to another, over floor that is known to be free; out of a tight place it
  /// may drive where it is no tighter.
  [[nodiscard]] bool is_clear(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
    const double from_clearance_m = clearance_m(occupancy_.lattice().index_of(from_m));
    return all_cells(from_m, to_m, [&](const incognita::Index<2>& cell) {
      const bool is_tight = clearance_m(cell) < std::min(clearance_needed_m, from_clearance_m);
      return occupancy_.value(cell) == incognita::Occupancy::free && !is_tight;
    });
  }

  /// Whether nothing that is known stands between two places.
  [[nodiscard]] bool is_in_sight(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
    return all_cells(from_m, to_m, [&](const incognita::Index<2>& cell) { return occupancy_.value(cell) != incognita::Occupancy::occupied; });
  }

 private:
  template <class IsFine>
  [[nodiscard]] bool all_cells(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, IsFine&& is_fine) const {
    bool all = true;
    incognita::traverse<2>(occupancy_.lattice(), from_m, to_m, [&](const incognita::Index<2>& cell) { return all = all && is_fine(cell); });
    return all;
  }

  static constexpr double clearance_needed_m = body_radius_m + 0.1;

  incognita::OccupancyGrid<2> occupancy_;
  incognita::Grid<float, 2> clearance_m_{occupancy_.lattice()};
};

/// The sigmas of the landmarks that a robot expects to see from each place, by squares of half a metre.
class ExpectedSight {
 public:
  ExpectedSight(const Robot& robot, const KnownFloor& floor, const incognita::Box<Eigen::Vector2d>& box_m) : lattice_(0.5) {
    sigmas_m_ = incognita::Grid<float, 2>(lattice_, lattice_.cells_of(box_m), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < robot.slam().landmarks().size(); ++i) {
      const auto sigma_m = static_cast<float>(incognita::mean_sigma(robot.slam().landmark_covariance_m2(i)));
      const Eigen::Vector2d landmark_m = robot.landmark_m(i);
      for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(sigmas_m_.size()); ++offset) {
        const Eigen::Vector2d from_m = lattice_.center_m(sigmas_m_.index_at(offset));
        const Eigen::Vector2d away_m = landmark_m - from_m;
        if (sigma_m >= sigmas_m_[offset] || away_m.norm() > sight_m) continue;
        // A landmark stands on a wall: what is seen ends before it.
        const Eigen::Vector2d before_m = landmark_m - away_m.normalized() * std::min(0.5, away_m.norm());
        if (floor.is_in_sight(from_m, before_m)) sigmas_m_[offset] = sigma_m;
      }
    }
  }

  template <class Visit>
  void operator()(const Eigen::Vector2d& place_m, Visit&& visit) const {
    const incognita::Index<2> square = lattice_.index_of(place_m);
    if (!sigmas_m_.contains(square)) return;
    const float sigma_m = sigmas_m_[sigmas_m_.offset_of(square)];
    if (std::isfinite(sigma_m)) visit(static_cast<double>(sigma_m));
  }

 private:
  incognita::Lattice<2> lattice_;
  incognita::Grid<float, 2> sigmas_m_{lattice_};
};

/// A way to an objective.
struct Plan {
  Eigen::Vector2d objective_m;
  std::vector<Eigen::Vector2d> way_m;
  double length_m;
};

/// The frontiers of a map that a system goes to.
[[nodiscard]] inline std::vector<incognita::Frontier<2>> objectives(const PlanningSystem& system, const Belief& map, const KnownFloor& floor) {
  if (system.by_uncertainty) {
    incognita::UncertaintyFrontierParams params;
    params.obstacle_distance_min_m = obstacle_distance_m;
    return incognita::find_uncertainty_frontiers(map, {}, params);
  }
  std::vector<incognita::Index<2>> cells = incognita::detect_frontier<2>(floor.occupancy());
  std::erase_if(cells, [&](const incognita::Index<2>& cell) { return floor.clearance_m(cell) < obstacle_distance_m; });
  return incognita::cluster_frontier<2>(map.lattice(), cells);
}

/// Of a tree's ways to each objective the cheapest; of these the shortest. None when no objective is reached.
template <class Cost>
[[nodiscard]] std::optional<Plan> best_plan(const incognita::RandomTree<Cost>& tree, const std::vector<Eigen::Vector2d>& objectives_m,
                                            const KnownFloor& floor) {
  std::optional<Plan> best;
  for (const Eigen::Vector2d& objective_m : objectives_m) {
    std::size_t cheapest = tree.none;
    for (std::size_t node = 0; node < tree.nodes().size(); ++node) {
      const auto& candidate = tree.nodes()[node];
      if ((candidate.place_m - objective_m).norm() > arrival_m || (cheapest != tree.none && candidate.cost >= tree.nodes()[cheapest].cost)) continue;
      if (floor.is_in_sight(candidate.place_m, objective_m)) cheapest = node;
    }
    if (cheapest == tree.none) continue;
    Plan plan{objective_m, tree.way_to(cheapest), 0.0};
    for (std::size_t i = 1; i < plan.way_m.size(); ++i) plan.length_m += (plan.way_m[i] - plan.way_m[i - 1]).norm();
    if (!best || plan.length_m < best->length_m) best = std::move(plan);
  }
  return best;
}

[[nodiscard]] inline std::optional<Plan> make_plan(const PlanningSystem& system, const Robot& robot, const KnownFloor& floor,
                                                   const std::vector<Eigen::Vector2d>& objectives_m, incognita::Random& random) {
  const incognita::Box<incognita::Point<2>> box_m{{-1.0, -1.0}, {hall_width_m + 1.0, hall_height_m + 1.0}};
  const auto is_clear = [&](const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) { return floor.is_clear(from_m, to_m); };
  incognita::RandomTreeParams params;
  params.samples = 2000;
  params.radius_m = system.by_landmarks ? 3.0 : 0.0;
  if (!system.by_landmarks) {
    const incognita::RandomTree<incognita::LengthCost> tree(robot.position_m(), box_m, is_clear, {}, random, params);
    return best_plan(tree, objectives_m, floor);
  }
  incognita::LandmarkCostParams cost_params;
  const double sigma_m = robot.position_sigma_m();
  cost_params.start_odometry_m = sigma_m * sigma_m / noise_m2_per_m;  // what it takes to become as uncertain as it is
  const incognita::LandmarkCost<ExpectedSight> cost(ExpectedSight(robot, floor, box_m), cost_params);
  const incognita::RandomTree<incognita::LandmarkCost<ExpectedSight>> tree(robot.position_m(), box_m, is_clear, cost, random, params);
  return best_plan(tree, objectives_m, floor);
}

}  // namespace uncertainty_frontiers
