/// geometry/: poses in the plane and in space, twists, axis-aligned boxes. A pose named T_a_b takes coordinates in
/// frame b to coordinates in frame a.
#pragma once

#include "incognita/geometry/box.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/pose3.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/vector.hpp"
