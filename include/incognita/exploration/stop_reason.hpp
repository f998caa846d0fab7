/// Why an exploration ended.
#pragma once

#include <string_view>

namespace incognita {

/// Why an exploration has ended.
enum class StopReason {
  complete,             ///< no frontier is left
  nothing_informative,  ///< frontiers are left, but going there would tell nothing new, or was tried and given up
  nothing_reachable,    ///< the robot's body cannot get to where any of the frontiers that are left is seen, or, returning, back to
                        ///< the start, or not in time; or stands where nothing is known to be free, or where it may not be
  lost,                 ///< the pose is more uncertain than the bound given, or its scans have contradicted the map for too long
  out_of_time,          ///< the time given is over
  stopped,              ///< on request
  returned              ///< to the start, on request
};

/// The name of the enumerator.
[[nodiscard]] constexpr std::string_view to_string(StopReason reason) {
  switch (reason) {
    case StopReason::complete: return "complete";
    case StopReason::nothing_informative: return "nothing_informative";
    case StopReason::nothing_reachable: return "nothing_reachable";
    case StopReason::lost: return "lost";
    case StopReason::out_of_time: return "out_of_time";
    case StopReason::stopped: return "stopped";
    case StopReason::returned: return "returned";
  }
  return "unknown";
}

}  // namespace incognita
