#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "../planning/drawn_plan.hpp"
#include "incognita/exploration/viewpoints.hpp"
#include "incognita/planning/safe_space.hpp"

using namespace incognita;

namespace {

/// (22) by its words: the hull of the frontier cell's centre and of a disc around the viewpoint is the union of the discs between
/// them, and none of those may reach into a cell that is not free. Searched cell by cell.
bool sees_by_definition(const OccupancyGrid<2>& belief, const Index<2>& from, const Index<2>& cell, const VisibilityParams& params) {
  const Lattice<2>& lattice = belief.lattice();
  const Eigen::Vector2d apex = lattice.center_m(cell);
  const Eigen::Vector2d center = lattice.center_m(from);
  if ((apex - center).norm() > params.range_max_m - params.tolerance_m + 1e-9) return false;
  const double half_m = 0.5 * lattice.resolution_m();
  const int reach = static_cast<int>(std::ceil(params.tolerance_m / lattice.resolution_m())) + 1;
  const Index<2> lower = from.cwiseMin(cell).array() - reach;
  const Index<2> upper = from.cwiseMax(cell).array() + reach;
  for (int y = lower.y(); y <= upper.y(); ++y) {
    for (int x = lower.x(); x <= upper.x(); ++x) {
      if (belief.value({x, y}) == Occupancy::free) continue;
      const Eigen::Vector2d middle = lattice.center_m({x, y});
      const auto beyond = [&](double share) {
        const Eigen::Vector2d off = (apex + share * (center - apex) - middle).cwiseAbs().array() - half_m;
        return off.cwiseMax(0.0).norm() - share * params.tolerance_m;
      };
      double low = 0.0;
      double high = 1.0;
      for (int n = 0; n < 100; ++n) {
        const double third = (high - low) / 3.0;
        if (beyond(low + third) < beyond(high - third)) high -= third; else low += third;
      }
      if (std::min({beyond(0.0), beyond(1.0), beyond(0.5 * (low + high))}) < -1e-9) return false;
    }
  }
  return true;
}

struct Scene {
  OccupancyGrid<2> belief;
  CellSet plan;
  std::vector<Index<2>> frontier;  // of all regions
  std::vector<Frontier<2>> regions;
};

Scene random_scene(Random& random) {
  OccupancyGrid<2> belief = random_belief(random, 34, 26, 0.1);
  CellSet plan = erode(belief, 0.15, [](Occupancy cell) { return cell == Occupancy::free; });
  const FrontierParams params{false, Adjacency::faces, Adjacency::corners, 0.0, 1e9};
  auto frontier = detect_frontier<2>(belief, params);
  auto regions = cluster_frontier<2>(belief.lattice(), frontier, params);
  return {std::move(belief), std::move(plan), std::move(frontier), std::move(regions)};
}

VisibilityParams random_visibility(Random& random) {
  VisibilityParams params;
  params.tolerance_m = random.uniform(0.01, 0.25);
  params.range_max_m = random.uniform(0.5, 2.0);
  return params;
}

auto in(const CellSet& set) {
  return [&set](const Index<2>& cell) { return set.value(cell) != 0; };
}

auto one_of(const std::vector<Index<2>>& cells) {
  return [&cells](const Index<2>& cell) { return std::find(cells.begin(), cells.end(), cell) != cells.end(); };
}

/// Pair by pair.
std::vector<Index<2>> seen_of(const std::vector<Index<2>>& cells, const Index<2>& from, const ReliableVisibility& visibility) {
  std::vector<Index<2>> seen;
  for (const Index<2>& cell : cells) {
    if (visibility.sees(from, cell)) seen.push_back(cell);
  }
  return seen;
}

std::vector<Index<2>> every_viewpoint(const Scene& scene, const std::vector<Index<2>>& region, const ReliableVisibility& visibility) {
  std::vector<Index<2>> viewpoints;
  for (Offset i = 0; i < static_cast<Offset>(scene.plan.size()); ++i) {
    const Index<2> at = scene.plan.index_at(i);
    if (scene.plan[i] != 0 && !seen_of(region, at, visibility).empty()) viewpoints.push_back(at);
  }
  return viewpoints;
}

}  // namespace

