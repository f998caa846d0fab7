#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drawn_plan.hpp"
#include "incognita/planning/safe_space.hpp"

using namespace incognita;

namespace {

bool is_free(Occupancy cell) { return cell == Occupancy::free; }

/// (7) by asking every cell around.
bool fits(const OccupancyGrid<2>& belief, const Index<2>& cell, double radius_m, CellShape shape) {
  const int reach = static_cast<int>(radius_m / belief.resolution_m()) + 2;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      if (is_free(belief.value({cell[0] + dx, cell[1] + dy}))) continue;
      const double half = shape == CellShape::centers ? 0.0 : 0.5;
      const double off_m =
          std::hypot(std::max(0.0, std::abs(dx) - half), std::max(0.0, std::abs(dy) - half)) * belief.resolution_m();
      if (shape == CellShape::centers ? off_m <= radius_m + 1e-12 : off_m < radius_m - 1e-12) return false;
      if (dx == 0 && dy == 0) return false;
    }
  }
  return true;
}

}  // namespace

TEST_CASE("Erosion keeps the cells around which a disc fits", "[planning]") {
  Random random(1);
  for (int draw = 0; draw < 60; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 40, 30, 0.1);
    // Multiples of the cell's side among them, where a disc just touches.
    const double radius_m = draw % 2 == 0 ? 0.1 * static_cast<double>(random.index(8)) : random.uniform(0.0, 0.8);
    for (const CellShape shape : {CellShape::centers, CellShape::squares}) {
      const CellSet kept = erode(belief, radius_m, is_free, shape);
      REQUIRE(kept.box() == belief.box());
      for (Offset i = 0; i < static_cast<Offset>(kept.size()); ++i) {
        CAPTURE(draw, radius_m, static_cast<int>(shape), belief.index_at(i));
        REQUIRE((kept[i] == 1) == fits(belief, belief.index_at(i), radius_m, shape));
      }
    }
  }
}

TEST_CASE("The planning space lies in the control space, and that in the free space; larger bodies fit nowhere new", "[planning]") {
  Random random(2);
  for (int draw = 0; draw < 100; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 50, 40, 0.1);
    BodyParams body;
    body.radius_m = random.uniform(0.0, 0.6);
    body.margin_m = random.uniform(0.0, 0.3);
    body.measured_to = draw % 2 == 0 ? CellShape::centers : CellShape::squares;
    const SafeSpaces spaces = safe_spaces(belief, body);
    BodyParams larger = body;
    larger.radius_m += random.uniform(0.0, 0.3);
    const SafeSpaces tighter = safe_spaces(belief, larger);
    const CellSet plan = erode(belief, body.radius_m + body.margin_m, is_free, body.measured_to);
    const CellSet control = erode(belief, body.radius_m, is_free, body.measured_to);
    for (Offset i = 0; i < static_cast<Offset>(belief.size()); ++i) {
      REQUIRE(spaces.plan[i] <= spaces.control[i]);
      REQUIRE(spaces.control[i] <= (is_free(belief[i]) ? 1 : 0));
      REQUIRE(tighter.plan[i] <= spaces.plan[i]);
      REQUIRE(tighter.control[i] <= spaces.control[i]);
      REQUIRE(spaces.plan[i] == plan[i]);
      REQUIRE(spaces.control[i] == control[i]);
    }
  }
}

TEST_CASE("The safe spaces of an empty belief are empty", "[planning]") {
  const OccupancyGrid<2> empty(Lattice<2>(0.1), {}, Occupancy::unknown);
  CHECK(safe_spaces(empty, {}).plan.size() == 0);
}

TEST_CASE("Bodies that make no sense are refused", "[planning]") {
  const OccupancyGrid<2> belief(Lattice<2>(0.1), {{0, 0}, {9, 9}}, Occupancy::unknown);
  for (const double bad : {-0.1, 9.0, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    CHECK_THROWS_AS(erode(belief, bad, is_free), std::invalid_argument);
    BodyParams body;
    body.radius_m = bad;
    CHECK_THROWS_AS(safe_spaces(belief, body), std::invalid_argument);
    body = {};
    body.margin_m = bad;
    CHECK_THROWS_AS(safe_spaces(belief, body), std::invalid_argument);
  }
}
