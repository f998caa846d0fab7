/// Whether a covariance tells the truth: normalised estimation error squared.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "incognita/geometry/pose2.hpp"

namespace incognita {

/// e^T Sigma^-1 e; its mean is the number of dimensions when the errors have that covariance. Throws
/// std::invalid_argument unless the covariance is finite and positive definite.
template <int Dim>
[[nodiscard]] double nees(const Eigen::Matrix<double, Dim, 1>& error,
                          const Eigen::Matrix<double, Dim, Dim>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, Dim, Dim>> factor(covariance);
  if (!covariance.allFinite() || factor.info() != Eigen::Success) {
    throw std::invalid_argument("nees: the covariance is not finite and positive definite");
  }
  return factor.matrixL().solve(error).squaredNorm();
}

/// The error of an estimated pose over (x, y, yaw), in metres and radians, both poses in one frame.
[[nodiscard]] inline Eigen::Vector3d pose_error(const Pose2& estimated, const Pose2& truth) {
  return {estimated.x_m - truth.x_m, estimated.y_m - truth.y_m,
          angle_between_rad(truth.yaw_rad, estimated.yaw_rad)};
}

/// NEES of the position alone, the upper left block of the covariance; 2 on average for an honest one.
[[nodiscard]] inline double position_nees(const Pose2& estimated, const Pose2& truth,
                                          const Pose2::Covariance& covariance) {
  return nees<2>(pose_error(estimated, truth).head<2>(), covariance.topLeftCorner<2, 2>());
}

/// NEES of position and heading; 3 on average for an honest covariance.
[[nodiscard]] inline double pose_nees(const Pose2& estimated, const Pose2& truth,
                                      const Pose2::Covariance& covariance) {
  return nees<3>(pose_error(estimated, truth), covariance);
}

/// Means over a trajectory.
class MeanNees {
 public:
  /// Throws as nees does; nothing is then added.
  void add(const Pose2& estimated, const Pose2& truth, const Pose2::Covariance& covariance) {
    const double position = position_nees(estimated, truth, covariance);
    pose_sum_ += pose_nees(estimated, truth, covariance);
    position_sum_ += position;
    ++count_;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  /// 0 before the first sample.
  [[nodiscard]] double position() const {
    return count_ == 0 ? 0.0 : position_sum_ / static_cast<double>(count_);
  }
  [[nodiscard]] double pose() const { return count_ == 0 ? 0.0 : pose_sum_ / static_cast<double>(count_); }

 private:
  double position_sum_ = 0.0;
  double pose_sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace incognita
