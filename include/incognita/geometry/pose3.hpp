/// Poses in space, SE(3).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace incognita {

/// A position in metres and an orientation. As T_a_b it takes coordinates in frame b to coordinates in frame a.
/// Its covariance is over (position, rotation vector), in m^2, m rad and rad^2, with both in the axes of frame a.
struct Pose3 {
  static constexpr int dimension = 3;
  using Vector = Eigen::Vector3d;
  using Rotation = Eigen::Matrix3d;
  using Covariance = Eigen::Matrix<double, 6, 6>;

  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< unit length

  [[nodiscard]] Vector position() const { return position_m; }

  [[nodiscard]] Rotation rotation() const { return orientation.toRotationMatrix(); }

  /// Coordinates in frame a of a point given in frame b.
  [[nodiscard]] Vector operator*(const Vector& point_b) const { return position_m + orientation * point_b; }

  [[nodiscard]] Pose3 operator*(const Pose3& T_b_c) const {
    return {*this * T_b_c.position_m, (orientation * T_b_c.orientation).normalized()};
  }

  [[nodiscard]] Pose3 inverse() const {
    const Eigen::Quaterniond back = orientation.conjugate();
    return {-(back * position_m), back};
  }

  [[nodiscard]] bool is_finite() const { return position_m.allFinite() && orientation.coeffs().allFinite(); }
};

}  // namespace incognita
