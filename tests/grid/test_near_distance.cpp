#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/near_distance.hpp"

using namespace incognita;

namespace {

Grid<std::uint8_t, 2> random_image(Random& random, std::uint8_t fill, double share) {
  const int width = 1 + static_cast<int>(random.index(40));
  const int height = 1 + static_cast<int>(random.index(40));
  const Index<2> lower(static_cast<int>(random.index(20)) - 10, static_cast<int>(random.index(20)) - 10);
  Grid<std::uint8_t, 2> grid(Lattice<2>(0.1, {0.3, -0.2}), {lower, {lower[0] + width, lower[1] + height}}, fill);
  for (auto& value : grid.values()) value = random.uniform() < share ? 1 : 0;
  return grid;
}

bool is_one(std::uint8_t value) { return value == 1; }

/// In cells, by asking every cell around, those outside of the box too.
double slow_distance(const Grid<std::uint8_t, 2>& grid, const Index<2>& cell, int reach, CellShape shape) {
  double best2 = 1e9;
  for (int dy = -reach - 1; dy <= reach + 1; ++dy) {
    for (int dx = -reach - 1; dx <= reach + 1; ++dx) {
      if (grid.value({cell[0] + dx, cell[1] + dy}) != 1) continue;
      const auto away = [&](int steps) {
        return shape == CellShape::centers ? std::abs(steps) : std::max(0.0, std::abs(steps) - 0.5);
      };
      best2 = std::min(best2, away(dx) * away(dx) + away(dy) * away(dy));
    }
  }
  return std::sqrt(best2);
}

}  // namespace

TEST_CASE("Near distances are those to the nearest source, within and outside of the box", "[grid]") {
  Random random(1);
  for (int draw = 0; draw < 300; ++draw) {
    const auto grid = random_image(random, static_cast<std::uint8_t>(draw % 2), draw % 3 == 0 ? 0.002 : 0.05);
    const int reach = static_cast<int>(random.index(14));
    const CellShape shape = draw % 5 < 3 ? CellShape::centers : CellShape::squares;
    const double farthest = shape == CellShape::centers ? reach : std::max(0.0, reach - 0.5);
    const NearDistances near(grid, reach, is_one, shape);
    for (Offset i = 0; i < static_cast<Offset>(grid.size()); ++i) {
      const double expected = slow_distance(grid, grid.index_at(i), reach, shape);
      CAPTURE(draw, reach, i, expected);
      if (expected > farthest) {
        REQUIRE(near.squared()[i] == near.beyond());
      } else {
        REQUIRE(near.unit_cells() * std::sqrt(near.squared()[i]) == Approx(expected));
      }
    }
  }
}

TEST_CASE("Near distances in metres are the exact ones up to their bound", "[grid]") {
  Random random(2);
  for (int draw = 0; draw < 100; ++draw) {
    const auto grid = random_image(random, 0, 0.01);
    const double distance_max_m = random.uniform(0.01, 3.0);
    const Grid<float, 2> near = near_distance_m(grid, distance_max_m, is_one);
    const Grid<float, 2> exact = distance_transform_m(grid, is_one);
    for (Offset i = 0; i < static_cast<Offset>(grid.size()); ++i) {
      REQUIRE(near[i] == Approx(std::min(static_cast<double>(exact[i]), distance_max_m)).epsilon(1e-6));
    }
  }
}

TEST_CASE("Near distances reach 90 cells, and refuse more", "[grid]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(1.0), {{0, 0}, {400, 3}}, 0);
  grid.set({0, 0}, 1);
  const NearDistances near(grid, 90, is_one);
  REQUIRE(near.squared().value({90, 0}) == 90 * 90);
  REQUIRE(near.squared().value({90, 1}) == near.beyond());
  REQUIRE(near.squared().value({91, 0}) == near.beyond());
  REQUIRE(near.squared().value({89, 2}) == 89 * 89 + 4);
  for (const int bad : {-1, 91, 100000}) REQUIRE_THROWS_AS(NearDistances(grid, bad, is_one), std::invalid_argument);
  for (const double bad : {0.0, -1.0, 90.5, 1e300, std::nan("")}) {
    REQUIRE_THROWS_AS(near_distance_m(grid, bad, is_one), std::invalid_argument);
  }
  const Grid<std::uint8_t, 2> empty(Lattice<2>(1.0));
  REQUIRE(NearDistances(empty, 3, is_one).squared().size() == 0);
}
