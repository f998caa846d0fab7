#include <catch2/catch.hpp>

#include "incognita/simulation/world.hpp"
#include "plans.hpp"

using namespace incognita;

TEST_CASE("Walls and what is solid stop light and robots alike, and so does the plan's end", "[simulation]") {
  // The plan's fill value says floor; outside of it is solid all the same.
  FloorPlan plan(Lattice<2>(0.5, {10.0, -2.0}), {{0, 0}, {8, 6}}, FloorCell::floor);
  plan.set({1, 2}, FloorCell::wall);
  plan.set({5, 2}, FloorCell::solid);
  const World world(plan);
  const Point<2> between(11.5, -0.75);
  CHECK(world.cast_ray_m(between, {1.0, 0.0}, 10.0) == Approx(1.0));
  CHECK(world.cast_ray_m(between, {-1.0, 0.0}, 10.0) == Approx(0.5));
  CHECK(world.cast_ray_m(between, {0.0, 1.0}, 10.0) == Approx(1.75));
  CHECK(world.cast_ray_m(between, {0.0, 1.0}, 1.5) == 1.5);
  CHECK(world.clearance_m(between) == Approx(0.5));
  CHECK(world.disc_is_clear({13.75, -1.75}, 0.249));
  CHECK_FALSE(world.disc_is_clear({13.75, -1.75}, 0.251));
  CHECK(world.plan().values() == plan.values());
}
