#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/frontier/detection.hpp"

using namespace incognita;

namespace {

template <int Dim>
OccupancyGrid<Dim> random_belief(Random& random, const Index<Dim>& extent, double unknown, double occupied) {
  const Index<Dim> lower = Index<Dim>::Constant(-4);
  OccupancyGrid<Dim> belief(Lattice<Dim>(0.1), {lower, lower + extent}, Occupancy::unknown);
  for (Occupancy& cell : belief.values()) {
    const double draw = random.uniform();
    cell = draw < unknown              ? Occupancy::unknown
           : draw < unknown + occupied ? Occupancy::occupied
                                       : Occupancy::free;
  }
  return belief;
}

/// The definition, cell by cell, over pairs of indices.
template <int Dim>
std::vector<Index<Dim>> frontier_by_definition(const OccupancyGrid<Dim>& belief, bool ignore_near_walls, bool across_corners) {
  const auto near_occupied = [&](const Index<Dim>& center) {
    for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
      if (belief[o] == Occupancy::occupied && (belief.index_at(o) - center).cwiseAbs().maxCoeff() == 1)
        return true;
    }
    return false;
  };
  std::vector<Index<Dim>> frontier;
  for (Offset o = 0; o < static_cast<Offset>(belief.size()); ++o) {
    if (belief[o] != Occupancy::free) continue;
    bool found = false;
    for (int code = 0; code < (Dim == 2 ? 9 : 27); ++code) {
      Index<Dim> step;
      for (int axis = 0, rest = code; axis < Dim; ++axis, rest /= 3) step[axis] = rest % 3 - 1;
      const int length = step.cwiseAbs().sum();
      if (length == 0 || (length > 1 && !across_corners)) continue;
      const Index<Dim> neighbor = belief.index_at(o) + step;
      found = found || (belief.value(neighbor) == Occupancy::unknown &&
                        !(ignore_near_walls && near_occupied(neighbor)));
    }
    if (found) frontier.push_back(belief.index_at(o));
  }
  return frontier;
}

template <int Dim>
void check_against_definition(const Index<Dim>& extent, int trials) {
  Random random(Dim);
  std::size_t found = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const auto belief =
        random_belief<Dim>(random, extent, random.uniform(0.0, 0.6), random.uniform(0.0, 0.1));
    for (const bool ignore : {true, false}) {
      for (const bool across_corners : {false, true}) {
        FrontierParams params;
        params.ignore_unknown_near_walls = ignore;
        params.unknown_adjacency = across_corners ? Adjacency::corners : Adjacency::faces;
        const auto frontier = detect_frontier<Dim>(belief, params);
        REQUIRE(frontier == frontier_by_definition<Dim>(belief, ignore, across_corners));
        found += frontier.size();
      }
    }
  }
  REQUIRE(found > 100);
}

OccupancyGrid<2> drawn(const std::vector<const char*>& rows) {
  const int height = static_cast<int>(rows.size());
  OccupancyGrid<2> belief(Lattice<2>(0.1),
                          {Index<2>(0, 0), Index<2>(static_cast<int>(std::string(rows[0]).size()), height)},
                          Occupancy::unknown);
  for (int row = 0; row < height; ++row) {
    for (int x = 0; x < belief.box().upper.x(); ++x) {
      const char drawn_as = rows[static_cast<std::size_t>(row)][x];
      belief.set({x, height - 1 - row}, drawn_as == '#'   ? Occupancy::occupied
                                        : drawn_as == '.' ? Occupancy::free
                                                          : Occupancy::unknown);
    }
  }
  return belief;
}

}  // namespace

TEST_CASE("The frontier is what its definition says", "[frontier]") {
  check_against_definition<2>(Index<2>(17, 13), 60);
  check_against_definition<2>(Index<2>(1, 30), 5);
  check_against_definition<2>(Index<2>(30, 1), 5);
  check_against_definition<3>(Index<3>(6, 5, 7), 20);
}

TEST_CASE("A sliver of unknown along a wall is no frontier, an opening is", "[frontier]") {
  const OccupancyGrid<2> belief = drawn({"##########    #",  //
                                         "#  ..  ...    #",  //
                                         "#.............#",  //
                                         "#.............#",  //
                                         "###############"});
  const auto frontier = detect_frontier<2>(belief);
  REQUIRE(frontier == std::vector<Index<2>>{{11, 2}, {12, 2}});
  FrontierParams all;
  all.ignore_unknown_near_walls = false;
  REQUIRE(detect_frontier<2>(belief, all).size() == 12);
}

TEST_CASE("What is free at the edge of the grid borders on the unknown", "[frontier]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(5, 5), Index<2>(8, 8)}, Occupancy::unknown);
  belief.values().assign(9, Occupancy::free);
  REQUIRE(detect_frontier<2>(belief).size() == 8);
  REQUIRE(detect_frontier<2>(OccupancyGrid<2>(Lattice<2>(0.1))).empty());
}

TEST_CASE("Frontier parameters out of their bounds are refused", "[frontier]") {
  const OccupancyGrid<2> belief(Lattice<2>(0.1));
  FrontierParams params;
  params.length_min_m = -0.1;
  REQUIRE_THROWS_WITH(detect_frontier<2>(belief, params), Catch::Contains("length_min_m is -0.1"));
  params = {};
  params.length_max_m = 0.0;
  REQUIRE_THROWS_AS(detect_frontier<2>(belief, params), std::invalid_argument);
}
