#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <numeric>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/components.hpp"

using namespace incognita;

namespace {

template <int Dim>
Grid<std::uint8_t, Dim> random_grid(Random& random, const Index<Dim>& extent, double share) {
  const Index<Dim> lower = Index<Dim>::Constant(-3);
  Grid<std::uint8_t, Dim> grid(Lattice<Dim>(0.1), {lower, lower + extent});
  for (std::uint8_t& value : grid.values()) value = random.uniform() < share ? 1 : 0;
  return grid;
}

bool touch(const auto& a, const auto& b, Adjacency adjacency) {
  const auto difference = (a - b).cwiseAbs().eval();
  return adjacency == Adjacency::faces ? difference.sum() == 1 : difference.maxCoeff() == 1;
}

/// Labels by merging the sets of all pairs of cells that touch.
template <int Dim>
void check_against_pairs(const Grid<std::uint8_t, Dim>& grid, Adjacency adjacency) {
  const auto components = connected_components(grid, adjacency, [](std::uint8_t v) { return v != 0; });
  const std::size_t n = grid.size();
  std::vector<std::size_t> set(n);
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (bool merged = true; merged;) {
    merged = false;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (grid.values()[a] == 0 || grid.values()[b] == 0 || set[a] == set[b]) continue;
        if (!touch(grid.index_at(static_cast<Offset>(a)), grid.index_at(static_cast<Offset>(b)), adjacency))
          continue;
        set[a] = set[b] = std::min(set[a], set[b]);
        merged = true;
      }
    }
  }
  std::int32_t next = 0;
  std::vector<std::size_t> count(components.sizes.size(), 0);
  for (std::size_t a = 0; a < n; ++a) {
    const std::int32_t label = components.labels.values()[a];
    if (grid.values()[a] == 0) {
      REQUIRE(label == Components<Dim>::none);
      continue;
    }
    if (set[a] == a) REQUIRE(label == next++);  // labels follow the first cells in storage order
    REQUIRE(label == components.labels.values()[set[a]]);
    ++count[static_cast<std::size_t>(label)];
  }
  REQUIRE(count == components.sizes);
}

}  // namespace

TEST_CASE("A cell has 4, 8, 6 and 26 neighbours", "[grid]") {
  REQUIRE(neighbor_steps<2>(Adjacency::faces).size() == 4);
  REQUIRE(neighbor_steps<2>(Adjacency::corners).size() == 8);
  REQUIRE(neighbor_steps<3>(Adjacency::faces).size() == 6);
  REQUIRE(neighbor_steps<3>(Adjacency::corners).size() == 26);
  REQUIRE(neighbor_steps<2>(Adjacency::corners).front() == Index<2>(-1, -1));
  REQUIRE(neighbor_steps<2>(Adjacency::corners).back() == Index<2>(1, 1));
}

TEST_CASE("Components equal the merged sets of touching pairs", "[grid]") {
  Random random(4);
  for (const Adjacency adjacency : {Adjacency::faces, Adjacency::corners}) {
    for (const double share : {0.0, 0.3, 0.5, 1.0}) {
      check_against_pairs<2>(random_grid<2>(random, Index<2>(9, 7), share), adjacency);
      check_against_pairs<3>(random_grid<3>(random, Index<3>(4, 3, 5), share), adjacency);
    }
  }
}

TEST_CASE("The largest component is the first of the largest", "[grid]") {
  Grid<std::uint8_t, 2> grid(Lattice<2>(1.0), {Index<2>(0, 0), Index<2>(9, 1)});
  for (const int x : {0, 2, 3, 5, 6, 8}) grid.set({x, 0}, 1);
  const auto components = connected_components(grid, Adjacency::faces, [](std::uint8_t v) { return v != 0; });
  REQUIRE(components.sizes == std::vector<std::size_t>{1, 2, 2, 1});
  REQUIRE(components.largest() == 1);
  REQUIRE(Components<2>{Grid<std::int32_t, 2>(Lattice<2>(1.0)), {}}.largest() == Components<2>::none);
}

TEST_CASE("A flood fills exactly its seed's component", "[grid]") {
  Random random(5);
  const auto is_one = [](std::uint8_t v) { return v != 0; };
  const Grid<std::uint8_t, 2> grid = random_grid<2>(random, Index<2>(30, 20), 0.55);
  const auto components = connected_components(grid, Adjacency::faces, is_one);
  for (Offset seed = 0; seed < static_cast<Offset>(grid.size()); seed += 7) {
    const auto reached = flood_fill(grid, grid.index_at(seed), Adjacency::faces, is_one);
    for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
      const bool together = grid[seed] != 0 && components.labels[offset] == components.labels[seed];
      REQUIRE((reached[offset] != 0) == together);
    }
  }
  const auto outside = flood_fill(grid, Index<2>(1000, 0), Adjacency::faces, is_one);
  REQUIRE(std::accumulate(outside.values().begin(), outside.values().end(), 0) == 0);
}
