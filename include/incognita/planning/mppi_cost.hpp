/// What plans of an MppiController cost.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/core/floor.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/planning/mppi_params.hpp"
#include "incognita/planning/polyline.hpp"

namespace incognita {

/// The costs of MppiParams, of plans that begin at one pose. What all of them ask for is laid out once: the path ahead as places at even
/// distances, and the clearance around, cut off where it costs nothing. Safe to use from many threads once it is prepared.
class MppiCost {
 public:
  /// For parameters that are valid.
  explicit MppiCost(const MppiParams& params) : params_(params) {}

  /// How far apart the places are that stand for the path.
  static constexpr double spacing_m = 0.1;

  /// Takes the path from progress_m along it on, and the clearance around the pose: distances in metres between the centres of cells, as
  /// distance_transform_m makes them, by which a cell that is not in the grid, or is NaN, is clear. All in one frame; the path must not be
  /// empty. Throws std::invalid_argument for a pose that is not finite or not within 2^30 cells of the lattice's origin, and for a reach of
  /// more than 5000 cells; what was prepared before is then as it was. O(cells in reach).
  void prepare(const Pose2& T_map_robot, const Polyline& path, double progress_m, const Grid<float, 2>& clearance_m) {
    take_clearance(T_map_robot, clearance_m);
    take_path(path, progress_m);
  }

  /// Where a plan is, and what it has cost so far.
  struct Rollout {
    UnicycleState state;    ///< in the frame of the pose and the path
    Twist2 before;          ///< the last command
    double cost = 0.0;      ///< without a unit, of the steps so far
    std::size_t place = 0;  ///< the nearest of the path

    /// At the pose that the cost was prepared for, with the command that the robot was given last.
    Rollout(const Pose2& T_map_robot, const Twist2& last) : state(T_map_robot), before(last) {}
  };

  /// Drives on by one command of a plan, which is within the robot's bounds.
  void drive(Rollout& rollout, const Twist2& command) const {
    rollout.state.drive(command, params_.step_s);
    const double speed_change = command.speed_m_per_s - rollout.before.speed_m_per_s;
    const double turn_change = command.turn_rate_rad_per_s - rollout.before.turn_rate_rad_per_s;
    rollout.before = command;
    const double stage = path_cost(rollout, command.speed_m_per_s) + obstacle_cost(rollout);
    rollout.cost += params_.step_s * stage + params_.smoothness_weight * (speed_change * speed_change + turn_change * turn_change);
  }

 private:
  /// One of the path.
  struct Place {
    double x_m;
    double y_m;
    double along_x;  // the path's direction, a unit vector, or 0 where it turns back or is no longer than a point
    double along_y;
    double left_m;   // to the last place
    double keep_m;   // the robot's radius, or what there is where the path itself comes nearer: whoever planned it has thought of that
  };

  void take_clearance(const Pose2& T_map_robot, const Grid<float, 2>& clearance_m) {
    require_finite_pose("MppiController::command", "the pose", T_map_robot);
    const Lattice<2>& lattice = clearance_m.lattice();
    const double reach_cells = params_.reach_m() / lattice.resolution_m();
    require(reach_cells <= 5000.0, "MppiController::command", "the plans' reach in cells", reach_cells, "<= 5000");
    const Eigen::Vector2d at = lattice.to_cells(T_map_robot.position());
    for (int axis = 0; axis < 2; ++axis) {
      require(std::abs(at[axis]) < 0x1p30, "MppiController::command", "a coordinate of the pose in cells", at[axis], "within 2^30 of the origin");
    }
    // One more on each side for what lies between centres, and one for rounding.
    const IndexBox<2> box = box_of_cell<2>(cell_holding<2>(at)).padded(static_cast<int>(std::ceil(reach_cells)) + 2);
    width_ = box.upper[0] - box.lower[0];
    height_ = box.upper[1] - box.lower[1];
    near_m_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    per_m_ = 1.0 / lattice.resolution_m();
    first_x_m_ = lattice.center_m(box.lower)[0];
    first_y_m_ = lattice.center_m(box.lower)[1];
    enough_m_ = params_.robot_radius_m + params_.margin_m;
    const auto enough_m = static_cast<float>(enough_m_);
    auto near_m = near_m_.begin();
    for (int y = box.lower[1]; y < box.upper[1]; ++y) {
      for (int x = box.lower[0]; x < box.upper[0]; ++x) *near_m++ = std::min(enough_m, clearance_m.value({x, y}));
    }
  }

  void take_path(const Polyline& path, double progress_m) {
    const double end_m = std::min(path.length_m(), progress_m + params_.reach_m() + params_.aim_m);
    const double length_m = std::max(0.0, end_m - progress_m);
    const auto steps = static_cast<std::size_t>(std::ceil(length_m / spacing_m));
    is_whole_ = end_m >= path.length_m();
    places_.resize(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) {
      const double left_m = std::max(0.0, length_m - static_cast<double>(i) * spacing_m);
      const Eigen::Vector2d place_m = path.point_at(end_m - (i == steps ? 0.0 : left_m));
      places_[i] = {place_m[0], place_m[1], 0.0, 0.0, i == steps ? 0.0 : left_m, params_.robot_radius_m};
      if (is_near(place_m[0], place_m[1])) places_[i].keep_m = std::min(places_[i].keep_m, clearance_at_m(place_m[0], place_m[1]));
    }
    for (std::size_t i = 0; i <= steps; ++i) {
      const Place& before = places_[i == 0 ? 0 : i - 1];
      const Place& after = places_[std::min(i + 1, steps)];
      const double x_m = after.x_m - before.x_m;
      const double y_m = after.y_m - before.y_m;
      const double chord_m = std::sqrt(x_m * x_m + y_m * y_m);
      if (!(chord_m > 1e-9)) continue;
      places_[i].along_x = x_m / chord_m;
      places_[i].along_y = y_m / chord_m;
    }
    aim_places_ = std::max<std::size_t>(1, static_cast<std::size_t>(params_.aim_m / spacing_m + 0.5));
  }

