// The plans that are drawn after those of Seo et al., section VI-C.
#include <catch2/catch.hpp>
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include "incognita/grid/components.hpp"
#include "incognita/simulation/world.hpp"
#include "support/study_plans.hpp"

using namespace incognita;

namespace {

/// How many regions there are where a disc can stand.
std::size_t region_count(const World& world, double radius_m) {
  return connected_components(disc_positions(world, radius_m), Adjacency::faces, [](std::uint8_t is_clear) { return is_clear != 0; }).sizes.size();
}

std::uint64_t hash_of(const FloorPlan& plan) {
  std::uint64_t hash = 14695981039346656037U;
  for (const FloorCell cell : plan.values()) hash = (hash ^ static_cast<std::uint64_t>(cell)) * 1099511628211U;
  return hash;
}

}  // namespace

TEST_CASE("The robot gets everywhere in the drawn plans, and nowhere out of them", "[examples]") {
  for (const std::string_view name : examples::study_plan_names) {
    CAPTURE(name);
    const World world(examples::study_plan(name));
    const FloorPlan& plan = world.plan();
    CHECK(region_count(world, examples::study_robot_radius_m) == 1);
    const IndexBox<2> inside = plan.box().padded(-1);
    for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
      if (!inside.contains(plan.index_at(cell))) REQUIRE(plan[cell] != FloorCell::floor);
    }
  }
}

TEST_CASE("The drawn plans have the sizes and rooms that they are named for", "[examples]") {
  const auto size_m = [](const World& world) { return Point<2>(world.box().extent().cast<double>() * world.resolution_m()); };
  // A disc wider than the doors stays in its room, or in the corridors.
  const World rooms_32(examples::rooms_32());
  CHECK(size_m(rooms_32).isApprox(Point<2>(125.0, 169.0)));
  CHECK(region_count(rooms_32, 1.1) == 32 + 1);
  const World underground(examples::underground());
  CHECK(size_m(underground).isApprox(Point<2>(220.0, 291.0)));
  CHECK(region_count(underground, 2.6) >= 30);
  CHECK(region_count(World(examples::long_corridors()), 0.9) == 16 + 14 + 11 + 10 + 10 + 1);
  const World room_cluster(examples::room_cluster());
  CHECK(region_count(room_cluster, 1.6) == 9);
  for (const double x_m : {29.0, 92.0, 156.0}) {
    for (const double y_m : {26.5, 83.0, 140.5}) CHECK(room_cluster.clearance_m({x_m, y_m}) > 25.0);
  }
  CHECK(region_count(World(examples::open_office()), 0.9) > 250);
}

TEST_CASE("The drawn plans stay what they are, so that results can be compared", "[examples]") {
  CHECK(hash_of(examples::rooms_32()) == 14277859245846316293U);
  CHECK(hash_of(examples::underground()) == 9784545854174802165U);
  CHECK(hash_of(examples::long_corridors()) == 371137929897254351U);
  CHECK(hash_of(examples::room_cluster()) == 11244028903393254721U);
  CHECK(hash_of(examples::open_office()) == 7293424723613295830U);
}

TEST_CASE("A plan that was not drawn is refused by its name", "[examples]") {
  CHECK_THROWS_WITH(examples::study_plan("castle"), "study_plan: the name is castle, but must be one of study_plan_names");
}
