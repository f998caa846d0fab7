/// The rays that casts are compared on: those of the shared drive, in the office itself at a resolution.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "recording.hpp"

namespace benchmarks {

/// The office's walls at a multiple of the plan's resolution: a cell is wall where any of its pixels is.
[[nodiscard]] inline incognita::Grid<std::uint8_t, 2> draw_office(double resolution_m) {
  const auto plan = draw_office();
  const int pixels = static_cast<int>(std::lround(resolution_m / plan.resolution_m()));
  const incognita::Index<2> extent = plan.box().extent();
  incognita::Grid<std::uint8_t, 2> office(incognita::Lattice<2>(resolution_m),
                                          {{0, 0}, {extent.x() / pixels, extent.y() / pixels}},
                                          std::uint8_t{0});
  for (int y = 0; y < extent.y(); ++y) {
    for (int x = 0; x < extent.x(); ++x) {
      if (plan.value({x, y}) != 0) office.set({x / pixels, y / pixels}, std::uint8_t{1});
    }
  }
  return office;
}

[[nodiscard]] inline bool is_wall(std::uint8_t value) { return value != 0; }

struct Ray {
  incognita::Point<2> origin_m;
  incognita::Point<2> direction;
};

/// 360 rays from every 20th pose of the drive, in an order as a scanner casts them.
struct RayCourse {
  static constexpr std::size_t pose_stride = 20;

  incognita::Grid<std::uint8_t, 2> walls;
  incognita::ObstacleField field;
  std::vector<incognita::Pose2> T_office_sensor;
  std::vector<Ray> rays;

  explicit RayCourse(double resolution_m) : walls(draw_office(resolution_m)), field(walls, is_wall) {
    const Recording& drive = recording();
    for (std::size_t n = 0; n < drive.scans.size(); n += pose_stride) {
      const incognita::Pose2& pose = drive.T_office_sensor[n];
      T_office_sensor.push_back(pose);
      for (std::size_t beam = 0; beam < drive.scans[n].size(); ++beam) {
        rays.push_back({pose.position(), pose.rotation() * drive.scans[n].direction(beam)});
      }
    }
  }
};

}  // namespace benchmarks
