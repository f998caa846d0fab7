#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/traversal.hpp"

using namespace incognita;

namespace {

/// The length in metres of the part of a segment inside of a closed cell enlarged by `margin_m` on each side,
/// or a negative number when they do not meet. Liang and Barsky's clipping, in long double.
template <int Dim>
long double length_inside_m(const Lattice<Dim>& lattice, const Point<Dim>& from_m, const Point<Dim>& to_m,
                            const Index<Dim>& cell, long double margin_m) {
  long double enter = 0.0L;
  long double leave = 1.0L;
  for (int axis = 0; axis < Dim; ++axis) {
    const long double res = lattice.resolution_m();
    const long double low = lattice.origin_m()[axis] + cell[axis] * res - margin_m;
    const long double high = lattice.origin_m()[axis] + (cell[axis] + 1) * res + margin_m;
    const long double at = from_m[axis];
    const long double delta = static_cast<long double>(to_m[axis]) - at;
    if (delta == 0.0L) {
      if (at < low || at > high) return -1.0L;
      continue;
    }
    const long double t0 = (low - at) / delta;
    const long double t1 = (high - at) / delta;
    enter = std::max(enter, std::min(t0, t1));
    leave = std::min(leave, std::max(t0, t1));
  }
  return (leave - enter) * static_cast<long double>((to_m - from_m).norm());
}

template <int Dim>
void check_walk(const Lattice<Dim>& lattice, const Point<Dim>& from_m, const Point<Dim>& to_m,
                bool every_cell) {
  std::vector<Index<Dim>> walk;
  traverse<Dim>(lattice, from_m, to_m, [&](const Index<Dim>& index) { walk.push_back(index); });

  const Index<Dim> first = lattice.index_of(from_m);
  const Index<Dim> last = lattice.index_of(to_m);
  REQUIRE(walk.front() == first);
  REQUIRE(walk.back() == last);
  REQUIRE(walk.size() == 1 + static_cast<std::size_t>((last - first).cwiseAbs().sum()));
  for (std::size_t i = 1; i < walk.size(); ++i) REQUIRE((walk[i] - walk[i - 1]).cwiseAbs().sum() == 1);

  // Enlarged by a rounding, for segments along a border.
  long double covered_m = 0.0L;
  for (const Index<Dim>& cell : walk) {
    const long double inside_m = length_inside_m<Dim>(lattice, from_m, to_m, cell, 1e-9L);
    REQUIRE(inside_m >= 0.0L);
    covered_m += inside_m;
  }
  REQUIRE(covered_m >= static_cast<long double>((to_m - from_m).norm()) * (1.0L - 1e-12L));

  if (!every_cell) return;
  const auto less = [](const Index<Dim>& a, const Index<Dim>& b) {
    return std::lexicographical_compare(a.data(), a.data() + Dim, b.data(), b.data() + Dim);
  };
  const std::set<Index<Dim>, decltype(less)> visited(walk.begin(), walk.end(), less);
  const Index<Dim> lower = first.cwiseMin(last).array() - 1;
  const Index<Dim> upper = first.cwiseMax(last).array() + 1;
  std::vector<Index<Dim>> box{lower};
  for (int axis = 0; axis < Dim; ++axis) {
    const std::size_t count = box.size();
    for (int at = lower[axis] + 1; at <= upper[axis]; ++at) {
      for (std::size_t i = 0; i < count; ++i) {
        box.push_back(box[i]);
        box.back()[axis] = at;
      }
    }
  }
  for (const Index<Dim>& cell : box) {
    // Shrunk a little, so that a segment along a border crosses the interior of neither side.
    if (length_inside_m<Dim>(lattice, from_m, to_m, cell, -1e-10L) > 1e-9L) REQUIRE(visited.count(cell) == 1);
  }
}

/// A coordinate in a small range: any, on a border, or on a centre.
double draw_m(Random& random, double resolution_m, double origin_m) {
  const double cells = random.uniform(-6.0, 6.0);
  switch (random.index(3)) {
    case 0:
      return origin_m + std::floor(cells) * resolution_m;
    case 1:
      return origin_m + (std::floor(cells) + 0.5) * resolution_m;
    default:
      return origin_m + cells * resolution_m;
  }
}

template <int Dim>
void check_random_walks(int trials) {
  Random random(Dim);
  for (int trial = 0; trial < trials; ++trial) {
    const double resolution_m = trial % 3 == 0 ? 0.5 : trial % 3 == 1 ? 0.1 : random.uniform(0.02, 1.0);
    Point<Dim> origin_m = Point<Dim>::Zero();
    if (trial % 2 == 0) {
      for (int axis = 0; axis < Dim; ++axis) origin_m[axis] = random.uniform(-3.0, 3.0);
    }
    const Lattice<Dim> lattice(resolution_m, origin_m);
    Point<Dim> from_m;
    Point<Dim> to_m;
    for (int axis = 0; axis < Dim; ++axis) {
      from_m[axis] = draw_m(random, resolution_m, origin_m[axis]);
      to_m[axis] = draw_m(random, resolution_m, origin_m[axis]);
    }
    switch (random.index(5)) {
      case 0: {  // parallel to an axis
        const int axis = static_cast<int>(random.index(Dim));
        const double at_m = to_m[axis];
        to_m = from_m;
        to_m[axis] = at_m;
        break;
      }
      case 1:  // a diagonal: through corners when it starts on a border
        for (int axis = 0; axis < Dim; ++axis) {
          const double side = random.uniform() < 0.5 ? -1.0 : 1.0;
          to_m[axis] = from_m[axis] + side * 4.0 * resolution_m;
        }
        break;
      case 2:  // tiny
        to_m = from_m + 1e-12 * (to_m - from_m);
        break;
      default:
        break;
    }
    check_walk<Dim>(lattice, from_m, to_m, true);
  }
}

}  // namespace

