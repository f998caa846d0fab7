#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/planning/travel_cost.hpp"

using namespace incognita;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The definition of TravelParams, cell by cell.
double cost_per_m(const OccupancyGrid<2>& belief, const Index<2>& index, const TravelParams& params) {
  if (belief.value(index) != Occupancy::free) return infinity;
  double clearance_m = infinity;
  for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
    if (belief[o] != Occupancy::occupied) continue;
    const double cells = (belief.index_at(o) - index).cast<double>().norm();
    clearance_m = std::min(clearance_m, cells * belief.resolution_m());
  }
  if (clearance_m < params.clearance_tight_m(belief.resolution_m())) return infinity;
  if (clearance_m < params.clearance_hard_m()) return params.tight_cost_per_m();
  const double lack = std::max(0.0, 1.0 - clearance_m / params.clearance_soft_m);
  return 1.0 + params.clearance_weight * lack * lack;
}

double proper_max_per_m(const TravelParams& params) { return 1.0 + params.clearance_weight; }

double step_cost_m(const std::vector<double>& per_m, const OccupancyGrid<2>& belief, const Index<2>& from,
                   const Index<2>& step) {
  const auto at = [&](const Index<2>& index) {
    return belief.contains(index) ? per_m[static_cast<std::size_t>(belief.offset_of(index))] : infinity;
  };
  if (step.x() != 0 && step.y() != 0) {
    if (std::isinf(at(from + Index<2>(step.x(), 0))) || std::isinf(at(from + Index<2>(0, step.y()))))
      return infinity;
  }
  return belief.resolution_m() * step.cast<double>().norm() * 0.5 * (at(from) + at(from + step));
}

/// Costs by relaxing every edge until nothing changes (Bellman and Ford).
std::vector<double> costs_by_relaxation(const OccupancyGrid<2>& belief, const std::vector<double>& per_m,
                                        const Index<2>& start) {
  std::vector<double> cost_m(belief.size(), infinity);
  cost_m[static_cast<std::size_t>(belief.offset_of(start))] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
      const double here_m = cost_m[static_cast<std::size_t>(o)];
      if (std::isinf(here_m)) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Index<2> step(dx, dy);
          const double edge_m = step_cost_m(per_m, belief, belief.index_at(o), step);
          if (std::isinf(edge_m)) continue;
          double& there_m = cost_m[static_cast<std::size_t>(belief.offset_of(belief.index_at(o) + step))];
          if (here_m + edge_m < there_m - 1e-12) {
            there_m = here_m + edge_m;
            changed = true;
          }
        }
      }
    }
  }
  return cost_m;
}

/// What is believed of a wall with a door, at the origin of the wall's frame, that leads through it along y; known around
/// the door only, so that there is no way around the wall. From ends of beams, noisy and half a cell inside of the surface,
/// as the map takes them.
OccupancyGrid<2> believed_door(const Pose2& T_map_wall, double door_m, double wall_m, Random& random) {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(-20, -20), Index<2>(30, 30)}, Occupancy::unknown);
  std::map<Offset, int> hits;
  const auto hit = [&](double x_m, double y_m, double into_rad) {
    const double angle_rad = into_rad + random.uniform(-1.0, 1.0);
    const double into_m = 0.05 + random.normal(0.0, 0.01);
    const Eigen::Vector2d end_m(x_m + into_m * std::cos(angle_rad), y_m + into_m * std::sin(angle_rad));
    const Index<2> index = belief.lattice().index_of(T_map_wall * end_m);
    if (belief.contains(index)) ++hits[belief.offset_of(index)];
  };
  for (const double side : {-1.0, 1.0}) {
    for (double x_m = 0.5 * door_m; x_m < 2.0; x_m += 0.01) {
      hit(side * x_m, -0.5 * wall_m, 0.5 * std::numbers::pi);
      hit(side * x_m, 0.5 * wall_m, -0.5 * std::numbers::pi);
    }
    for (double y_m = -0.5 * wall_m; y_m <= 0.5 * wall_m; y_m += 0.01) {
      hit(side * 0.5 * door_m, y_m, side > 0.0 ? 0.0 : std::numbers::pi);
    }
  }
  for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
    const Eigen::Vector2d center_m = belief.lattice().center_m(belief.index_at(o));
    if ((center_m - T_map_wall.position()).norm() < 1.4) belief[o] = Occupancy::free;
  }
  for (const auto& [offset, count] : hits) {
    if (count > 1) belief[offset] = Occupancy::occupied;
  }
  return belief;
}

}  // namespace

