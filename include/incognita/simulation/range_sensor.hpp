/// A range sensor in a world: exact ranges plus noise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "incognita/core/error.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// The LiDAR of Seo et al., section VI-B: 10 m.
struct RangeSensorParams {
  BeamPattern<2> beams = circular_beams(360, 10.0);  ///< in the sensor's frame
  double range_sigma_m = 0.01;                       ///< standard deviation, >= 0; on hits only
};

/// Holds one scan and fills it anew.
class RangeSensor {
 public:
  /// Throws std::invalid_argument for bad parameters.
  RangeSensor(const RangeSensorParams& params, std::uint64_t seed)
      : range_sigma_m_(params.range_sigma_m), random_(seed), scan_(params.beams) {
    require_non_negative("RangeSensor", "range_sigma_m", params.range_sigma_m);
  }

  /// No hit reads nearer than this, whatever the noise.
  static constexpr double hit_min_m = 1e-3;

  /// A scan from a pose. A reading at or beyond the range's end is exactly range_max_m. Noise is drawn for
  /// every beam, used or not, so the draws of a later scan do not depend on what this one met. O(beams), no
  /// allocation.
  const Scan<2>& measure(const ObstacleField& obstacles, const Pose2& T_world_sensor) {
    const Point<2> origin_m = T_world_sensor.position();
    const Pose2::Rotation rotation = T_world_sensor.rotation();
    const double range_max_m = scan_.range_max_m();
    for (std::size_t beam = 0; beam < scan_.size(); ++beam) {
      const double noise_m = random_.normal(0.0, range_sigma_m_);
      const double true_m = obstacles.cast_ray_m(origin_m, product(rotation, scan_.direction(beam)), range_max_m);
      const bool is_hit = true_m < range_max_m;
      scan_.set_range_m(beam,
                        is_hit ? std::min(std::max(true_m + noise_m, hit_min_m), range_max_m) : range_max_m);
    }
    return scan_;
  }

  [[nodiscard]] const Scan<2>& scan() const { return scan_; }  ///< the last one measured

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(random_, scan_);
  }

 private:
  double range_sigma_m_;
  Random random_;
  Scan<2> scan_;
};

}  // namespace incognita
