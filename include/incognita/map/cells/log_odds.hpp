/// Log-odds cells with an inverse sensor model: fixed steps for a hit and a pass, whatever the pose's confidence.
#pragma once

#include <algorithm>
#include <cmath>

#include "incognita/core/error.hpp"
#include "incognita/map/cell_policy.hpp"

namespace incognita {

/// The classic occupancy cell (Moravec and Elfes; Thrun, Burgard and Fox, chapter 9): the decoupled baseline of
/// Seo et al., section VI-B. It does not look at the residual or at the pose's variance.
class LogOdds {
 public:
  /// What scans add, in log-odds, and where cells stop.
  struct Params {
    float hit = 0.85F;            ///< added to the log-odds by a hit, > 0 (p = 0.7)
    float pass = -0.4F;           ///< added to the log-odds by a pass, < 0 (p = 0.4)
    float log_odds_min = -10.0F;  ///< < 0
    float log_odds_max = 10.0F;   ///< > 0
    bool hits_win = true;         ///< passes of a scan leave alone what the same scan hit

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields("hit, pass, log_odds_min, log_odds_max, hits_win", hit, pass, log_odds_min, log_odds_max, hits_win);
    }
  };

  /// The cells of OctoMap: hit and pass are its 0.7 and 0.4 to two digits, the bounds its clamping thresholds (0.1192 and 0.971).
  [[nodiscard]] static Params octomap_params() {
    Params params;
    params.log_odds_min = -2.0F;
    params.log_odds_max = 3.5F;
    return params;
  }

  /// What a cell remembers, in 8 bytes.
  struct State {
    float log_odds = 0.0F;  ///< natural; 0 is unknown
    ScanStamp hit_by = 0;   ///< the last scan that hit the cell

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Archive>
    void archive_state(Archive& archive) {
      archive(log_odds, hit_by);
    }
  };

  struct Beam {};  ///< nothing: all beams are equal

  /// With the default parameters.
  LogOdds() : LogOdds(Params{}) {}

  /// Throws std::invalid_argument for parameters outside of the bounds stated with them.
  explicit LogOdds(const Params& params) : params_(params) {
    const auto finite_require = [](bool holds, const char* field, float value, const char* bound) {
      require(holds && std::isfinite(value), "LogOdds", field, static_cast<double>(value), bound);
    };
    finite_require(params.hit > 0.0F, "hit", params.hit, "finite and > 0");
    finite_require(params.pass < 0.0F, "pass", params.pass, "finite and < 0");
    finite_require(params.log_odds_min < 0.0F, "log_odds_min", params.log_odds_min, "finite and < 0");
    finite_require(params.log_odds_max > 0.0F, "log_odds_max", params.log_odds_max, "finite and > 0");
  }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given

  /// The variance does not matter.
  [[nodiscard]] Beam beam(double /*variance_m2*/) const { return {}; }

  /// Adds Params::hit, up to log_odds_max.
  void hit(State& state, const Beam& /*beam*/, float /*residual_m*/, ScanStamp stamp) const {
    state.hit_by = stamp;
    add(state, params_.hit);
  }

  /// Adds Params::pass, down to log_odds_min, unless this scan hit the cell and hits win.
  void pass(State& state, const Beam& /*beam*/, float /*residual_m*/, ScanStamp stamp) const {
    if (params_.hits_win && state.hit_by == stamp) return;
    add(state, params_.pass);
  }

  /// Free beyond doubt.
  [[nodiscard]] bool ignores_passes(const State& state) const { return state.log_odds <= params_.log_odds_min; }

  /// Nothing but the stamp changes.
  void forget_stamp(State& state) const { state.hit_by = 0; }

  /// See PriorPolicy.
  [[nodiscard]] State state_of_log_odds(float log_odds) const {
    return {std::clamp(log_odds, params_.log_odds_min, params_.log_odds_max), 0};
  }

  [[nodiscard]] static float log_odds(const State& state) { return state.log_odds; }  ///< as stored

 private:
  void add(State& state, float increment) const {
    state.log_odds = std::clamp(state.log_odds + increment, params_.log_odds_min, params_.log_odds_max);
  }

  Params params_;
};

static_assert(PriorPolicy<LogOdds>);

}  // namespace incognita
