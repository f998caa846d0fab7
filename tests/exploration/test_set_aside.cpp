#include <catch2/catch.hpp>

#include "../planning/drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/exploration/set_aside.hpp"

namespace incognita {

TEST_CASE("known cells are counted in the square around a point") {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const OccupancyGrid<2> belief = random_belief(random, 30, 20, 0.1);
    const Lattice<2>& lattice = belief.lattice();
    const Eigen::Vector2d center_m = lattice.center_m({-7, 3}) + Eigen::Vector2d(random.uniform(-1.0, 4.0), random.uniform(-1.0, 3.0));
    const double radius_m = random.uniform(0.1, 1.5);
    int known = 0;
    for (Offset offset = 0; offset < static_cast<Offset>(belief.size()); ++offset) {
      const Eigen::Vector2d away = (lattice.center_m(belief.index_at(offset)) - center_m).cwiseAbs();
      // A cell counts when its square meets the square around the point.
      if (away.maxCoeff() < radius_m + 0.05 && belief[offset] != Occupancy::unknown) ++known;
    }
    CHECK(count_known(belief, center_m, radius_m) == known);
  }
}

TEST_CASE("a place stays set aside until the map around it changes") {
  SetAsideParams params;
  params.radius_m = 0.5;
  params.watch_radius_m = 0.6;
  params.change_cells_min = 10;
  OccupancyGrid<2> belief(Lattice<2>(0.1), {{0, 0}, {60, 60}}, Occupancy::unknown);
  const Eigen::Vector2d place(3.05, 3.05);
  SetAsidePlaces places(params);
  CHECK_FALSE(places.contains(place, belief));
  places.add(place, belief);
  CHECK(places.contains(place, belief));
  CHECK(places.contains(place + Eigen::Vector2d(0.3, 0.39), belief));
  CHECK_FALSE(places.contains(place + Eigen::Vector2d(0.3, 0.41), belief));

  for (int x = 0; x < 60; ++x) belief.set({x, 5}, Occupancy::free);  // far away
  CHECK(places.contains(place, belief));
  for (int x = 26; x < 35; ++x) belief.set({x, 30}, Occupancy::free);
  CHECK(places.contains(place, belief));
  belief.set({30, 31}, Occupancy::occupied);  // the tenth
  CHECK_FALSE(places.contains(place, belief));

  places.add(place, belief);
  CHECK(places.contains(place, belief));
  for (int x = 26; x < 35; ++x) belief.set({x, 30}, Occupancy::unknown);  // forgotten again, as when a wall is taken back
  belief.set({30, 31}, Occupancy::unknown);
  CHECK(places.contains(place, belief));  // as it was when it was set aside for the first time
}

TEST_CASE("parameters of places set aside are checked") {
  const auto refused = [](SetAsideParams params, const char* field) {
    CHECK_THROWS_WITH(params.validate(), Catch::Contains("SetAsideParams") && Catch::Contains(field));
  };
  refused({0.0, 1.0, 15}, "radius_m");
  refused({0.5, -1.0, 15}, "watch_radius_m");
  refused({0.5, 1.0, 0}, "change_cells_min");
}

}  // namespace incognita
