/// T-BayesMap: a cell updated by tempered DVL likelihoods, marginalised over the pose (Seo et al., Lemma 4.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "incognita/core/error.hpp"
#include "incognita/core/fast_log.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/sensor/dvl.hpp"

namespace incognita {

/// The increment of a cell's log-odds by one beam is, from (14) and (15) with N the number of hits, this one included,
///   dl = (1 - N/N_max) ln N(r; 0, S_o) - (N/N_max) ln N(r; 0, S_u),   S = H Sigma H^T + R.
/// An uncertain pose widens S and so weakens the update; a cell that was hit before resists beams through it.
///
/// Rule::literal adds dl for every hit and pass, as printed. So printed, a beam through a cell with N = N_max can only
/// raise it: walls thicken, and what was hit N_max times is never freed again. Rule::robust (the default) adds
/// dl of a pass only where it lowers the cell, and lets passes free a saturated cell slowly: by erosion_log_odds, once
/// a scan, unless the scan also hit it or the surface is near; what falls below 0 starts again with N = 0.
class TBayes {
 public:
  /// What a pass does to a cell: the repaired rule, or the printed one.
  enum class Rule {
    robust,  ///< passes lower cells, and free saturated ones slowly
    literal  ///< (15) as printed
  };

  /// The sensor's likelihood, and where cells stop.
  struct Params {
    Rule rule = Rule::robust;            ///< of passes
    DvlVariances dvl;                    ///< R_o and R_u
    int hits_max = 3;                    ///< N_max, 1 to 255
    float log_odds_min = -20.0F;         ///< < 0
    float log_odds_max = 6.0F;           ///< > 0
    float erosion_log_odds = 0.4F;       ///< robust: what a scan through a saturated cell takes, >= 0
    double erosion_residual_m = 0.6;     ///< robust: erosion only where the beam goes on for longer, >= 0 ...
    double erosion_residual_sigmas = 3;  ///< ... and for longer than this many standard deviations of the pose along the beam

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields(
          "rule, dvl, hits_max, log_odds_min, log_odds_max, erosion_log_odds, erosion_residual_m, erosion_residual_sigmas",
          rule, dvl, hits_max, log_odds_min, log_odds_max, erosion_log_odds, erosion_residual_m, erosion_residual_sigmas);
    }
  };

  /// The paper's equation alone: no bounds, no erosion.
  [[nodiscard]] static Params literal_params() {
    Params params;
    params.rule = Rule::literal;
    params.log_odds_min = -std::numeric_limits<float>::max();
    params.log_odds_max = std::numeric_limits<float>::max();
    return params;
  }

  /// What a cell remembers, in 8 bytes.
  struct State {
    float log_odds = 0.0F;     ///< natural; 0 is unknown
    ScanStamp settled_by = 0;  ///< the last scan that hit or eroded the cell
    std::uint8_t hits = 0;     ///< N_a of (14)

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Archive>
    void archive_state(Archive& archive) {
      archive(log_odds, settled_by, hits);
    }
  };

  /// ln N(r; 0, S) = offset - r^2 precision_half, for the two occupancies of the cell.
  struct Beam {
    float occupied_offset,          ///< S with R_o, without a unit
        occupied_half_precision;    ///< in 1/m^2
    float unoccupied_offset,        ///< S with R_u, without a unit
        unoccupied_half_precision;  ///< in 1/m^2
    float erosion_residual2_m2;     ///< passes nearer than its root do not erode
  };

  /// With the default parameters.
  TBayes() : TBayes(Params{}) {}

  /// Throws std::invalid_argument for parameters outside of the bounds stated with them.
  explicit TBayes(const Params& params) : params_(params) {
    params_.dvl.validate();
    // Beam's half precision is a float.
    require(params.dvl.occupied_m2 >= 1e-12, "TBayes", "dvl.occupied_m2", params.dvl.occupied_m2, ">= 1e-12");
    require(params.hits_max >= 1 && params.hits_max <= 255, "TBayes", "hits_max", params.hits_max, "in 1..255");
    require(params.log_odds_min < 0.0F && std::isfinite(params.log_odds_min), "TBayes", "log_odds_min",
            static_cast<double>(params.log_odds_min), "finite and < 0");
    require(params.log_odds_max > 0.0F && std::isfinite(params.log_odds_max), "TBayes", "log_odds_max",
            static_cast<double>(params.log_odds_max), "finite and > 0");
    require_non_negative("TBayes", "erosion_log_odds", static_cast<double>(params.erosion_log_odds));
    require_non_negative("TBayes", "erosion_residual_m", params.erosion_residual_m);
    require_non_negative("TBayes", "erosion_residual_sigmas", params.erosion_residual_sigmas);
    erosion_residual2_m2_ = params.erosion_residual_m * params.erosion_residual_m;
    erosion_sigmas2_ = params.erosion_residual_sigmas * params.erosion_residual_sigmas;
    per_hit_ = 1.0F / static_cast<float>(params.hits_max);
  }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given