TEST_CASE("Travel costs equal those of a search by relaxation", "[planning]") {
  Random random(1);
  std::size_t reached = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const OccupancyGrid<2> belief = random_belief(random, 40, 30, trial % 2 == 0 ? 0.1 : 0.05);
    TravelParams params;
    params.robot_radius_m = trial % 3 == 0 ? 0.05 : 0.15;
    params.clearance_weight = random.uniform(0.0, 8.0);
    std::vector<double> per_m;
    for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
      per_m.push_back(cost_per_m(belief, belief.index_at(o), params));
    }
    Offset start = 0;
    do {
      start = static_cast<Offset>(random.index(belief.size()));
    } while (per_m[static_cast<std::size_t>(start)] > proper_max_per_m(params));
    const auto expected_m = costs_by_relaxation(belief, per_m, belief.index_at(start));
    const TravelCostField field(belief, clearance_of(belief),
                                belief.lattice().center_m(belief.index_at(start)), params);
    for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
      const Index<2> index = belief.index_at(o);
      const double expected = expected_m[static_cast<std::size_t>(o)];
      const bool is_proper = per_m[static_cast<std::size_t>(o)] <= proper_max_per_m(params);
      REQUIRE(field.reaches(index) == (is_proper && std::isfinite(expected)));
      REQUIRE(field.is_proper(index) == is_proper);
      REQUIRE(field.is_passable(index) == std::isfinite(per_m[static_cast<std::size_t>(o)]));
      const std::vector<Index<2>> cells = field.cells_to(index);
      REQUIRE(cells.empty() != field.reaches(index));
      if (cells.empty()) continue;
      ++reached;
      REQUIRE(static_cast<double>(field.cost_m(index)) == Approx(expected).epsilon(1e-5).margin(1e-6));
      REQUIRE(cells.front() == belief.index_at(start));
      REQUIRE(cells.back() == index);
      double along_m = 0.0;
      for (std::size_t i = 1; i < cells.size(); ++i) {
        REQUIRE((cells[i] - cells[i - 1]).cwiseAbs().maxCoeff() == 1);
        along_m += step_cost_m(per_m, belief, cells[i - 1], cells[i] - cells[i - 1]);
      }
      REQUIRE(along_m == Approx(expected).epsilon(1e-5).margin(1e-6));
    }
  }
  REQUIRE(reached > 3000);
}

TEST_CASE("A door of 0.75 m stays open in a belief of 0.1 m at any angle", "[planning]") {
  Random random(2);
  constexpr double door_m = 0.75;
  constexpr double wall_m = 0.15;
  for (int trial = 0; trial < 100; ++trial) {
    const Pose2 T_map_wall{random.uniform(), random.uniform(), random.uniform(-3.1, 3.1)};
    const OccupancyGrid<2> belief = believed_door(T_map_wall, door_m, wall_m, random);
    const TravelCostField field(belief, clearance_of(belief), T_map_wall * Eigen::Vector2d(0.0, -0.9));
    const Index<2> goal = belief.lattice().index_of(T_map_wall * Eigen::Vector2d(0.0, 0.9));
    REQUIRE(field.reaches(goal));
    for (const Index<2>& cell : field.cells_to(goal)) {
      const Eigen::Vector2d at_m = T_map_wall.inverse() * belief.lattice().center_m(cell);
      const Eigen::Vector2d apart(std::max(0.0, 0.5 * door_m - std::abs(at_m.x())),
                                  std::max(0.0, std::abs(at_m.y()) - 0.5 * wall_m));
      REQUIRE(apart.norm() > 0.25);  // the robot's radius and some: it goes through the middle
    }
  }
}

TEST_CASE("A door hardly wider than the robot rarely closes in a belief of 0.1 m at any angle, one too narrow never opens",
          "[planning]") {
  Random random(4);
  int open = 0;
  int lacking = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Pose2 T_map_wall{random.uniform(), random.uniform(), random.uniform(-3.1, 3.1)};
    const auto cells_through = [&](double door_m) {
      const OccupancyGrid<2> belief = believed_door(T_map_wall, door_m, 0.15, random);
      const TravelCostField field(belief, clearance_of(belief), T_map_wall * Eigen::Vector2d(0.0, -0.9));
      const std::vector<Index<2>> cells = field.cells_to(belief.lattice().index_of(T_map_wall * Eigen::Vector2d(0.0, 0.9)));
      const auto is_tight = [&](const Index<2>& cell) { return !field.is_proper(cell); };
      if (std::any_of(cells.begin(), cells.end(), is_tight)) ++lacking;
      return cells;
    };
    if (!cells_through(0.45).empty()) ++open;
    REQUIRE(cells_through(0.15).empty());
  }
  CAPTURE(open, lacking);
  CHECK(open >= 190);
  CHECK(lacking >= 100);  // without the tight cells these would be closed
}

