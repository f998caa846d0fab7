/// The drive that the benchmarks share: an office drawn on a grid, and what a robot records that drives
/// through it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/sensor/ray_cast.hpp"
#include "incognita/sensor/scan.hpp"

namespace benchmarks {

/// How far behind a measured end point the walk of a beam ends, in cells: the default of
/// incognita::MapParams.
constexpr double hit_push_cells = 0.5;
constexpr double range_max_m = 10.0;

/// 55 m x 25 m at 0.05 m: a corridor along the middle, eleven rooms on either side with doors of 0.9 m, a
/// column in each. True is wall.
[[nodiscard]] inline incognita::Grid<std::uint8_t, 2> draw_office() {
  constexpr int width = 1100;
  constexpr int height = 500;
  incognita::Grid<std::uint8_t, 2> office(incognita::Lattice<2>(0.05), {{0, 0}, {width, height}},
                                          std::uint8_t{1});
  const auto fill = [&](int x0, int y0, int x1, int y1, std::uint8_t value) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) office.set({x, y}, value);
    }
  };
  fill(4, 226, width - 4, 274, 0);  // 2.4 m
  for (int room = 0; room < 11; ++room) {
    const int left = room * 100;
    fill(left + 4, 4, left + 96, 222, 0);
    fill(left + 4, 278, left + 96, height - 4, 0);
    fill(left + 41, 222, left + 59, 226, 0);
    fill(left + 41, 274, left + 59, 278, 0);
    fill(left + 20, 100, left + 28, 108, 1);
    fill(left + 70, 380, left + 78, 388, 1);
  }
  return office;
}

/// What a drive along the corridor, with a visit to every other room, would record, in a turned frame.
struct Recording {
  std::vector<incognita::Scan<2>> scans;
  std::vector<incognita::Pose2> T_office_sensor;
  std::vector<incognita::Pose2> T_map_sensor;
  Eigen::Matrix3d covariance = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();

  Recording() {
    const auto office = draw_office();
    const incognita::Pose2 T_map_office{-3.7, 8.1, 0.3};
    incognita::Random random(1);
    std::vector<incognita::Point<2>> path{{1.0, 12.5}};
    for (int room = 0; room < 11; room += 2) {
      const double door_m = 5.0 * room + 2.5;
      const double inside_m = room % 4 == 0 ? 5.0 : 20.0;
      path.insert(path.end(), {{door_m, 12.5}, {door_m, inside_m}, {door_m, 12.5}});
    }
    path.emplace_back(54.0, 12.5);
    for (std::size_t leg = 1; leg < path.size(); ++leg) {
      const incognita::Point<2> way = path[leg] - path[leg - 1];
      const double yaw_rad = std::atan2(way.y(), way.x());
      for (double along_m = 0.0; along_m < way.norm(); along_m += 0.1) {
        const incognita::Point<2> at = path[leg - 1] + way.normalized() * along_m;
        const incognita::Pose2 pose{at.x(), at.y(), yaw_rad};
        incognita::Scan<2> scan(incognita::circular_beams(360, range_max_m));
        for (std::size_t beam = 0; beam < scan.size(); ++beam) {
          const double range_m = incognita::cast_ray_m<std::uint8_t, 2>(
              office, at, pose.rotation() * scan.direction(beam), range_max_m,
              [](std::uint8_t wall) { return wall != 0; });
          if (range_m < range_max_m) scan.set_range_m(beam, range_m + random.normal(0.0, 0.01));
        }
        scans.push_back(scan);
        T_office_sensor.push_back(pose);
        T_map_sensor.push_back(T_map_office * pose);
      }
    }
  }

  /// Where the walk of a beam ends; the same for all contestants.
  [[nodiscard]] incognita::Point<2> end_m(std::size_t n, std::size_t beam, double resolution_m) const {
    const bool is_hit = scans[n].reading(beam) == incognita::Reading::hit;
    return T_map_sensor[n] * scans[n].end_point_m(beam, is_hit ? hit_push_cells * resolution_m : 0.0);
  }

  [[nodiscard]] double touches(double resolution_m) const {
    const incognita::Lattice<2> lattice(resolution_m);
    std::int64_t count = 0;
    for (std::size_t n = 0; n < scans.size(); ++n) {
      for (std::size_t beam = 0; beam < scans[n].size(); ++beam) {
        if (scans[n].reading(beam) == incognita::Reading::invalid) continue;
        incognita::traverse<2>(lattice, T_map_sensor[n].position(), end_m(n, beam, resolution_m),
                               [&count](const incognita::Index<2>&) { ++count; });
      }
    }
    return static_cast<double>(count);
  }
};

[[nodiscard]] inline const Recording& recording() {
  static const Recording drive;
  return drive;
}

}  // namespace benchmarks
