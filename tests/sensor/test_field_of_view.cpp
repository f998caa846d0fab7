#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <set>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/sensor/field_of_view.hpp"

namespace {

using namespace incognita;

constexpr auto is_set = [](std::uint8_t value) { return value != 0; };

/// Whether the segment between two centres touches a closed cell; whole numbers in half cells.
bool touches(const Index<2>& from, const Index<2>& to, const Index<2>& cell) {
  const Index<2> a = 2 * from;
  const Index<2> b = 2 * to;
  const Index<2> c = 2 * cell;
  for (int axis = 0; axis < 2; ++axis) {
    if (std::max(a[axis], b[axis]) < c[axis] - 1 || std::min(a[axis], b[axis]) > c[axis] + 1) return false;
  }
  int above = 0;
  int below = 0;
  for (const Index<2>& corner : {Index<2>(-1, -1), Index<2>(1, -1), Index<2>(-1, 1), Index<2>(1, 1)}) {
    const Index<2> p = c + corner;
    const int side = (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    above += side > 0 ? 1 : 0;
    below += side < 0 ? 1 : 0;
  }
  return above < 4 && below < 4;
}

bool sees(const Grid<std::uint8_t, 2>& grid, const Index<2>& from, const Index<2>& to, double range_max_m) {
  if ((to - from).cast<double>().norm() * grid.resolution_m() > range_max_m + 1e-9) return false;
  for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
    if (grid[cell] != 0 && touches(from, to, grid.index_at(cell))) return false;
  }
  return true;
}

Grid<std::uint8_t, 2> random_grid(int width, int height, double share_blocked, Random& random) {
  Grid<std::uint8_t, 2> grid(Lattice<2>(0.1), {{-3, 2}, {width - 3, height + 2}}, 0);
  for (std::uint8_t& value : grid.values()) value = random.uniform() < share_blocked ? 1 : 0;
  return grid;
}

Grid<std::uint8_t, 2> seen_from(FieldOfView& view, const Grid<std::uint8_t, 2>& grid, const Index<2>& from,
                                double range_max_m) {
  Grid<std::uint8_t, 2> seen(grid.lattice(), grid.box(), 0);
  view.visit_visible(grid, from, range_max_m, is_set, [&](const Index<2>& cell) { seen.set(cell, 1); });
  return seen;
}

}  // namespace

TEST_CASE("What is seen is what no segment between centres forbids", "[sensor]") {
  Random random(1);
  FieldOfView view;
  for (const double share_blocked : {0.0, 0.03, 0.1, 0.3, 0.6}) {
    for (int world = 0; world < 3; ++world) {
      const Grid<std::uint8_t, 2> grid = random_grid(23, 17, share_blocked, random);
      const double range_max_m = world == 0 ? 10.0 : random.uniform(0.2, 2.0);
      for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); cell += 13) {
        const Index<2> from = grid.index_at(cell);
        const Grid<std::uint8_t, 2> seen = seen_from(view, grid, from, range_max_m);
        for (Offset other = 0; other < static_cast<Offset>(grid.size()); ++other) {
          const bool expected = sees(grid, from, grid.index_at(other), range_max_m);
          if ((seen[other] != 0) != expected) {
            CAPTURE(share_blocked, world, from.transpose(), grid.index_at(other).transpose());
            REQUIRE((seen[other] != 0) == expected);
          }
        }
      }
    }
  }
}

TEST_CASE("Sight is symmetric", "[sensor]") {
  Random random(2);
  FieldOfView view;
  const Grid<std::uint8_t, 2> grid = random_grid(24, 24, 0.08, random);
  std::set<std::pair<Offset, Offset>> pairs;
  for (Offset from = 0; from < static_cast<Offset>(grid.size()); ++from) {
    view.visit_visible(grid, grid.index_at(from), 1.3, is_set,
                       [&](const Index<2>& to) { pairs.emplace(from, grid.offset_of(to)); });
  }
  REQUIRE(pairs.size() > 20000);
  for (const auto& [from, to] : pairs) REQUIRE(pairs.count({to, from}) == 1);
}

TEST_CASE("Light does not pass between two cells that touch in a corner", "[sensor]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(1.0), {{0, 0}, {8, 8}}, 0);
  for (int i = 0; i < 8; ++i) grid.set({i, 7 - i}, 1);
  FieldOfView view;
  const Grid<std::uint8_t, 2> seen = seen_from(view, grid, {1, 1}, 100.0);
  for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
    const Index<2> index = grid.index_at(cell);
    CHECK((seen[cell] != 0) == (index.sum() < 7));
  }
}

TEST_CASE("Towards a box, every seen cell whose ray meets the box is visited", "[sensor]") {
  Random random(3);
  FieldOfView view;
  for (int trial = 0; trial < 200; ++trial) {
    const Grid<std::uint8_t, 2> grid = random_grid(25, 25, 0.05, random);
    const auto draw = [&](int below) {
      return static_cast<int>(random.index(static_cast<std::uint64_t>(below)));
    };
    const Index<2> from = grid.box().lower + Index<2>(draw(25), draw(25));
    const Index<2> corner = grid.box().lower + Index<2>(draw(25), draw(25));
    const IndexBox<2> target{corner, corner + Index<2>(1 + draw(3), 1 + draw(3))};
    const Grid<std::uint8_t, 2> seen = seen_from(view, grid, from, 2.0);
    Grid<std::uint8_t, 2> seen_toward(grid.lattice(), grid.box(), 0);
    view.visit_visible_toward(grid, from, target, 2.0, is_set,
                              [&](const Index<2>& to) { seen_toward.set(to, 1); });
    for (Offset cell = 0; cell < static_cast<Offset>(grid.size()); ++cell) {
      if (seen_toward[cell] != 0) REQUIRE(seen[cell] != 0);
      bool meets = false;
      for (int y = target.lower.y(); y < target.upper.y(); ++y) {
        for (int x = target.lower.x(); x < target.upper.x(); ++x)
          meets |= touches(from, grid.index_at(cell), {x, y});
      }
      if (seen[cell] != 0 && meets) REQUIRE(seen_toward[cell] != 0);
    }
  }
  // A small box far away: few cells are looked at.
  const Grid<std::uint8_t, 2> open(Lattice<2>(0.1), {{0, 0}, {100, 100}}, 0);
  int visited = 0;
  view.visit_visible_toward(open, {50, 50}, {{90, 70}, {91, 71}}, 10.0, is_set,
                            [&](const Index<2>&) { ++visited; });
  CHECK(visited < 150);
}

TEST_CASE("A visit ends by returning false, and nothing is seen from within a wall", "[sensor]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(0.1), {{0, 0}, {9, 9}}, 0);
  grid.set({4, 4}, 1);
  FieldOfView view;
  int visited = 0;
  view.visit_visible(grid, {1, 1}, 10.0, is_set, [&](const Index<2>&) { return ++visited < 5; });
  CHECK(visited == 5);
  visited = 0;
  const auto count = [&](const Index<2>&) { ++visited; };
  view.visit_visible(grid, {4, 4}, 10.0, is_set, count);
  view.visit_visible(grid, {-1, 4}, 10.0, is_set, count);
  CHECK(visited == 0);
  view.visit_visible(grid, {0, 0}, 0.0, is_set, count);
  CHECK(visited == 1);
}
