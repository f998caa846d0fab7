#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drawn_plan.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/planning/travel_cost.hpp"
#include "incognita/planning/visit_cost.hpp"

using namespace incognita;

namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// The distance to the nearest cell for which holds(index), those around the box among them.
template <class Holds>
double nearest_m(const OccupancyGrid<2>& belief, const Index<2>& from, Holds&& holds) {
  double best_m = std::numeric_limits<double>::infinity();
  const IndexBox<2> box = belief.box().padded(1);
  for (int y = box.lower.y(); y < box.upper.y(); ++y) {
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      if (holds(Index<2>(x, y))) best_m = std::min(best_m, std::hypot(x - from.x(), y - from.y()) * belief.resolution_m());
    }
  }
  return best_m;
}

enum class Corners { closed, open, cut };

/// (14) over the edges of footnote 2, relaxed until nothing gets cheaper.
Grid<double, 2> slow_costs(const Grid<float, 2>& cost_per_m, const Index<2>& start, Corners corners) {
  Grid<double, 2> costs(cost_per_m.lattice(), cost_per_m.box(), std::numeric_limits<double>::infinity());
  if (!(cost_per_m.value(start) < kInfinite) || !costs.contains(start)) return costs;
  const auto at = [&](const Index<2>& cell) { return cost_per_m.contains(cell) ? cost_per_m.value(cell) : kInfinite; };
  costs.set(start, 0.0);
  bool changed = true;
  while (changed) {
    changed = false;
    for (Offset i = 0; i < static_cast<Offset>(costs.size()); ++i) {
      const Index<2> to = costs.index_at(i);
      if (!(at(to) < kInfinite)) continue;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Index<2> from(to.x() + dx, to.y() + dy);
          if ((dx == 0 && dy == 0) || !(at(from) < kInfinite)) continue;
          if (dx != 0 && dy != 0) {
            if (corners == Corners::closed) continue;
            const bool is_cut = !(at({to.x() + dx, to.y()}) < kInfinite) || !(at({to.x(), to.y() + dy}) < kInfinite);
            if (corners == Corners::open && is_cut) continue;
          }
          const double step_m = std::hypot(dx, dy) * cost_per_m.resolution_m();
          const double cost = costs.value(from) + 0.5 * (static_cast<double>(at(from)) + static_cast<double>(at(to))) * step_m;
          if (cost < costs[i] - 1e-12) {
            costs[i] = cost;
            changed = true;
          }
        }
      }
    }
  }
  return costs;
}

/// A belief with room, its planning space and a place in that.
struct VisitScene {
  OccupancyGrid<2> belief;
  CellSet plan;
  Grid<float, 2> cost;
  std::vector<Index<2>> places;
};

VisitScene random_scene(Random& random, const VisitCostParams& params = {}) {
  OccupancyGrid<2> belief = random_belief(random, 36, 28, 0.1);
  CellSet plan = erode(belief, 0.15, [](Occupancy cell) { return cell == Occupancy::free; });
  Grid<float, 2> cost = visit_cost(belief, plan, params);
  std::vector<Index<2>> places;
  for (Offset i = 0; i < static_cast<Offset>(plan.size()); ++i) {
    if (plan[i] != 0) places.push_back(plan.index_at(i));
  }
  return {std::move(belief), std::move(plan), std::move(cost), std::move(places)};
}

const Index<2>& any_of(Random& random, const std::vector<Index<2>>& places) {
  return places[random.index(places.size())];
}

}  // namespace

