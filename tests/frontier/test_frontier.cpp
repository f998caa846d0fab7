#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/frontier/frontier.hpp"

using namespace incognita;

namespace {

FrontierParams params_of(double length_min_m, double length_max_m) {
  FrontierParams params;
  params.length_min_m = length_min_m;
  params.length_max_m = length_max_m;
  return params;
}

template <int Dim>
std::vector<Index<Dim>> random_cells(Random& random, const Index<Dim>& extent, double share,
                                     Grid<std::uint8_t, Dim>& marks) {
  marks = Grid<std::uint8_t, Dim>(Lattice<Dim>(0.1), {Index<Dim>::Constant(-5), extent});
  std::vector<Index<Dim>> cells;
  for (Offset o = 0; o < static_cast<Offset>(marks.size()); ++o) {
    if (random.uniform() >= share) continue;
    marks[o] = 1;
    cells.push_back(marks.index_at(o));
  }
  return cells;
}

template <int Dim>
void check_groups(const Index<Dim>& extent, double share, Adjacency adjacency = Adjacency::corners) {
  Random random(Dim);
  FrontierParams params = params_of(0.3, 1000.0);
  params.group_adjacency = adjacency;
  for (int trial = 0; trial < 10; ++trial) {
    Grid<std::uint8_t, Dim> marks{Lattice<Dim>(0.1)};
    const auto cells = random_cells<Dim>(random, extent, share, marks);
    const auto components =
        connected_components(marks, adjacency, [](std::uint8_t m) { return m != 0; });
    const auto frontiers = cluster_frontier<Dim>(marks.lattice(), cells, params);
    std::size_t group = 0;
    for (std::size_t label = 0; label < components.sizes.size(); ++label) {
      if (components.sizes[label] < 3) continue;
      const Frontier<Dim>& frontier = frontiers.at(group++);
      REQUIRE(frontier.cells.size() == components.sizes[label]);
      Point<Dim> centroid_m = Point<Dim>::Zero();
      Offset before = -1;
      for (const Index<Dim>& cell : frontier.cells) {
        const Offset offset = marks.offset_of(cell);
        REQUIRE(components.labels[offset] == static_cast<std::int32_t>(label));
        REQUIRE(offset > before);
        before = offset;
        centroid_m += marks.lattice().center_m(cell) / static_cast<double>(frontier.cells.size());
      }
      REQUIRE((frontier.centroid_m - centroid_m).norm() < 1e-9);
      REQUIRE(std::count(frontier.cells.begin(), frontier.cells.end(), frontier.representative) == 1);
      for (const Index<Dim>& cell : frontier.cells) {
        REQUIRE((marks.lattice().center_m(cell) - centroid_m).norm() >=
                (marks.lattice().center_m(frontier.representative) - centroid_m).norm() - 1e-9);
      }
    }
    REQUIRE(group == frontiers.size());
  }
}

}  // namespace

TEST_CASE("Groups are the connected components that are long enough", "[frontier]") {
  check_groups<2>(Index<2>(20, 15), 0.25);
  check_groups<3>(Index<3>(4, 3, 5), 0.06);
  check_groups<2>(Index<2>(20, 15), 0.5, Adjacency::faces);
  check_groups<3>(Index<3>(4, 3, 5), 0.2, Adjacency::faces);
}

TEST_CASE("A long straight frontier is split evenly along itself", "[frontier]") {
  for (const Index<2>& step : {Index<2>(1, 0), Index<2>(0, 1), Index<2>(1, 1), Index<2>(-1, 1)}) {
    std::vector<Index<2>> cells;
    for (int i = 0; i < 90; ++i) cells.emplace_back(i * step);
    std::sort(cells.begin(), cells.end(), [](const Index<2>& a, const Index<2>& b) {
      return a.y() != b.y() ? a.y() < b.y() : a.x() < b.x();
    });
    const double step_m = 0.1 * step.cast<double>().norm();
    const auto frontiers = cluster_frontier<2>(Lattice<2>(0.1), cells, params_of(0.3, 30.1 * step_m));
    REQUIRE(frontiers.size() == 3);
    for (const Frontier<2>& frontier : frontiers) {
      REQUIRE(frontier.cells.size() == 30);
      REQUIRE((frontier.cells.back() - frontier.cells.front()).cwiseAbs().maxCoeff() == 29);
    }
  }
}

