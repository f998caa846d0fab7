#include <catch2/catch.hpp>
#include <cstdint>

#include "incognita/core/random.hpp"
#include "incognita/metrics/belief_box.hpp"

using namespace incognita;

TEST_CASE("The belief box holds every point of a world grid", "[metrics]") {
  Random random(1);
  const Grid<std::uint8_t, 2> world(Lattice<2>(0.05, {-1.0, 4.0}), {{-7, 12}, {40, 31}}, 0);
  const Lattice<2> lattice(0.13, {0.02, -0.3});
  for (int trial = 0; trial < 50; ++trial) {
    const Pose2 T_belief_world{random.normal(0.0, 9.0), random.normal(0.0, 9.0), random.uniform(-3.2, 3.2)};
    const IndexBox<2> box = belief_box(world, T_belief_world, lattice);
    for (int i = 0; i < 100; ++i) {
      const Point<2> point_m(-1.0 + 0.05 * random.uniform(-7.0, 40.0),
                             4.0 + 0.05 * random.uniform(12.0, 31.0));
      REQUIRE(box.contains(lattice.index_of(T_belief_world * point_m)));
    }
    // No longer than the diagonal.
    const double diagonal_cells = 0.05 * std::sqrt(47.0 * 47.0 + 19.0 * 19.0) / 0.13;
    CHECK(box.extent().maxCoeff() <= static_cast<int>(diagonal_cells) + 2);
  }
  CHECK(belief_box(Grid<std::uint8_t, 2>(Lattice<2>(0.05)), Pose2{}, lattice).empty());
}
