/// Why an explorer decided anew where to go.
#pragma once

#include <string_view>

namespace incognita {

/// What ended the time of the goal before.
enum class DecisionReason {
  no_goal,        ///< there was none: at the start, or after a pause or an end
  arrived,        ///< at the goal
  in_vain,        ///< arrived, and nothing around had changed: the goal is set aside
  overdue,        ///< the way took too long: the goal is set aside
  path_closed,    ///< something has come in the way
  seen_enough,    ///< what the goal was chosen for has been seen on the way
  learned,        ///< enough was learned to compare goals again (Strategy::online)
  way_in_doubt,   ///< the robot was found elsewhere, the map drawn again, or a retreat is over
  ended           ///< nothing was decided but to stop
};

/// The name of the enumerator.
[[nodiscard]] constexpr std::string_view to_string(DecisionReason reason) {
  switch (reason) {
    case DecisionReason::no_goal: return "no_goal";
    case DecisionReason::arrived: return "arrived";
    case DecisionReason::in_vain: return "in_vain";
    case DecisionReason::overdue: return "overdue";
    case DecisionReason::path_closed: return "path_closed";
    case DecisionReason::seen_enough: return "seen_enough";
    case DecisionReason::learned: return "learned";
    case DecisionReason::way_in_doubt: return "way_in_doubt";
    case DecisionReason::ended: return "ended";
  }
  return "unknown";
}

}  // namespace incognita