TEST_CASE("What is reliably seen is what (22) says, cell by cell", "[exploration]") {
  Random random(1);
  int seen = 0;
  int hidden = 0;
  for (int draw = 0; draw < 12; ++draw) {
    const Scene scene = random_scene(random);
    const VisibilityParams params = random_visibility(random);
    const CellBits free = free_cells(scene.belief);
    const ReliableVisibility visibility(scene.belief, free, params);
    for (int pair = 0; pair < 300; ++pair) {
      const Index<2> from = scene.belief.index_at(static_cast<Offset>(random.index(scene.belief.size())));
      if (scene.frontier.empty() || scene.belief.value(from) != Occupancy::free) continue;
      const Index<2>& cell = scene.frontier[random.index(scene.frontier.size())];
      const bool expected = sees_by_definition(scene.belief, from, cell, params);
      CAPTURE(draw, from, cell, params.tolerance_m, params.range_max_m);
      REQUIRE(visibility.sees(from, cell) == expected);
      (expected ? seen : hidden) += 1;
    }
  }
  CHECK(seen > 100);
  CHECK(hidden > 1000);
}

TEST_CASE("A frontier is seen from a place exactly when the place is among its viewpoints", "[exploration]") {
  ViewpointSearch search;
  Random random(2);
  for (int draw = 0; draw < 6; ++draw) {
    const Scene scene = random_scene(random);
    const CellBits free = free_cells(scene.belief);
    const ReliableVisibility visibility(scene.belief, free, random_visibility(random));
    for (std::size_t r = 0; r < std::min<std::size_t>(scene.regions.size(), 8); ++r) {
      const std::vector<Index<2>>& region = scene.regions[r].cells;
      const auto viewpoints = search.all(region, in(scene.plan), visibility);
      CHECK(std::is_sorted(viewpoints.begin(), viewpoints.end(), is_stored_before<2>));
      for (Offset i = 0; i < static_cast<Offset>(scene.plan.size()); ++i) {
        const Index<2> at = scene.plan.index_at(i);
        const bool views = std::find(viewpoints.begin(), viewpoints.end(), at) != viewpoints.end();
        REQUIRE(views == (scene.plan[i] != 0 && !seen_of(region, at, visibility).empty()));
      }
    }
  }
}

TEST_CASE("The best viewpoint is that of the whole set with the least sum of distances", "[exploration]") {
  ViewpointSearch search;
  Random random(3);
  int found = 0;
  int none = 0;
  for (int draw = 0; draw < 25; ++draw) {
    const Scene scene = random_scene(random);
    const CellBits free = free_cells(scene.belief);
    const ReliableVisibility visibility(scene.belief, free, random_visibility(random));
    const auto is_frontier = one_of(scene.frontier);
    for (const Frontier<2>& region : scene.regions) {
      const auto viewpoints = every_viewpoint(scene, region.cells, visibility);
      const auto best = search.best(region.cells, in(scene.plan), visibility);
      CAPTURE(draw, region.representative);
      REQUIRE(best.has_value() == !viewpoints.empty());
      if (!best) {
        ++none;
        continue;
      }
      ++found;
      REQUIRE(std::find(viewpoints.begin(), viewpoints.end(), *best) != viewpoints.end());
      double least = std::numeric_limits<double>::infinity();
      for (const Index<2>& at : viewpoints) {
        double sum = 0.0;
        for (const Index<2>& cell : region.cells) sum += (at - cell).cast<double>().norm();
        least = std::min(least, sum);
      }
      REQUIRE(summed_distance_cells(*best, region.cells) == Approx(least).epsilon(1e-12));
      const auto most = search.most_seeing(region.cells, is_frontier, in(scene.plan), visibility);
      std::size_t largest = 0;
      for (const Index<2>& at : viewpoints) largest = std::max(largest, seen_of(scene.frontier, at, visibility).size());
      REQUIRE(search.visible(most.value(), is_frontier, visibility).size() == largest);
    }
  }
  CHECK(found > 50);
  CHECK(none > 5);
}

TEST_CASE("The best viewpoint from which enough is seen is the nearest of those that see as much", "[exploration]") {
  ViewpointSearch search;
  Random random(6);
  int moved = 0;
  int none = 0;
  for (int draw = 0; draw < 25; ++draw) {
    const Scene scene = random_scene(random);
    const CellBits free = free_cells(scene.belief);
    const ReliableVisibility visibility(scene.belief, free, random_visibility(random));
    const std::size_t seen_min = 2 + random.index(6);
    for (const Frontier<2>& region : scene.regions) {
      const auto best = search.best(region.cells, in(scene.plan), visibility, seen_min);
      double least = std::numeric_limits<double>::infinity();
      for (const Index<2>& at : every_viewpoint(scene, region.cells, visibility)) {
        if (seen_of(region.cells, at, visibility).size() < seen_min) continue;
        least = std::min(least, summed_distance_cells(at, region.cells));
      }
      CAPTURE(draw, region.representative, seen_min);
      REQUIRE(best.has_value() == std::isfinite(least));
      const auto any = search.best(region.cells, in(scene.plan), visibility);
      if (!best) {
        none += any ? 1 : 0;
        continue;
      }
      REQUIRE(seen_of(region.cells, *best, visibility).size() >= seen_min);
      REQUIRE(summed_distance_cells(*best, region.cells) == Approx(least).epsilon(1e-12));
      moved += *any == *best ? 0 : 1;
    }
  }
  CHECK(moved > 5);
  CHECK(none > 5);
}

