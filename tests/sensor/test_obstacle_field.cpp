#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "../simulation/plans.hpp"
#include "incognita/core/random.hpp"
#include "incognita/sensor/obstacle_field.hpp"
#include "incognita/sensor/ray_cast.hpp"

namespace {

using namespace incognita;

constexpr auto blocks = [](FloorCell cell) { return cell != FloorCell::floor; };

/// The distance to the nearest blocked pixel or to the outside, each on its own.
double brute_force_clearance_m(const FloorPlan& plan, const Point<2>& point_m) {
  const Point<2> at = plan.lattice().to_cells(point_m);
  const IndexBox<2>& box = plan.box();
  double nearest =
      std::min((at - box.lower.cast<double>()).minCoeff(), (box.upper.cast<double>() - at).minCoeff());
  if (nearest <= 0.0) return 0.0;
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (!blocks(plan[cell])) continue;
    const Point<2> lower = plan.index_at(cell).cast<double>();
    const Point<2> upper = lower.array() + 1.0;
    nearest = std::min(nearest, (at - at.cwiseMax(lower).cwiseMin(upper)).norm());
  }
  return nearest * plan.resolution_m();
}

Point<2> random_point(const FloorPlan& plan, Random& random) {
  const Point<2> extent = plan.box().extent().cast<double>() * plan.resolution_m();
  return plan.lattice().origin_m() +
         Point<2>(random.uniform(-0.1, 1.1) * extent.x(), random.uniform(-0.1, 1.1) * extent.y());
}

}  // namespace

TEST_CASE("Rays with strides through open space equal rays that walk cell by cell", "[sensor]") {
  Random random(1);
  for (const auto& [width, height] : {std::pair{30, 40}, {120, 90}, {700, 20}}) {
    const FloorPlan plan = test::random_plan(width, height, 0.05, random);
    const ObstacleField field(plan, blocks);
    for (int trial = 0; trial < 2000; ++trial) {
      const Point<2> from = random_point(plan, random);
      const double angle_rad = random.uniform(-4.0, 4.0);
      const Point<2> direction(std::cos(angle_rad), std::sin(angle_rad));
      const double range_max_m = random.uniform(0.0, 12.0);
      const double expected_m = cast_ray_m(plan, from, direction, range_max_m, blocks);
      REQUIRE(field.cast_ray_m(from, direction, range_max_m) == Approx(expected_m).margin(1e-12));
    }
  }
}

TEST_CASE("A wide hall: rays are longer than the table can count", "[sensor]") {
  const FloorPlan plan = test::room(1000, 600, 0.05);
  const ObstacleField field(plan, blocks);
  const Point<2> middle(25.0, 15.0);
  CHECK(field.cast_ray_m(middle, {1.0, 0.0}, 100.0) == Approx(24.95).epsilon(1e-14));
  CHECK(field.cast_ray_m(middle, {-1.0, -0.0}, 100.0) == Approx(24.95).epsilon(1e-14));
  CHECK(field.cast_ray_m(middle, {0.0, -1.0}, 100.0) == Approx(14.95).epsilon(1e-14));
  CHECK(field.cast_ray_m(middle, {0.0, 1.0}, 10.0) == 10.0);
  CHECK(field.clearance_m(middle) == Approx(14.95).epsilon(1e-14));
  CHECK(field.disc_is_clear(middle, 14.9499));
  CHECK_FALSE(field.disc_is_clear(middle, 14.9501));
}

TEST_CASE("Clearance is the distance to the nearest square", "[sensor]") {
  Random random(2);
  for (int world = 0; world < 6; ++world) {
    const FloorPlan plan = test::random_plan(20 + 9 * world, 45, 0.05, random);
    const ObstacleField field(plan, blocks);
    for (int trial = 0; trial < 300; ++trial) {
      const Point<2> point = random_point(plan, random);
      const double expected_m = brute_force_clearance_m(plan, point);
      REQUIRE(field.clearance_m(point) == Approx(expected_m).margin(1e-12));
      const double radius_m = random.uniform(0.01, 0.6);
      if (std::abs(expected_m - radius_m) > 1e-9) {
        REQUIRE(field.disc_is_clear(point, radius_m) == (expected_m > radius_m));
      }
    }
  }
}

TEST_CASE("A disc may touch a corner but not overlap it", "[sensor]") {
  const ObstacleField field(test::plan_from_rows({"......", "......", "..#...", "......", "......"}, 1.0),
                            blocks);
  // The pixel's upper right corner is (3, 3); 3-4-5 away from it.
  CHECK(field.disc_is_clear({3.3, 3.4}, 0.4999));
  CHECK_FALSE(field.disc_is_clear({3.3, 3.4}, 0.5001));
  CHECK(field.disc_is_clear({1.0, 2.5}, 1.0));
  CHECK_FALSE(field.disc_is_clear({2.5, 2.5}, 0.0));
  CHECK_FALSE(field.disc_is_clear({-0.5, 2.5}, 0.0));
}

