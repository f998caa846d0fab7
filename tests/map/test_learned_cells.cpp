#include <catch2/catch.hpp>

#include <set>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/map/learned_cells.hpp"
#include "reference.hpp"

using namespace incognita;

TEST_CASE("What a map knew before is not learned", "[map]") {
  Map<LogOdds> map({0.2, 0.5});
  Scan<2> scan(circular_beams(60, 4.0));
  for (int n = 0; n < 5; ++n) map.update(scan, {}, Eigen::Matrix3d::Zero());
  OccupancyLayer<2> occupancy(map.lattice());
  LearnedCells<2> learned(map.lattice());
  occupancy.rebuild(map);
  learned.follow(occupancy);
  const std::size_t before = learned.count();
  CHECK(before > 500);
  map.update(scan, {}, Eigen::Matrix3d::Zero());
  occupancy.follow(map);
  learned.follow(occupancy);
  CHECK(learned.count() == before);
}

TEST_CASE("Cells are learned once, however often they come and go") {
  Random random(1);
  Map<LogOdds> map({0.2, 0.5});
  OccupancyLayer<2> occupancy(map.lattice());
  LearnedCells<2> learned(map.lattice());
  std::set<std::pair<int, int>> ever;
  std::size_t forgotten = 0;
  for (int n = 0; n < 200; ++n) {
    // Beams of random lengths from nearby places: hits and passes contradict each other.
    Scan<2> scan(circular_beams(60, 4.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, random.uniform(0.5, 4.5));
    map.update(scan, {random.uniform(-0.01 * n, 0.01 * n), 0.0, random.uniform(-3.0, 3.0)}, Eigen::Matrix3d::Zero());
    n % 50 == 49 ? occupancy.rebuild(map) : occupancy.follow(map);
    learned.follow(occupancy);
    std::size_t known = 0;
    for (Offset cell = 0; cell < static_cast<Offset>(occupancy.grid().size()); ++cell) {
      if (occupancy.grid()[cell] == Occupancy::unknown) continue;
      const Index<2> index = occupancy.grid().index_at(cell);
      ever.emplace(index[0], index[1]);
      ++known;
    }
    CAPTURE(n);
    REQUIRE(learned.count() == ever.size());
    forgotten += ever.size() - known;
  }
  CHECK(forgotten > 1000);
}