TEST_CASE("Less is seen with a larger tolerance, and nothing further away than what is left of the range", "[exploration]") {
  ViewpointSearch search;
  Random random(4);
  for (int draw = 0; draw < 10; ++draw) {
    const Scene scene = random_scene(random);
    const CellBits free = free_cells(scene.belief);
    VisibilityParams narrow = random_visibility(random);
    VisibilityParams wide = narrow;
    wide.tolerance_m += random.uniform(0.0, 0.2);
    const double side_m = scene.belief.resolution_m();
    const ReliableVisibility sharp(scene.belief, free, narrow);
    const ReliableVisibility blurred(scene.belief, free, wide);
    for (Offset i = 0; i < static_cast<Offset>(scene.plan.size()); i += 7) {
      const Index<2> at = scene.plan.index_at(i);
      const auto more = seen_of(scene.frontier, at, sharp);
      for (const Index<2>& cell : seen_of(scene.frontier, at, blurred)) {
        REQUIRE(std::find(more.begin(), more.end(), cell) != more.end());
        REQUIRE((cell - at).cast<double>().norm() * side_m <= wide.range_max_m - wide.tolerance_m + 1e-9);
      }
      REQUIRE(search.visible(at, one_of(scene.frontier), sharp) == more);
    }
  }
}

TEST_CASE("Lemma 1: with no frontier within the range, none is seen from any place within the tolerance", "[exploration]") {
  ViewpointSearch search;
  Random random(5);
  int far = 0;
  for (int draw = 0; draw < 40; ++draw) {
    const Scene scene = random_scene(random);
    const CellBits free = free_cells(scene.belief);
    VisibilityParams params = random_visibility(random);
    params.range_max_m = random.uniform(0.3, 0.6);
    const double side_m = scene.belief.resolution_m();
    const ReliableVisibility visibility(scene.belief, free, params);
    for (Offset i = 0; i < static_cast<Offset>(scene.plan.size()); i += 3) {
      const Index<2> x = scene.plan.index_at(i);
      const bool is_far = std::all_of(scene.frontier.begin(), scene.frontier.end(), [&](const Index<2>& cell) {
        return (cell - x).cast<double>().norm() * side_m > params.range_max_m;
      });
      if (scene.plan[i] == 0 || !is_far) continue;
      ++far;
      const int reach = static_cast<int>(params.tolerance_m / side_m);
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          if (std::hypot(dx, dy) * side_m > params.tolerance_m) continue;
          REQUIRE(search.visible({x.x() + dx, x.y() + dy}, one_of(scene.frontier), visibility).empty());
        }
      }
    }
  }
  CHECK(far > 100);
}

TEST_CASE("Nothing is seen of no frontier, and visibility that makes no sense is refused", "[exploration]") {
  const OccupancyGrid<2> empty(Lattice<2>(0.1), {}, Occupancy::unknown);
  const CellBits free = free_cells(empty);
  const ReliableVisibility visibility(empty, free, {});
  const auto anywhere = [](const Index<2>&) { return true; };
  ViewpointSearch search;
  CHECK_FALSE(search.best({}, anywhere, visibility));
  CHECK(search.all({}, anywhere, visibility).empty());
  CHECK(search.visible({0, 0}, anywhere, visibility).empty());
  CHECK_FALSE(visibility.sees({0, 0}, {1, 1}));
  for (const auto& [range_m, tolerance_m] : std::vector<std::pair<double, double>>{
           {0.1, 0.1}, {1.0, 0.0}, {1.0, -0.1}, {std::nan(""), 0.1}, {1.0, std::nan("")}, {std::numeric_limits<double>::infinity(), 0.1}}) {
    CHECK_THROWS_AS(ReliableVisibility(empty, free, {range_m, tolerance_m}), std::invalid_argument);
  }
}
