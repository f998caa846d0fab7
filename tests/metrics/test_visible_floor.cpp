#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "../simulation/plans.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/sensor/ray_cast.hpp"
#include "incognita/simulation/start.hpp"
#include "set_cells.hpp"

namespace {

using namespace incognita;

constexpr auto blocks = [](FloorCell cell) { return cell != FloorCell::floor; };

/// Sight between all pairs. A segment that a corner decides may go either way here, so both ends are asked
/// and a little to the sides: seen by all is seen, seen by none is not.
enum class Sight { no, touching, yes };

Sight sight(const FloorPlan& plan, const Index<2>& a, const Index<2>& b, double range_max_m) {
  const Point<2> from_m = plan.lattice().center_m(a);
  const Point<2> to_m = plan.lattice().center_m(b);
  const double length_m = (to_m - from_m).norm();
  if (length_m > range_max_m + 1e-9) return Sight::no;
  if (length_m == 0.0) return Sight::yes;
  const Point<2> direction = (to_m - from_m) / length_m;
  const Point<2> aside_m = Point<2>(-direction.y(), direction.x()) * 1e-7;
  int seen = 0;
  for (const double side : {-1.0, 1.0}) {
    const Point<2> start_m = from_m + side * aside_m;
    seen += cast_ray_m(plan, start_m, direction, length_m, blocks) >= length_m ? 1 : 0;
  }
  return seen == 2 ? Sight::yes : seen == 0 ? Sight::no : Sight::touching;
}

/// Plans with the least share of their floor that can be seen.
void check_real_plans(const std::vector<std::pair<std::string, double>>& plans) {
  const std::filesystem::path folder = std::filesystem::path(INCOGNITA_DATA_DIR) / "kth";
  if (!std::filesystem::exists(folder)) {
    WARN("no floor plans in " << folder);
    return;
  }
  for (const auto& [name, least_share] : plans) {
    const FloorPlan plan = read_floor_plan(folder / (name + ".yaml"));
    const ObstacleField field(plan, blocks);
    Random random(1);
    const Point<2> start_m = random_start(field, 0.2, random).position();
    const Grid<std::uint8_t, 2> visible = visible_floor(field, start_m, 0.2, 10.0);
    std::size_t floor = 0;
    for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
      floor += blocks(plan[cell]) ? 0 : 1;
      if (blocks(plan[cell]) && visible[cell] != 0) FAIL("a wall counts as visible floor");
    }
    CAPTURE(name);
    CHECK(static_cast<double>(count_set(visible)) > least_share * static_cast<double>(floor));
    CHECK(static_cast<double>(count_set(visible)) < 0.995 * static_cast<double>(floor));
  }
}

}  // namespace

TEST_CASE("Visible floor against sight between all pairs, in small random worlds", "[metrics]") {
  Random random(1);
  std::size_t hidden_floor = 0;
  std::size_t seen_by_few = 0;
  for (int world = 0; world < 12; ++world) {
    const FloorPlan plan = test::random_plan(28, 24, 0.1, random);
    const ObstacleField field(plan, blocks);
    const double radius_m = 0.17;
    const Grid<std::uint8_t, 2> clear = disc_positions(field, radius_m);
    if (count_set(clear) == 0) continue;
    Offset first = static_cast<Offset>(random.index(clear.size()));
    while (clear[first] == 0) first = (first + 1) % static_cast<Offset>(clear.size());
    const double range_max_m = world % 3 == 0 ? 0.9 : 10.0;
    const Point<2> start_m = plan.lattice().center_m(clear.index_at(first)) + Point<2>(1e-3, -2e-3);
    if (!field.disc_is_clear(start_m, radius_m)) continue;

    const Grid<std::uint8_t, 2> reachable = reachable_positions(field, start_m, radius_m);
    const Grid<std::uint8_t, 2> expected_reachable = flood_fill(
        clear, clear.index_at(first), Adjacency::faces, [](std::uint8_t is_clear) { return is_clear != 0; });
    REQUIRE(reachable.values() == expected_reachable.values());

    const Grid<std::uint8_t, 2> visible = visible_floor(field, start_m, radius_m, range_max_m);
    for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
      Sight best = Sight::no;
      std::size_t observers = 0;
      for (Offset position = 0; position < static_cast<Offset>(plan.size()) && !blocks(plan[cell]);
           ++position) {
        if (reachable[position] == 0) continue;
        const Sight s = sight(plan, plan.index_at(cell), plan.index_at(position), range_max_m);
        best = std::max(best, s);
        observers += s == Sight::yes ? 1 : 0;
      }
      if (best != Sight::touching) {
        CAPTURE(world, plan.index_at(cell).transpose());
        REQUIRE((visible[cell] != 0) == (best == Sight::yes));
      }
      hidden_floor += best == Sight::no && !blocks(plan[cell]) ? 1 : 0;
      seen_by_few += observers > 0 && observers < 10 ? 1 : 0;
    }
  }
  CHECK(hidden_floor > 500);
  CHECK(seen_by_few > 20);
}

