/// Who steers the robot along the explorer's paths.
#pragma once

#include <optional>
#include <string_view>

#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/grid/lattice.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/planning/clearance_window.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/mppi.hpp"
#include "incognita/planning/room_aside.hpp"
#include "incognita/sensor/scan.hpp"

namespace examples {

/// The explorer's own follower, or an MppiController.
class Steering {
 public:
  /// `controller` is "follower" or "mppi", the radius that of the robot, the lattice that of the explorer's map.
  Steering(std::string_view controller, double robot_radius_m, const incognita::Lattice<2>& lattice,
           double speed_max_m_per_s = incognita::MppiParams{}.speed_max_m_per_s)
      : window_(lattice) {
    if (controller != "mppi") return;
    incognita::MppiParams params;
    params.speed_max_m_per_s = speed_max_m_per_s;
    params.robot_radius_m = robot_radius_m + incognita::CollisionGuardParams{}.creep_margin_m;
    controller_.emplace(params);
  }

  /// What the robot is told until the next scan.
  template <class Explorer>
  [[nodiscard]] incognita::Twist2 operator()(Explorer& explorer, const incognita::Scan<2>& scan) {
    using namespace incognita;
    if (!controller_) return explorer.command(scan);
    const OccupancyGrid<2>& occupancy = explorer.occupancy().grid();
    const bool is_open = explorer.closed().none();
    const auto is_obstacle = [&](const Index<2>& cell) {
      return occupancy.value(cell) == Occupancy::occupied || (!is_open && explorer.closed().bits().get(cell));
    };
    const MppiParams& params = controller_->params();
    const double keep_m = params.robot_radius_m + params.margin_m;
    const double reach_m = params.reach_m() + keep_m;
    return explorer.command(scan, [&](const Pose2& T_map_robot, const Scan<2>& latest, const PathFollower& course) {
      window_.measure(T_map_robot.position(), reach_m, is_obstacle);
      const Grid<float, 2>& clearance_m = window_.lower_to(near_hits_m(T_map_robot, latest, reach_m), keep_m);
      if (!is_tight(course, clearance_m)) return controller_->command(T_map_robot, course, clearance_m);
      controller_->forget();
      return PathFollower(course).command(T_map_robot, latest, explorer.params().guard);
    });
  }

  template <class Archive>
  void archive_state(Archive& archive) {
    if (controller_) archive(*controller_);
  }

 private:
  /// Whether the path leads through something so narrow that clearance by cells does not tell its middle. There the follower steers, by
  /// what the scan shows.
  [[nodiscard]] bool is_tight(const incognita::PathFollower& course, const incognita::Grid<float, 2>& clearance_m) const {
    const double enough_m = controller_->params().robot_radius_m + 0.5 * clearance_m.resolution_m();
    const double end_m = course.progress_m() + course.params().lookahead_m;
    for (double along_m = course.progress_m() - controller_->params().robot_radius_m; along_m < end_m; along_m += clearance_m.resolution_m()) {
      const incognita::Index<2> cell = clearance_m.lattice().index_of(course.path().point_at(along_m));
      if (static_cast<double>(clearance_m.value(cell)) < enough_m) return true;
    }
    return false;
  }

  std::optional<incognita::MppiController> controller_;
  incognita::ClearanceWindow window_;
};

}  // namespace examples
