#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../planning/drawn_plan.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/exploration/action_aware.hpp"
#include "incognita/exploration/frontier_information.hpp"

using namespace incognita;

namespace {

double region_size(const Frontier<2>& frontier) { return static_cast<double>(frontier.cells.size()); }

ActionAwareParams small_body() {
  ActionAwareParams params;
  params.body.radius_m = 0.12;
  params.visibility = {1.5, 0.05};
  return params;
}

/// Two dead ends: the upper corridor is entered from the left and ends on the right, the lower one the other way round.
OccupancyGrid<2> crossed_corridors() {
  return draw({"###########################",  //
               "#.........................?",  //
               "#.#########################",  //
               "#.#########################",  //
               "#.?.......................#",  //
               "#.#######################.#",  //
               "#.#######################.#",  //
               "#.........................#",  //
               "###########################"},
              0.1, 4);
}

struct Swing {
  int switches = 0;
  bool arrived = false;
  Eigen::Vector2d at_m{0.0, 0.0};  // in the end
};

/// A robot that drives a cell along the plan, plans anew, and so on, in a belief that stays as it is.
Swing plan_online(const OccupancyGrid<2>& belief, NavigationCost navigation, bool keeps_goal_until_change) {
  ActionAwareParams params = small_body();
  params.navigation = navigation;
  std::optional<Index<2>> goal;
  Swing swing;
  Eigen::Vector2d& at_m = swing.at_m;
  at_m = belief.lattice().center_m({54, 6});
  for (int step = 0; step < 2000 && !swing.arrived; ++step) {
    const ExplorationPlan plan = plan_exploration(belief, at_m, params, region_size);
    REQUIRE(plan.chosen);
    Index<2> next = plan.chosen->viewpoint;
    if (goal && keeps_goal_until_change) next = *goal;
    if (goal && !equal(*goal, next)) ++swing.switches;
    goal = next;
    TravelCostField field(belief.lattice());
    const SafeSpaces spaces = safe_spaces(belief, params.body);
    field.restart(visit_cost(belief, spaces.plan, params.visit), at_m, params.steps);
    const auto cells = field.cells_to(*goal);
    at_m = belief.lattice().center_m(cells.size() > 1 ? cells[1] : cells.front());
    swing.arrived = is_near(at_m, belief.lattice().center_m(*goal), params.visibility.tolerance_m);
  }
  return swing;
}

}  // namespace

TEST_CASE("Areas are compared by whole cells", "[exploration]") {
  CHECK(least_cells_above(0.0, 0.1) == 1);
  CHECK(least_cells_above(0.01, 0.1) == 2);
  CHECK(least_cells_above(0.02, 0.1) == 3);
  CHECK(least_cells_above(0.025, 0.1) == 3);
  CHECK(least_cells_above(0.03, 0.1) == 4);
}

TEST_CASE("Navigation costs are nothing, the straight line, and the cheapest way", "[exploration]") {
  const OccupancyGrid<2> belief = crossed_corridors();
  const CellSet plan = erode(belief, 0.12, [](Occupancy cell) { return cell == Occupancy::free; });
  TravelCostField field(belief.lattice());
  field.restart(visit_cost(belief, plan), belief.lattice().center_m({54, 6}));
  const Index<2> goal(20, 6);
  CHECK(navigation_cost(NavigationCost::uniform, field, goal) == 1.0);
  CHECK(navigation_cost(NavigationCost::euclidean, field, goal) == Approx(3.4));
  CHECK(navigation_cost(NavigationCost::geodesic, field, goal) == Approx(static_cast<double>(field.cost_m(goal))));
  CHECK(information_per_cost(2.0, 4.0) == 0.5);
  CHECK(information_per_cost(2.0, 0.0) == std::numeric_limits<double>::infinity());
  CHECK(information_per_cost(0.0, 0.0) == 0.0);
  CHECK(is_near({0.0, 0.0}, {0.3, 0.4}, 0.5));
  CHECK_FALSE(is_near({0.0, 0.0}, {0.3, 0.4}, 0.49));
}

