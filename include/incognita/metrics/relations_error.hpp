/// How well a trajectory agrees with measured relations between its poses.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/metrics/stamps.hpp"

namespace incognita {

/// The pose that a robot had at a time, seen from its pose at another.
struct PoseRelation {
  double from_s = 0.0;  ///< a stamp of the trajectory
  double to_s = 0.0;    ///< a later or an earlier one
  Pose2 T_from_to;      ///< true, as measured
};

/// Means over the relations whose two stamps the trajectory has; all 0 when it has none.
struct RelationsError {
  std::size_t matched = 0;          ///< relations
  double translation_mean_m = 0.0;  ///< of distances
  double rotation_mean_rad = 0.0;   ///< of absolute turns
};

/// The metric of Kümmerle et al. (2009, "On measuring the accuracy of SLAM algorithms"): the mean distance
/// and the mean absolute turn of relation^-1 * (T_from^-1 * T_to). It needs no common frame, and a bend of
/// the map counts only in the relations across it. times_s ascend, one a pose; stamps match within
/// tolerance_s. Throws std::invalid_argument for times that fall or are not as many as the poses, and for a
/// negative tolerance. O(relations log poses).
[[nodiscard]] inline RelationsError relations_error(std::span<const double> times_s,
                                                    std::span<const Pose2> poses,
                                                    std::span<const PoseRelation> relations,
                                                    double tolerance_s = 1e-5) {
  if (times_s.size() != poses.size()) {
    throw std::invalid_argument("relations_error: " + std::to_string(times_s.size()) + " times for " +
                                std::to_string(poses.size()) + " poses, but must be as many");
  }
  require_ascending("relations_error", times_s);
  require_non_negative("relations_error", "tolerance_s", tolerance_s);
  RelationsError error;
  for (const PoseRelation& relation : relations) {
    const std::optional<std::size_t> from = find_stamp(times_s, relation.from_s, tolerance_s);
    const std::optional<std::size_t> to = find_stamp(times_s, relation.to_s, tolerance_s);
    if (!from || !to) continue;
    const Pose2 difference = relation.T_from_to.inverse() * (poses[*from].inverse() * poses[*to]);
    ++error.matched;
    error.translation_mean_m += norm(difference.position());
    error.rotation_mean_rad += std::abs(difference.yaw_rad);
  }
  if (error.matched > 0) {
    error.translation_mean_m /= static_cast<double>(error.matched);
    error.rotation_mean_rad /= static_cast<double>(error.matched);
  }
  return error;
}

}  // namespace incognita