TEST_CASE("A tight passage is passed where there is no better way, and is no place to go to", "[planning]") {
  // Rooms of 3 m with a gap of 0.3 m between them, and later a door of 0.9 m as well.
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(30, 61)}, Occupancy::occupied);
  for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
    if (belief.index_at(o).y() != 30) belief[o] = Occupancy::free;
  }
  for (int x = 10; x < 13; ++x) belief.set({x, 30}, Occupancy::free);
  const TravelCostField tight(belief, clearance_of(belief), {1.15, 2.05});
  const Index<2> gap(11, 30);
  const Index<2> beyond(11, 40);
  CHECK_FALSE(tight.is_proper(gap));
  CHECK(tight.is_passable(gap));
  CHECK_FALSE(tight.reaches(gap));
  const auto passes_gap = [&](const TravelCostField& field) {
    const std::vector<Index<2>> cells = field.cells_to(beyond);
    return std::any_of(cells.begin(), cells.end(), [&](const Index<2>& cell) { return cell == gap; });
  };
  CHECK(passes_gap(tight));

  for (int x = 18; x < 27; ++x) belief.set({x, 30}, Occupancy::free);
  const TravelCostField with_door(belief, clearance_of(belief), {1.15, 2.05});
  CHECK(with_door.reaches(beyond));
  CHECK_FALSE(passes_gap(with_door));
}

TEST_CASE("Cells have room to spare from a cell beyond the clearance that the robot needs", "[planning]") {
  Random random(12);
  for (const double soft_m : {0.6, 0.1}) {
    TravelParams params;
    params.clearance_soft_m = soft_m;
    OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(60, 40)}, Occupancy::free);
    for (int n = 0; n < 60; ++n) {
      belief[static_cast<Offset>(random.index(belief.size()))] = n % 5 == 0 ? Occupancy::unknown : Occupancy::occupied;
    }
    const Grid<float, 2> clearance_m = clearance_of(belief);
    const TravelCostField field(belief, clearance_m, {3.05, 2.05}, params);
    int proper_only = 0;
    for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
      const Index<2> cell = belief.index_at(o);
      // The costs of clearances beyond the soft one are all the same.
      const double roomy_m = std::min(soft_m, 0.22 + 0.1);
      const bool is_roomy = field.is_proper(cell) && static_cast<double>(clearance_m[o]) >= roomy_m - 1e-6;
      REQUIRE(field.is_roomy(cell) == is_roomy);
      proper_only += field.is_proper(cell) && !is_roomy ? 1 : 0;
    }
    CHECK((proper_only > 100) == (soft_m > 0.3));
  }
}

TEST_CASE("A robot that stands too near to a wall gets away and not back", "[planning]") {
  // Two rooms with a gap of 0.1 m between them, too narrow for the robot; it stands in the gap.
  const OccupancyGrid<2> belief = draw({"###############",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#######.#######",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "#.............#",  //
                                        "###############"},
                                       0.1);
  const Grid<float, 2> clearance_m = clearance_of(belief);
  const TravelCostField from_gap(belief, clearance_m, {0.75, 0.65});
  REQUIRE(from_gap.reaches({7, 9}));
  REQUIRE(from_gap.reaches({7, 3}));
  REQUIRE_FALSE(from_gap.reaches({7, 6}));  // where it stands is no goal
  REQUIRE_FALSE(from_gap.is_proper({7, 6}));
  REQUIRE(from_gap.cells_to({7, 9}).front() == Index<2>(7, 6));
  REQUIRE(from_gap.cost_m({7, 9}) >
          0.05F * 20.0F + 0.25F);  // half a cell at 20 a metre, the rest at 1 or more

  // From a room the gap stays closed, even when the robot stands too near to the wall beside it.
  const TravelCostField from_room(belief, clearance_m, {0.75, 0.95});
  REQUIRE(from_room.is_proper({7, 9}));
  REQUIRE(from_room.reaches({4, 10}));
  REQUIRE_FALSE(from_room.reaches({7, 3}));
  TravelParams short_escape;
  short_escape.escape_radius_m = 0.15;
  const TravelCostField beside(belief, clearance_m, {0.45, 0.75}, short_escape);
  REQUIRE_FALSE(beside.is_proper({4, 7}));
  REQUIRE(beside.reaches({7, 10}));
  REQUIRE_FALSE(beside.reaches({7, 3}));
}

