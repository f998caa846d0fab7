/// exploration/: where to go next. `information_gain` predicts what driving along a path would tell (Seo et al., (16) to
/// (18), BIG with a Behavioral entropy); `find_viewpoint` and `evaluate_candidates` make and rank ways to frontiers;
/// `Explorer<Map, Entropy, Filter>` composes the three policies CellPolicy, EntropyMeasure and Estimator into the loop of
/// Algorithm 1 and ends with a StopReason. All parts work without the Explorer.
#pragma once

#include "incognita/exploration/candidate.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/exploration/set_aside.hpp"
#include "incognita/exploration/stop_reason.hpp"
