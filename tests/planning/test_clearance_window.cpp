#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/planning/clearance_window.hpp"

using namespace incognita;

TEST_CASE("Clearance around a place is that of the cells there, and of nearer points", "[planning]") {
  Random random(1);
  for (int draw = 0; draw < 40; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 40, 30, 0.1);
    const auto is_obstacle = [&](const Index<2>& cell) { return belief.value(cell) == Occupancy::occupied; };
    const Eigen::Vector2d center_m = belief.lattice().center_m({5, 15}) + Eigen::Vector2d(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const double reach_m = draw == 0 ? 0.0 : random.uniform(0.1, 1.5);
    ClearanceWindow window(belief.lattice());
    const Grid<float, 2> cells_m = window.measure(center_m, reach_m, is_obstacle);
    const IndexBox<2> box = cells_m.box();
    REQUIRE(box.contains(belief.lattice().index_of(center_m)));
    std::vector<Eigen::Vector2d> points_m;
    for (int point = 0; point < 20; ++point) {
      const Eigen::Vector2d point_m = center_m + Eigen::Vector2d(random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5));
      points_m.push_back(point_m);
    }
    points_m.push_back({1e300, 0.0});
    points_m.push_back({std::nan(""), 0.0});
    constexpr double near_m = 0.45;
    const Grid<float, 2>& lowered_m = window.lower_to(points_m, near_m);
    REQUIRE(lowered_m.box() == box);
    for (Offset i = 0; i < static_cast<Offset>(cells_m.size()); ++i) {
      const Eigen::Vector2d at_m = belief.lattice().center_m(cells_m.index_at(i));
      double expected_m = std::numeric_limits<double>::infinity();
      for (int y = box.lower.y(); y < box.upper.y(); ++y) {
        for (int x = box.lower.x(); x < box.upper.x(); ++x) {
          if (is_obstacle({x, y})) expected_m = std::min(expected_m, (belief.lattice().center_m({x, y}) - at_m).norm());
        }
      }
      REQUIRE(static_cast<double>(cells_m[i]) == Approx(expected_m));
      for (const Eigen::Vector2d& point_m : points_m) {
        const double distance_m = (point_m - at_m).norm();
        if (distance_m < near_m) expected_m = std::min(expected_m, distance_m);
      }
      REQUIRE(static_cast<double>(lowered_m[i]) == Approx(expected_m).margin(1e-7));
    }
  }
}

TEST_CASE("A window of clearance refuses places and reaches that are none", "[planning]") {
  ClearanceWindow window(Lattice<2>(0.1));
  const auto nothing = [](const Index<2>&) { return false; };
  REQUIRE_THROWS_WITH(window.measure({0.0, 0.0}, -1.0, nothing), "ClearanceWindow: reach_m is -1, but must be finite and >= 0");
  REQUIRE_THROWS_WITH(window.measure({std::nan(""), 0.0}, 1.0, nothing), Catch::Contains("a coordinate in cells is nan"));
  REQUIRE_THROWS_WITH(window.measure({0.0, 1e12}, 1.0, nothing), Catch::Contains("within 2^30 of the origin"));
  REQUIRE_THROWS_WITH(window.lower_to({}, std::nan("")), Catch::Contains("distance_max_m"));
  CHECK(std::isinf(window.measure({0.0, 0.0}, 1.0, nothing).values().front()));
}
