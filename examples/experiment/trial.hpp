/// One mission of a study.
#pragma once

#include <string>

#include "experiment/arena.hpp"
#include "experiment/settings.hpp"
#include "incognita/geometry/pose2.hpp"

namespace experiment {

/// A mission in two texts, each the members of a JSON object without its braces.
struct TrialText {
  std::string result;  ///< metrics, how they grew, and the way: the same for any number of threads or ranks
  std::string cost;    ///< what it took
};

/// Throws std::invalid_argument for settings that no mission can have.
void require_possible(const Settings& settings);

/// The pose in the plan's frame that a trial begins at. Throws what random_start throws: where the robot fits nowhere.
[[nodiscard]] incognita::Pose2 start_of_trial(const Arena& arena, const Settings& settings, int start);

/// Throws what the simulation throws.
[[nodiscard]] TrialText run_trial(const Arena& arena, const Settings& settings, int start, int seed);

}  // namespace experiment
