/// planning/: from a belief to speeds, for a disc-shaped robot in the plane. `TravelCostField` is one search
/// that serves all goals; `find_path` and `shorten_path` turn it into a path; `PathFollower` follows a path,
/// through the middle of what is narrow (`roomiest_aside`);
/// `guard_command` slows the robot down before what its latest scan shows; `Retreat` takes it out of a tight
/// place. `safe_spaces`, `visit_cost` and `SafePathFollower` are the planning of Isleyen et al.: where a body fits, paths that keep
/// clear of walls and near to the unknown, and a unicycle that follows them without leaving where it fits. `AllowedArea` is where a
/// user lets the robot be. `MppiController` steers along a path by many plans compared; it is in planning/mppi.hpp, which costs time to
/// compile, and looks at what a `ClearanceWindow` measures. `RandomTree` is an RRT or RRT* with a cost of any kind, such as `LandmarkCost`. Each part works without the others.
#pragma once

#include "incognita/planning/allowed_area.hpp"
#include "incognita/planning/clearance_window.hpp"
#include "incognita/planning/closed_cells.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/planning/landmark_cost.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/polyline.hpp"
#include "incognita/planning/random_tree.hpp"
#include "incognita/planning/retreat.hpp"
#include "incognita/planning/room_aside.hpp"
#include "incognita/planning/safe_follow.hpp"
#include "incognita/planning/safe_space.hpp"
#include "incognita/planning/travel_cost.hpp"
#include "incognita/planning/visit_cost.hpp"
