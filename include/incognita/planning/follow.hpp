/// Following a path with a robot that drives along its heading and turns.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/polyline.hpp"
#include "incognita/planning/room_aside.hpp"

namespace incognita {

/// What a robot can do and how it follows.
struct FollowParams {
  double speed_max_m_per_s = 1.0;        ///< > 0
  double turn_rate_max_rad_per_s = 1.0;  ///< > 0, either way
  double deceleration_m_per_s2 = 1.0;    ///< how hard it brakes before corners and the end
  double lookahead_m = 0.6;              ///< it aims at a place on the path this far ahead
  double lookahead_min_m = 0.15;         ///< or nearer, down to this,
  double deviation_max_m = 0.04;         ///< when the path or its own arc leaves the straight line there by more
  double aside_max_m = 0.1;              ///< how far it leaves the path for the middle of a passage that the latest scan shows
  double turn_in_place_rad = 0.6;        ///< it turns in place when the place lies further aside; < pi / 2
  double goal_tolerance_m = 0.1;         ///< this near to its end the path is finished

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("FollowParams", "speed_max_m_per_s", speed_max_m_per_s);
    require_positive("FollowParams", "turn_rate_max_rad_per_s", turn_rate_max_rad_per_s);
    require_positive("FollowParams", "deceleration_m_per_s2", deceleration_m_per_s2);
    require_positive("FollowParams", "lookahead_min_m", lookahead_min_m);
    require(std::isfinite(lookahead_m) && lookahead_m >= lookahead_min_m, "FollowParams", "lookahead_m",
            lookahead_m, "finite and >= lookahead_min_m");
    require_positive("FollowParams", "deviation_max_m", deviation_max_m);
    require_non_negative("FollowParams", "aside_max_m", aside_max_m);
    require(turn_in_place_rad > 0.0 && turn_in_place_rad < std::numbers::pi / 2.0, "FollowParams",
            "turn_in_place_rad", turn_in_place_rad, "in (0, pi / 2)");
    require_positive("FollowParams", "goal_tolerance_m", goal_tolerance_m);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "speed_max_m_per_s, turn_rate_max_rad_per_s, deceleration_m_per_s2, lookahead_m, lookahead_min_m, deviation_max_m, "
        "aside_max_m, turn_in_place_rad, goal_tolerance_m",
        speed_max_m_per_s, turn_rate_max_rad_per_s, deceleration_m_per_s2, lookahead_m, lookahead_min_m, deviation_max_m, aside_max_m,
        turn_in_place_rad, goal_tolerance_m);
  }
};

/// Pure pursuit (Coulter 1992) of one path. It brakes before corners, turns in place where the path lies far
/// aside, and never goes back along the path, so a path that crosses itself is followed through. A plain
/// value.
class PathFollower {
 public:
  /// Nothing to follow: finished.
  PathFollower() = default;

  /// Follows `path_m`, in the frame of the poses that command() is given; better with few corners (see
  /// shorten_path). Throws std::invalid_argument for parameters outside of their bounds.
  explicit PathFollower(std::vector<Eigen::Vector2d> path_m, const FollowParams& params = {})
      : path_(std::move(path_m)), params_(params), finished_(path_.empty()) {
    params_.validate();
  }

  /// The speeds to drive with from where the robot is; zero when the path is finished. Speed is never
  /// negative.
  [[nodiscard]] Twist2 command(const Pose2& T_map_robot) { return command(T_map_robot, Surroundings{}); }

  /// As command(T_map_robot), but through the middle of passages so narrow that the guard would hold the robot a
  /// little aside of it: a path from cell to cell may be off by more than they leave. `scan` is in the robot's frame,
  /// its latest. O(beams), and beside something narrow 1000 times what is near.
  [[nodiscard]] Twist2 command(const Pose2& T_map_robot, const Scan<2>& scan, const CollisionGuardParams& guard) {
    const double keep_m = guard.robot_radius_m + guard.creep_margin_m;
    const double range_m = params_.lookahead_m + params_.aside_max_m + keep_m + params_.deviation_max_m;
    return command(T_map_robot, {near_hits_m(T_map_robot, scan, range_m), keep_m});
  }

