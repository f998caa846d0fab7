/// Cells that know how certain the place of what was measured in them is (Sansoni et al., 3.1 and 3.2), beside occupancy.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/map/dispersion_probability.hpp"
#include "incognita/map/dispersion_view.hpp"

namespace incognita {

/// Each cell in a scan's field of view, free space included, is a measurement of a point at its distance; what a cell keeps is the
/// probability p that such a point lies in a box of box_side_m around its mean, given the covariance of pose and sensor: (10) to
/// (12). A scan updates a cell once, by (15) and (16),
///   l += kappa (l_new - l)  unless  l > max(l_beta, l_new),
/// with l the log-odds of p and l_beta those of the largest uncertainty that is tolerated, from which a cell starts when it is first seen.
/// So a cell that is known better than a scan could tell stays as it is, and one beyond what is tolerated may get better or worse.
/// Occupancy is that of LogOdds, in steps of 1/512, a step for hit or pass once a scan, hits first.
/// View tells the log-odds of what a scan may measure, as DispersionView does.
template <class View>
class BasicDispersion {
 public:
  static constexpr bool once_a_scan = true;  ///< see OncePolicy

  /// What is tolerated, what the sensor is like, and what occupancy a scan adds.
  struct Params {
    /// The tolerated standard deviation along each axis: what is explored against what is revisited. More than an eighth of the box's
    /// side or so: a view does not tell smaller ones apart.
    double sigma_max_m = 1.0;
    double box_side_m = 0.1;      ///< s_1 = s_2 of (11), > 0
    double kappa = 0.5;           ///< of (15), in [0, 1]
    RangeBearingNoise noise;      ///< of the sensor
    double hit = 0.85;            ///< added to the occupancy's log-odds by a hit, in [1/512, 31]
    double pass = -0.4;           ///< to the log-odds by a pass, in [-31, -1/512]
    double log_odds_min = -10.0;  ///< in [-31, -1/512]
    double log_odds_max = 10.0;   ///< in [1/512, 31]

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields(
          "sigma_max_m, box_side_m, kappa, noise, hit, pass, log_odds_min, log_odds_max",
          sigma_max_m, box_side_m, kappa, noise, hit, pass, log_odds_min, log_odds_max);
    }
  };

  static constexpr int occupancy_zero = 1 << 14;  ///< what log-odds 0 of occupancy is stored as

  /// What a cell remembers, in 8 bytes.
  struct State {
    float dispersion_log_odds = 0.0F;               ///< where it is explored
    ScanStamp seen_by = 0;                          ///< the last scan that updated the cell
    std::uint16_t occupancy : 15 = occupancy_zero;  ///< in steps of 1/512 of log-odds, from occupancy_zero
    bool is_explored : 1 = false;                   ///< whether a scan ever saw it

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Archive>
    void archive_state(Archive& archive) {
      auto bits = static_cast<std::uint16_t>(occupancy | (is_explored ? 0x8000U : 0U));
      archive(dispersion_log_odds, seen_by, bits);
      if constexpr (Archive::is_loading) {
        archive.require(std::isfinite(dispersion_log_odds), "a cell's dispersion is not finite");
        occupancy = bits & 0x7FFFU;
        is_explored = (bits & 0x8000U) != 0;
      }
    }
  };

  using Beam = typename View::Beam;  ///< the log-odds along a beam, by range

  /// With the default parameters.
  BasicDispersion() : BasicDispersion(Params{}) {}

  /// Throws std::invalid_argument for parameters outside of the bounds stated with them.
  explicit BasicDispersion(const Params& params) : params_(params) {
    require_positive("Dispersion", "sigma_max_m", params.sigma_max_m);
    require_positive("Dispersion", "box_side_m", params.box_side_m);
    require(params.kappa >= 0.0 && params.kappa <= 1.0, "Dispersion", "kappa", params.kappa, "in [0, 1]");
    params.noise.validate();
    const auto require_steps = [](bool holds, const char* field, double value, const char* bound) {
      require(holds && std::abs(value) <= 31.0 && std::abs(value) >= 1.0 / steps_per_unit, "Dispersion", field, value, bound);
    };
    require_steps(params.hit > 0.0, "hit", params.hit, "in [1/512, 31]");
    require_steps(params.pass < 0.0, "pass", params.pass, "in [-31, -1/512]");
    require_steps(params.log_odds_min < 0.0, "log_odds_min", params.log_odds_min, "in [-31, -1/512]");
    require_steps(params.log_odds_max > 0.0, "log_odds_max", params.log_odds_max, "in [1/512, 31]");
    const auto steps = [](double log_odds) { return static_cast<int>(std::lround(log_odds * steps_per_unit)); };
    hit_ = steps(params.hit);
    pass_ = steps(params.pass);
    least_ = occupancy_zero + steps(params.log_odds_min);
    most_ = occupancy_zero + steps(params.log_odds_max);
    kappa_ = static_cast<float>(params.kappa);
    const Eigen::Vector2d sides = Eigen::Vector2d::Constant(params.box_side_m);
    const Eigen::Matrix2d tolerated = params.sigma_max_m * params.sigma_max_m * Eigen::Matrix2d::Identity();
    beta_ = incognita::dispersion_probability<2>(tolerated, sides);
    beta_log_odds_ = static_cast<float>(incognita::dispersion_log_odds<2>(tolerated, sides));
    require(beta_log_odds_ > View::log_odds_min && beta_log_odds_ < View::log_odds_max, "Dispersion", "sigma_max_m", params.sigma_max_m,
            "between an eighth of box_side_m and a thousand times it, or so");
  }

