#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/frontier/uncertainty_frontier.hpp"
#include "incognita/map/cells/dispersion.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

const IndexBox<2> kBox{{-3, -2}, {21, 17}};

std::set<std::pair<int, int>> set_of(const std::vector<Index<2>>& cells) {
  std::set<std::pair<int, int>> result;
  for (const Index<2>& cell : cells) result.emplace(cell[0], cell[1]);
  REQUIRE(result.size() == cells.size());
  REQUIRE(std::is_sorted(cells.begin(), cells.end(), is_stored_before<2>));
  return result;
}

}  // namespace

TEST_CASE("An uncertainty frontier is what its definition says, cell by cell", "[frontier]") {
  Random random(1);
  std::size_t found = 0;
  for (int draw = 0; draw < 20; ++draw) {
    Grid<float, 2> uncertainty_m(Lattice<2>(0.2), kBox, 0.0F);
    OccupancyGrid<2> occupancy(Lattice<2>(0.2), kBox, Occupancy::free);
    for (float& value : uncertainty_m.values()) value = static_cast<float>(0.3 * std::floor(random.uniform(0.0, 4.0)));
    for (Occupancy& cell : occupancy.values()) {
      if (random.uniform() < 0.01) cell = Occupancy::occupied;
    }
    UncertaintyFrontierParams params;
    params.gradient_min_m = random.uniform(0.2, 0.9);
    params.obstacle_distance_min_m = random.uniform(0.0, 1.0);
    const double tolerated_m = random.uniform(0.4, 1.0);
    std::set<std::pair<int, int>> expected;
    const auto at = [&](int x, int y) {
      const bool inside = x >= -3 && x < 21 && y >= -2 && y < 17;
      return inside ? std::min(tolerated_m, static_cast<double>(uncertainty_m.value({x, y}))) : tolerated_m;
    };
    for (int y = -2; y < 17; ++y) {
      for (int x = -3; x < 21; ++x) {
        if (static_cast<double>(uncertainty_m.value({x, y})) >= tolerated_m) continue;
        double leap2 = 0.0;
        for (const bool along_x : {true, false}) {
          double leap = 0.0;
          for (const int step : {-1, 1}) leap = std::max(leap, std::abs(at(x + (along_x ? step : 0), y + (along_x ? 0 : step)) - at(x, y)));
          leap2 += leap * leap;
        }
        if (std::sqrt(leap2) <= params.gradient_min_m) continue;
        double obstacle_m = 1e9;
        for (int oy = -2; oy < 17; ++oy) {
          for (int ox = -3; ox < 21; ++ox) {
            if (occupancy.value({ox, oy}) == Occupancy::occupied) obstacle_m = std::min(obstacle_m, 0.2 * std::hypot(ox - x, oy - y));
          }
        }
        if (obstacle_m >= params.obstacle_distance_min_m) expected.emplace(x, y);
      }
    }
    REQUIRE(set_of(detect_uncertainty_frontier(uncertainty_m, tolerated_m, occupancy, params)) == expected);
    found += expected.size();
  }
  REQUIRE(found > 500);
}

TEST_CASE("A leap counts on the side that is known better, whichever way it faces", "[frontier]") {
  const OccupancyGrid<2> free(Lattice<2>(0.1), {{0, 0}, {20, 20}}, Occupancy::free);
  for (const bool mirrored : {false, true}) {
    Grid<float, 2> uncertainty_m(Lattice<2>(0.1), {{0, 0}, {20, 20}}, 1.0F);
    for (int y = 5; y < 15; ++y) {
      for (int x = 5; x < 15; ++x) uncertainty_m.set({mirrored ? 19 - x : x, y}, 0.3F);
    }
    const auto cells = set_of(detect_uncertainty_frontier(uncertainty_m, 1.0, free, {}));
    REQUIRE(cells.size() == 36);  // the rim of ten by ten, all four sides
    for (const auto& [x, y] : cells) REQUIRE((x == 5 || x == 14 || y == 5 || y == 14));
  }
}

