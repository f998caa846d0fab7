#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/sensor/ray_cast.hpp"

namespace {

using namespace incognita;

constexpr auto is_wall = [](std::uint8_t value) { return value != 0; };

/// The range by the slab method against every blocked cell on its own.
template <int Dim>
double brute_force_range_m(const Grid<std::uint8_t, Dim>& grid, const Point<Dim>& origin_m,
                           const Point<Dim>& direction, double range_max_m) {
  double nearest_m = range_max_m;
  for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
    if (grid[cell] == 0) continue;
    const Point<Dim> center_m = grid.lattice().center_m(grid.index_at(cell));
    double enter_m = 0.0;
    double leave_m = range_max_m;
    for (int axis = 0; axis < Dim; ++axis) {
      const double half_m = 0.5 * grid.resolution_m();
      double a = (center_m[axis] - half_m - origin_m[axis]) / direction[axis];
      double b = (center_m[axis] + half_m - origin_m[axis]) / direction[axis];
      if (a > b) std::swap(a, b);
      enter_m = std::max(enter_m, a);
      leave_m = std::min(leave_m, b);
    }
    if (enter_m < leave_m) nearest_m = std::min(nearest_m, enter_m);
  }
  return nearest_m;
}

template <int Dim>
void compare_with_brute_force(std::uint64_t seed, double share_blocked) {
  Random random(seed);
  const Point<Dim> origin = Point<Dim>::Constant(-3.7);
  const IndexBox<Dim> box{Index<Dim>::Constant(-4), Index<Dim>::Constant(9)};
  Grid<std::uint8_t, Dim> grid(Lattice<Dim>(0.13, origin), box, 0);
  for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
    grid[cell] = random.uniform() < share_blocked ? 1 : 0;
  }
  for (int trial = 0; trial < 300; ++trial) {
    Point<Dim> from;
    Point<Dim> direction;
    for (int axis = 0; axis < Dim; ++axis) {
      from[axis] = origin[axis] + 0.13 * random.uniform(-8.0, 13.0);  // outside of the box too
      direction[axis] = random.normal();
    }
    direction.normalize();
    const double range_max_m = random.uniform(0.1, 3.0);
    const double expected_m = brute_force_range_m<Dim>(grid, from, direction, range_max_m);
    CHECK(cast_ray_m(grid, from, direction, range_max_m, is_wall) == Approx(expected_m).margin(1e-12));
  }
}

}  // namespace

TEST_CASE("A ray ends on the face of the first blocked cell", "[sensor]") {
  compare_with_brute_force<2>(1, 0.05);
  compare_with_brute_force<2>(2, 0.3);
  compare_with_brute_force<3>(3, 0.02);
  compare_with_brute_force<3>(4, 0.2);
}

TEST_CASE("Rays along the axes, also from the face of a cell", "[sensor]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(0.5), {{0, 0}, {10, 10}}, 0);
  grid.set({7, 3}, 1);
  grid.set({1, 3}, 1);
  grid.set({4, 8}, 1);
  const auto range_m = [&](double x_m, double y_m, double dx, double dy) {
    return cast_ray_m(grid, Point<2>(x_m, y_m), Point<2>(dx, dy), 100.0, is_wall);
  };
  CHECK(range_m(2.25, 1.75, 1.0, 0.0) == Approx(1.25));
  CHECK(range_m(2.25, 1.75, -1.0, 0.0) == Approx(1.25));
  CHECK(range_m(2.25, 1.75, 0.0, 1.0) == Approx(2.25));
  CHECK(range_m(2.25, 1.75, -0.0, 1.0) == Approx(2.25));
  CHECK(range_m(2.25, 1.75, 0.0, -1.0) == 100.0);
  // A lower face belongs to the cell: along it the cell at its upper side is met.
  CHECK(range_m(2.0, 1.5, 1.0, 0.0) == Approx(1.5));
  CHECK(range_m(2.0, 2.0, 1.0, 0.0) == 100.0);
  CHECK(range_m(2.0, 1.5, 0.0, 1.0) == Approx(2.5));
  CHECK(range_m(1.0, 1.75, -1.0, 0.0) == 0.0);
}

TEST_CASE("Where a ray starts and how far it may go", "[sensor]") {
  Grid<std::uint8_t, 2> walled(Lattice<2>(0.5), {{0, 0}, {4, 4}}, 1);
  for (std::uint8_t& value : walled.values()) value = 0;
  const Point<2> diagonal = Point<2>(1.0, 1.0).normalized();
  CHECK(cast_ray_m(walled, Point<2>(-0.1, 1.0), Point<2>(1.0, 0.0), 5.0, is_wall) == 0.0);
  CHECK(cast_ray_m(walled, Point<2>(1.0, 1.0), diagonal, 5.0, is_wall) == Approx(std::sqrt(2.0)));
  CHECK(cast_ray_m(walled, Point<2>(1.0, 1.0), diagonal, 1.4, is_wall) == 1.4);
  CHECK(cast_ray_m(walled, Point<2>(1.0, 1.2), Point<2>(1.0, 0.0), 1.0, is_wall) == 1.0);
  CHECK(cast_ray_m(walled, Point<2>(1.0, 1.2), Point<2>(1.0, 0.0), 0.0, is_wall) == 0.0);
}
