#include <catch2/catch.hpp>

#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/metrics/mapped_fraction.hpp"

using namespace incognita;

TEST_CASE("The mapped fraction counts the workspace's cells that are known", "[metrics]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {{-2, -2}, {8, 8}}, Occupancy::unknown);
  const IndexBox<2> workspace{{0, 0}, {20, 10}};
  REQUIRE(mapped_fraction(belief, workspace) == 0.0);
  belief.set({0, 0}, Occupancy::free);
  belief.set({7, 7}, Occupancy::occupied);
  belief.set({-1, 0}, Occupancy::free);  // out of the workspace
  REQUIRE(mapped_fraction(belief, workspace) == Approx(2.0 / 200.0));
  REQUIRE_THROWS_AS(mapped_fraction(belief, IndexBox<2>{}), std::invalid_argument);
}

TEST_CASE("A map that only learns never has a smaller mapped fraction", "[metrics]") {
  Random random(1);
  OccupancyGrid<2> belief(Lattice<2>(0.1), {{0, 0}, {20, 20}}, Occupancy::unknown);
  double before = 0.0;
  for (int n = 0; n < 400; ++n) {
    Occupancy& cell = belief[static_cast<Offset>(random.index(belief.size()))];
    if (cell == Occupancy::unknown) cell = random.uniform() < 0.5 ? Occupancy::free : Occupancy::occupied;
    const double now = mapped_fraction(belief, belief.box());
    REQUIRE(now >= before);
    before = now;
  }
  REQUIRE(before > 0.5);
}
