#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/grid/distance_transform.hpp"

using namespace incognita;

namespace {

template <int Dim>
Grid<std::uint8_t, Dim> random_grid_anywhere(Random& random, const Index<Dim>& extent, double share) {
  IndexBox<Dim> box;
  for (int axis = 0; axis < Dim; ++axis) {
    box.lower[axis] = static_cast<int>(random.index(20)) - 10;
    box.upper[axis] = box.lower[axis] + extent[axis];
  }
  Grid<std::uint8_t, Dim> grid(Lattice<Dim>(0.05, Point<Dim>::Constant(3.7)), box);
  for (std::uint8_t& value : grid.values()) value = random.uniform() < share ? 1 : 0;
  return grid;
}

template <int Dim>
double nearest_m(const Grid<std::uint8_t, Dim>& grid, const Index<Dim>& from) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
    if (grid[offset] == 0) continue;
    nearest = std::min(nearest, (grid.index_at(offset) - from).template cast<double>().norm());
  }
  return grid.resolution_m() * nearest;
}

template <int Dim>
void check_against_brute_force(const Grid<std::uint8_t, Dim>& grid) {
  const Grid<float, Dim> distance_m =
      distance_transform_m(grid, [](std::uint8_t value) { return value != 0; });
  REQUIRE(distance_m.box().lower == grid.box().lower);
  REQUIRE(distance_m.box().upper == grid.box().upper);
  REQUIRE(distance_m.lattice().origin_m() == grid.lattice().origin_m());
  for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
    const double expected_m = nearest_m(grid, grid.index_at(offset));
    if (std::isinf(expected_m)) {
      REQUIRE(std::isinf(distance_m[offset]));
    } else {
      REQUIRE(static_cast<double>(distance_m[offset]) == Approx(expected_m).epsilon(3e-7).margin(0.0));
    }
  }
}

}  // namespace

TEST_CASE("The distance transform equals brute force in the plane", "[grid]") {
  Random random(1);
  for (const double share : {0.0, 0.002, 0.02, 0.3, 1.0}) {
    for (int trial = 0; trial < 8; ++trial) {
      const Index<2> extent{1 + static_cast<int>(random.index(40)), 1 + static_cast<int>(random.index(40))};
      check_against_brute_force<2>(random_grid_anywhere<2>(random, extent, share));
    }
  }
}

TEST_CASE("The distance transform equals brute force in space", "[grid]") {
  Random random(2);
  for (const double share : {0.0, 0.002, 0.02, 0.3}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Index<3> extent{1 + static_cast<int>(random.index(13)), 1 + static_cast<int>(random.index(13)),
                            1 + static_cast<int>(random.index(13))};
      check_against_brute_force<3>(random_grid_anywhere<3>(random, extent, share));
    }
  }
}

TEST_CASE("Single rows and columns have distances", "[grid]") {
  Random random(3);
  check_against_brute_force<2>(random_grid_anywhere<2>(random, Index<2>(200, 1), 0.02));
  check_against_brute_force<2>(random_grid_anywhere<2>(random, Index<2>(1, 200), 0.02));
  check_against_brute_force<3>(random_grid_anywhere<3>(random, Index<3>(1, 200, 1), 0.02));
}

TEST_CASE("A distance of thousands of cells is exact", "[grid]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(1.0), {Index<2>(0, 0), Index<2>(3001, 401)});
  grid.set({0, 0}, 1);
  const Grid<float, 2> distance_m = distance_transform_m(grid, [](std::uint8_t value) { return value != 0; });
  REQUIRE(distance_m.value({3000, 400}) == static_cast<float>(std::hypot(3000.0, 400.0)));
  REQUIRE(distance_m.value({300, 400}) == 500.0F);
}

TEST_CASE("The distance transform of an empty grid is empty, and beyond the box all is far", "[grid]") {
  const Grid<std::uint8_t, 2> empty(Lattice<2>(0.1));
  const Grid<float, 2> distance_m = distance_transform_m(empty, [](std::uint8_t) { return true; });
  REQUIRE(distance_m.size() == 0);
  REQUIRE(std::isinf(distance_m.value({0, 0})));
}