TEST_CASE("No part of a split frontier is longer than asked, and none of its cells is lost", "[frontier]") {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    // A wandering band.
    Grid<std::uint8_t, 2> marks(Lattice<2>(0.1), {Index<2>(-400, -400), Index<2>(400, 400)});
    Index<2> at(0, 0);
    for (int i = 0; i < 300; ++i) {
      marks.set(at, 1);
      at += Index<2>(1, static_cast<int>(random.index(3)) - 1);
    }
    std::vector<Index<2>> cells;
    for (Offset o = 0; o < static_cast<Offset>(marks.size()); ++o) {
      if (marks[o] != 0) cells.push_back(marks.index_at(o));
    }
    const auto frontiers = cluster_frontier<2>(marks.lattice(), cells, params_of(0.3, 3.0));
    REQUIRE(frontiers.size() >= 10);
    std::size_t total = 0;
    for (const Frontier<2>& frontier : frontiers) {
      total += frontier.cells.size();
      for (const Index<2>& cell : frontier.cells) {
        marks.set(cell, static_cast<std::uint8_t>(marks.value(cell) + 1));
        REQUIRE(marks.value(cell) == 2);  // in one part only
      }
      // The walk runs along x, so its principal axis leans by less than 45 degrees.
      const auto [low, high] =
          std::minmax_element(frontier.cells.begin(), frontier.cells.end(),
                              [](const auto& a, const auto& b) { return a.x() < b.x(); });
      REQUIRE(high->x() - low->x() <= 45);
    }
    REQUIRE(total == cells.size());
  }
}

TEST_CASE("A ring is split into arcs that each touch in themselves", "[frontier]") {
  std::vector<Index<2>> cells;
  for (int y = -100; y <= 100; ++y) {
    for (int x = -100; x <= 100; ++x) {
      if (std::abs(std::hypot(x, y) - 95.0) < 0.75) cells.emplace_back(x, y);
    }
  }
  const auto frontiers = cluster_frontier<2>(Lattice<2>(0.1), cells, params_of(0.3, 3.0));
  std::size_t total = 0;
  for (const Frontier<2>& frontier : frontiers) {
    total += frontier.cells.size();
    for (const Index<2>& a : frontier.cells) {
      REQUIRE((Lattice<2>(0.1).center_m(a) - frontier.centroid_m).norm() < 2.0);
    }
    // The middle of an arc lies on the ring, but for its sag.
    REQUIRE(frontier.centroid_m.norm() > 9.2);
  }
  REQUIRE(total == cells.size());
  REQUIRE(frontiers.size() >= 20);
  REQUIRE(frontiers.size() <= 60);
}

TEST_CASE("Finding frontiers is detecting and grouping", "[frontier]") {
  OccupancyGrid<2> belief(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(60, 20)}, Occupancy::unknown);
  for (int y = 5; y < 15; ++y) {
    for (int x = 5; x < 25; ++x) belief.set({x, y}, Occupancy::free);
  }
  belief.set({40, 10}, Occupancy::free);  // too small to matter
  const auto frontiers = find_frontiers<2>(belief);
  REQUIRE(frontiers.size() == 1);
  REQUIRE(frontiers[0].cells == [&] {
    auto cells = detect_frontier<2>(belief);
    cells.erase(std::find(cells.begin(), cells.end(), Index<2>(40, 10)));
    return cells;
  }());
  REQUIRE(cluster_frontier<2>(belief.lattice(), {}).empty());
}
