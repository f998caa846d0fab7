/// What an explorer asks of the estimate of the robot's pose.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/ray_update.hpp"
#include "incognita/map/map.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// What a correction by a scan rested on.
struct CorrectionReport {
  std::size_t associations = 0;   ///< N_h: beams that had something to be compared with
  double residual_rms_m = 0.0;    ///< of what was compared; 0 without associations
  double consistent_share = 1.0;  ///< of the beams that the map can judge, see ScanConsistency
  /// False when the scan cannot have been taken where the robot believes to be: neither the map nor the estimator may learn
  /// from it.
  bool trusted = true;
  bool relocated = false;  ///< the robot was found again somewhere else
  bool lost = false;       ///< too many scans in a row were not to be trusted

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(associations, residual_rms_m, consistent_share, trusted, relocated, lost);
  }
};

/// An estimator holds a PoseBelief in the map's frame. For each odometry increment: predict. For each scan, in this
/// order (Algorithm 1 of Seo et al.: the filter reads the map before the map takes the scan): correct, then the map's
/// update at the corrected belief, then learn, by which the estimator keeps what it needs of the scan for itself; both of
/// these only when the correction's report is trusted.
/// imagine_motion and imagine_scan are the same steps for poses that were not driven to: they change nothing, and may
/// be called from many threads at once.
///
/// Laws, checked by check_estimator_laws: the covariance stays symmetric and positive semi-definite; predict composes the
/// pose with the increment and does not reduce the covariance of a robot that stands; a scan without hits leaves pose and
/// covariance as they are (once the start is over); imagine_scan never adds variance; equal calls give equal beliefs.
template <class F, class MapType = Map<>>
concept Estimator =
    std::copyable<F> && requires(F& filter, const F& seen, const Pose2& increment, double duration_s,
                                 const Scan<2>& scan, const MapType& map, const PoseBelief& belief,
                                 std::span<const RayObservation> hits, std::size_t beam_count, double scan_count) {
      { seen.belief() } -> std::same_as<const PoseBelief&>;
      { seen.is_ready() } -> std::same_as<bool>;
      { filter.predict(increment, duration_s) } -> std::same_as<void>;
      { filter.correct(scan, map) } -> std::same_as<CorrectionReport>;
      { filter.learn(scan) } -> std::same_as<void>;
      { seen.imagine_motion(belief, increment, duration_s) } -> std::same_as<PoseBelief>;
      { seen.imagine_scan(belief, hits, beam_count, scan_count) } -> std::same_as<PoseBelief>;
    };

}  // namespace incognita
