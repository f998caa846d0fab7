/// People who walk through a building and stand in the scanner's way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/sensor/scan.hpp"
#include "incognita/simulation/start.hpp"
#include "incognita/simulation/world.hpp"

namespace accuracy {

/// Discs that walk straight on until a wall is near, then in another direction.
class People {
 public:
  static constexpr int count = 5;
  static constexpr double radius_m = 0.25;
  static constexpr double speed_m_per_s = 1.0;

  People(const incognita::World& world, std::uint64_t seed) : world_(world), random_(seed) {
    for (int person = 0; person < count; ++person) people_.push_back(random_start(world, radius_m, random_));
  }

  void walk(double duration_s) {
    const double step_m = speed_m_per_s * duration_s;
    for (incognita::Pose2& person : people_) {
      const incognita::Pose2 next = person * incognita::Pose2{step_m, 0.0, 0.0};
      if (world_.clearance_m(next.position()) >= radius_m) {
        person = next;
      } else {
        person.yaw_rad = random_.uniform(-std::numbers::pi, std::numbers::pi);
      }
    }
  }

  /// Shortens the beams that meet somebody. Who stands where the scanner is, is not there.
  void block(incognita::Scan<2>& scan, const incognita::Pose2& T_world_sensor, double range_sigma_m) {
    for (const incognita::Pose2& person : people_) {
      const Eigen::Vector2d to_m = T_world_sensor.inverse() * person.position();
      const double distance_m = to_m.norm();
      if (distance_m <= radius_m || distance_m > scan.range_max_m() + radius_m) continue;
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        const double along_m = scan.direction(beam).dot(to_m);
        const double aside_m2 = distance_m * distance_m - along_m * along_m;
        if (along_m <= 0.0 || aside_m2 >= radius_m * radius_m) continue;
        const double range_m = along_m - std::sqrt(radius_m * radius_m - aside_m2) + random_.normal(0.0, range_sigma_m);
        if (range_m < scan.range_m(beam)) scan.set_range_m(beam, std::max(range_m, 1e-3));
      }
    }
  }

 private:
  const incognita::World& world_;
  incognita::Random random_;
  std::vector<incognita::Pose2> people_;
};

}  // namespace accuracy
