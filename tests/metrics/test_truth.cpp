#include <catch2/catch.hpp>

#include "../simulation/plans.hpp"
#include "incognita/core/random.hpp"
#include "incognita/metrics/truth.hpp"
#include "set_cells.hpp"

using namespace incognita;

TEST_CASE("Cells with the centre of a wall pixel are occupied, solid ones are not", "[metrics]") {
  const FloorPlan plan = test::plan_from_rows({"x..#", "x..#", "x##."}, 0.1, {1.0, 2.0});
  const Grid<std::uint8_t, 2> occupied = truly_occupied_cells(plan, Pose2{}, Lattice<2>(0.2));
  // Pixel centres at x = 1.15, 1.25 (y = 2.05) and x = 1.35 (y = 2.15, 2.25).
  CHECK(occupied.value({5, 10}) == 1);
  CHECK(occupied.value({6, 10}) == 1);
  CHECK(occupied.value({6, 11}) == 1);
  CHECK(count_set(occupied) == 3);
}

TEST_CASE("Occupied cells in a turned frame, against a search for each cell", "[metrics]") {
  Random random(1);
  const FloorPlan plan = test::random_plan(30, 25, 0.05, random);
  const Pose2 T_belief_world{3.3, -1.7, 0.6};
  const Lattice<2> lattice(0.1, {0.03, 0.01});
  const Grid<std::uint8_t, 2> occupied = truly_occupied_cells(plan, T_belief_world, lattice);
  std::size_t expected_count = 0;
  for (Offset cell = 0; cell < static_cast<Offset>(occupied.size()); ++cell) {
    bool expected = false;
    const Point<2> center_m = lattice.center_m(occupied.index_at(cell));
    for (Offset pixel = 0; pixel < static_cast<Offset>(plan.size()); ++pixel) {
      const Point<2> from_center_m =
          T_belief_world * plan.lattice().center_m(plan.index_at(pixel)) - center_m;
      expected |= plan[pixel] == FloorCell::wall && from_center_m.cwiseAbs().maxCoeff() < 0.05;
    }
    expected_count += expected ? 1 : 0;
    REQUIRE((occupied[cell] != 0) == expected);
  }
  CHECK(expected_count > 50);
}

TEST_CASE("A plan without walls occupies nothing", "[metrics]") {
  CHECK(count_set(truly_occupied_cells(FloorPlan(Lattice<2>(0.1)), Pose2{}, Lattice<2>(0.2))) == 0);
  CHECK(count_set(truly_occupied_cells(test::plan_from_rows({"..", "xx"}, 0.1), Pose2{}, Lattice<2>(0.2))) == 0);
}
