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
  static constexpr int dimension = 3;
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  using Rotation = Eigen::Matrix<Scalar, 3, 3>;
  using Covariance = Eigen::Matrix<Scalar, 6, 6>;
  using Orientation = Eigen::Quaternion<Scalar>;

  Vector position_m = Vector::Zero();
  Orientation orientation = Orientation::Identity();  ///< unit length

  [[nodiscard]] Vector position() const { return position_m; }

  [[nodiscard]] Rotation rotation() const { return orientation.toRotationMatrix(); }

  /// Coordinates in frame a of a point given in frame b.
  [[nodiscard]] Vector operator*(const Vector& point_b) const { return position_m + orientation * point_b; }

  [[nodiscard]] BasicPose3 operator*(const BasicPose3& T_b_c) const {
    return {*this * T_b_c.position_m, (orientation * T_b_c.orientation).normalized()};
  }

  [[nodiscard]] BasicPose3 inverse() const {
    const Orientation back = orientation.conjugate();
    return {-(back * position_m), back};
  }

  [[nodiscard]] bool is_finite() const { return position_m.allFinite() && orientation.coeffs().allFinite(); }
};

using Pose3 = BasicPose3<double>;

/// "(x, y, z) turned by (qx, qy, qz, qw)" in metres, for messages.
template <class Scalar>
[[nodiscard]] std::string tuple_text(const BasicPose3<Scalar>& pose) {
  return tuple_text(pose.position_m) + " turned by " + tuple_text(pose.orientation.coeffs());
}

template <>
struct PoseOf<3> {
  using Type = Pose3;
};

}  // namespace incognita
