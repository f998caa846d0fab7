/// Odometry with noise: what a robot's wheels say of its own motion.
#pragma once

#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/twist2.hpp"
#include "incognita/geometry/unicycle.hpp"

namespace incognita {

/// Standard deviations of the measured twist, drawn anew each step. Reading of Seo et al., "Estimation": at
/// 50 Hz these give the drift that the paper shows.
struct OdometryParams {
  double speed_sigma_m_per_s = 0.05;        ///< >= 0
  double turn_rate_sigma_rad_per_s = 0.02;  ///< >= 0

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("speed_sigma_m_per_s, turn_rate_sigma_rad_per_s", speed_sigma_m_per_s, turn_rate_sigma_rad_per_s);
  }
};

/// Measures the twist that a robot really made plus normal noise. So odometry knows when a wall stops the
/// robot, as wheels that stall do; slipping wheels are not modelled.
class Odometry {
 public:
  /// Throws std::invalid_argument for bad parameters.
  Odometry(const OdometryParams& params, std::uint64_t seed) : params_(params), random_(seed) {
    require_non_negative("Odometry", "speed_sigma_m_per_s", params.speed_sigma_m_per_s);
    require_non_negative("Odometry", "turn_rate_sigma_rad_per_s", params.turn_rate_sigma_rad_per_s);
  }

  /// T_before_after as measured over one step in which the robot made `twist`.
  [[nodiscard]] Pose2 measure(const Twist2& twist, double duration_s) {
    const double speed_m_per_s = random_.normal(twist.speed_m_per_s, params_.speed_sigma_m_per_s);
    const double turn_rate_rad_per_s =
        random_.normal(twist.turn_rate_rad_per_s, params_.turn_rate_sigma_rad_per_s);
    return unicycle_motion({speed_m_per_s, turn_rate_rad_per_s}, duration_s);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("odometry", params_);
    archive(random_);
  }

 private:
  OdometryParams params_;
  Random random_;
};

}  // namespace incognita
