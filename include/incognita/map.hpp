/// map/: beliefs over occupancy. `Map<Cell>` grows with what it is shown; a cell policy (concept CellPolicy, with its laws)
/// says what a hit and a pass do to one cell: TBayes (Seo et al.) or LogOdds. `Overlay` predicts scans on top of a map
/// without copying it. `classify` reduces a belief to free, occupied and unknown for frontiers and planning;
/// `OccupancyLayer` and `EntropyLayer` follow a map scan by scan at the cost of what changes.
#pragma once

#include "incognita/map/cell_layers.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/map/learned_cells.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/map/occupancy_layer.hpp"
#include "incognita/map/overlay.hpp"
#include "incognita/map/scan_integration.hpp"
