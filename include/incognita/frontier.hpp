/// frontier/: where what is known to be free ends. `detect_frontier` lists the free cells of a belief that
/// border on the open unknown, `cluster_frontier` groups them, `find_frontiers` does both. They read an
/// OccupancyGrid in two or three dimensions and need nothing else of the library: no map, filter or planner. `FrontierLayer`
/// has the same cells of a map of the plane and follows it scan by scan.
#pragma once

#include "incognita/frontier/detection.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