TEST_CASE("Nothing leaps where all is unknown, and where uncertainty grows slowly", "[frontier]") {
  const IndexBox<2> box{{0, 0}, {40, 40}};
  const OccupancyGrid<2> free(Lattice<2>(0.1), box, Occupancy::free);
  Grid<float, 2> uncertainty_m(Lattice<2>(0.1), box, 1.0F);
  REQUIRE(detect_uncertainty_frontier(uncertainty_m, 1.0, free, {}).empty());
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const int rim = std::min({x, y, 39 - x, 39 - y});
      uncertainty_m.set({x, y}, std::max(0.05F, 0.95F - 0.05F * static_cast<float>(rim)));
    }
  }
  REQUIRE(detect_uncertainty_frontier(uncertainty_m, 1.0, free, {}).empty());
}

TEST_CASE("A threshold above what is tolerated may find frontiers, against the text", "[frontier]") {
  const OccupancyGrid<2> free(Lattice<2>(0.1), {{0, 0}, {3, 3}}, Occupancy::free);
  Grid<float, 2> uncertainty_m(Lattice<2>(0.1), {{0, 0}, {3, 3}}, 1.0F);
  uncertainty_m.set({1, 1}, 0.01F);
  UncertaintyFrontierParams params;
  params.gradient_min_m = 1.2;
  REQUIRE(detect_uncertainty_frontier(uncertainty_m, 1.0, free, params).size() == 1);
  params.gradient_min_m = 1.42;
  REQUIRE(detect_uncertainty_frontier(uncertainty_m, 1.0, free, params).empty());
}

TEST_CASE("The uncertainty frontiers of a map ask for the rim of what was seen, until it is as uncertain as tolerated", "[frontier]") {
  for (const bool is_certain : {true, false}) {
    Map<Dispersion> map;
    const double variance_m2 = is_certain ? 0.01 : 0.95;
    for (int n = 0; n < 6; ++n) map.update(Scan<2>(circular_beams(720, 5.0)), {}, Eigen::Vector3d(variance_m2, variance_m2, 1e-6).asDiagonal());
    const auto frontiers = find_uncertainty_frontiers(map);
    if (!is_certain) {
      REQUIRE(frontiers.empty());
      continue;
    }
    REQUIRE(frontiers.size() > 6);  // a rim of 31 m in pieces of 3 m
    for (const Frontier<2>& frontier : frontiers) {
      for (const Index<2>& cell : frontier.cells) REQUIRE(map.lattice().center_m(cell).norm() == Approx(5.0).margin(0.25));
    }
  }
}

TEST_CASE("Uncertainty frontiers refuse bad parameters", "[frontier]") {
  const OccupancyGrid<2> free(Lattice<2>(0.1), {{0, 0}, {3, 3}}, Occupancy::free);
  const Grid<float, 2> uncertainty_m(Lattice<2>(0.1), {{0, 0}, {3, 3}}, 1.0F);
  UncertaintyFrontierParams params;
  params.gradient_min_m = 0.0;
  REQUIRE_THROWS_WITH(detect_uncertainty_frontier(uncertainty_m, 1.0, free, params), Contains("gradient_min_m is 0"));
  params = {};
  params.obstacle_distance_min_m = -1.0;
  REQUIRE_THROWS_WITH(detect_uncertainty_frontier(uncertainty_m, 1.0, free, params), Contains("obstacle_distance_min_m is -1"));
  REQUIRE_THROWS_WITH(detect_uncertainty_frontier(uncertainty_m, 0.0, free, {}), Contains("tolerated_m is 0"));
  const OccupancyGrid<2> other(Lattice<2>(0.1), {{0, 0}, {4, 3}}, Occupancy::free);
  REQUIRE_THROWS_WITH(detect_uncertainty_frontier(uncertainty_m, 1.0, other, {}),
                      Contains("the box of occupancy is") && Contains("that of uncertainty_m"));
}
