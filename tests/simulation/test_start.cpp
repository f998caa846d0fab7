#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/simulation/start.hpp"
#include "incognita/simulation/world.hpp"
#include "plans.hpp"

namespace {

using namespace incognita;

/// Two rooms without a door between; the right one is larger.
FloorPlan two_rooms() {
  std::vector<std::string> rows(40, std::string(100, '.'));
  for (std::string& row : rows) row[35] = '#';
  return test::plan_from_rows(rows, 0.05, {-3.0, 2.0});
}

}  // namespace

TEST_CASE("A random start is clear, in the largest region, anywhere in it and in any direction",
          "[simulation]") {
  const World world(two_rooms());
  Random random(1);
  std::set<std::pair<double, double>> places;
  double x_sum = 0.0, y_sum = 0.0, cos_sum = 0.0, sin_sum = 0.0;
  const int count = 500;
  for (int i = 0; i < count; ++i) {
    const Pose2 start = random_start(world, 0.2, random);
    REQUIRE(world.clearance_m(start.position()) >= 0.2);
    REQUIRE(start.x_m > -3.0 + 36 * 0.05);
    const Point<2> cells = world.lattice().to_cells(start.position());
    REQUIRE((cells.array() - cells.array().floor() - 0.5).abs().maxCoeff() < 1e-9);
    places.emplace(start.x_m, start.y_m);
    x_sum += start.x_m;
    y_sum += start.y_m;
    cos_sum += std::cos(start.yaw_rad);
    sin_sum += std::sin(start.yaw_rad);
  }
  // 56 x 32 places, 500 draws: 1792 (1 - e^(-500 / 1792)) = 436 different ones are to be expected.
  CHECK(places.size() > 400);
  CHECK(places.size() < 480);
  CHECK(x_sum / count == Approx(0.4).margin(0.14));  // the standard deviation of this mean is 0.036
  CHECK(y_sum / count == Approx(3.0).margin(0.08));
  CHECK(cos_sum / count == Approx(0.0).margin(0.13));
  CHECK(sin_sum / count == Approx(0.0).margin(0.13));
}

TEST_CASE("Every place of the region is as likely", "[simulation]") {
  const World world(test::room(7, 5, 0.1));  // a disc of 0.14 m has three places: 0.25, 0.35 and 0.45 m
  Random random(2);
  std::map<int, int> counts;
  for (int i = 0; i < 3000; ++i)
    ++counts[world.lattice().index_of(random_start(world, 0.14, random).position()).x()];
  REQUIRE(counts.size() == 3);
  for (const auto& [x, count] : counts) {
    CHECK((x >= 2 && x <= 4));
    CHECK(count == Approx(1000).margin(100));  // the standard deviation is 26
  }
}

TEST_CASE("A seed gives its start again", "[simulation]") {
  const World world(two_rooms());
  Random one(7);
  Random same(7);
  const Pose2 a = random_start(world, 0.2, one);
  const Pose2 b = random_start(world, 0.2, same);
  CHECK(a.x_m == b.x_m);
  CHECK(a.y_m == b.y_m);
  CHECK(a.yaw_rad == b.yaw_rad);
  CHECK(one.uniform() == same.uniform());
}

TEST_CASE("Where there is no room nothing starts", "[simulation]") {
  const World world(test::room(10, 10, 0.05));
  Random random(1);
  CHECK_THROWS_AS(random_start(world, 0.21, random), std::invalid_argument);
  CHECK_THROWS_AS(random_start(world, -0.1, random), std::invalid_argument);
  CHECK(world.disc_is_clear(random_start(world, 0.17, random).position(), 0.17));
}

TEST_CASE("A start inside of a wall is refused, with the place and the room there is", "[simulation]") {
  const World world(two_rooms());
  CHECK_NOTHROW(check_start(world, {0.0, 3.0}, 0.2));
  CHECK_THROWS_AS(check_start(world, {-100.0, 3.0}, 0.2), std::invalid_argument);
  std::string message;
  try {
    check_start(world, {-1.225, 3.5}, 0.2);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message ==
        "check_start: the start -1.225,3.5 (m) is 0 m from the nearest obstacle, but must be 0.2 m away or "
        "more");
  CHECK_THROWS_AS(check_start(world, {-1.1, 3.5}, 0.2), std::invalid_argument);
  CHECK_NOTHROW(check_start(world, {-1.1, 3.5}, 0.09));
}
