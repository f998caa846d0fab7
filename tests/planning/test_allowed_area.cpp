#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/planning/closed_cells.hpp"

using namespace incognita;

namespace {

AllowedArea yard() {
  AllowedArea area;
  area.bounds = {{-3.0, -2.0}, {4.0, -2.5}, {3.5, 3.0}, {-2.0, 2.5}};
  area.no_go = {{{0.0, 0.0}, {1.5, 0.2}, {0.5, 1.0}}, {{-2.0, -1.5}, {-1.0, -1.5}, {-1.0, -0.8}, {-2.0, -0.8}}};
  return area;
}

bool allows(const AllowedArea& area, const Eigen::Vector2d& place_m) { return area.clearance_m(place_m) > 0.0; }

}  // namespace

TEST_CASE("An area allows what its bounds hold and no no-go polygon does", "[planning]") {
  const AllowedArea area = yard();
  CHECK(allows(area, {-1.0, 1.0}));
  CHECK_FALSE(allows(area, {5.0, 1.0}));
  CHECK_FALSE(allows(area, {0.6, 0.4}));
  CHECK_FALSE(allows(area, {-1.5, -1.0}));
  CHECK(area.clearance_m({-1.5, -0.5}) == Approx(0.3));
  CHECK(AllowedArea{}.is_everywhere());
  CHECK(std::isinf(AllowedArea{}.clearance_m({1e6, -1e6})));

  // No place that is not allowed lies nearer than the clearance, and one lies as near.
  Random random(1);
  for (int draw = 0; draw < 300; ++draw) {
    const Eigen::Vector2d place_m(random.uniform(-3.0, 4.0), random.uniform(-2.5, 3.0));
    const double clearance_m = area.clearance_m(place_m);
    double nearest_m = std::numeric_limits<double>::infinity();
    for (int x = -80; x <= 100; ++x) {
      for (int y = -70; y <= 80; ++y) {
        const Eigen::Vector2d other_m(0.05 * x, 0.05 * y);
        if (!allows(area, other_m)) nearest_m = std::min(nearest_m, (other_m - place_m).norm());
      }
    }
    CHECK(nearest_m >= clearance_m - 1e-12);
    CHECK(nearest_m <= clearance_m + 0.15);
  }
}

TEST_CASE("A transformed area allows the transformed places", "[planning]") {
  const AllowedArea area = yard();
  const Pose2 T_a_b{3.0, -1.0, 0.7};
  const AllowedArea moved = area.transformed(T_a_b);
  Random random(2);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Vector2d place_m(random.uniform(-4.0, 5.0), random.uniform(-3.0, 4.0));
    CHECK(moved.clearance_m(T_a_b * place_m) == Approx(area.clearance_m(place_m)).margin(1e-12));
  }
}

TEST_CASE("All of an open cell is allowed, and a cell is open unless the disc around it is not", "[planning]") {
  const AllowedArea area = yard();
  const Lattice<2> lattice(0.2, {0.03, -0.05});
  ClosedCells<2> cells(lattice, area);
  CHECK_FALSE(cells.none());
  // In steps, as a map grows.
  for (int side = 5; side <= 40; side += 7) cells.grow_to_include({{-side, -side}, {side / 2, side}});
  cells.grow_to_include({{-40, -40}, {40, 40}});
  int open = 0;
  for (int y = -40; y < 40; ++y) {
    for (int x = -40; x < 40; ++x) {
      const Index<2> cell(x, y);
      const Eigen::Vector2d center_m = lattice.center_m(cell);
      const double clearance_m = area.clearance_m(center_m);
      const bool is_open = clearance_m >= 0.2 * std::sqrt(0.5);
      REQUIRE(cells.bits().get(cell) == !is_open);
      REQUIRE(static_cast<double>(cells.clearance_m(cell)) == Approx(is_open ? clearance_m : 0.0));
      if (!is_open) continue;
      ++open;
      for (const double dx : {-0.0999, 0.0, 0.0999}) {
        for (const double dy : {-0.0999, 0.0, 0.0999}) REQUIRE(allows(area, center_m + Eigen::Vector2d(dx, dy)));
      }
    }
  }
  CHECK(open > 300);
}

TEST_CASE("Without bounds and polygons no cell is closed, and what is no area is refused", "[planning]") {
  ClosedCells<2> everywhere(Lattice<2>(0.1), {});
  everywhere.grow_to_include({{-10, -10}, {10, 10}});
  CHECK(everywhere.none());
  CHECK_FALSE(everywhere.bits().get({0, 0}));
  AllowedArea line;
  line.bounds = {{0.0, 0.0}, {1.0, 0.0}};
  CHECK_THROWS_WITH(ClosedCells<2>(Lattice<2>(0.1), line), Catch::Contains("bounds is 2"));
  AllowedArea broken;
  broken.no_go = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, std::numeric_limits<double>::infinity()}}};
  CHECK_THROWS_WITH(ClosedCells<2>(Lattice<2>(0.1), broken), Catch::Contains("no_go is inf"));
}
