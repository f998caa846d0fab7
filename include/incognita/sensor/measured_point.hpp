/// Where a point measured by range and bearing lies, and how uncertain that is, the pose's uncertainty included.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"

namespace incognita {

/// The errors of one measurement, independent of each other and of the pose; one standard deviation each.
struct RangeBearingNoise {
  double range_m = 0.12;            ///< >= 0
  double bearing_rad = 0.00218166;  ///< >= 0; an eighth of a degree

  /// Throws std::invalid_argument for a value outside of the bounds stated with it.
  void validate() const {
    require_non_negative("RangeBearingNoise", "range_m", range_m);
    require_non_negative("RangeBearingNoise", "bearing_rad", bearing_rad);
  }
};

/// A point in the pose's frame with its covariance.
struct MeasuredPoint {
  Eigen::Vector2d mean_m;
  Eigen::Matrix2d covariance_m2;
};

/// (10) of Sansoni et al. and its covariance to first order: the point at range_m along `direction`, a unit vector in the axes of
/// the map, from a sensor at `position_m`. The covariance is a polynomial of the range,
///   P + range (n g^T + g n^T) + range^2 (yaw variance + bearing variance) n n^T + range variance u u^T,
/// with u the direction, n the normal to its left, P the position's covariance and g its covariance with the yaw. Nothing is checked; RangeBearingNoise::validate checks the noise.
[[nodiscard]] inline MeasuredPoint measured_point(const Eigen::Vector2d& position_m, const Pose2::Covariance& pose_covariance,
                                                  const Eigen::Vector2d& direction, double range_m,
                                                  const RangeBearingNoise& noise) {
  const Eigen::Vector2d normal(-direction[1], direction[0]);
  const double turn_rad2 = pose_covariance(2, 2) + noise.bearing_rad * noise.bearing_rad;
  MeasuredPoint point;
  for (int row = 0; row < 2; ++row) {
    point.mean_m[row] = position_m[row] + range_m * direction[row];
    for (int column = 0; column < 2; ++column) {
      point.covariance_m2(row, column) =
          pose_covariance(row, column) +
          range_m * (normal[row] * pose_covariance(column, 2) + pose_covariance(row, 2) * normal[column]) +
          range_m * range_m * turn_rad2 * normal[row] * normal[column] +
          noise.range_m * noise.range_m * direction[row] * direction[column];
    }
  }
  return point;
}

/// The same of a bearing_rad from the pose's heading.
[[nodiscard]] inline MeasuredPoint measured_point(const Pose2& pose, const Pose2::Covariance& pose_covariance, double range_m,
                                                  double bearing_rad, const RangeBearingNoise& noise) {
  const double angle_rad = pose.yaw_rad + bearing_rad;
  return measured_point(pose.position(), pose_covariance, {std::cos(angle_rad), std::sin(angle_rad)}, range_m, noise);
}

}  // namespace incognita
