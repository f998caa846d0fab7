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

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("range_m, bearing_rad", range_m, bearing_rad);
  }
};

/// A point in the pose's frame with its covariance.
struct MeasuredPoint {
  Eigen::Vector2d mean_m;         ///< where it was measured
  Eigen::Matrix2d covariance_m2;  ///< over (x, y), in the axes of the pose's frame
};

/// An element of the covariance of what is measured along one direction, as a polynomial of the range.
struct MeasuredCovarianceElement {
  double constant_m2;  ///< from the position, and the noise of the range
  double linear_m;     ///< by metre: from position and heading together
  double quadratic;    ///< by square metre: from heading and bearing, in rad^2

  /// At a range.
  [[nodiscard]] double at_m2(double range_m) const { return constant_m2 + range_m * (linear_m + range_m * quadratic); }
};

/// (10) of Sansoni et al. to first order: the element (row, column) of the covariance of a point measured along `direction`, a unit
/// vector in the axes of the map,
///   P + range (n g^T + g n^T) + range^2 (yaw variance + bearing variance) n n^T + range variance u u^T,
/// with u the direction, n the normal to its left, P the position's covariance and g its covariance with the yaw. Nothing is checked.
[[nodiscard]] inline MeasuredCovarianceElement measured_covariance_element(int row, int column, const Pose2::Covariance& pose_covariance,
                                                                           const Eigen::Vector2d& direction,
                                                                           const RangeBearingNoise& noise) {
  const Eigen::Vector2d normal(-direction[1], direction[0]);
  const double turn_rad2 = pose_covariance(2, 2) + noise.bearing_rad * noise.bearing_rad;
  return {pose_covariance(row, column) + noise.range_m * noise.range_m * direction[row] * direction[column],
          normal[row] * pose_covariance(column, 2) + pose_covariance(row, 2) * normal[column], turn_rad2 * normal[row] * normal[column]};
}

/// (10): the point at range_m along `direction` from a sensor at `position_m`, and measured_covariance_element's covariance. Nothing is
/// checked; RangeBearingNoise::validate checks the noise.
[[nodiscard]] inline MeasuredPoint measured_point(const Eigen::Vector2d& position_m, const Pose2::Covariance& pose_covariance,
                                                  const Eigen::Vector2d& direction, double range_m,
                                                  const RangeBearingNoise& noise) {
  MeasuredPoint point;
  for (int row = 0; row < 2; ++row) {
    point.mean_m[row] = position_m[row] + range_m * direction[row];
    for (int column = 0; column < 2; ++column) {
      point.covariance_m2(row, column) = measured_covariance_element(row, column, pose_covariance, direction, noise).at_m2(range_m);
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
