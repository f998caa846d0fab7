/// One mission of a study.
#pragma once

#include <string>

#include "experiment/arena.hpp"
#include "experiment/settings.hpp"

namespace experiment {

/// A mission in two texts, each the members of a JSON object without its braces.
struct TrialText {
  std::string result;  ///< metrics, how they grew, and the way: the same on any machine and number of threads
  std::string cost;    ///< what it took
};

/// Throws what the simulation throws.
[[nodiscard]] TrialText run_trial(const Arena& arena, const Settings& settings, int start, int seed);

}  // namespace experiment
