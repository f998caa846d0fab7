/// Where robots start, so that they are spread over a world.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "incognita/simulation/world.hpp"

namespace office_exploration {

/// Positions each as far from those before it as can be, in a straight line, of the largest region on whose cells' centres
/// a disc is clear; the first is drawn, as are the headings, so that the robots' maps are turned against the walls. The
/// first poses of many are those of few. Throws std::invalid_argument when there are fewer cells than poses.
[[nodiscard]] inline std::vector<incognita::Pose2> spread_poses(const incognita::World& world, double radius_m,
                                                                std::size_t count, incognita::Random& random) {
  using namespace incognita;
  const Components<2> regions = connected_components(disc_positions(world, radius_m), Adjacency::faces,
                                                     [](std::uint8_t is_clear) { return is_clear != 0; });
  std::vector<Point<2>> positions_m;
  for (Offset cell = 0; cell < static_cast<Offset>(regions.labels.size()); ++cell) {
    if (regions.labels[cell] == Components<2>::none || regions.labels[cell] != regions.largest()) continue;
    positions_m.push_back(world.lattice().center_m(regions.labels.index_at(cell)));
  }
  if (positions_m.size() < count) {
    throw std::invalid_argument("spread_poses: there is room for " + std::to_string(positions_m.size()) +
                                " poses, not for " + std::to_string(count));
  }
  std::vector<Pose2> poses;
  std::vector<double> nearest_m(positions_m.size(), std::numeric_limits<double>::infinity());
  std::size_t next = random.index(positions_m.size());
  while (poses.size() < count) {
    const Point<2> chosen_m = positions_m[next];
    poses.push_back({chosen_m.x(), chosen_m.y(), random.uniform(-std::numbers::pi, std::numbers::pi)});
    for (std::size_t i = 0; i < positions_m.size(); ++i) {
      nearest_m[i] = std::min(nearest_m[i], distance(positions_m[i], chosen_m));
    }
    next = static_cast<std::size_t>(std::max_element(nearest_m.begin(), nearest_m.end()) - nearest_m.begin());
  }
  return poses;
}

}  // namespace office_exploration
