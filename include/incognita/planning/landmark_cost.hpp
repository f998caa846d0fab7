/// A cost of ways that keep landmarks in sight (Sansoni et al., (A.15)).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// Which of several landmarks in sight counts.
enum class LandmarkRule {
  best,  ///< the one known best
  last   ///< the last that is told of, as the paper does
};

/// The scale of (A.15).
struct LandmarkCostParams {
  double cell_m = 0.1;                     ///< c, > 0
  double process_sigma_m = 0.1;            ///< Q tilde = |Q|^(1 / 2N), > 0; the paper says 0.01 where its Q = 0.01 I has 0.1
  double start_odometry_m = 0.0;           ///< what the robot has driven without landmarks before the start, >= 0
  LandmarkRule rule = LandmarkRule::best;  ///< of several in sight

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("LandmarkCostParams", "cell_m", cell_m);
    require_positive("LandmarkCostParams", "process_sigma_m", process_sigma_m);
    require_non_negative("LandmarkCostParams", "start_odometry_m", start_odometry_m);
  }
};

/// C = d + d_odo + 2 sigma_l / (c Q), (A.15), a WayCost: the length of a way in cells, the length of what is driven without a landmark
/// in sight since the last, and how well that one is known (0 before the first, as the paper has it, so that the first may cost more than none). for_each_in_sight(place_m, visit) calls visit(sigma_m) for each
/// landmark that is seen from a place, with mean_sigma of its covariance.
template <class ForEachInSight>
class LandmarkCost {
 public:
  /// The terms of (A.15) at a place.
  struct State {
    double length_cells = 0.0;      ///< d, of the whole way
    double odometry_cells = 0.0;    ///< d_odo, driven without a landmark since the last
    double landmark_sigma_m = 0.0;  ///< sigma_l of that landmark, 0 before the first
  };

  /// Throws std::invalid_argument for bad parameters.
  LandmarkCost(ForEachInSight for_each_in_sight, const LandmarkCostParams& params)
      : for_each_in_sight_(std::move(for_each_in_sight)), params_(params) {
    params_.validate();
  }

  [[nodiscard]] State start() const { return {0.0, params_.start_odometry_m / params_.cell_m, 0.0}; }  ///< where the way begins

  /// After a straight piece, with what is in sight at its end. Positions in the frame of the tree.
  [[nodiscard]] State extend(const State& state, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const {
    const double edge_cells = distance(from_m, to_m) / params_.cell_m;
    State next{state.length_cells + edge_cells, state.odometry_cells + edge_cells, state.landmark_sigma_m};
    bool sees_any = false;
    for_each_in_sight_(to_m, [&](double sigma_m) {
      next.landmark_sigma_m = sees_any && params_.rule == LandmarkRule::best ? std::min(next.landmark_sigma_m, sigma_m) : sigma_m;
      sees_any = true;
    });
    if (sees_any) next.odometry_cells = 0.0;
    return next;
  }

  /// C of (A.15), in cells.
  [[nodiscard]] double total(const State& state) const {
    return state.length_cells + state.odometry_cells + 2.0 * state.landmark_sigma_m / (params_.cell_m * params_.process_sigma_m);
  }

 private:
  ForEachInSight for_each_in_sight_;
  LandmarkCostParams params_;
};

}  // namespace incognita