TEST_CASE("A walk in the plane passes exactly the cells of the segment", "[grid]") {
  check_random_walks<2>(3000);
}

TEST_CASE("A walk in space passes exactly the cells of the segment", "[grid]") { check_random_walks<3>(600); }

TEST_CASE("Long walks far from the origin leave no gap", "[grid]") {
  Random random(8);
  for (int trial = 0; trial < 30; ++trial) {
    const Point<2> origin_m{random.uniform(-900.0, 900.0), random.uniform(-900.0, 900.0)};
    const Point<2> from_m{random.uniform(-900.0, 900.0), random.uniform(-900.0, 900.0)};
    const Point<2> to_m{random.uniform(-900.0, 900.0), random.uniform(-900.0, 900.0)};
    check_walk<2>(Lattice<2>(0.1, origin_m), from_m, to_m, false);
    const Point<3> from3_m{random.uniform(-90.0, 90.0), random.uniform(-90.0, 90.0),
                           random.uniform(-90.0, 90.0)};
    check_walk<3>(Lattice<3>(0.05, 0.1 * from3_m), from3_m, {to_m.x() / 9.0, to_m.y() / 9.0, 7.0}, false);
  }
}

TEST_CASE("A segment within a cell passes that cell alone", "[grid]") {
  int visits = 0;
  traverse<2>(Lattice<2>(1.0), {0.25, 0.25}, {0.25, 0.25}, [&](const Index<2>& index) {
    REQUIRE(index == Index<2>(0, 0));
    ++visits;
  });
  REQUIRE(visits == 1);
}

TEST_CASE("Through a corner the lower axis steps first", "[grid]") {
  std::vector<Index<2>> walk;
  traverse<2>(Lattice<2>(1.0), {0.5, 0.5}, {1.5, 1.5}, [&](const Index<2>& index) { walk.push_back(index); });
  REQUIRE(walk == std::vector<Index<2>>{{0, 0}, {1, 0}, {1, 1}});
}

TEST_CASE("A visit that returns false ends the walk", "[grid]") {
  int visits = 0;
  traverse<2>(Lattice<2>(1.0), {0.5, 0.5}, {9.5, 0.5}, [&](const Index<2>& index) {
    ++visits;
    return index.x() < 3;
  });
  REQUIRE(visits == 4);
}
