/// Parameters of surfaces that tests lay out by hand.
#pragma once

#include "incognita/estimation/surface_map.hpp"

/// Cells of 0.2 m and neighbourhoods to match, wide enough for points that a test puts down one by one.
inline incognita::SurfaceMap<2>::Params coarse_params() {
  incognita::SurfaceMap<2>::Params params;
  params.cell_m = 0.2;
  params.pool_radius_m = 0.3;
  params.flatness = 0.1;
  return params;
}
