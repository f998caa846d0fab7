/// core/: what every other room stands on. Angles, errors that name the value and its bound, seeded random numbers,
/// integrals, and the loop over threads, the only place that names OpenMP.
#pragma once

#include "incognita/core/angles.hpp"
#include "incognita/core/counter_random.hpp"
#include "incognita/core/error.hpp"
#include "incognita/core/fast_log.hpp"
#include "incognita/core/floor.hpp"
#include "incognita/core/parallel.hpp"
#include "incognita/core/quadrature.hpp"
#include "incognita/core/random.hpp"
#include "incognita/core/split_mix.hpp"
