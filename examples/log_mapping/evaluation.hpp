/// How good the trajectory of a mapped log is.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/input_error.hpp"
#include "incognita/io/relations.hpp"
#include "incognita/io/tum.hpp"
#include "incognita/metrics/relations_error.hpp"
#include "incognita/metrics/stamps.hpp"
#include "incognita/metrics/trajectory_error.hpp"

namespace log_mapping {

using Trajectory = std::vector<incognita::TimedPose2>;

/// A trajectory as the metrics take it.
struct Stamped {
  std::vector<double> times_s;
  std::vector<incognita::Pose2> poses;

  explicit Stamped(const Trajectory& trajectory) {
    for (const incognita::TimedPose2& timed : trajectory) {
      times_s.push_back(timed.time_s);
      poses.push_back(timed.pose);
    }
  }
};

/// Against another trajectory of the same scans.
struct ReferenceError {
  double ate_rmse_m = 0.0;  ///< of positions, after rigid alignment
  Trajectory reference;     ///< aligned to the estimate, in the map's frame
};

/// Stamps match to 10 us, as relations do. Throws incognita::InputError, which names `file`, when fewer than
/// two poses match.
[[nodiscard]] inline ReferenceError compare(const Trajectory& estimated, const Trajectory& reference,
                                            const std::filesystem::path& file) {
  using namespace incognita;
  const Stamped known(reference);
  std::vector<Pose2> ours;
  std::vector<Pose2> theirs;
  for (const TimedPose2& timed : estimated) {
    const std::optional<std::size_t> match = find_stamp(known.times_s, timed.time_s, 1e-5);
    if (!match) continue;
    ours.push_back(timed.pose);
    theirs.push_back(known.poses[*match]);
  }
  if (ours.size() < 2) {
    throw InputError(file, "has " + std::to_string(ours.size()) + " scans at the times of the log, but must have 2 or more");
  }
  const Pose2 T_map_reference = align_rigidly(theirs, ours);
  for (Pose2& pose : theirs) pose = T_map_reference * pose;
  ReferenceError error;
  error.ate_rmse_m = trajectory_error(ours, theirs).translation_rmse_m();
  for (const TimedPose2& timed : reference)
    error.reference.push_back({timed.time_s, T_map_reference * timed.pose});
  return error;
}

/// All that can be said; what was not given stays empty.
struct Evaluation {
  std::optional<ReferenceError> reference;
  std::optional<incognita::RelationsError> relations;
  std::optional<incognita::RelationsError> odometry_relations;
};

}  // namespace log_mapping
