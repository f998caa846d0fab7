/// What a frontier promises to tell, before anybody goes there (Isleyen et al., Table II).
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// volume(FR), (10), in square metres.
[[nodiscard]] inline double frontier_size_m2(const std::vector<Index<2>>& frontier, double resolution_m) {
  return static_cast<double>(frontier.size()) * resolution_m * resolution_m;
}

/// entropy(FR), (9), in nats times square metres. `map` tells log_odds(index), `entropy` a measure of log-odds in nats, such as
/// EntropyTable.
template <class MapType, class Entropy>
[[nodiscard]] double frontier_entropy_nats_m2(const std::vector<Index<2>>& frontier, const MapType& map, const Entropy& entropy) {
  double sum_nats = 0.0;
  for (const Index<2>& cell : frontier) sum_nats += static_cast<double>(entropy(map.log_odds(cell)));
  return sum_nats * map.resolution_m() * map.resolution_m();
}

/// Footnote 1: the entropy of the neighbourhood of a frontier, cells within radius_m of each of its cells weighed by
/// exp(-d^2 / (2 sigma^2)), in nats times metres to the fourth. Throws std::invalid_argument unless both are finite and > 0.
/// O(frontier cells * radius^2).
template <class MapType, class Entropy>
[[nodiscard]] double kernel_entropy_nats_m4(const std::vector<Index<2>>& frontier, const MapType& map, const Entropy& entropy,
                                            double radius_m, double sigma_m) {
  require_positive("kernel_entropy_nats_m4", "radius_m", radius_m);
  require_positive("kernel_entropy_nats_m4", "sigma_m", sigma_m);
  struct Near {
    Index<2> step;
    double weight;
  };
  std::vector<Near> kernel;
  const double radius = radius_m / map.resolution_m();
  const double per_two_sigma2 = 0.5 * map.resolution_m() * map.resolution_m() / (sigma_m * sigma_m);
  constexpr double rounding = 1e-9;  // 0.3 m of 0.1 m cells are 3
  const int reach = static_cast<int>(radius + rounding);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double distance2 = dx * dx + dy * dy;
      if (distance2 <= radius * radius + rounding) kernel.push_back({{dx, dy}, std::exp(-distance2 * per_two_sigma2)});
    }
  }
  double sum_nats = 0.0;
  for (const Index<2>& cell : frontier) {
    for (const Near& near : kernel) {
      const Index<2> at(cell[0] + near.step[0], cell[1] + near.step[1]);
      sum_nats += near.weight * static_cast<double>(entropy(map.log_odds(at)));
    }
  }
  const double cell_m2 = map.resolution_m() * map.resolution_m();
  return sum_nats * cell_m2 * cell_m2;
}

}  // namespace incognita
