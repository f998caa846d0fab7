/// How far an estimated trajectory is from the true one.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// Errors over time-aligned poses, estimated and true in one frame (the robot's start frame). Seo et al.,
/// section VI-A, "Localization error". Everything is 0 before the first pair.
class TrajectoryError {
 public:
  /// A pair of one time, in one frame.
  void add(const Pose2& estimated, const Pose2& truth) {
    const double distance_m = distance(estimated.position(), truth.position());
    const double turn_rad = angle_between_rad(truth.yaw_rad, estimated.yaw_rad);
    distances_m_ += distance_m;
    squared_distances_m2_ += distance_m * distance_m;
    squared_turns_rad2_ += turn_rad * turn_rad;
    translation_max_m_ = std::max(translation_max_m_, distance_m);
    ++count_;
  }

  [[nodiscard]] std::size_t count() const { return count_; }  ///< of pairs
  /// The root of the mean squared distance.
  [[nodiscard]] double translation_rmse_m() const { return std::sqrt(mean(squared_distances_m2_)); }
  /// The mean of the distances.
  [[nodiscard]] double translation_mae_m() const { return mean(distances_m_); }
  [[nodiscard]] double translation_max_m() const { return translation_max_m_; }  ///< the largest distance
  [[nodiscard]] double heading_rmse_rad() const { return std::sqrt(mean(squared_turns_rad2_)); }  ///< of the turns between them

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(distances_m_, squared_distances_m2_, squared_turns_rad2_, translation_max_m_, count_);
  }

 private:
  [[nodiscard]] double mean(double sum) const {
    return count_ == 0 ? 0.0 : sum / static_cast<double>(count_);
  }

  double distances_m_ = 0.0;
  double squared_distances_m2_ = 0.0;
  double squared_turns_rad2_ = 0.0;
  double translation_max_m_ = 0.0;
  std::size_t count_ = 0;
};

namespace detail {

inline void require_equal_sizes(const char* where, std::size_t a, std::size_t b) {
  if (a != b) {
    throw std::invalid_argument(std::string(where) + ": " + std::to_string(a) + " estimated and " +
                                std::to_string(b) + " true poses, but must be as many");
  }
}

}  // namespace detail

/// The errors of whole trajectories. Throws std::invalid_argument when their lengths differ.
[[nodiscard]] inline TrajectoryError trajectory_error(std::span<const Pose2> estimated,
                                                      std::span<const Pose2> truth) {
  detail::require_equal_sizes("trajectory_error", estimated.size(), truth.size());
  TrajectoryError error;
  for (std::size_t i = 0; i < estimated.size(); ++i) error.add(estimated[i], truth[i]);
  return error;
}

/// T_true_estimated, the rigid motion that brings the estimated positions nearest to the true ones in the
/// sense of least squares (Umeyama 1991 without scale, in the plane; Horn). For trajectories whose start is
/// not known to be common. Throws std::invalid_argument when the lengths differ or are 0. Where the positions
/// do not fix the rotation (all equal) it is 0.
[[nodiscard]] inline Pose2 align_rigidly(std::span<const Pose2> estimated, std::span<const Pose2> truth) {
  detail::require_equal_sizes("align_rigidly", estimated.size(), truth.size());
  require(!estimated.empty(), "align_rigidly", "the number of poses", 0.0, ">= 1");
  const double per_pose = 1.0 / static_cast<double>(estimated.size());
  Eigen::Vector2d estimated_mean(0.0, 0.0);
  Eigen::Vector2d true_mean(0.0, 0.0);
  for (std::size_t i = 0; i < estimated.size(); ++i) {
    estimated_mean = sum(estimated_mean, scaled(estimated[i].position(), per_pose));
    true_mean = sum(true_mean, scaled(truth[i].position(), per_pose));
  }
  // In the plane the best rotation is the argument of sum conj(estimated) true, as complex numbers.
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < estimated.size(); ++i) {
    const Eigen::Vector2d a = difference(estimated[i].position(), estimated_mean);
    const Eigen::Vector2d b = difference(truth[i].position(), true_mean);
    along += dot(a, b);
    across += a[0] * b[1] - a[1] * b[0];
  }
  Pose2 T_true_estimated{0.0, 0.0, std::atan2(across, along)};
  const Eigen::Vector2d shift = difference(true_mean, T_true_estimated * estimated_mean);
  T_true_estimated.x_m = shift[0];
  T_true_estimated.y_m = shift[1];
  return T_true_estimated;
}

}  // namespace incognita
