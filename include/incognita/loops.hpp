/// loops/: what a robot learns when it returns. `LoopClosingDvlEkf` is the filter with `LoopClosure`: it measures the pieces of
/// its map against each other and puts them where all measurements cost least, so that a map does not end up torn
/// where a ring of corridors closes. Not part of incognita.hpp: Eigen's sparse factorisations cost every
/// program that includes them some time to compile.
#pragma once

#include "incognita/loops/drift_graph.hpp"
#include "incognita/loops/kept_scans.hpp"
#include "incognita/loops/loop_closure.hpp"