TEST_CASE("Beyond the box and inside of walls nothing is clear and nothing is seen", "[sensor]") {
  const ObstacleField field(test::room(10, 10, 0.1), blocks);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Point<2>& point :
       {Point<2>(-5.0, 0.5), Point<2>(0.5, 1e12), Point<2>(0.05, 0.5), Point<2>(nan, 0.5)}) {
    CHECK(field.cast_ray_m(point, {1.0, 0.0}, 5.0) == 0.0);
    CHECK(field.clearance_m(point) == 0.0);
    CHECK_FALSE(field.disc_is_clear(point, 0.01));
  }
  CHECK(field.is_blocked({0, 0}));
  CHECK(field.is_blocked({-100, 3}));
  CHECK_FALSE(field.is_blocked({1, 1}));
  const ObstacleField nothing(FloorPlan(Lattice<2>(0.1)), blocks);
  CHECK(nothing.cast_ray_m({0.0, 0.0}, {1.0, 0.0}, 5.0) == 0.0);
}

TEST_CASE("The positions of a disc are the centres on which it is clear", "[sensor]") {
  Random random(3);
  const FloorPlan plan = test::random_plan(40, 30, 0.05, random);
  const ObstacleField field(plan, blocks);
  const Grid<std::uint8_t, 2> positions = disc_positions(field, 0.12);
  REQUIRE(positions.size() == plan.size());
  for (Offset cell = 0; cell < static_cast<Offset>(positions.size()); ++cell) {
    const double clearance_m = brute_force_clearance_m(plan, plan.lattice().center_m(plan.index_at(cell)));
    REQUIRE((positions[cell] != 0) == (clearance_m >= 0.12));
  }
}

TEST_CASE("A disc goes along a curve up to the contact", "[sensor]") {
  const ObstacleField field(test::room(100, 100, 0.05), blocks);  // free from 0.05 m to 4.95 m
  const auto along_x = [](double s_m) { return Point<2>(1.0 + s_m, 2.5); };
  CHECK(clear_length_m(field, 0.2, 10.0, along_x) == Approx(3.75).margin(2e-6));
  CHECK(clear_length_m(field, 0.2, 10.0, along_x) <= 3.75);
  CHECK(clear_length_m(field, 0.2, 3.0, along_x) == 3.0);
  CHECK(clear_length_m(field, 0.2, 0.0, along_x) == 0.0);
  CHECK(clear_length_m(field, 1.5, 1.0, along_x) == 0.0);
  // Along a wall that it touches it goes on; a hair nearer it does not start.
  const auto along_wall = [](double s_m) { return Point<2>(1.0 + s_m, 0.25 + 1e-12); };
  CHECK(clear_length_m(field, 0.2, 2.0, along_wall) == 2.0);
  // On a circle around (2.5, 2.5) it meets the wall where the circle's height is 4.75 m.
  const auto circle = [](double s_m) {
    return Point<2>(2.5 + 2.4 * std::cos(s_m / 2.4), 2.5 + 2.4 * std::sin(s_m / 2.4));
  };
  CHECK(clear_length_m(field, 0.2, 10.0, circle) == 0.0);
  const auto from_inside = [&](double s_m) { return circle(s_m + 2.4 * 0.8); };
  CHECK(clear_length_m(field, 0.2, 10.0, from_inside) ==
        Approx(2.4 * (std::asin(2.25 / 2.4) - 0.8)).margin(3e-6));
}

TEST_CASE("Rays that run along lines of the lattice but for rounding end", "[sensor]") {
  Grid<std::uint8_t, 2> plan(Lattice<2>(1.0), {{0, 0}, {200, 40}}, std::uint8_t{0});
  const ObstacleField field(plan, [](std::uint8_t value) { return value != 0; });
  for (const double across : {0.0, 1.2246e-16, -1.2246e-16}) {
    for (const double along : {1.0, -1.0}) {
      for (const double on_line : {2.0, 20.0, 38.0}) {
        const double to_wall_x_m = along > 0.0 ? 99.5 : 100.5;
        CHECK(field.cast_ray_m({100.5, on_line}, {along, across}, 150.0) == Approx(to_wall_x_m));
        CHECK(field.cast_ray_m({100.5, on_line}, {along, across}, 50.0) == 50.0);
        const double to_wall_y_m = along > 0.0 ? 40.0 - on_line : on_line;
        CHECK(field.cast_ray_m({100.0, on_line}, {across, along}, 150.0) == Approx(to_wall_y_m));
      }
    }
  }
}