TEST_CASE("A robot does not escape through what is closed to it, but gets out of it", "[planning]") {
  // A wall on the left that the robot stands too near to, and a strip without clearance right of it.
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(30, 12)}, Occupancy::unknown);
  belief.values().assign(belief.size(), Occupancy::free);
  for (int y = 0; y < 12; ++y) belief.set({0, y}, Occupancy::occupied);
  Grid<float, 2> clearance_m = clearance_of(belief);
  REQUIRE(TravelCostField(belief, clearance_m, {0.15, 0.55}).reaches({8, 5}));
  for (int y = 0; y < 12; ++y) {
    for (int x = 2; x < 5; ++x) clearance_m[clearance_m.offset_of({x, y})] = 0.0F;
  }
  REQUIRE_FALSE(TravelCostField(belief, clearance_m, {0.15, 0.55}).reaches({8, 5}));
  const TravelCostField within(belief, clearance_m, {0.35, 0.55});
  REQUIRE(within.reaches({8, 5}));
  REQUIRE_FALSE(within.reaches({3, 5}));
  // Nor from a place that the belief has a wall in.
  REQUIRE_FALSE(TravelCostField(belief, clearance_m, {0.05, 0.55}).reaches({8, 5}));
}

TEST_CASE("A robot in a cell that the belief calls occupied gets away", "[planning]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(30, 30)}, Occupancy::unknown);
  belief.values().assign(belief.size(), Occupancy::free);
  belief.set({15, 15}, Occupancy::occupied);
  const TravelCostField field(belief, clearance_of(belief), {1.55, 1.55});
  REQUIRE(field.reaches({20, 15}));
  REQUIRE_FALSE(field.reaches({15, 15}));
}

TEST_CASE("The unknown is never entered, and from outside of the box nothing is reached", "[planning]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(20, 10)}, Occupancy::unknown);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      if (x != 10) belief.set({x, y}, Occupancy::free);
    }
  }
  const Grid<float, 2> clearance_m = clearance_of(belief);
  const TravelCostField field(belief, clearance_m, {0.5, 0.5});
  REQUIRE(field.reaches({9, 9}));
  REQUIRE(field.reaches({0, 0}));  // the edge of the box is as good as any cell
  REQUIRE_FALSE(field.reaches({10, 5}));
  REQUIRE_FALSE(field.reaches({11, 5}));
  REQUIRE_FALSE(field.reaches({-1, 5}));
  for (const Eigen::Vector2d& start_m : {Eigen::Vector2d(-0.01, 0.5), Eigen::Vector2d(1e300, 0.0)}) {
    const TravelCostField outside(belief, clearance_m, start_m);
    REQUIRE_FALSE(outside.reaches({5, 5}));
    REQUIRE(outside.cells_to({5, 5}).empty());
  }
}

TEST_CASE("A field refuses what makes no sense", "[planning]") {
  const OccupancyGrid<2> belief = draw({"...", "..."}, 0.1);
  const Grid<float, 2> clearance_m = clearance_of(belief);
  REQUIRE_THROWS_WITH(TravelCostField(belief, clearance_m, {std::nan(""), 0.0}), Catch::Contains("start_m is (nan, 0), but must be finite"));
  REQUIRE_THROWS_WITH(TravelCostField(belief, Grid<float, 2>(Lattice<2>(0.1)), {0.0, 0.0}),
                      Catch::Contains("the box of clearance_m is (0, 0) to (0, 0), but must be that of occupancy"));
  const auto refused = [&](auto change, const char* message) {
    TravelParams params;
    change(params);
    REQUIRE_THROWS_WITH(TravelCostField(belief, clearance_m, {0.05, 0.05}, params), Catch::Contains(message));
  };
  refused([](TravelParams& params) { params.robot_radius_m = -0.1; }, "robot_radius_m is -0.1");
  refused([](TravelParams& params) { params.margin_m = infinity; }, "margin_m");
  refused([](TravelParams& params) { params.clearance_soft_m = 0.0; }, "clearance_soft_m");
  refused([](TravelParams& params) { params.clearance_weight = -1.0; }, "clearance_weight");
  refused([](TravelParams& params) { params.escape_radius_m = -1.0; }, "escape_radius_m");
  refused([](TravelParams& params) { params.escape_cost_per_m = 5.0; }, "escape_cost_per_m");
}