TEST_CASE("A visit costs the distance to the unknown over the distance to collision", "[planning]") {
  Random random(1);
  for (int draw = 0; draw < 20; ++draw) {
    VisitCostParams params;
    params.unknown_max_m = random.uniform(0.2, 2.0);
    params.collision_max_m = random.uniform(0.2, 1.0);
    if (draw % 4 == 1) params.to_unknown = DistanceMeasure::uniform;
    if (draw % 4 == 2) params.to_collision = DistanceMeasure::uniform;
    const VisitScene scene = random_scene(random, params);
    for (Offset i = 0; i < static_cast<Offset>(scene.cost.size()); ++i) {
      const Index<2> cell = scene.cost.index_at(i);
      if (scene.plan[i] == 0) {
        REQUIRE(scene.cost[i] == kInfinite);
        continue;
      }
      const double to_unknown =
          params.to_unknown == DistanceMeasure::uniform
              ? 1.0
              : std::min(params.unknown_max_m,
                         nearest_m(scene.belief, cell, [&](const Index<2>& at) { return scene.belief.value(at) == Occupancy::unknown; }));
      const double to_collision =
          params.to_collision == DistanceMeasure::uniform
              ? 1.0
              : std::min(params.collision_max_m, nearest_m(scene.belief, cell, [&](const Index<2>& at) {
                           return !scene.plan.contains(at) || scene.plan.value(at) == 0;
                         }));
      CAPTURE(draw, cell);
      REQUIRE(scene.cost[i] == Approx(to_unknown / to_collision).epsilon(1e-5));
    }
  }
}

TEST_CASE("The inverse of a cell's entropy is a distance to the unknown too", "[planning]") {
  const OccupancyGrid<2> belief(Lattice<2>(0.1), {{0, 0}, {3, 1}}, Occupancy::free);
  const std::vector<float> log_odds{0.0F, -2.0F, -30.0F};
  const EntropyTable entropy{Shannon{}};
  const auto inverse = inverse_entropy(belief, [&](Offset i) { return log_odds[static_cast<std::size_t>(i)]; }, entropy, 0.01);
  const double p = 1.0 / (1.0 + std::exp(2.0));
  CHECK(inverse[0] == Approx(1.0 / std::log(2.0)).epsilon(1e-4));
  CHECK(inverse[1] == Approx(-1.0 / (p * std::log(p) + (1.0 - p) * std::log(1.0 - p))).epsilon(1e-3));
  CHECK(inverse[2] == Approx(100.0));
  CHECK_THROWS_AS(inverse_entropy(belief, [](Offset) { return 0.0F; }, entropy, 0.0), std::invalid_argument);
}

TEST_CASE("Travel over visit costs is what relaxing every edge gives, for faces and for corners", "[planning]") {
  Random random(2);
  for (int draw = 0; draw < 12; ++draw) {
    const VisitScene scene = random_scene(random);
    if (scene.places.empty()) continue;
    const Index<2> start = any_of(random, scene.places);
    TravelCostField field(scene.belief.lattice());
    for (const Adjacency steps : {Adjacency::faces, Adjacency::corners}) {
      field.restart(scene.cost, scene.belief.lattice().center_m(start), steps);
      const Grid<double, 2> slow =
          slow_costs(scene.cost, start, steps == Adjacency::faces ? Corners::closed : Corners::open);
      for (Offset i = 0; i < static_cast<Offset>(slow.size()); ++i) {
        const Index<2> cell = slow.index_at(i);
        CAPTURE(draw, cell);
        REQUIRE(field.reaches(cell) == std::isfinite(slow[i]));
        if (field.reaches(cell)) REQUIRE(field.cost_m(cell) == Approx(slow[i]).epsilon(1e-4).margin(1e-6));
      }
    }
  }
}

TEST_CASE("Travel costs that differ a million times are still exact", "[planning]") {
  Random random(3);
  for (int draw = 0; draw < 10; ++draw) {
    VisitScene scene = random_scene(random);
    if (scene.places.empty()) continue;
    for (float& cost : scene.cost.values()) {
      if (cost < kInfinite) cost = static_cast<float>(std::pow(10.0, random.uniform(-3.0, 3.0)));
    }
    const Index<2> start = any_of(random, scene.places);
    TravelCostField field(scene.belief.lattice());
    field.restart(scene.cost, scene.belief.lattice().center_m(start));
    const Grid<double, 2> slow = slow_costs(scene.cost, start, Corners::open);
    for (Offset i = 0; i < static_cast<Offset>(slow.size()); ++i) {
      if (std::isfinite(slow[i])) REQUIRE(field.cost_m(slow.index_at(i)) == Approx(slow[i]).epsilon(1e-4).margin(1e-6));
    }
  }
}