  /// What is constant along a beam at a pose with this variance along it.
  [[nodiscard]] Beam beam(double variance_m2) const {
    const double occupied_m2 = variance_m2 + params_.dvl.occupied_m2;
    const double unoccupied_m2 = variance_m2 + params_.dvl.unoccupied_m2;
    constexpr double two_pi = 2.0 * std::numbers::pi;
    const double half_per_both = 0.5 / (occupied_m2 * unoccupied_m2);  // one division for two
    return {static_cast<float>(-0.5 * fast_log(two_pi * occupied_m2)),
            static_cast<float>(half_per_both * unoccupied_m2),
            static_cast<float>(-0.5 * fast_log(two_pi * unoccupied_m2)),
            static_cast<float>(half_per_both * occupied_m2),
            static_cast<float>(std::max(erosion_residual2_m2_, erosion_sigmas2_ * variance_m2))};
  }

  /// (15) for the cell a beam ends in. The count is raised first, as Algorithm 1 does.
  void hit(State& state, const Beam& beam, float residual_m, ScanStamp stamp) const {
    if (state.hits < params_.hits_max) ++state.hits;
    state.settled_by = stamp;
    add(state, increment(state, beam, residual_m));
  }

  /// (15) for a cell a beam passes.
  void pass(State& state, const Beam& beam, float residual_m, ScanStamp stamp) const {
    const float change = increment(state, beam, residual_m);
    if (params_.rule == Rule::literal) {
      add(state, change);
      return;
    }
    // Selected rather than branched on: what a cell is cannot be foreseen, and the next one waits.
    const bool is_saturated = state.hits == params_.hits_max;
    const bool erodes = is_saturated & (state.settled_by != stamp) & (residual_m > 0.0F) &
                        (residual_m * residual_m > beam.erosion_residual2_m2);
    const float eroded = erodes ? -params_.erosion_log_odds : 0.0F;
    add(state, is_saturated ? eroded : std::min(0.0F, change));
    state.settled_by = erodes ? stamp : state.settled_by;
    const bool starts_anew = erodes & (state.log_odds < 0.0F);
    state.hits = starts_anew ? std::uint8_t{0} : state.hits;
  }

  /// Free beyond doubt, and not saturated with hits.
  [[nodiscard]] bool ignores_passes(const State& state) const {
    return state.log_odds <= params_.log_odds_min && state.hits < params_.hits_max && params_.rule == Rule::robust;
  }

  /// See ClearingPolicy.
  [[nodiscard]] State cleared() const { return {params_.log_odds_min, 0, 0}; }

  /// Where ln N(r; 0, S_o) falls below log_odds_min, and a little further, so that rounding does not matter.
  [[nodiscard]] float clearing_residual_m(const Beam& beam) const {
    if (params_.rule == Rule::literal) return std::numeric_limits<float>::infinity();
    const float to_fall = std::max(0.0F, beam.occupied_offset - params_.log_odds_min);
    return 1e-4F + 1.0001F * std::sqrt(to_fall / beam.occupied_half_precision);
  }

  /// Nothing but the stamp changes.
  void forget_stamp(State& state) const { state.settled_by = 0; }

  /// See PriorPolicy. The cell was hit as often as hits at an exact pose, with residual 0, take to raise a new one so far, so what is
  /// believed to be a wall resists beams as a wall does. O(hits_max).
  [[nodiscard]] State state_of_log_odds(float log_odds) const {
    State state{std::clamp(log_odds, params_.log_odds_min, params_.log_odds_max), 0, 0};
    const Beam exact = beam(0.0);
    for (float raised = 0.0F; raised < state.log_odds && state.hits < params_.hits_max;) {
      ++state.hits;
      raised += increment(state, exact, 0.0F);
    }
    return state;
  }

  [[nodiscard]] static float log_odds(const State& state) { return state.log_odds; }  ///< as stored

 private:
  [[nodiscard]] float increment(const State& state, const Beam& beam, float residual_m) const {
    const float unoccupied_weight = static_cast<float>(state.hits) * per_hit_;
    const float r2 = residual_m * residual_m;
    return (1.0F - unoccupied_weight) * (beam.occupied_offset - r2 * beam.occupied_half_precision) -
           unoccupied_weight * (beam.unoccupied_offset - r2 * beam.unoccupied_half_precision);
  }

  void add(State& state, float increment) const {
    state.log_odds = std::clamp(state.log_odds + increment, params_.log_odds_min, params_.log_odds_max);
  }

  Params params_;
  float per_hit_ = 0.0F;
  double erosion_residual2_m2_ = 0.0;
  double erosion_sigmas2_ = 0.0;
};

static_assert(ClearingPolicy<TBayes> && PriorPolicy<TBayes>);

}  // namespace incognita
