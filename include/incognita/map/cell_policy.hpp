/// What a map asks of the rule that updates one cell.
#pragma once

#include <concepts>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

#include "incognita/geometry/pose2.hpp"

namespace incognita {

/// Numbers the scans of a map so that a cell can remember that a scan has already settled it. 0 is never a scan.
using ScanStamp = std::uint16_t;

/// A cell policy is a value with parameters; a `State` is what one cell remembers; a `Beam` holds what is constant
/// along one beam. `residual_m` is measured range minus the distance from the sensor to the centre of the cell,
/// h(x, m) of Seo et al., (6); `variance_m2` is the pose's variance projected on the beam, H Sigma H^T of (13).
///
/// Laws, checked by check_cell_policy_laws: State{} has log-odds exactly 0 (unknown); a hit of an unknown cell at an
/// exact pose, with residual 0, raises it, and a pass far before the surface lowers it; log-odds stay finite under any
/// sequence of hits and passes; a pass leaves a state for which ignores_passes holds as it is, to the bit (most of what a
/// scan meets is free and known to be, so maps ask before they touch a cell); equal sequences give equal states; forget_stamp
/// leaves the log-odds as they are and makes every stamp new.
/// A map hands a scan over in two rounds, first its hits, then its passes, so a policy may let hits win.
/// hit and pass are O(1) and noexcept in spirit: they are the hot path. A const policy is safe to share among threads.
template <class P>
concept CellPolicy =
    std::copyable<P> && std::is_trivially_copyable_v<typename P::State> &&
    std::default_initializable<typename P::State> && (sizeof(typename P::State) <= 8) &&
    requires(const P& policy, typename P::State& state, const typename P::State& seen,
             const typename P::Beam& beam, double variance_m2, float residual_m, ScanStamp stamp) {
      { policy.beam(variance_m2) } -> std::same_as<typename P::Beam>;
      { policy.hit(state, beam, residual_m, stamp) } -> std::same_as<void>;
      { policy.pass(state, beam, residual_m, stamp) } -> std::same_as<void>;
      { policy.ignores_passes(seen) } -> std::same_as<bool>;
      { policy.forget_stamp(state) } -> std::same_as<void>;
      { P::log_odds(seen) } -> std::same_as<float>;
    };

/// A policy may say what a pass far before the surface leaves of a cell that was never written, so that maps clear many of them
/// at once. Law: a pass of State{} with a residual of at least clearing_residual_m(beam), for ranges up to 1 km whatever the
/// rounding of a float, leaves cleared(), to the bit, and cleared() ignores passes.
template <class P>
concept ClearingPolicy = CellPolicy<P> && requires(const P& policy, const typename P::Beam& beam) {
  { policy.cleared() } -> std::same_as<typename P::State>;
  { policy.clearing_residual_m(beam) } -> std::same_as<float>;
};

/// A policy may ask for all of a pose's covariance rather than the variance along each beam. Maps of the plane then call view once
/// a scan, and its beam for each beam, with the direction in the map's axes (a unit vector) and the range that was read.
template <class P>
concept PoseAwarePolicy =
    CellPolicy<P> && requires(const P& policy, const Pose2::Covariance& covariance, double range_m, const Eigen::Vector2d& direction) {
      { policy.view(covariance, range_m).beam(direction, range_m) } -> std::same_as<typename P::Beam>;
    };

/// A policy may say that a cell takes one update a scan, so that maps step over what a scan has settled. Law: a hit or a pass with the
/// stamp of the last update leaves a state as it is.
template <class P>
concept OncePolicy = CellPolicy<P> && P::once_a_scan;

/// A policy may make the state of a cell of which log-odds are known already, so that a map starts from a prior (map/prior.hpp). Laws:
/// state_of_log_odds(l) has the log-odds l, held within the policy's bounds and to its steps; those of 0 are exactly 0; no stamp is in
/// it. l may be infinite.
template <class P>
concept PriorPolicy = CellPolicy<P> && requires(const P& policy, float log_odds) {
  { policy.state_of_log_odds(log_odds) } -> std::same_as<typename P::State>;
};

/// A policy may know how certain the place of what a cell holds is, as log-odds of a dispersion probability (map/cells/dispersion.hpp),
/// and what is just tolerated, beta.
template <class P>
concept DispersionPolicy = CellPolicy<P> && requires(const P& policy, const typename P::State& state) {
  { policy.dispersion_log_odds(state) } -> std::same_as<float>;
  { policy.beta() } -> std::same_as<double>;
  { state.is_explored } -> std::convertible_to<bool>;
};

}  // namespace incognita
