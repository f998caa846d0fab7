/// A toy building for the figures: walls in open space, and what a range sensor reads in it.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/geometry/box.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/map/map.hpp"
#include "incognita/sensor/ray_cast.hpp"
#include "incognita/sensor/scan.hpp"

namespace coupling {

using Area = incognita::Box<Eigen::Vector2d>;
using Map = incognita::Map<incognita::TBayes>;

constexpr double kCell_m = 0.2;   ///< of the maps, as in section VI-B of Seo et al.
constexpr double kRange_m = 5.0;  ///< of the sensor; short, so that a toy is small
constexpr std::size_t kBeams = 360;

/// Walls as boxes within an extent, on squares of 5 cm.
class Scene {
 public:
  Scene(const Area& extent_m, std::vector<Area> walls_m)
      : extent_m_(extent_m),
        walls_m_(std::move(walls_m)),
        is_wall_(incognita::Lattice<2>(0.05), incognita::Lattice<2>(0.05).cells_of(extent_m)) {
    for (incognita::Offset square = 0; square < static_cast<incognita::Offset>(is_wall_.size()); ++square) {
      const Eigen::Vector2d center_m = is_wall_.lattice().center_m(is_wall_.index_at(square));
      for (const Area& wall_m : walls_m_) {
        if (wall_m.contains(center_m)) is_wall_[square] = 1;
      }
    }
  }

  [[nodiscard]] const Area& extent_m() const { return extent_m_; }
  [[nodiscard]] const std::vector<Area>& walls_m() const { return walls_m_; }

  /// What the sensor reads at a position, without noise, its axes along the scene's.
  [[nodiscard]] incognita::Scan<2> scan(const Eigen::Vector2d& position_m,
                                        const incognita::BeamPattern<2>& beams) const {
    incognita::Scan<2> scan(beams);
    const auto blocks = [](std::uint8_t value) { return value != 0; };
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      scan.set_range_m(beam, incognita::cast_ray_m(is_wall_, position_m, scan.direction(beam),
                                                   scan.range_max_m(), blocks));
    }
    return scan;
  }

 private:
  Area extent_m_;
  std::vector<Area> walls_m_;
  incognita::Grid<std::uint8_t, 2> is_wall_;
};

/// A map with room for all of the scene and nothing in it.
[[nodiscard]] inline Map empty_map(const Scene& scene) {
  Map map(incognita::MapParams{.resolution_m = kCell_m});
  map.reserve(scene.extent_m());
  return map;
}

/// Writes scans into the map every 0.2 m along a straight line, from poses that are known exactly.
inline void survey(const Scene& scene, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, Map& map) {
  const incognita::BeamPattern<2> beams = incognita::circular_beams(kBeams, kRange_m);
  const int steps = static_cast<int>((to_m - from_m).norm() / 0.2);
  for (int step = 0; step <= steps; ++step) {
    const Eigen::Vector2d at_m = from_m + (to_m - from_m) * (static_cast<double>(step) / steps);
    map.update(scene.scan(at_m, beams), {at_m.x(), at_m.y(), 0.0}, Eigen::Matrix3d::Zero());
  }
}

}  // namespace coupling
