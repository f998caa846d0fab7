/// All that a robot needs of what needs Eigen alone: all rooms but io/ (libraries of its own), loops/ (costs time to compile), simulation/
/// (a robot has a world of its own) and testing/ (for tests).
#pragma once

#include "incognita/core.hpp"
#include "incognita/entropy.hpp"
#include "incognita/estimation.hpp"
#include "incognita/exploration.hpp"
#include "incognita/frontier.hpp"
#include "incognita/geometry.hpp"
#include "incognita/grid.hpp"
#include "incognita/map.hpp"
#include "incognita/metrics.hpp"
#include "incognita/planning.hpp"
#include "incognita/sensor.hpp"
#include "incognita/version.hpp"
