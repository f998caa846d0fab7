#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/metrics/coverage.hpp"

namespace {

using namespace incognita;

Grid<std::uint8_t, 2> random_floor(Random& random) {
  Grid<std::uint8_t, 2> visible(Lattice<2>(0.05, {2.0, -3.0}), {{0, 0}, {50, 30}}, 0);
  for (std::uint8_t& cell : visible.values()) cell = random.uniform() < 0.7 ? 1 : 0;
  return visible;
}

}  // namespace

TEST_CASE("The explored fraction counts the pixels whose centre is known", "[metrics]") {
  Random random(1);
  const Grid<std::uint8_t, 2> visible = random_floor(random);
  for (const double resolution_m : {0.02, 0.1, 0.37}) {
    const Pose2 T_belief_world{-4.0, 7.0, random.uniform(-3.0, 3.0)};
    const Lattice<2> lattice(resolution_m);
    const auto is_known = [](const Index<2>& cell) { return (cell.x() + 3 * cell.y()) % 4 != 0; };
    double known = 0.0;
    double total = 0.0;
    for (Offset pixel = 0; pixel < static_cast<Offset>(visible.size()); ++pixel) {
      if (visible[pixel] == 0) continue;
      total += 1.0;
      const Point<2> center_m = visible.lattice().center_m(visible.index_at(pixel));
      known += is_known(lattice.index_of(T_belief_world * center_m)) ? 1.0 : 0.0;
    }
    const Coverage coverage(visible, T_belief_world, lattice);
    CHECK(coverage.explored_fraction(is_known) == known / total);
    CHECK(coverage.floor_area_m2() == Approx(total * 0.0025));
    CHECK(coverage.explored_fraction([](const Index<2>&) { return false; }) == 0.0);
    CHECK(coverage.explored_fraction([](const Index<2>&) { return true; }) == 1.0);
  }
}

TEST_CASE("Coverage of no floor or in no frame is refused", "[metrics]") {
  Random random(2);
  Grid<std::uint8_t, 2> visible = random_floor(random);
  const Pose2 nowhere{std::numeric_limits<double>::infinity(), 0.0, 0.0};
  CHECK_THROWS_AS(Coverage(visible, nowhere, Lattice<2>(0.1)), std::invalid_argument);
  for (std::uint8_t& cell : visible.values()) cell = 0;
  CHECK_THROWS_AS(Coverage(visible, Pose2{}, Lattice<2>(0.1)), std::invalid_argument);
}
