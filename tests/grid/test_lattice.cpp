#include <catch2/catch.hpp>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/grid/lattice.hpp"

using namespace incognita;

namespace {

template <int Dim>
void check_cells_of_points() {
  Random random(Dim);
  for (int trial = 0; trial < 500; ++trial) {
    Point<Dim> origin_m;
    Point<Dim> point_m;
    Index<Dim> index;
    for (int axis = 0; axis < Dim; ++axis) {
      origin_m[axis] = random.uniform(-50.0, 50.0);
      point_m[axis] = random.uniform(-50.0, 50.0);
      index[axis] = static_cast<int>(random.index(20001)) - 10000;
    }
    const Lattice<Dim> lattice(random.uniform(0.02, 1.0), origin_m);
    REQUIRE(lattice.index_of(lattice.center_m(index)) == index);
    const Index<Dim> cell = lattice.index_of(point_m);
    const Point<Dim> lower_m = origin_m + cell.template cast<double>() * lattice.resolution_m();
    REQUIRE((point_m.array() >= lower_m.array() - 1e-9).all());
    REQUIRE((point_m.array() < lower_m.array() + lattice.resolution_m() + 1e-9).all());
  }
}

}  // namespace

TEST_CASE("The cell of a point covers the point, and a centre lies in its cell", "[grid]") {
  check_cells_of_points<2>();
  check_cells_of_points<3>();
}

TEST_CASE("A cell holds its lower border and not its upper one", "[grid]") {
  const Lattice<2> lattice(0.5, {1.0, -1.0});
  REQUIRE(lattice.index_of({1.0, -1.0}) == Index<2>(0, 0));
  REQUIRE(lattice.index_of({1.5, -1.25}) == Index<2>(1, -1));
  REQUIRE(lattice.index_of({0.999, 0.0}) == Index<2>(-1, 2));
  REQUIRE(lattice.center_m({0, -1}) == Point<2>(1.25, -1.25));
  REQUIRE(lattice.to_cells({2.0, -0.75}) == Point<2>(2.0, 0.5));
}

TEST_CASE("The cells of a box of points hold the box's upper face", "[grid]") {
  const IndexBox<2> cells = Lattice<2>(0.5).cells_of({{-0.25, 0.0}, {1.0, 0.9}});
  REQUIRE(cells.lower == Index<2>(-1, 0));
  REQUIRE(cells.upper == Index<2>(3, 2));
}

TEST_CASE("A lattice refuses a bad resolution and a bad origin", "[grid]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -0.1, nan, std::numeric_limits<double>::infinity()}) {
    REQUIRE_THROWS_AS(Lattice<2>(bad), std::invalid_argument);
  }
  REQUIRE_THROWS_WITH(Lattice<2>(0.0), Catch::Contains("resolution_m is 0"));
  REQUIRE_THROWS_AS(Lattice<3>(0.1, Point<3>(0.0, 0.0, nan)), std::invalid_argument);
}
