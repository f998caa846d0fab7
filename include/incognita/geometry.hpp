/// geometry/: poses in the plane, twists and the arcs that they drive, axis-aligned boxes, polygons, the size of a covariance. A pose named T_a_b takes coordinates in frame b to coordinates in
/// frame a. Poses in space are in geometry/pose3.hpp, which costs time to compile.
#pragma once

#include "incognita/geometry/box.hpp"
#include "incognita/geometry/d_optimality.hpp"
#include "incognita/geometry/disc_hull.hpp"
#include "incognita/geometry/polygon.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/principal_axes.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/geometry/vector.hpp"
