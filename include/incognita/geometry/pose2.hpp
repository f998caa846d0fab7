/// Poses in the plane, SE(2).
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Core>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"

namespace incognita {

/// A position in metres and a heading in radians. As T_a_b it takes coordinates in frame b to coordinates in frame a;
/// composition reads T_a_c = T_a_b * T_b_c. Its covariance is over (x, y, yaw), in m^2, m rad and rad^2, with the
/// position in the axes of frame a.
struct Pose2 {
  static constexpr int dimension = 2;  ///< of the positions
  using Vector = Eigen::Vector2d;      ///< a position or a way, in metres
  using Rotation = Eigen::Matrix2d;    ///< orthogonal, with determinant 1
  /// Over (x, y, yaw) in m^2, m rad, rad^2; the position in the axes of frame a of T_a_b.
  using Covariance = Eigen::Matrix3d;

  double x_m = 0.0;      ///< of frame b's origin in frame a
  double y_m = 0.0;      ///< likewise
  double yaw_rad = 0.0;  ///< of b's x axis from a's, counter-clockwise, in (-pi, pi]

  [[nodiscard]] Vector position() const { return {x_m, y_m}; }  ///< (x_m, y_m)

  /// Takes directions in frame b to directions in frame a.
  [[nodiscard]] Rotation rotation() const {
    Rotation matrix;
    matrix(0, 0) = matrix(1, 1) = std::cos(yaw_rad);
    matrix(1, 0) = std::sin(yaw_rad);
    matrix(0, 1) = -matrix(1, 0);
    return matrix;
  }

  /// Coordinates in frame a of a point given in frame b.
  [[nodiscard]] Vector operator*(const Vector& point_b) const {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return {x_m + c * point_b[0] - s * point_b[1], y_m + s * point_b[0] + c * point_b[1]};
  }

  /// T_a_c of this T_a_b; the yaw is wrapped.
  [[nodiscard]] Pose2 operator*(const Pose2& T_b_c) const {
    const Vector p = *this * T_b_c.position();
    return {p[0], p[1], wrap_angle_rad(yaw_rad + T_b_c.yaw_rad)};
  }

  /// T_b_a of this T_a_b; the yaw is wrapped.
  [[nodiscard]] Pose2 inverse() const {
    const double c = std::cos(yaw_rad);
    const double s = std::sin(yaw_rad);
    return {-(c * x_m + s * y_m), s * x_m - c * y_m, wrap_angle_rad(-yaw_rad)};
  }

  /// Whether all three numbers are finite.
  [[nodiscard]] bool is_finite() const {
    return std::isfinite(x_m) && std::isfinite(y_m) && std::isfinite(yaw_rad);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(x_m, y_m, yaw_rad);
  }
};

/// "(x, y, yaw)" in metres and radians, for messages.
[[nodiscard]] inline std::string tuple_text(const Pose2& pose) {
  return detail::element_text(true, pose.x_m) + detail::element_text(false, pose.y_m) + detail::element_text(false, pose.yaw_rad) + ')';
}

}  // namespace incognita