TEST_CASE("Travel costs are a distance, and ways with more steps to take are no longer", "[planning]") {
  Random random(4);
  int compared = 0;
  for (int draw = 0; draw < 30; ++draw) {
    const VisitScene scene = random_scene(random);
    if (scene.places.size() < 3) continue;
    const Lattice<2>& lattice = scene.belief.lattice();
    const Index<2> a = any_of(random, scene.places);
    const Index<2> b = any_of(random, scene.places);
    const Index<2> c = any_of(random, scene.places);
    TravelCostField from_a(lattice);
    TravelCostField from_b(lattice);
    TravelCostField by_faces(lattice);
    from_a.restart(scene.cost, lattice.center_m(a));
    from_b.restart(scene.cost, lattice.center_m(b));
    by_faces.restart(scene.cost, lattice.center_m(a), Adjacency::faces);
    const Grid<double, 2> cutting = slow_costs(scene.cost, a, Corners::cut);
    if (!from_a.reaches(b) || !from_a.reaches(c)) continue;
    const double ab = static_cast<double>(from_a.cost_m(b));
    const double bc = static_cast<double>(from_b.cost_m(c));
    const double ac = static_cast<double>(from_a.cost_m(c));
    CHECK(ab == Approx(static_cast<double>(from_b.cost_m(a))).epsilon(1e-4));
    CHECK(ac <= (ab + bc) * (1.0 + 1e-4));
    const float least = *std::min_element(scene.cost.values().begin(), scene.cost.values().end());
    CHECK(ac >= static_cast<double>(least) * (lattice.center_m(a) - lattice.center_m(c)).norm() * (1.0 - 1e-4));
    CHECK(static_cast<double>(by_faces.cost_m(c)) >= ac * (1.0 - 1e-4));
    CHECK(ac >= cutting.value(c) * (1.0 - 1e-4));
    CHECK(from_a.cost_m(a) == 0.0F);
    ++compared;
  }
  CHECK(compared > 10);
}

TEST_CASE("From a start out of the planning space nothing is reached, and bad costs are refused", "[planning]") {
  Random random(5);
  VisitScene scene = random_scene(random);
  const Lattice<2>& lattice = scene.belief.lattice();
  TravelCostField field(lattice);
  for (Offset i = 0; i < static_cast<Offset>(scene.plan.size()); ++i) {
    if (scene.plan[i] != 0) continue;
    field.restart(scene.cost, lattice.center_m(scene.plan.index_at(i)));
    for (const Index<2>& place : scene.places) REQUIRE_FALSE(field.reaches(place));
    if (i > 40) break;
  }
  field.restart(scene.cost, lattice.center_m(scene.places.front()));
  const float before = field.cost_m(scene.places.back());
  for (const float bad : {0.0F, -1.0F, std::nanf("")}) {
    Grid<float, 2> wrong = scene.cost;
    wrong.values().back() = bad;
    CHECK_THROWS_AS(field.restart(wrong, lattice.center_m(scene.places.front())), std::invalid_argument);
  }
  CHECK_THROWS_AS(field.restart(scene.cost, {std::nan(""), 0.0}), std::invalid_argument);
  CHECK(field.cost_m(scene.places.back()) == before);
  VisitCostParams params;
  params.unknown_max_m = -1.0;
  CHECK_THROWS_AS(visit_cost(scene.belief, scene.plan, params), std::invalid_argument);
  params = {};
  params.collision_max_m = 100.0;
  CHECK_THROWS_AS(visit_cost(scene.belief, scene.plan, params), std::invalid_argument);
  CHECK_THROWS_AS(visit_cost(scene.plan, Grid<float, 2>(lattice), {}), std::invalid_argument);
}
