/// The correction of a covariance by a measured heading.
#pragma once

#include <Eigen/Core>

namespace incognita {

/// The covariance over (x, y, yaw) after a measurement of the yaw with `variance_rad2`, in Joseph's form: symmetric to the
/// last bit and positive semi-definite. The gain is the covariance's last column over (its last entry + variance_rad2).
[[nodiscard]] inline Eigen::Matrix3d yaw_updated_covariance(const Eigen::Matrix3d& prior, double variance_rad2) {
  const double innovation_rad2 = prior(2, 2) + variance_rad2;
  const auto gain = [&](int row) { return prior(row, 2) / innovation_rad2; };
  // (I - K H) P (I - K H)^T + K R K^T for H = (0, 0, 1).
  Eigen::Matrix3d posterior;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column <= row; ++column) {
      const double kept = prior(row, column) - gain(row) * prior(2, column) - gain(column) * prior(row, 2) +
                          gain(row) * gain(column) * prior(2, 2);
      posterior(row, column) = posterior(column, row) = kept + gain(row) * gain(column) * variance_rad2;
    }
  }
  return posterior;
}

}  // namespace incognita
