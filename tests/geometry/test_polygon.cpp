#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/geometry/polygon.hpp"

using namespace incognita;

namespace {

/// Corners in any order, so that sides may cross.
Polygon random_polygon(Random& random) {
  Polygon polygon;
  for (std::uint64_t left = 3 + random.index(6); left > 0; --left) {
    polygon.emplace_back(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
  }
  return polygon;
}

/// How often the outline goes around a place, by the angles under which it sees the sides.
long turns_around(const Polygon& polygon, const Eigen::Vector2d& place) {
  double angle_rad = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d a = polygon[i] - place;
    const Eigen::Vector2d b = polygon[(i + 1) % polygon.size()] - place;
    angle_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::lround(angle_rad / (2.0 * std::numbers::pi));
}

}  // namespace

TEST_CASE("A polygon holds what its outline goes around an odd number of times", "[geometry]") {
  Random random(1);
  int inside = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const Polygon polygon = random_polygon(random);
    const Eigen::Vector2d place(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
    CAPTURE(draw, place);
    REQUIRE(contains(polygon, place) == (turns_around(polygon, place) % 2 != 0));
    inside += contains(polygon, place) ? 1 : 0;
  }
  CHECK(inside > 200);
  CHECK(inside < 1800);
}

TEST_CASE("The distance to an outline is that to the nearest of its points", "[geometry]") {
  Random random(2);
  for (int draw = 0; draw < 200; ++draw) {
    Polygon polygon = random_polygon(random);
    if (draw % 10 == 0) polygon.push_back(polygon.back());  // a side without a length
    const Eigen::Vector2d place(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d& a = polygon[i];
      const Eigen::Vector2d& b = polygon[(i + 1) % polygon.size()];
      for (int share = 0; share <= 2000; ++share) nearest = std::min(nearest, (a + share / 2000.0 * (b - a) - place).norm());
    }
    CHECK(distance_to_outline(polygon, place) <= nearest + 1e-12);
    CHECK(distance_to_outline(polygon, place) >= nearest - 0.003);
  }
  CHECK(std::isinf(distance_to_outline(Polygon{}, Eigen::Vector2d(0.0, 0.0))));
}

TEST_CASE("What is no polygon is refused by name", "[geometry]") {
  const Polygon two{{0.0, 0.0}, {1.0, 0.0}};
  CHECK_THROWS_WITH(require_polygon("here", "fence", two), Catch::Contains("here: fence is 2") && Catch::Contains("three corners"));
  const Polygon broken{{0.0, 0.0}, {1.0, std::nan("")}, {1.0, 1.0}};
  CHECK_THROWS_WITH(require_polygon("here", "fence", broken), Catch::Contains("nan") && Catch::Contains("finite"));
  const Polygon far{{0.0, 0.0}, {1e200, 0.0}, {1.0, 1.0}};
  CHECK_THROWS_WITH(require_polygon("here", "fence", far), Catch::Contains("1e+200"));
  CHECK_NOTHROW(require_polygon("here", "fence", Polygon{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}));
}
