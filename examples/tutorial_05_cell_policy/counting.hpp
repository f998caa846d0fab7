/// A cell policy of one's own: how often beams that reached a cell ended in it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/map/cell_policy.hpp"

/// A beam that reaches the cell ends in it with an unknown probability r, the share of hits: 1 for a wall, 0 for air, something
/// between for glass, a mesh fence or the legs of a table. With a Beta(a, b) prior, r given h hits and m passes is
/// Beta(a + h, b + m). The cell is called occupied by comparing the odds of r with what the prior expects,
///   l = ln((a + h) / (b + m)) - ln(a / b),
/// so that a prior with a mean of 0.02 takes what stops one beam in twenty for an obstacle.
class Counting {
 public:
  struct Params {
    double prior_hits = 0.05;              ///< a, > 0
    double prior_passes = 2.45;            ///< b, > 0
    std::uint16_t count_max = 1000;        ///< both counts are halved beyond: the old is forgotten; in 2..60000
  };

  struct State {
    float log_odds = 0.0F;
    std::uint16_t hits = 0;
    std::uint16_t passes = 0;
  };

  struct Beam {};  // nothing is constant along a beam

  Counting() : Counting(Params{}) {}

  explicit Counting(const Params& params) : params_(params) {
    incognita::require_positive("Counting", "prior_hits", params.prior_hits);
    incognita::require_positive("Counting", "prior_passes", params.prior_passes);
    incognita::require(params.count_max >= 2 && params.count_max <= 60000, "Counting", "count_max", params.count_max, "in 2..60000");
  }

  [[nodiscard]] Beam beam(double /*variance_m2*/) const { return {}; }

  void hit(State& state, const Beam& /*beam*/, float /*residual_m*/, incognita::ScanStamp /*stamp*/) const {
    count(state, state.hits);
  }

  void pass(State& state, const Beam& /*beam*/, float residual_m, incognita::ScanStamp /*stamp*/) const {
    if (residual_m < 0.1F || ignores_passes(state)) return;  // so near to the surface a pass may be its edge
    count(state, state.passes);
  }

  /// Free for as long as is remembered.
  [[nodiscard]] bool ignores_passes(const State& state) const { return state.hits == 0 && state.passes >= params_.count_max; }

  void forget_stamp(State& /*state*/) const {}  // no stamps are kept

  [[nodiscard]] static float log_odds(const State& state) { return state.log_odds; }

  /// Of r: its mean and standard deviation.
  [[nodiscard]] double mean(const State& state) const { return hits(state) / (hits(state) + passes(state)); }
  [[nodiscard]] double sigma(const State& state) const {
    const double sum = hits(state) + passes(state);
    return std::sqrt(mean(state) * (1.0 - mean(state)) / (sum + 1.0));
  }

 private:
  [[nodiscard]] double hits(const State& state) const { return params_.prior_hits + state.hits; }
  [[nodiscard]] double passes(const State& state) const { return params_.prior_passes + state.passes; }

  void count(State& state, std::uint16_t& counted) const {
    ++counted;
    if (counted > params_.count_max) {
      state.hits = static_cast<std::uint16_t>(state.hits / 2);
      state.passes = static_cast<std::uint16_t>(state.passes / 2);
    }
    const double prior = std::log(params_.prior_hits / params_.prior_passes);
    state.log_odds = static_cast<float>(std::log(hits(state) / passes(state)) - prior);
  }

  Params params_;
};

static_assert(incognita::CellPolicy<Counting>);
