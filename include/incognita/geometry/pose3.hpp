/// Poses in space, SE(3).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "incognita/geometry/pose.hpp"

namespace incognita {

/// A position in metres and an orientation. As T_a_b it takes coordinates in frame b to coordinates in frame a.
/// Its covariance is over (position, rotation vector), in m^2, m rad and rad^2, with both in the axes of frame a.
template <class Scalar>
struct BasicPose3 {
  static constexpr int dimension = 3;              ///< of the positions
  using Vector = Eigen::Matrix<Scalar, 3, 1>;      ///< a position or a way, in metres
  using Rotation = Eigen::Matrix<Scalar, 3, 3>;    ///< orthogonal, with determinant 1
  using Covariance = Eigen::Matrix<Scalar, 6, 6>;  ///< of position and rotation, in m^2, m rad, rad^2
  using Orientation = Eigen::Quaternion<Scalar>;   ///< of length 1

  Vector position_m = Vector::Zero();                 ///< of frame b's origin in frame a
  Orientation orientation = Orientation::Identity();  ///< unit length

  [[nodiscard]] Vector position() const { return position_m; }  ///< the same as of a Pose2

  [[nodiscard]] Rotation rotation() const { return orientation.toRotationMatrix(); }  ///< takes directions in frame b to frame a

  /// Coordinates in frame a of a point given in frame b.
  [[nodiscard]] Vector operator*(const Vector& point_b) const { return position_m + orientation * point_b; }

  /// T_a_c of this T_a_b.
  [[nodiscard]] BasicPose3 operator*(const BasicPose3& T_b_c) const {
    return {*this * T_b_c.position_m, (orientation * T_b_c.orientation).normalized()};
  }

  /// T_b_a of this T_a_b.
  [[nodiscard]] BasicPose3 inverse() const {
    const Orientation back = orientation.conjugate();
    return {-(back * position_m), back};
  }

  /// Whether all numbers are finite.
  [[nodiscard]] bool is_finite() const { return position_m.allFinite() && orientation.coeffs().allFinite(); }
};

/// What maps in space are told of a sensor's place.
using Pose3 = BasicPose3<double>;

/// "(x, y, z) turned by (qx, qy, qz, qw)" in metres, for messages.
template <class Scalar>
[[nodiscard]] std::string tuple_text(const BasicPose3<Scalar>& pose) {
  return tuple_text(pose.position_m) + " turned by " + tuple_text(pose.orientation.coeffs());
}

/// Space.
template <>
struct PoseOf<3> {
  using Type = Pose3;  ///< a position and a quaternion
};

}  // namespace incognita
