#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/disc_hull.hpp"

using namespace incognita;

namespace {

using Vector = Eigen::Vector2d;

/// The hull is the union of the discs between its apex and its own disc, so a box is as far from it as from the nearest of those;
/// negative where it reaches into one. Convex along the way, so a search by thirds finds it.
double signed_distance(const DiscHull& hull, const Box<Vector>& box) {
  const auto at = [&](double share) {
    const Vector center = hull.apex() + share * (hull.center() - hull.apex());
    const Vector off = (box.lower - center).cwiseMax(center - box.upper).cwiseMax(0.0);
    return off.norm() - share * hull.radius();
  };
  double low = 0.0;
  double high = 1.0;
  for (int n = 0; n < 200; ++n) {
    const double third = (high - low) / 3.0;
    (at(low + third) < at(high - third) ? high : low) += at(low + third) < at(high - third) ? -third : third;
  }
  return std::min({at(0.0), at(1.0), at(0.5 * (low + high))});
}

Vector random_point(Random& random, double reach) { return {random.uniform(-reach, reach), random.uniform(-reach, reach)}; }

DiscHull random_hull(Random& random, int draw) {
  const Vector apex = random_point(random, 6.0);
  Vector center = random_point(random, 6.0);
  if (draw % 5 == 1) center.y() = apex.y();
  if (draw % 5 == 2) center.x() = apex.x();
  if (draw % 5 == 3) center = apex + 0.1 * random_point(random, 1.0);  // the disc may hold the apex
  return DiscHull(apex, center, draw % 7 == 0 ? 0.0 : random.uniform(0.0, 2.0));
}

}  // namespace

TEST_CASE("A hull is as far from a box as the nearest of the discs that it is made of", "[geometry]") {
  Random random(1);
  int overlapping = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const DiscHull hull = random_hull(random, draw);
    Vector lower = random_point(random, 8.0);
    const Vector extent(random.uniform(0.1, 3.0), random.uniform(0.1, 3.0));
    if (draw % 6 == 0) lower.y() = hull.apex().y() - 0.5 * extent.y();  // in line with it, for those that lie along an axis
    const Box<Vector> box{lower, lower + extent};
    const double expected = signed_distance(hull, box);
    CAPTURE(draw, hull.apex(), hull.center(), hull.radius(), box.lower, box.upper);
    REQUIRE(hull.distance_to(box) == Approx(std::max(0.0, expected)).margin(1e-7));
    overlapping += static_cast<int>(expected < -1e-6);
  }
  REQUIRE(overlapping > 1000);
}

TEST_CASE("A hull overlaps the cells that one of its discs overlaps, row by row", "[geometry]") {
  Random random(2);
  std::size_t cells = 0;
  for (int draw = 0; draw < 3000; ++draw) {
    const DiscHull hull = random_hull(random, draw);
    std::vector<Eigen::Vector2i> met;
    hull.for_each_row([&](int y, int first, int last) {
      REQUIRE(first <= last);
      for (int x = first; x <= last; ++x) met.emplace_back(x, y);
      return true;
    });
    const Box<Vector> box = hull.box();
    for (int y = static_cast<int>(std::floor(box.lower.y())) - 1; y <= box.upper.y() + 1.0; ++y) {
      for (int x = static_cast<int>(std::floor(box.lower.x())) - 1; x <= box.upper.x() + 1.0; ++x) {
        const double off = signed_distance(hull, {Vector(x, y), Vector(x + 1, y + 1)});
        const bool is_met = std::find(met.begin(), met.end(), Eigen::Vector2i(x, y)) != met.end();
        CAPTURE(draw, x, y, off, hull.apex(), hull.center(), hull.radius());
        if (off > 1e-7) REQUIRE_FALSE(is_met);
        // A hull without a disc is a line, which lies in a cell without reaching into it.
        if (off < -1e-7) REQUIRE(is_met);
        cells += static_cast<std::size_t>(is_met);
      }
    }
  }
  REQUIRE(cells > 30000);
}

TEST_CASE("A line between two cells' centres overlaps the cells that it crosses, not those that it touches", "[geometry]") {
  const auto cells_of = [](const DiscHull& hull) {
    std::vector<Eigen::Vector2i> met;
    hull.for_each_row([&](int y, int first, int last) {
      for (int x = first; x <= last; ++x) met.emplace_back(x, y);
      return true;
    });
    return met;
  };
  using Cells = std::vector<Eigen::Vector2i>;
  CHECK(cells_of(DiscHull({0.5, 0.5}, {3.5, 0.5}, 0.0)) == Cells{{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  CHECK(cells_of(DiscHull({0.5, 2.5}, {0.5, 0.5}, 0.0)) == Cells{{0, 0}, {0, 1}, {0, 2}});
  CHECK(cells_of(DiscHull({2.5, 2.5}, {0.5, 0.5}, 0.0)) == Cells{{0, 0}, {1, 1}, {2, 2}});
  // A disc of a cell and a half touches the rows beyond and does not overlap them.
  const Cells disc = cells_of(DiscHull({0.5, 0.5}, {0.5, 0.5}, 1.5));
  CHECK(disc.size() == 9);
}

TEST_CASE("A hull's rows can be left early", "[geometry]") {
  int rows = 0;
  CHECK_FALSE(DiscHull({0.0, 0.0}, {0.0, 9.0}, 1.0).for_each_row([&](int, int, int) { return ++rows < 3; }));
  CHECK(rows == 3);
}
