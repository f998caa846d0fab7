/// estimation/: where the robot is. `DvlEkf` weighs each hit by the map's confidence (Seo et al., section IV-B);
/// `DeadReckoning` is the baseline. Both model the concept Estimator, whose page states the laws. `register_scan`,
/// `ray_update` and `propagate` are the filter's steps as free functions; `SurfaceMap` holds what registration needs;
/// `CorrelativeSearch` finds the pose again when odometry is too far off to register. `Slam` couples a filter and a map. `LandmarkSlam` is a
/// linear filter of its own, for robots that know their heading.
/// For maps that stay whole where a ring of corridors closes, see loops/.
#pragma once

#include "incognita/estimation/compass.hpp"
#include "incognita/estimation/correlative_search.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/estimator.hpp"
#include "incognita/estimation/filter_with_map.hpp"
#include "incognita/estimation/information.hpp"
#include "incognita/estimation/landmark_slam.hpp"
#include "incognita/estimation/likelihood_grid.hpp"
#include "incognita/estimation/likelihood_pyramid.hpp"
#include "incognita/estimation/map_drift.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/ray_update.hpp"
#include "incognita/estimation/registration.hpp"
#include "incognita/estimation/relocation.hpp"
#include "incognita/estimation/scan_consistency.hpp"
#include "incognita/estimation/search_lattice.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/estimation/surface_map.hpp"
#include "incognita/estimation/yaw_update.hpp"
