/// A disc-shaped robot that drives in a world and cannot pass its walls.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "incognita/simulation/start.hpp"
#include "incognita/simulation/world.hpp"

namespace incognita {

/// The robot of Seo et al., section VI-B: 1 m/s and 1 rad/s at most.
struct RobotParams {
  double radius_m = 0.2;                 ///< >= 0
  double speed_max_m_per_s = 1.0;        ///< > 0, forwards and backwards
  double turn_rate_max_rad_per_s = 1.0;  ///< > 0

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("radius_m, speed_max_m_per_s, turn_rate_max_rad_per_s", radius_m, speed_max_m_per_s, turn_rate_max_rad_per_s);
  }
};

/// A unicycle under a disc. What would take it into a wall is carried out up to the contact; it does not
/// slide, but a disc can always turn on the spot.
class Robot {
 public:
  /// Throws std::invalid_argument for bad parameters, a pose that is not finite, or one that is not clear.
  Robot(const World& world, const Pose2& T_world_robot, const RobotParams& params = {})
      : params_(params), T_world_robot_(T_world_robot) {
    require_non_negative("Robot", "radius_m", params.radius_m);
    require_positive("Robot", "speed_max_m_per_s", params.speed_max_m_per_s);
    require_positive("Robot", "turn_rate_max_rad_per_s", params.turn_rate_max_rad_per_s);
    require_finite_pose("Robot", "the pose", T_world_robot);
    check_start(world, T_world_robot.position(), params.radius_m);
  }

  [[nodiscard]] const RobotParams& params() const { return params_; }  ///< as given
  [[nodiscard]] const Pose2& T_world_robot() const { return T_world_robot_; }  ///< the true pose
  /// The length of the way so far.
  [[nodiscard]] double distance_m() const { return distance_m_; }
  /// How often it ran into something. Staying there and pushing on is the same collision until the robot has
  /// been more than contact_end_m away.
  [[nodiscard]] std::size_t collisions() const { return collisions_; }

  /// How far from everything a contact is over.
  static constexpr double contact_end_m = 1e-3;

  /// Holds the command, cut to the robot's limits, for duration_s, and returns the twist that came of it: the
  /// way driven and the turn made, each over the duration. Throws std::invalid_argument for a command that is
  /// not finite or a duration that is not finite and > 0.
  Twist2 move(const World& world, const Twist2& command, double duration_s) {
    require_positive("Robot::move", "duration_s", duration_s);
    const Twist2 twist{
        limited("speed_m_per_s", command.speed_m_per_s, params_.speed_max_m_per_s),
        limited("turn_rate_rad_per_s", command.turn_rate_rad_per_s, params_.turn_rate_max_rad_per_s)};
    const double speed_m_per_s = std::abs(twist.speed_m_per_s);
    const double wanted_m = speed_m_per_s * duration_s;
    const auto pose_after = [&](double way_m) {
      return T_world_robot_ * unicycle_motion(twist, wanted_m > 0.0 ? way_m / speed_m_per_s : duration_s);
    };
    const double driven_m = clear_length_m(world, params_.radius_m, wanted_m,
                                           [&](double way_m) { return pose_after(way_m).position(); });
    const bool is_stopped = driven_m < wanted_m;
    if (is_stopped && !in_contact_) ++collisions_;

    const Eigen::Vector2d position = pose_after(driven_m).position();
    const double turn_rad = twist.turn_rate_rad_per_s * duration_s;
    T_world_robot_ = {position.x(), position.y(), wrap_angle_rad(T_world_robot_.yaw_rad + turn_rad)};
    distance_m_ += driven_m;
    in_contact_ =
        is_stopped || (in_contact_ && !world.disc_is_clear(position, params_.radius_m + contact_end_m));
    return {std::copysign(driven_m / duration_s, twist.speed_m_per_s), twist.turn_rate_rad_per_s};
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("robot", params_);
    archive(T_world_robot_, distance_m_, collisions_, in_contact_);
    archive.require(T_world_robot_.is_finite(), "the robot's pose is not finite");
  }

 private:
  [[nodiscard]] static double limited(const char* field, double value, double bound) {
    require(std::isfinite(value), "Robot::move", field, value, "finite");
    return std::clamp(value, -bound, bound);
  }

  RobotParams params_;
  Pose2 T_world_robot_;
  double distance_m_ = 0.0;
  std::size_t collisions_ = 0;
  bool in_contact_ = false;
};

}  // namespace incognita
