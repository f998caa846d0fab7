/// Small worlds drawn as text, for the tests of planning.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/map/occupancy.hpp"

namespace incognita {

/// '#' is occupied, '.' free, anything else unknown; the first row is the top. Every character becomes a
/// square of `scale` cells.
inline OccupancyGrid<2> draw(const std::vector<std::string>& rows, double resolution_m, int scale = 1) {
  const int width = static_cast<int>(rows.front().size()) * scale;
  const int height = static_cast<int>(rows.size()) * scale;
  OccupancyGrid<2> belief(Lattice<2>(resolution_m), {Index<2>(0, 0), Index<2>(width, height)},
                          Occupancy::unknown);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const char drawn_as =
          rows[static_cast<std::size_t>((height - 1 - y) / scale)][static_cast<std::size_t>(x / scale)];
      if (drawn_as == '#') belief.set({x, y}, Occupancy::occupied);
      if (drawn_as == '.') belief.set({x, y}, Occupancy::free);
    }
  }
  return belief;
}

inline Grid<float, 2> clearance_of(const OccupancyGrid<2>& belief) {
  return distance_transform_m(belief, [](Occupancy cell) { return cell == Occupancy::occupied; });
}

/// Free but for random blocks and patches of unknown.
inline OccupancyGrid<2> random_belief(Random& random, int width, int height, double resolution_m) {
  const Lattice<2> lattice(resolution_m, {random.uniform(-3.0, 3.0), 0.0});
  OccupancyGrid<2> belief(lattice, {Index<2>(-7, 3), Index<2>(width - 7, height + 3)}, Occupancy::unknown);
  belief.values().assign(belief.size(), Occupancy::free);
  for (int block = 0; block < 14; ++block) {
    const Index<2> low{static_cast<int>(random.index(static_cast<std::uint64_t>(width))) - 7,
                       static_cast<int>(random.index(static_cast<std::uint64_t>(height))) + 3};
    const Index<2> extent{1 + static_cast<int>(random.index(9)), 1 + static_cast<int>(random.index(9))};
    const Occupancy kind = random.uniform() < 0.7 ? Occupancy::occupied : Occupancy::unknown;
    for (int y = low.y(); y < low.y() + extent.y(); ++y) {
      for (int x = low.x(); x < low.x() + extent.x(); ++x) {
        if (belief.contains({x, y})) belief.set({x, y}, kind);
      }
    }
  }
  return belief;
}

/// The distance from a point to the nearest occupied square, cell by cell within a metre; infinity beyond.
inline double distance_to_squares_m(const OccupancyGrid<2>& world, const Eigen::Vector2d& point_m) {
  const Lattice<2>& lattice = world.lattice();
  const Index<2> lower = lattice.index_of((point_m.array() - 1.0).matrix());
  const Index<2> upper = lattice.index_of((point_m.array() + 1.0).matrix());
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int y = lower.y(); y <= upper.y(); ++y) {
    for (int x = lower.x(); x <= upper.x(); ++x) {
      if (world.value({x, y}) != Occupancy::occupied) continue;
      const Eigen::Vector2d offset = (point_m - lattice.center_m({x, y})).cwiseAbs();
      nearest_m =
          std::min(nearest_m, (offset.array() - 0.5 * lattice.resolution_m()).max(0.0).matrix().norm());
    }
  }
  return nearest_m;
}

}  // namespace incognita