  [[nodiscard]] const Params& params() const { return params_; }  ///< as given

  /// The dispersion probability of what is just tolerated (Appendix A.2): that of a cell that was never seen.
  [[nodiscard]] double beta() const { return beta_; }

  /// Its log-odds.
  [[nodiscard]] float beta_log_odds() const { return beta_log_odds_; }

  /// See PoseAwarePolicy.
  [[nodiscard]] View view(const Pose2::Covariance& covariance, double range_max_m) const {
    return {covariance, range_max_m, params_.noise, params_.box_side_m};
  }

  /// A beam along x, read at 0 m, from a position that has this variance along each axis and a heading that is known. Passes lie at
  /// the negative of their residual. For those who update cells without a map; made from a view of 100 m, so less exact near the robot.
  [[nodiscard]] Beam beam(double variance_m2) const {
    Pose2::Covariance covariance = Pose2::Covariance::Zero();
    covariance(0, 0) = covariance(1, 1) = variance_m2;
    return view(covariance, 100.0).beam({1.0, 0.0}, 0.0);
  }

  /// The residual does not matter: the point lies where it was measured.
  void hit(State& state, const Beam& beam, float /*residual_m*/, ScanStamp stamp) const {
    update(state, hit_, beam.log_odds_at(beam.range_m), stamp);
  }

  /// The point lies residual_m before the beam's end.
  void pass(State& state, const Beam& beam, float residual_m, ScanStamp stamp) const {
    update(state, pass_, beam.log_odds_at(beam.range_m - residual_m), stamp);
  }

  /// No cell is known so well that no scan could know it better.
  [[nodiscard]] bool ignores_passes(const State& /*state*/) const { return false; }

  /// Nothing but the stamp changes.
  void forget_stamp(State& state) const { state.seen_by = 0; }

  /// See PriorPolicy. Of occupancy: the dispersion stays that of a cell that was never seen.
  [[nodiscard]] State state_of_log_odds(float log_odds) const {
    const int steps = static_cast<int>(std::lround(std::clamp(static_cast<double>(log_odds), -31.0, 31.0) * steps_per_unit));
    State state;
    state.occupancy = static_cast<unsigned>(std::clamp(occupancy_zero + steps, least_, most_)) & 0x7FFFU;
    return state;
  }

  /// Of occupancy.
  [[nodiscard]] static float log_odds(const State& state) {
    return static_cast<float>(state.occupancy - occupancy_zero) * (1.0F / steps_per_unit);
  }

  /// Of dispersion; l_beta where nothing was ever measured.
  [[nodiscard]] float dispersion_log_odds(const State& state) const {
    return state.is_explored ? state.dispersion_log_odds : beta_log_odds_;
  }

  /// The probability of the same.
  [[nodiscard]] double dispersion_probability(const State& state) const {
    return 1.0 / (1.0 + std::exp(-static_cast<double>(dispersion_log_odds(state))));
  }

 private:
  static constexpr int steps_per_unit = 512;

  void update(State& state, int steps, float new_log_odds, ScanStamp stamp) const {
    if (state.seen_by == stamp) return;
    const float old = dispersion_log_odds(state);
    const bool is_kept = old > std::max(beta_log_odds_, new_log_odds);  // (16)
    state.dispersion_log_odds = is_kept ? old : old + kappa_ * (new_log_odds - old);
    state.is_explored = true;
    state.seen_by = stamp;
    state.occupancy = static_cast<unsigned>(std::clamp(state.occupancy + steps, least_, most_)) & 0x7FFFU;
  }

  Params params_;
  int hit_ = 0;
  int pass_ = 0;
  int least_ = 0;
  int most_ = 0;
  float kappa_ = 0.5F;
  float beta_log_odds_ = 0.0F;
  double beta_ = 0.0;
};

/// The cell as scans of the plane write it.
using Dispersion = BasicDispersion<DispersionView>;

}  // namespace incognita