TEST_CASE("The chosen view has the most information per cost, and every view that was eligible was looked at", "[exploration]") {
  Random random(1);
  int planned = 0;
  int ended = 0;
  int replaced = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const OccupancyGrid<2> belief = random_belief(random, 40, 30, 0.1);
    ActionAwareParams params = small_body();
    params.navigation = static_cast<NavigationCost>(draw % 3);
    params.information_min_m2 = draw % 4 == 0 ? 0.05 : 0.0;
    const Index<2> start = belief.index_at(static_cast<Offset>(random.index(belief.size())));
    const Eigen::Vector2d start_m = belief.lattice().center_m(start);
    const ExplorationPlan plan = plan_exploration(belief, start_m, params, region_size);

    // By the definitions, region by region.
    const auto cells = detect_frontier<2>(belief, params.frontier);
    const SafeSpaces spaces = safe_spaces(belief, params.body);
    TravelCostField field(belief.lattice());
    field.restart(visit_cost(belief, spaces.plan, params.visit), start_m);
    const CellBits free = free_cells(belief);
    const ReliableVisibility visibility(belief, free, params.visibility);
    ViewpointSearch search;
    double most = 0.0;
    std::size_t eligible = 0;
    double most_actionable_m2 = 0.0;
    for (const Frontier<2>& region : plan.frontiers) {
      const auto is_reached = [&](const Index<2>& cell) { return field.reaches(cell); };
      auto view = search.best(region.cells, is_reached, visibility);
      if (!view) continue;
      if (!is_informative(*view, cells, visibility, params.information_min_m2)) {
        const std::size_t least = least_cells_above(params.information_min_m2, 0.1);
        if (const auto better = search.best(region.cells, is_reached, visibility, least)) {
          view = better;
          ++replaced;
        }
      }
      const double actionable_m2 = 0.01 * static_cast<double>(std::count_if(
          cells.begin(), cells.end(), [&](const Index<2>& cell) { return visibility.sees(*view, cell); }));
      most_actionable_m2 = std::max(most_actionable_m2, actionable_m2);
      if (!is_informative(*view, cells, visibility, params.information_min_m2)) continue;
      ++eligible;
      most = std::max(most, information_per_cost(region_size(region), navigation_cost(params.navigation, field, *view)));
    }
    CAPTURE(draw, start);
    REQUIRE(plan.chosen.has_value() == (eligible > 0));
    REQUIRE(plan.ended.has_value() == (eligible == 0));
    // (28)
    REQUIRE((eligible == 0) == (most_actionable_m2 <= params.information_min_m2 + 1e-9));
    if (!plan.chosen) {
      CHECK(plan.path.empty());
      ++ended;
      continue;
    }
    ++planned;
    REQUIRE(plan.views.size() == eligible);
    const Frontier<2>& chosen = plan.frontiers[plan.chosen->region];
    CHECK(information_per_cost(region_size(chosen), navigation_cost(params.navigation, field, plan.chosen->viewpoint)) == most);
    CHECK(equal(plan.path.points_m().front(), start_m));
    CHECK(equal(plan.path.points_m().back(), belief.lattice().center_m(plan.chosen->viewpoint)));
    for (const Eigen::Vector2d& place_m : plan.path.points_m()) CHECK(spaces.plan.value(belief.lattice().index_of(place_m)) == 1);
  }
  CHECK(replaced > 1);
  CHECK(planned > 15);
  CHECK(ended > 15);
}

TEST_CASE("Planning ends with a reason where there is nothing to see, or no way to it", "[exploration]") {
  const ActionAwareParams params = small_body();
  const auto reason = [&](const OccupancyGrid<2>& belief, const Eigen::Vector2d& start_m) {
    const ExplorationPlan plan = plan_exploration(belief, start_m, params, region_size);
    CHECK(plan.path.empty());
    CHECK_FALSE(plan.chosen);
    return plan.ended.value();
  };
  const OccupancyGrid<2> closed = draw({"#####", "#...#", "#...#", "#####"}, 0.1, 4);
  CHECK(reason(closed, {0.8, 0.8}) == StopReason::complete);
  const OccupancyGrid<2> open = draw({"#####", "#...?", "#...#", "#####"}, 0.1, 4);
  CHECK_FALSE(plan_exploration(open, {0.8, 0.8}, params, region_size).ended);
  CHECK(reason(open, {0.1, 0.1}) == StopReason::nothing_reachable);    // in a wall
  CHECK(reason(open, {9.0, 9.0}) == StopReason::nothing_reachable);    // out of the belief
  CHECK(reason(open, {0.45, 0.45}) == StopReason::nothing_reachable);  // in a corner, where the body does not fit
  CHECK(plan_exploration(open, {0.77, 0.79}, params, region_size).path.points_m().size() > 1);
  const OccupancyGrid<2> apart = draw({"######", "#.#..?", "#.#..#", "######"}, 0.1, 6);
  CHECK(reason(apart, {0.9, 0.9}) == StopReason::nothing_reachable);
  CHECK(reason(OccupancyGrid<2>(Lattice<2>(0.1), {}, Occupancy::unknown), {0.0, 0.0}) == StopReason::nothing_reachable);
  CHECK(reason(OccupancyGrid<2>(Lattice<2>(0.1), {{0, 0}, {9, 9}}, Occupancy::unknown), {0.4, 0.4}) == StopReason::nothing_reachable);

  ActionAwareParams choosy = params;
  choosy.information_min_m2 = 1.0;
  CHECK(plan_exploration(open, {0.8, 0.8}, choosy, region_size).ended == StopReason::nothing_informative);
}

