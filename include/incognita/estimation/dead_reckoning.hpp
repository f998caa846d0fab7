/// Odometry alone: the baseline A1 of Seo et al., section VI-B.
#pragma once

#include <cstddef>
#include <span>

#include "incognita/estimation/estimator.hpp"

namespace incognita {

/// Integrates odometry and lets its variance grow; scans correct nothing.
class DeadReckoning {
 public:
  /// The noise of odometry, and where the robot starts.
  struct Params {
    /// As random as 0.05 m/s and 0.02 rad/s drawn anew every 0.02 s.
    MotionNoise noise{0.00707, 0.00283};
    PoseBelief start;  ///< in the map's frame

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Fields>
    void list_fields(Fields& fields) const {
      fields("noise, start", noise, start);
    }
  };

  /// Starts at identity, without uncertainty.
  DeadReckoning() : DeadReckoning(Params{}) {}

  /// Throws std::invalid_argument for noise or a start that is not finite, or a start covariance that is none.
  explicit DeadReckoning(const Params& params) : params_(params), belief_(params.start) {
    params.noise.validate();
    require_belief("DeadReckoning", params.start);
  }

  [[nodiscard]] const PoseBelief& belief() const { return belief_; }  ///< in the map's frame
  [[nodiscard]] bool is_ready() const { return true; }  ///< always

  /// Throws std::invalid_argument unless the increment is finite and the duration finite and >= 0.
  void predict(const Pose2& increment, double duration_s) {
    require_motion("DeadReckoning::predict", increment, duration_s);
    belief_ = propagate(belief_, increment, params_.noise, duration_s);
  }

  /// Does nothing, and trusts every scan.
  template <class MapType>
  CorrectionReport correct(const Scan<2>& /*scan*/, const MapType& /*map*/) {
    return {};
  }

  /// Does nothing.
  void learn(const Scan<2>& /*scan*/) {}

  /// As predict, of any belief. Checks nothing.
  [[nodiscard]] PoseBelief imagine_motion(const PoseBelief& belief, const Pose2& increment, double duration_s) const {
    return propagate(belief, increment, params_.noise, duration_s);
  }

  /// The belief as it is: scans tell it nothing.
  [[nodiscard]] PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation> /*hits*/,
                                        std::size_t /*beam_count*/, double /*scan_count*/) const {
    return belief;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("filter", params_);
    archive(belief_);
    archive.require(belief_.pose.is_finite(), "a pose is not finite");
  }

 private:
  Params params_;
  PoseBelief belief_;
};

}  // namespace incognita
