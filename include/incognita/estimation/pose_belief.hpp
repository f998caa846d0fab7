/// A Gaussian belief over a pose in the plane and how a motion spreads it.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// N(pose, covariance) over (x, y, yaw); see Pose2::Covariance for units and axes.
struct PoseBelief {
  Pose2 pose;                                            ///< the mean
  Eigen::Matrix3d covariance = zero<Eigen::Matrix3d>();  ///< symmetric and positive semi-definite

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(pose, covariance);
  }
};

/// The covariance of independent errors.
[[nodiscard]] inline Eigen::Matrix3d diagonal_covariance(double x_m2, double y_m2, double yaw_rad2) {
  Eigen::Matrix3d covariance = zero<Eigen::Matrix3d>();
  covariance(0, 0) = x_m2;
  covariance(1, 1) = y_m2;
  covariance(2, 2) = yaw_rad2;
  return covariance;
}

/// Throws std::invalid_argument unless the pose is finite and the covariance is one.
inline void require_belief(const char* where, const PoseBelief& belief) {
  require_finite_pose(where, "the start pose", belief.pose);
  require_covariance(where, "the start covariance", belief.covariance);
}

/// The standard deviation of the position along its worst direction, in metres.
[[nodiscard]] inline double position_sigma_m(const Eigen::Matrix3d& covariance) {
  const double mean = 0.5 * (covariance(0, 0) + covariance(1, 1));
  const double half_difference = 0.5 * (covariance(0, 0) - covariance(1, 1));
  return std::sqrt(mean + std::hypot(half_difference, covariance(0, 1)));
}

/// White process noise: its variance grows with time, whatever the steps time is cut into.
struct MotionNoise {
  double position_m_per_sqrt_s = 0.0;  ///< of x and of y
  double yaw_rad_per_sqrt_s = 0.0;     ///< of the heading

  /// Throws std::invalid_argument unless both are finite and >= 0.
  void validate() const {
    require_non_negative("MotionNoise", "position_m_per_sqrt_s", position_m_per_sqrt_s);
    require_non_negative("MotionNoise", "yaw_rad_per_sqrt_s", yaw_rad_per_sqrt_s);
  }

  /// Q of Seo et al., (7), for a step of duration_s.
  [[nodiscard]] Eigen::Matrix3d covariance(double duration_s) const {
    const double position_m2 = position_m_per_sqrt_s * position_m_per_sqrt_s * duration_s;
    const double yaw_rad2 = yaw_rad_per_sqrt_s * yaw_rad_per_sqrt_s * duration_s;
    return diagonal_covariance(position_m2, position_m2, yaw_rad2);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("position_m_per_sqrt_s, yaw_rad_per_sqrt_s", position_m_per_sqrt_s, yaw_rad_per_sqrt_s);
  }
};

/// Throws std::invalid_argument unless the increment is finite and the duration finite and >= 0.
inline void require_motion(const char* where, const Pose2& increment, double duration_s) {
  require_finite_pose(where, "the increment", increment);
  require_non_negative(where, "duration_s", duration_s);
}

/// F_x of Seo et al., (7): the derivative of the next pose, pose * increment, by the pose.
[[nodiscard]] inline Eigen::Matrix3d motion_jacobian(const Pose2& pose, const Pose2& increment) {
  const double c = std::cos(pose.yaw_rad);
  const double s = std::sin(pose.yaw_rad);
  Eigen::Matrix3d jacobian = zero<Eigen::Matrix3d>();
  for (int axis = 0; axis < 3; ++axis) jacobian(axis, axis) = 1.0;
  jacobian(0, 2) = -(s * increment.x_m + c * increment.y_m);
  jacobian(1, 2) = c * increment.x_m - s * increment.y_m;
  return jacobian;
}

/// The covariance of a pose that is rigidly `lever_m` (in the map's axes) away from one of the given covariance, with the
/// same heading: F P F^T for F = [1 0 -lever_y; 0 1 lever_x; 0 0 1].
[[nodiscard]] inline Eigen::Matrix3d carried_covariance(const Eigen::Matrix3d& covariance,
                                                        const Eigen::Vector2d& lever_m) {
  const double a = -lever_m[1];
  const double b = lever_m[0];
  const double xt = covariance(0, 2) + a * covariance(2, 2);
  const double yt = covariance(1, 2) + b * covariance(2, 2);
  Eigen::Matrix3d carried;
  carried(0, 0) = covariance(0, 0) + a * (covariance(0, 2) + xt);
  carried(1, 1) = covariance(1, 1) + b * (covariance(1, 2) + yt);
  carried(2, 2) = covariance(2, 2);
  carried(0, 1) = carried(1, 0) = covariance(0, 1) + a * covariance(1, 2) + b * xt;
  carried(0, 2) = carried(2, 0) = xt;
  carried(1, 2) = carried(2, 1) = yt;
  return carried;
}

/// sum += weight * term.
inline void add_to(Eigen::Matrix3d& sum, const Eigen::Matrix3d& term, double weight = 1.0) {
  for (int i = 0; i < 9; ++i) sum(i) += weight * term(i);
}

/// The prediction step, Seo et al., (7): the pose moves by `increment` (in the robot's frame) within duration_s.
[[nodiscard]] inline PoseBelief propagate(const PoseBelief& belief, const Pose2& increment, const MotionNoise& noise,
                                          double duration_s) {
  // F_x is the identity but for the lever that the step puts between the old place and the new one.
  PoseBelief next{belief.pose * increment, noise.covariance(duration_s)};
  const Eigen::Vector2d step_m = difference(next.pose.position(), belief.pose.position());
  add_to(next.covariance, carried_covariance(belief.covariance, step_m));
  return next;
}

}  // namespace incognita
