/// Whether a covariance tells the truth: normalised estimation error squared.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"

namespace incognita {

/// e^T Sigma^-1 e over the first `Dim` coordinates of a pose's error (2: position alone); on average Dim when
/// the errors have that covariance. Throws std::invalid_argument unless that part of the covariance is finite
/// and positive definite.
template <int Dim>
[[nodiscard]] double nees(const Eigen::Vector3d& error, const Pose2::Covariance& covariance) {
  static_assert(Dim >= 1 && Dim <= 3);
  // Cholesky, written out: Eigen's costs every user of this header a second of parsing.
  std::array<std::array<double, Dim>, Dim> root{};
  std::array<double, Dim> whitened{};
  double sum = 0.0;
  for (std::size_t i = 0; i < Dim; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j <= i; ++j) {
      root[i][j] = covariance(row, static_cast<Eigen::Index>(j));
      for (std::size_t k = 0; k < j; ++k) root[i][j] -= root[i][k] * root[j][k];
      if (j < i) root[i][j] /= root[j][j];
    }
    require(std::isfinite(root[i][i]) && root[i][i] > 0.0, "nees", "a pivot of the covariance", root[i][i],
            "finite and > 0: a covariance is positive definite");
    root[i][i] = std::sqrt(root[i][i]);
    whitened[i] = error(row);
    for (std::size_t k = 0; k < i; ++k) whitened[i] -= root[i][k] * whitened[k];
    whitened[i] /= root[i][i];
    sum += whitened[i] * whitened[i];
  }
  return sum;
}

/// The error of an estimated pose over (x, y, yaw), in metres and radians, both poses in one frame.
[[nodiscard]] inline Eigen::Vector3d pose_error(const Pose2& estimated, const Pose2& truth) {
  return {estimated.x_m - truth.x_m, estimated.y_m - truth.y_m,
          angle_between_rad(truth.yaw_rad, estimated.yaw_rad)};
}

/// NEES of the position alone, the upper left block of the covariance; 2 on average for an honest one.
[[nodiscard]] inline double position_nees(const Pose2& estimated, const Pose2& truth,
                                          const Pose2::Covariance& covariance) {
  return nees<2>(pose_error(estimated, truth), covariance);
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

  [[nodiscard]] std::size_t count() const { return count_; }  ///< of poses added
  /// Without a unit; 0 before the first sample.
  [[nodiscard]] double position() const {
    return count_ == 0 ? 0.0 : position_sum_ / static_cast<double>(count_);
  }
  /// Likewise without a unit, of position and heading.
  [[nodiscard]] double pose() const { return count_ == 0 ? 0.0 : pose_sum_ / static_cast<double>(count_); }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(position_sum_, pose_sum_, count_);
  }

 private:
  double position_sum_ = 0.0;
  double pose_sum_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace incognita
