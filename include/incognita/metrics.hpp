/// The door of metrics/: what a mission was worth, in figures.
///
/// - metrics/trajectory_error.hpp: RMSE and MAE of a trajectory, and its rigid alignment
/// - metrics/relations_error.hpp: agreement with measured relations between poses (Kümmerle et al.)
/// - metrics/stamps.hpp: poses of different trajectories that belong to one instant
/// - metrics/nees.hpp: normalised estimation error squared
/// - metrics/map_error.hpp: map error and map uncertainty of Seo et al., section VI-A
/// - metrics/truth.hpp: the cells of a belief that are truly occupied
/// - metrics/visible_floor.hpp: the floor that can be seen from where a disc can go
/// - metrics/coverage.hpp: the share of that floor which a belief knows
/// - metrics/mapped_fraction.hpp: the share of a workspace's cells which a belief knows
///
/// Estimates and truth are compared in one frame: a simulated robot starts at the identity of its own frame,
/// so T_belief_world is the inverse of the true start pose. Accumulators are plain values; sums run in the
/// order of add(), so a figure is the same on any number of threads.
#pragma once

#include "incognita/metrics/belief_box.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/map_error.hpp"
#include "incognita/metrics/mapped_fraction.hpp"
#include "incognita/metrics/nees.hpp"
#include "incognita/metrics/relations_error.hpp"
#include "incognita/metrics/stamps.hpp"
#include "incognita/metrics/trajectory_error.hpp"
#include "incognita/metrics/truth.hpp"
#include "incognita/metrics/visible_floor.hpp"
