/// map/: beliefs over occupancy. `Map<Cell>` grows with what it is shown; a cell policy (concept CellPolicy, with its laws)
/// says what a hit and a pass do to one cell: TBayes (Seo et al.), LogOdds, or Dispersion, which also knows how certain the place of
/// what it holds is (Sansoni et al.; `uncertainty_map` draws it). `Overlay` predicts scans on top of a map
/// without copying it. `map_with_prior` starts a map from what is known already. `classify` reduces a belief to free, occupied and unknown for frontiers and planning;
/// `OccupancyLayer`, `EntropyLayer` and `CellSum` follow a map scan by scan at the cost of what changes.
#pragma once

#include "incognita/map/cell_layers.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/map/cell_sum.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/exact_pose.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/dispersion_probability.hpp"
#include "incognita/map/dispersion_view.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/map/learned_cells.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/map/occupancy_layer.hpp"
#include "incognita/map/overlay.hpp"
#include "incognita/map/prior.hpp"
#include "incognita/map/scan_integration.hpp"
#include "incognita/map/uncertainty_map.hpp"
