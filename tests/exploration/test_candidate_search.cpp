#include <catch2/catch.hpp>
#include <cstdlib>
#include <vector>

#include "incognita/exploration/candidate_search.hpp"
#include "incognita/map/cells/t_bayes.hpp"

using namespace incognita;

TEST_CASE("where the robot did not get through, no way leads while the map stays, though the belief has room for it") {
  // Two rooms of 3 m, 0.1 m cells, and a gap in the wall between them: of 0.5 m, so that its middle has the clearance that is
  // needed (0.22 m) and no cell more, or of 1.1 m.
  for (const bool is_wide : {false, true}) {
    OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(30, 61)}, Occupancy::free);
    const int half = is_wide ? 5 : 2;
    for (int x = 0; x < 30; ++x) {
      if (x < 15 - half || x > 15 + half) belief.set({x, 30}, Occupancy::occupied);
    }
    const Eigen::Vector2d here_m(1.55, 2.05);
    const Eigen::Vector2d gap_m(1.55, 3.05);
    const Index<2> beyond(15, 40);
    CandidateSearch<TBayes> search(belief.lattice());
    SetAsidePlaces shut;
    const ClosedCells<2> closed(belief.lattice(), {});
    const auto is_open = [&] {
      search.search_ways(belief, {belief.lattice().index_of(here_m)}, closed, shut, here_m, {});
      return search.ways().reaches(beyond);
    };
    REQUIRE(is_open());
    CHECK(search.ways().is_proper({15, 30}));
    CHECK(search.ways().is_roomy({15, 30}) == is_wide);
    shut.add(gap_m, belief);
    CHECK(is_open() == is_wide);
    for (int y = 32; y < 40; ++y) {
      for (int x = 0; x < 30; ++x) belief.set({x, y}, std::abs(x - 15) < 5 ? Occupancy::free : Occupancy::unknown);
    }
    CHECK(is_open());
  }
}