  /// A second so far from the path's end, beside the path, off the heading to the place ahead, and at another speed than would be good.
  [[nodiscard]] double path_cost(Rollout& rollout, double speed_m_per_s) const {
    const UnicycleState& at = rollout.state;
    const auto squared_m2 = [&](const Place& place) {
      const double x_m = at.x_m - place.x_m;
      const double y_m = at.y_m - place.y_m;
      return x_m * x_m + y_m * y_m;
    };
    // Never back, as PathFollower: a path that crosses itself is followed through.
    std::size_t nearest = rollout.place;
    double nearest_m2 = squared_m2(places_[nearest]);
    for (; nearest + 1 < places_.size(); ++nearest) {
      const double next_m2 = squared_m2(places_[nearest + 1]);
      if (next_m2 > nearest_m2) break;
      nearest_m2 = next_m2;
    }
    rollout.place = nearest;
    const Place& place = places_[nearest];
    const bool is_last = nearest + 1 == places_.size();
    double along_m = (at.x_m - place.x_m) * place.along_x + (at.y_m - place.y_m) * place.along_y;
    if (is_last) along_m = std::min(along_m, 0.0);
    const double aside_m2 = std::max(0.0, nearest_m2 - along_m * along_m);
    const double way_left_m = place.left_m - along_m + std::sqrt(aside_m2);

    const Place& aim = places_[std::min(nearest + aim_places_, places_.size() - 1)];
    const double aim_m = std::sqrt(squared_m2(aim));
    const double ahead_m = (aim.x_m - at.x_m) * at.cosine + (aim.y_m - at.y_m) * at.sine;
    const double heading_cosine = aim_m > 1e-6 ? ahead_m / aim_m : 1.0;
    // Before the path's end no heading is better than another.
    const double turned_off = (1.0 - heading_cosine) * std::min(1.0, aim_m / params_.aim_m);
    double wanted_m_per_s = params_.speed_max_m_per_s;
    if (is_whole_) {
      wanted_m_per_s = std::min(wanted_m_per_s, std::sqrt(2.0 * params_.deceleration_m_per_s2 * std::max(0.0, way_left_m)));
    }
    const double slower_m_per_s = std::max(0.0, heading_cosine) * wanted_m_per_s - speed_m_per_s;
    return params_.way_left_weight * way_left_m + params_.deviation_weight * aside_m2 + params_.heading_weight * turned_off +
           params_.speed_weight * slower_m_per_s * slower_m_per_s;
  }

  /// A second so near to obstacles.
  [[nodiscard]] double obstacle_cost(const Rollout& rollout) const {
    const double clearance_m = clearance_at_m(rollout.state.x_m, rollout.state.y_m);
    if (clearance_m >= enough_m_) return 0.0;
    const double share = std::min(1.0, (enough_m_ - clearance_m) / params_.margin_m);
    const double inside_m = places_[rollout.place].keep_m - clearance_m;
    const double collision = inside_m > 0.0 ? params_.collision_weight * (1.0 + inside_m / params_.robot_radius_m) : 0.0;
    return params_.obstacle_weight * share * share + collision;
  }

  /// Whether a place lies within reach.
  [[nodiscard]] bool is_near(double x_m, double y_m) const {
    const double column = (x_m - first_x_m_) * per_m_;
    const double row = (y_m - first_y_m_) * per_m_;
    return column >= 0.0 && column < width_ - 1 && row >= 0.0 && row < height_ - 1;
  }

  /// Between the centres of cells, of a place within reach.
  [[nodiscard]] double clearance_at_m(double x_m, double y_m) const {
    const double column = (x_m - first_x_m_) * per_m_;
    const double row = (y_m - first_y_m_) * per_m_;
    const int x = floor_to_int(column);
    const int y = floor_to_int(row);
    const double right = column - x;
    const double up = row - y;
    const float* const corner_m = near_m_.data() + static_cast<std::ptrdiff_t>(y) * width_ + x;
    const auto at = [&](std::ptrdiff_t offset) { return static_cast<double>(corner_m[offset]); };
    return (1.0 - up) * ((1.0 - right) * at(0) + right * at(1)) + up * ((1.0 - right) * at(width_) + right * at(width_ + 1));
  }

  MppiParams params_;
  std::vector<Place> places_;
  std::size_t aim_places_ = 1;
  bool is_whole_ = false;       // whether the last place is the path's end
  std::vector<float> near_m_;   // clearance by cell, x fastest, cut off at enough_m_
  int width_ = 0;               // of its rows
  int height_ = 0;              // of its columns
  double per_m_ = 0.0;          // cells
  double first_x_m_ = 0.0;      // the centre of its first cell
  double first_y_m_ = 0.0;
  double enough_m_ = 0.0;
};

}  // namespace incognita