TEST_CASE("A room behind a slit is seen in part, a sealed one and one around two corners are not",
          "[metrics]") {
  const FloorPlan plan = test::plan_from_rows(
      {
          "########################",
          "#........#.........#...#",
          "#........#.........#...#",
          "#........#.........#...#",
          "#..................#...#",  // the slit is one pixel high
          "#........#.........#...#",
          "#........#.........#...#",
          "#........####.######...#",  // and so is the way down
          "#........#.........#...#",
          "#........#########.#...#",
          "#........#.........#...#",
          "########################",
      },
      0.1);
  const ObstacleField field(plan, blocks);
  const Grid<std::uint8_t, 2> visible = visible_floor(field, {0.5, 0.6}, 0.15, 10.0);
  for (int x = 1; x < 19; ++x) CHECK(visible.value({x, 7}) == 1);
  CHECK(visible.value({11, 10}) == 0);  // beside the slit
  CHECK(visible.value({10, 8}) == 0);
  CHECK(visible.value({18, 9}) == 1);  // in the cone behind it
  CHECK(visible.value({12, 1}) == 0);  // around two corners
  CHECK(visible.value({21, 5}) == 0);  // sealed
  for (int y = 1; y < 11; ++y)
    CHECK(visible.value({1, y}) == 1);  // along the wall where the disc cannot stand
  // With a range of 0.5 m nothing far behind the slit is seen.
  const Grid<std::uint8_t, 2> near = visible_floor(field, {0.5, 0.6}, 0.15, 0.5);
  CHECK(near.value({10, 7}) == 1);
  CHECK(near.value({14, 7}) == 0);
}

TEST_CASE("A disc reaches what it fits through to", "[metrics]") {
  std::vector<std::string> rows(21, std::string(40, '.'));
  for (int y = 0; y < 21; ++y)
    rows[static_cast<std::size_t>(y)][20] = y >= 6 && y < 15 ? '.' : '#';  // 9 pixels
  const ObstacleField field(test::plan_from_rows(rows, 0.05), blocks);
  const Point<2> start_m(0.41, 0.52);
  const Grid<std::uint8_t, 2> through = reachable_positions(field, start_m, 0.2);
  CHECK(through.value({30, 10}) == 1);
  CHECK(through.value({20, 10}) == 1);
  CHECK(through.value({20, 11}) == 0);
  CHECK(reachable_positions(field, start_m, 0.226).value({30, 10}) == 0);
}

TEST_CASE("A start that a disc cannot use is refused", "[metrics]") {
  const ObstacleField field(test::room(20, 20, 0.1), blocks);
  CHECK_THROWS_AS(visible_floor(field, {0.1, 0.5}, 0.2, 10.0), std::invalid_argument);
  CHECK_THROWS_AS(visible_floor(field, {-9.0, 0.5}, 0.2, 10.0), std::invalid_argument);
  CHECK_THROWS_AS(visible_floor(field, {1.0, 1.0}, -0.2, 10.0), std::invalid_argument);
  CHECK_THROWS_AS(visible_floor(field, {1.0, 1.0}, 0.2, -1.0), std::invalid_argument);
  // Clear between the centres of cells, but on none of them.
  const ObstacleField slot(test::room(6, 6, 0.1), blocks);
  CHECK(slot.disc_is_clear({0.3, 0.3}, 0.19));
  CHECK_THROWS_AS(visible_floor(slot, {0.3, 0.3}, 0.19, 10.0), std::invalid_argument);
}

TEST_CASE("Nearly all floor of real plans can be seen", "[metrics]") {
  check_real_plans({{"50052751", 0.98}, {"50052753", 0.98}, {"50052749", 0.97}});
}

TEST_CASE("Most floor of large real plans, which have closed courtyards, can be seen", "[metrics][.long]") {
  check_real_plans({{"50010535_PLAN1", 0.93}, {"50015848", 0.81}});
}
