#include <catch2/catch.hpp>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/grid.hpp"

using namespace incognita;

namespace {

template <int Dim>
Index<Dim> random_index(Random& random, int radius) {
  Index<Dim> index;
  for (int axis = 0; axis < Dim; ++axis) {
    index[axis] = static_cast<int>(random.index(static_cast<std::uint64_t>(2 * radius + 1))) - radius;
  }
  return index;
}

template <int Dim>
IndexBox<Dim> one_cell(const Index<Dim>& index) {
  return {index, (index.array() + 1).matrix()};
}

template <int Dim>
void check_growth_keeps_values() {
  Random random(Dim);
  Grid<int, Dim> grid(Lattice<Dim>(0.1), {}, -7);
  std::vector<std::pair<Index<Dim>, int>> written;
  for (int radius = 1; radius < 30; ++radius) {
    const Index<Dim> index = random_index<Dim>(random, radius);
    grid.grow_to_include(one_cell<Dim>(index));
    REQUIRE(grid.contains(index));
    for (auto& entry : written) {
      if (entry.first == index) entry.second = radius;
    }
    written.emplace_back(index, radius);
    grid.set(index, radius);
    for (const auto& entry : written) REQUIRE(grid.value(entry.first) == entry.second);
    std::size_t filled = 0;
    bool inverse = true;
    for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
      inverse = inverse && grid.offset_of(grid.index_at(offset)) == offset;
      filled += grid[offset] == -7 ? 1U : 0U;
    }
    REQUIRE(inverse);
    REQUIRE(filled >= grid.size() - written.size());
  }
}

}  // namespace

TEST_CASE("Growth keeps every value at its index and fills the rest", "[grid]") {
  check_growth_keeps_values<2>();
  check_growth_keeps_values<3>();
}

TEST_CASE("Storage runs along x first", "[grid]") {
  Grid<int, 3> grid(Lattice<3>(1.0), {Index<3>(-1, 5, 2), Index<3>(3, 8, 4)});
  REQUIRE(grid.size() == 24);
  REQUIRE(grid.stride(0) == 1);
  REQUIRE(grid.stride(1) == 4);
  REQUIRE(grid.stride(2) == 12);
  REQUIRE(grid.offset_of({0, 6, 3}) == 1 + 4 + 12);
  REQUIRE(grid.index_at(17) == Index<3>(0, 6, 3));
}

TEST_CASE("A robot that leaves the grid step by step rarely moves the storage", "[grid]") {
  for (const Index<2>& heading : {Index<2>(1, 0), Index<2>(-1, 0), Index<2>(0, 1), Index<2>(-1, 1)}) {
    Grid<std::uint8_t, 2> grid(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(1, 1)});
    int moves = 0;
    for (int step = 0; step < 1000; ++step) {
      moves += grid.grow_to_include(one_cell<2>(heading * step)) ? 1 : 0;
    }
    // Each move makes a side 1.5 times as long, after the first few cells.
    REQUIRE(moves <= 20);
    REQUIRE(moves >= 10);
    REQUIRE_FALSE(grid.grow_to_include(one_cell<2>(heading * 500)));
  }
}

TEST_CASE("Outside of its box a grid reads its fill value and refuses to be written", "[grid]") {
  Grid<int, 2> grid(Lattice<2>(1.0), {Index<2>(0, 0), Index<2>(2, 2)}, 4);
  REQUIRE(grid.value({-1, 0}) == 4);
  REQUIRE_THROWS_AS(grid.set({2, 0}, 1), std::out_of_range);
  REQUIRE_THROWS_WITH(grid.set({2, 0}, 1), Catch::Contains("the index is (2, 0), but must lie in the grid's box, (0, 0) to "));
  Grid<int, 2> empty(Lattice<2>(1.0), {}, 3);
  REQUIRE(empty.size() == 0);
  REQUIRE(empty.value({0, 0}) == 3);
  REQUIRE_FALSE(empty.grow_to_include({}));
}

TEST_CASE("A box that is empty on one axis holds nothing", "[grid]") {
  const Grid<int, 2> grid(Lattice<2>(1.0), {Index<2>(5, 0), Index<2>(3, 10)});
  REQUIRE(grid.size() == 0);
  REQUIRE(grid.box().empty());
}

TEST_CASE("A wild index is refused and leaves the grid as it was", "[grid]") {
  constexpr int highest = std::numeric_limits<int>::max();
  constexpr int lowest = std::numeric_limits<int>::min();
  Grid<int, 2> grid(Lattice<2>(1.0), {Index<2>(-2, -2), Index<2>(3, 3)}, 0);
  grid.set({1, -2}, 9);
  const std::vector<IndexBox<2>> wild{{{0, 0}, {highest, highest}},
                                      {{lowest, 0}, {lowest + 1, 1}},
                                      {{lowest, lowest}, {highest, highest}},
                                      {{0, highest - 1}, {1, highest}}};
  for (const IndexBox<2>& needed : wild) {
    REQUIRE_THROWS_AS(grid.grow_to_include(needed), std::length_error);
    REQUIRE(grid.size() == 25);
    REQUIRE(grid.box().lower == Index<2>(-2, -2));
    REQUIRE(grid.value({1, -2}) == 9);
  }
  REQUIRE_THROWS_AS((Grid<std::uint8_t, 2>(Lattice<2>(1.0), {Index<2>(lowest, 0), Index<2>(highest, 1)})),
                    std::length_error);
}

TEST_CASE("A grid grows at the ends of the range of indices", "[grid]") {
  constexpr int highest = std::numeric_limits<int>::max();
  constexpr int lowest = std::numeric_limits<int>::min();
  Grid<int, 2> grid(Lattice<2>(1.0),
                    {Index<2>(highest - 20, lowest + 5), Index<2>(highest - 5, lowest + 20)});
  grid.set({highest - 6, lowest + 5}, 1);
  REQUIRE(grid.grow_to_include({Index<2>(highest - 1, lowest), Index<2>(highest, lowest + 1)}));
  REQUIRE(grid.contains({highest - 1, lowest}));
  REQUIRE(grid.value({highest - 6, lowest + 5}) == 1);
}
