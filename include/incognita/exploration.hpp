/// exploration/: where to go next. `information_gain` predicts what driving along a path would tell (Seo et al., (16) to
/// (18), BIG with a Behavioral entropy), `evaluate_candidates` what many would. `ViewpointSearch` tells from where a frontier is
/// reliably seen and what is seen from there, `find_views` and `choose_view` which frontier tells most for the cost of getting there
/// (Isleyen et al., (20) to (28)); `plan_exploration` is their Algorithm 1 as a whole. `Explorer<Map, Entropy, Filter>` composes
/// the three policies CellPolicy, EntropyMeasure and Estimator into a loop with a Strategy that ends with a StopReason. All parts
/// work without the Explorer.
#pragma once

#include "incognita/exploration/action_aware.hpp"
#include "incognita/exploration/candidate.hpp"
#include "incognita/exploration/candidate_search.hpp"
#include "incognita/exploration/decision_reason.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/exploration/explorer_params.hpp"
#include "incognita/exploration/frontier_information.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/stop_reason.hpp"
#include "incognita/exploration/strategy.hpp"
#include "incognita/exploration/viewpoints.hpp"
