/// When an explorer plans anew, and what it weighs (Isleyen, van de Molengraft and Arslan).
#pragma once

namespace incognita {

/// When the way to a viewpoint is given up for another (Table I).
enum class Strategy {
  persistent,  ///< at the viewpoint (Algorithm 2)
  last_mile,   ///< as soon as the viewpoint is no longer informative (Algorithm 3)
  online       ///< in fixed periods, if enough was learned (Algorithm 4 plans whether it was or not, and can swing for ever)
};

/// What is known of a frontier before it is gone to.
enum class FrontierInformation {
  uniform,  ///< 1 (Table II)
  size,     ///< its cells, in square metres (Table II)
  entropy,  ///< of its cells (Table II)
  big,      ///< the information gain of the path to its viewpoint (Seo et al., (16); BIG of (18) with a Behavioral entropy)
  log_big   ///< ln(1 + big / the least gain worth going for, or else a cell's): what is at hand is seen before what is large, docs/exploration.md
};

/// Whether it is told by the path to the viewpoint.
[[nodiscard]] constexpr bool is_of_path(FrontierInformation information) {
  return information == FrontierInformation::big || information == FrontierInformation::log_big;
}

}  // namespace incognita
