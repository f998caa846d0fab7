#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "incognita/core/random.hpp"
#include "incognita/simulation/plan_drawing.hpp"

using namespace incognita;

namespace {

/// The plan as rows of text, the top first.
std::string picture(const FloorPlan& plan) {
  std::string text;
  for (int y = plan.box().upper.y() - 1; y >= plan.box().lower.y(); --y) {
    for (int x = plan.box().lower.x(); x < plan.box().upper.x(); ++x) {
      const FloorCell cell = plan.value({x, y});
      text += cell == FloorCell::wall ? '#' : cell == FloorCell::floor ? '.' : 'x';
    }
    text += '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("Walls are drawn with their doors, along either axis", "[simulation]") {
  FloorPlan plan = walled_floor({1.2, 0.8}, 0.1, 0.1);
  CHECK(picture(plan) ==
        "############\n"
        "#..........#\n"
        "#..........#\n"
        "#..........#\n"
        "#..........#\n"
        "#..........#\n"
        "#..........#\n"
        "############\n");
  draw_wall(plan, {.wall_m = 0.1, .door_m = 0.2}, Along::y, 0.65, 0.1, 0.7, {0.3});
  draw_wall(plan, {.wall_m = 0.2, .door_m = 0.1}, Along::x, 0.4, 0.1, 0.6, {0.15, 0.45});
  draw_blocks(plan, {{{0.8, 0.2}, {1.0, 0.3}}});
  CHECK(picture(plan) ==
        "############\n"
        "#.....#....#\n"
        "#.....#....#\n"
        "#.##.##....#\n"
        "#.##.#.....#\n"
        "#.......##.#\n"
        "#.....#....#\n"
        "############\n");
}

TEST_CASE("A rectangle takes the cells whose centres it holds, wherever the plan lies", "[simulation]") {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Lattice<2> lattice(random.uniform(0.05, 0.3), {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)});
    FloorPlan plan(lattice, {{-4, 3}, {9, 11}}, FloorCell::solid);
    const Point<2> corner_m(random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0));
    const Box<Point<2>> area_m{corner_m, corner_m + Point<2>(random.uniform(0.0, 4.0), random.uniform(0.0, 4.0))};
    fill_area(plan, area_m, FloorCell::floor);
    for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
      const bool holds = area_m.contains(lattice.center_m(plan.index_at(cell)));
      REQUIRE((plan[cell] == FloorCell::floor) == holds);
    }
  }
}

TEST_CASE("A wall and its door are as wide wherever they lie", "[simulation]") {
  Random random(2);
  const auto cells = [](const FloorPlan& plan, FloorCell cell) { return std::count(plan.values().begin(), plan.values().end(), cell); };
  for (int trial = 0; trial < 200; ++trial) {
    FloorPlan plan(Lattice<2>(0.1, {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)}), {{0, 0}, {60, 60}}, FloorCell::floor);
    const Along along = random.index(2) == 0 ? Along::x : Along::y;
    const double across_m = random.uniform(1.1, 4.9);
    const double door_m = random.uniform(1.5, 4.5);
    const double wall_m = random.uniform(0.01, 0.5);
    draw_wall(plan, {.wall_m = wall_m, .door_m = 0.7}, along, across_m, -9.0, 9.0, {});
    const auto thickness_cells = std::max(1L, std::lround(wall_m / 0.1));
    REQUIRE(cells(plan, FloorCell::wall) == 60 * thickness_cells);
    draw_wall(plan, {.wall_m = wall_m, .door_m = 0.7}, along, across_m, -9.0, 9.0, {door_m});
    REQUIRE(cells(plan, FloorCell::wall) == 53 * thickness_cells);
  }
}

TEST_CASE("What cannot be drawn is refused and leaves the plan as it was", "[simulation]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  FloorPlan plan = walled_floor({1.0, 1.0}, 0.1, 0.1);
  const std::string before = picture(plan);
  CHECK_THROWS_AS(fill_area(plan, {{0.2, nan}, {0.5, 0.5}}, FloorCell::wall), std::invalid_argument);
  CHECK_THROWS_AS(draw_wall(plan, {}, Along::x, nan, 0.0, 1.0, {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_wall(plan, {}, Along::x, 0.5, 0.0, 1.0, {0.5, nan}), std::invalid_argument);
  CHECK_THROWS_AS(draw_wall(plan, {.wall_m = 0.0}, Along::x, 0.5, 0.0, 1.0, {}), std::invalid_argument);
  CHECK_THROWS_AS(draw_wall(plan, {.door_m = -1.0}, Along::x, 0.5, 0.0, 1.0, {}), std::invalid_argument);
  CHECK(picture(plan) == before);
  CHECK_THROWS_AS(walled_floor({nan, 1.0}, 0.1, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(walled_floor({1.0, 0.0}, 0.1, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(walled_floor({1.0, 1.0}, 0.0, 0.1), std::invalid_argument);
  CHECK_THROWS_AS(walled_floor({1.0, 1.0}, 0.1, -0.1), std::invalid_argument);
  CHECK_THROWS_AS(walled_floor({1e300, 1e300}, 0.1, 0.1), std::length_error);
}
