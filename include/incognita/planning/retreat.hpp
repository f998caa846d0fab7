/// The way out for a robot that stands so near to something that no path can begin there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// How a robot gets out of a tight place.
struct RetreatParams {
  double distance_m = 0.1;           ///< how far it goes
  double speed_m_per_s = 0.1;        ///< of driving
  double turn_rate_rad_per_s = 0.5;  ///< of turning
  double aim_rad = 0.1;              ///< it drives once its heading is this near to the way out
  double look_m = 0.5;               ///< ways that are free for this long are as good as each other
  int headings = 36;                 ///< how many ways are tried
  int blocked_scans_max = 10;        ///< a way out is given up when it was blocked more often than this in a row

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("RetreatParams", "distance_m", distance_m);
    require_positive("RetreatParams", "speed_m_per_s", speed_m_per_s);
    require_positive("RetreatParams", "turn_rate_rad_per_s", turn_rate_rad_per_s);
    require_positive("RetreatParams", "aim_rad", aim_rad);
    require_positive("RetreatParams", "look_m", look_m);
    require(headings >= 4, "RetreatParams", "headings", headings, ">= 4");
    require(blocked_scans_max >= 0, "RetreatParams", "blocked_scans_max", blocked_scans_max, ">= 0");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "distance_m, speed_m_per_s, turn_rate_rad_per_s, aim_rad, look_m, headings, blocked_scans_max",
        distance_m, speed_m_per_s, turn_rate_rad_per_s, aim_rad, look_m, headings, blocked_scans_max);
  }
};

/// The turn, in (-pi, pi], to the heading in which a disc can drive straight for longest, up to look_m; among equals, the
/// smallest. What is nearer than its radius and creep margin already must not come nearer still, as guard_command has
/// it. `scan` is in the robot's frame. O(headings * near beams).
[[nodiscard]] inline double turn_to_way_out_rad(const Scan<2>& scan, const CollisionGuardParams& guard,
                                                const RetreatParams& params) {
  struct Obstacle {
    Eigen::Vector2d at_m;
    double keep_m;
  };
  std::vector<Obstacle> obstacles;
  const double keep_m = guard.robot_radius_m + guard.creep_margin_m;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit || scan.range_m(beam) > keep_m + params.look_m) continue;
    const double range_m = smoothed_range_m(scan, beam);
    obstacles.push_back({scaled(scan.direction(beam), range_m), std::min(range_m, keep_m)});
  }
  double best_free_m = -1.0;
  double best_turn_rad = 0.0;
  for (int heading = 0; heading < params.headings; ++heading) {
    const double turn_rad = wrap_angle_rad(2.0 * std::numbers::pi * heading / params.headings);
    const Eigen::Vector2d ahead(std::cos(turn_rad), std::sin(turn_rad));
    double free_m = params.look_m;
    for (const Obstacle& obstacle : obstacles) {
      const Eigen::Vector2d seen_m(dot(ahead, obstacle.at_m),
                                   ahead[0] * obstacle.at_m[1] - ahead[1] * obstacle.at_m[0]);
      free_m = std::min(free_m, distance_to_contact_m(seen_m, 0.0, obstacle.keep_m));
    }
    const bool better = free_m > best_free_m ||
                        (free_m == best_free_m && std::abs(turn_rad) < std::abs(best_turn_rad));
    if (!better) continue;
    best_free_m = free_m;
    best_turn_rad = turn_rad;
  }
  return best_turn_rad;
}

/// A robot's retreat from where it stands. It keeps to the way out that it has chosen until it faces that and cannot drive for
/// a while: of two ways that are nearly as good, each scan's noise would choose another, and the robot would face neither, or
/// turn to and fro between the two ends of a passage hardly wider than itself.
class Retreat {
 public:
  /// From where the robot is, with its latest scan, which is in its frame. Throws std::invalid_argument for parameters
  /// outside of their bounds.
  Retreat(const Pose2& T_map_robot, const Scan<2>& scan, const CollisionGuardParams& guard,
          const RetreatParams& params = {})
      : guard_(guard), params_(params), from_m_(T_map_robot.position()) {
    guard.validate();
    params.validate();
    choose_heading(T_map_robot, scan);
  }

  /// Whether the robot has come far enough.
  [[nodiscard]] bool is_over(const Pose2& T_map_robot) const {
    return distance(T_map_robot.position(), from_m_) >= params_.distance_m;
  }

  /// The speeds that turn the robot on the spot, which is safe for a disc, towards the way out and then take it there,
  /// slowed down by guard_command. `scan` is in the robot's frame, its latest.
  [[nodiscard]] Twist2 command(const Pose2& T_map_robot, const Scan<2>& scan) {
    const double turn_rad = angle_between_rad(T_map_robot.yaw_rad, heading_rad_);
    const double turn_rad_per_s = std::clamp(2.0 * turn_rad, -params_.turn_rate_rad_per_s, params_.turn_rate_rad_per_s);
    if (std::abs(turn_rad) > params_.aim_rad) return {0.0, turn_rad_per_s};
    const Twist2 allowed = guard_command({params_.speed_m_per_s, turn_rad_per_s}, scan, guard_);
    blocked_scans_ = allowed.speed_m_per_s == 0.0 ? blocked_scans_ + 1 : 0;
    if (blocked_scans_ > params_.blocked_scans_max) choose_heading(T_map_robot, scan);
    return allowed;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(from_m_, heading_rad_, blocked_scans_);
  }

 private:
  void choose_heading(const Pose2& T_map_robot, const Scan<2>& scan) {
    blocked_scans_ = 0;
    heading_rad_ = wrap_angle_rad(T_map_robot.yaw_rad + turn_to_way_out_rad(scan, guard_, params_));
  }

  CollisionGuardParams guard_;
  RetreatParams params_;
  Eigen::Vector2d from_m_;
  double heading_rad_ = 0.0;
  int blocked_scans_ = 0;  // in a row
};

}  // namespace incognita