  /// Takes note of how far the robot has come, and whether that is the end, as command() does too: for robots that another controller
  /// steers along the path.
  void advance(const Pose2& T_map_robot) {
    if (finished_) return;
    const Eigen::Vector2d position = T_map_robot.position();
    progress_m_ = path_.nearest_along_m(position, progress_m_, progress_m_ + params_.lookahead_m);
    finished_ = path_.length_m() - progress_m_ <= params_.goal_tolerance_m &&
                distance(path_.points_m().back(), position) <= params_.goal_tolerance_m;
  }

  [[nodiscard]] const FollowParams& params() const { return params_; }  ///< as given

  [[nodiscard]] bool is_finished() const { return finished_; }  ///< whether it is at the path's end

  /// How far along the path the robot has come; never decreases.
  [[nodiscard]] double progress_m() const { return progress_m_; }

  [[nodiscard]] const Polyline& path() const { return path_; }  ///< as given

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. The parameters stay as they are.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(path_, progress_m_, turning_, finished_);
    archive.require(finished_ || !path_.empty(), "there is no path to follow");
    archive.require(progress_m_ >= 0.0 && progress_m_ <= path_.length_m(), "a path was followed beyond its end");
  }

 private:
  /// What is around the robot, in the path's frame, and how far its centre keeps from it.
  struct Surroundings {
    std::vector<Eigen::Vector2d> obstacles_m;
    double keep_m = 0.0;
  };

  /// Where to aim, as seen from the robot.
  struct Target {
    double distance_m;
    double aside_rad;
  };

  [[nodiscard]] Twist2 command(const Pose2& T_map_robot, const Surroundings& around) {
    advance(T_map_robot);
    if (finished_) return {};
    const double end_distance_m = distance(path_.points_m().back(), T_map_robot.position());
    const Target target = aim(T_map_robot, around);
    // Once begun, a turn is finished: an arc that begins far aside swings wide.
    turning_ = std::abs(target.aside_rad) > (turning_ ? 0.25 : 1.0) * params_.turn_in_place_rad;
    if (turning_) {
      const double rate_rad_per_s = params_.turn_rate_max_rad_per_s;
      return {0.0, std::clamp(2.0 * target.aside_rad, -rate_rad_per_s, rate_rad_per_s)};
    }
    // The arc through the target.
    const double curvature_per_m = 2.0 * std::sin(target.aside_rad) / std::max(target.distance_m, 1e-6);
    const double speed_m_per_s =
        std::min(braking_speed_m_per_s(end_distance_m),
                 params_.turn_rate_max_rad_per_s / std::max(std::abs(curvature_per_m), 1e-6));
    return {speed_m_per_s, speed_m_per_s * curvature_per_m};
  }

  /// The place on the path lookahead_m ahead, or a nearer one while the path leaves its chord too far (so a
  /// corner is not cut), the arc to it would (so the robot does not swing out of one), or the way there lacks the room.
  [[nodiscard]] Target aim(const Pose2& T_map_robot, const Surroundings& around) const {
    double ahead_m = params_.lookahead_m;
    for (;;) {
      const RoomyPlace place = place_at(progress_m_ + ahead_m, around);
      const Eigen::Vector2d to_target = difference(place.position_m, T_map_robot.position());
      const double bearing_rad = std::atan2(to_target[1], to_target[0]);
      const Target target{norm(to_target), angle_between_rad(T_map_robot.yaw_rad, bearing_rad)};
      const double swing_m = 0.5 * target.distance_m * std::tan(0.5 * std::abs(target.aside_rad));
      const bool is_near = ahead_m <= params_.lookahead_min_m;
      if ((is_near || std::max(swing_m, corner_beside_chord_m(ahead_m)) <= params_.deviation_max_m) &&
          has_room(T_map_robot.position(), to_target, ahead_m, around)) {
        return target;
      }
      // Nearer than lookahead_min_m only where there is no room: from aside of a door, first to its middle.
      ahead_m = is_near ? 0.8 * ahead_m : std::max(0.8 * ahead_m, params_.lookahead_min_m);
    }
  }

  /// The path's place so far along it, or the middle of a narrow passage that it lies in.
  [[nodiscard]] RoomyPlace place_at(double along_m, const Surroundings& around) const {
    const Eigen::Vector2d place_m = path_.point_at(along_m);
    const double enough_m = around.keep_m + params_.deviation_max_m;
    if (around.obstacles_m.empty()) return {place_m, enough_m};
    // Across the path's direction at large: single steps from cell to cell have others.
    const Eigen::Vector2d before_m = path_.point_at(along_m - params_.lookahead_min_m);
    const Eigen::Vector2d along = difference(path_.point_at(along_m + params_.lookahead_min_m), before_m);
    return roomiest_aside(place_m, along, around.obstacles_m, params_.aside_max_m, enough_m);
  }

  /// Whether the straight way to a target ahead_m further along leaves no place between by more than there is room for.
  [[nodiscard]] bool has_room(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_target_m, double ahead_m,
                              const Surroundings& around) const {
    if (around.obstacles_m.empty()) return true;
    constexpr double sample_m = 0.05;
    const double length2_m2 = std::max(dot(to_target_m, to_target_m), 1e-12);
    for (double along_m = sample_m; along_m < ahead_m; along_m += sample_m) {
      const RoomyPlace place = place_at(progress_m_ + along_m, around);
      const Eigen::Vector2d way_m = difference(place.position_m, from_m);
      const double share = std::clamp(dot(way_m, to_target_m) / length2_m2, 0.0, 1.0);
      const double room_m = std::max(room_step_m, place.clearance_m - around.keep_m);
      if (distance(way_m, scaled(to_target_m, share)) > room_m) return false;
    }
    return true;
  }

  /// How far the path up to ahead_m further along leaves the straight line to there.
  [[nodiscard]] double corner_beside_chord_m(double ahead_m) const {
    const Eigen::Vector2d from = path_.point_at(progress_m_);
    const Eigen::Vector2d chord = difference(path_.point_at(progress_m_ + ahead_m), from);
    double deviation_m = 0.0;
    for (std::size_t i = path_.corner_after(progress_m_);
         i < path_.points_m().size() && path_.arc_m(i) < progress_m_ + ahead_m; ++i) {
      const Eigen::Vector2d corner = difference(path_.points_m()[i], from);
      const double share = std::clamp(dot(corner, chord) / std::max(dot(chord, chord), 1e-12), 0.0, 1.0);
      deviation_m = std::max(deviation_m, distance(corner, scaled(chord, share)));
    }
    return deviation_m;
  }

  /// The speed from which the robot can brake before each corner to what the corner allows, and at the end to
  /// a crawl.
  [[nodiscard]] double braking_speed_m_per_s(double end_distance_m) const {
    const double crawl_m_per_s = 0.1 * params_.speed_max_m_per_s;
    double speed_m_per_s = params_.speed_max_m_per_s;
    const auto& points_m = path_.points_m();
    for (std::size_t i = path_.corner_after(progress_m_); i < points_m.size(); ++i) {
      const bool is_end = i + 1 == points_m.size();
      const double before_m =
          is_end ? std::max(path_.arc_m(i) - progress_m_, end_distance_m) : path_.arc_m(i) - progress_m_;
      if (2.0 * params_.deceleration_m_per_s2 * before_m > speed_m_per_s * speed_m_per_s) break;
      double corner_m_per_s = crawl_m_per_s;
      if (i > 0 && !is_end) {
        const Eigen::Vector2d in = difference(points_m[i], points_m[i - 1]);
        const Eigen::Vector2d out = difference(points_m[i + 1], points_m[i]);
        const double turn_rad = std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], dot(in, out)));
        const double allowed = 1.0 - turn_rad / params_.turn_in_place_rad;
        corner_m_per_s = std::max(crawl_m_per_s, allowed * params_.speed_max_m_per_s);
      }
      speed_m_per_s =
          std::min(speed_m_per_s, std::sqrt(corner_m_per_s * corner_m_per_s +
                                            2.0 * params_.deceleration_m_per_s2 * std::max(0.0, before_m)));
    }
    return speed_m_per_s;
  }

  Polyline path_;
  FollowParams params_;
  double progress_m_ = 0.0;
  bool turning_ = false;  ///< in place
  bool finished_ = true;
};

}  // namespace incognita
