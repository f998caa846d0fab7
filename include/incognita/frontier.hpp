/// frontier/: where what is known to be free ends. `detect_frontier` lists the free cells of a belief that
/// border on the open unknown, `cluster_frontier` groups them, `find_frontiers` does both. They read an
/// OccupancyGrid in two or three dimensions and need nothing else of the library: no map, filter or planner. `FrontierLayer`
/// has the same cells of a map of the plane and follows it scan by scan. `find_uncertainty_frontiers` lists where the uncertainty
/// of what was seen leaps (Sansoni et al.): places to explore, or to look at again.
#pragma once

#include "incognita/frontier/detection.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/frontier/uncertainty_frontier.hpp"