TEST_CASE("Parameters that contradict each other are refused", "[exploration]") {
  const OccupancyGrid<2> belief = crossed_corridors();
  const auto refuses = [&](auto&& change) {
    ActionAwareParams params;
    change(params);
    CHECK_THROWS_AS(params.validate(), std::invalid_argument);
    CHECK_THROWS_AS(plan_exploration(belief, {1.0, 1.0}, params, region_size), std::invalid_argument);
  };
  refuses([](ActionAwareParams& p) { p.visibility = {0.3, 0.1}; });  // sees no further than its body reaches
  refuses([](ActionAwareParams& p) { p.body.margin_m = 20.0; });
  refuses([](ActionAwareParams& p) { p.information_min_m2 = -1.0; });
  refuses([](ActionAwareParams& p) { p.information_min_m2 = std::nan(""); });
  refuses([](ActionAwareParams& p) { p.visit.collision_max_m = 0.0; });
  CHECK_THROWS_AS(plan_exploration(belief, {std::nan(""), 1.0}, ActionAwareParams{}, region_size), std::invalid_argument);
}

TEST_CASE("Online planning by straight lines swings between two goals for ever; by ways it arrives, and so it does if it keeps "
          "its goal until the map changes",
          "[exploration]") {
  const OccupancyGrid<2> belief = crossed_corridors();
  const Swing livelock = plan_online(belief, NavigationCost::euclidean, false);
  CHECK_FALSE(livelock.arrived);
  CHECK(livelock.switches > 100);
  const Swing guarded = plan_online(belief, NavigationCost::euclidean, true);
  CHECK(guarded.arrived);
  const Swing geodesic = plan_online(belief, NavigationCost::geodesic, false);
  CHECK(geodesic.arrived);

  // By a uniform cost the goal does not depend on where the robot is: it does not swing, but would stand at its goal for ever.
  const Swing uniform = plan_online(belief, NavigationCost::uniform, false);
  CHECK(uniform.arrived);
  CHECK(uniform.switches == 0);
  ActionAwareParams params = small_body();
  params.navigation = NavigationCost::uniform;
  const ExplorationPlan stays = plan_exploration(belief, uniform.at_m, params, region_size);
  REQUIRE(stays.chosen);
  CHECK(is_near(belief.lattice().center_m(stays.chosen->viewpoint), uniform.at_m, 0.05));
}

TEST_CASE("What a frontier promises is its number, its size, its entropy, or that of its neighbourhood", "[exploration]") {
  struct Belief {
    [[nodiscard]] double resolution_m() const { return 0.2; }
    [[nodiscard]] float log_odds(const Index<2>& cell) const { return static_cast<float>(0.3 * cell[0] - 0.2 * cell[1]); }
  };
  const std::vector<Index<2>> frontier{{0, 0}, {1, 0}, {1, 1}};
  const EntropyTable entropy{Shannon{}};
  const auto nats = [](int x, int y) {
    const double p = 1.0 / (1.0 + std::exp(-(0.3 * x - 0.2 * y)));
    return -p * std::log(p) - (1.0 - p) * std::log(1.0 - p);
  };
  CHECK(frontier_size_m2(frontier, 0.2) == Approx(0.12));
  CHECK(frontier_entropy_nats_m2(frontier, Belief{}, entropy) == Approx(0.04 * (nats(0, 0) + nats(1, 0) + nats(1, 1))).epsilon(1e-4));
  double expected = 0.0;
  for (const Index<2>& cell : frontier) {
    for (int y = -9; y <= 9; ++y) {
      for (int x = -9; x <= 9; ++x) {
        const double distance_m = 0.2 * std::hypot(x, y);
        if (distance_m > 0.6 + 1e-9) continue;
        expected += nats(cell[0] + x, cell[1] + y) * std::exp(-distance_m * distance_m / (2.0 * 0.3 * 0.3));
      }
    }
  }
  CHECK(kernel_entropy_nats_m4(frontier, Belief{}, entropy, 0.6, 0.3) == Approx(0.0016 * expected).epsilon(1e-4));
  CHECK_THROWS_AS(kernel_entropy_nats_m4(frontier, Belief{}, entropy, 0.0, 0.3), std::invalid_argument);
  CHECK_THROWS_AS(kernel_entropy_nats_m4(frontier, Belief{}, entropy, 0.6, std::nan("")), std::invalid_argument);
}
