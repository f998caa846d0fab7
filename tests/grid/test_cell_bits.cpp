#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/grid/traversal.hpp"

using namespace incognita;

namespace {

constexpr double kCell = 0.1;

/// Segments of all lengths and directions, many of them through corners of the lattice or along its lines.
struct Segment {
  Point<2> from;
  Point<2> to;
};

Segment random_segment(Random& random, int kind) {
  const auto anywhere = [&] { return random.uniform(-12.0, 12.0); };
  const auto on_lines = [&](double m, double per_m) { return std::round(m * per_m) / per_m; };
  Segment segment{{anywhere(), anywhere()}, {anywhere(), anywhere()}};
  if (kind == 1) segment.from = {on_lines(segment.from.x(), 10.0), on_lines(segment.from.y(), 10.0)};
  if (kind == 2) {
    for (Point<2>* end : {&segment.from, &segment.to}) *end = {on_lines(end->x(), 20.0), on_lines(end->y(), 20.0)};
  }
  if (kind == 3) segment.to.x() = segment.from.x();
  if (kind == 4) segment.to.y() = segment.from.y();
  if (kind == 5) {  // diagonals
    const double length_m = anywhere();
    segment.from = {on_lines(segment.from.x(), 10.0), on_lines(segment.from.y(), 10.0)};
    segment.to = segment.from + length_m * Point<2>(1.0, random.uniform() < 0.5 ? 1.0 : -1.0);
  }
  if (kind == 6) segment.to = segment.from + 0.03 * Point<2>(anywhere(), anywhere());
  return segment;
}

bool before(const Index<2>& a, const Index<2>& b) { return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0]; }

/// The cells of a segment that `holds` is true for, as traverse has them.
template <class Holds>
std::vector<Index<2>> expected_cells(const Lattice<2>& lattice, const Segment& segment, Holds&& holds) {
  std::vector<Index<2>> cells;
  traverse<2>(lattice, segment.from, segment.to, [&](const Index<2>& cell) {
    if (holds(cell)) cells.push_back(cell);
  });
  std::sort(cells.begin(), cells.end(), before);
  return cells;
}

}  // namespace

TEST_CASE("Cells keep their bits when the tiles grow", "[grid]") {
  for (const bool fill : {false, true}) {
    CellBits bits(Lattice<2>(kCell), fill);
    bits.grow_to_include({{-3, 5}, {4, 9}});
    REQUIRE(bits.get({-3, 5}) == fill);
    bits.set({-3, 5}, !fill);
    bits.set({3, 8}, !fill);
    bits.grow_to_include({{-300, -40}, {90, 70}});
    for (int x = -20; x < 20; ++x) {
      for (int y = -20; y < 20; ++y) {
        const bool is_changed = (x == -3 && y == 5) || (x == 3 && y == 8);
        REQUIRE(bits.get({x, y}) == (is_changed ? !fill : fill));
      }
    }
    bits.set({3, 8}, fill);
    REQUIRE(bits.get({3, 8}) == fill);
  }
}

TEST_CASE("A walk over set bits meets the cells of traverse, at corners and along lines too", "[grid]") {
  Random random(1);
  for (const double offset_m : {0.0, 0.03}) {
    const Lattice<2> lattice(kCell, {offset_m, -0.5 * offset_m});
    CellBits all(lattice, true);
    all.grow_to_include({{-260, -260}, {260, 260}});
    CellBits some(lattice, false);
    some.grow_to_include({{-260, -260}, {260, 260}});
    for (int n = 0; n < 40000; ++n) {
      some.set({static_cast<int>(random.uniform(-130.0, 130.0)), static_cast<int>(random.uniform(-130.0, 130.0))}, true);
    }
    for (int draw = 0; draw < 40000; ++draw) {
      const Segment segment = random_segment(random, draw % 7);
      for (CellBits* bits : {&all, &some}) {
        std::vector<Index<2>> met;
        traverse_set(lattice, segment.from, segment.to, *bits, [&](const Index<2>& cell) {
          met.push_back(cell);
          return true;
        });
        std::sort(met.begin(), met.end(), before);
        const auto expected = expected_cells(lattice, segment, [&](const Index<2>& cell) { return bits->get(cell); });
        CAPTURE(draw, offset_m, segment.from, segment.to);
        REQUIRE(met == expected);
      }
    }
  }
}

TEST_CASE("A walk clears the bits of cells that the visit lets go", "[grid]") {
  Random random(2);
  const Lattice<2> lattice(kCell);
  CellBits bits(lattice, true);
  bits.grow_to_include({{-260, -260}, {260, 260}});
  CellBits expected = bits;
  const auto is_kept = [](const Index<2>& cell) { return (cell[0] * 7 + cell[1] * 3) % 5 != 0; };
  for (int draw = 0; draw < 300; ++draw) {
    const Segment segment = random_segment(random, draw % 7);
    traverse<2>(lattice, segment.from, segment.to, [&](const Index<2>& cell) {
      if (!is_kept(cell)) expected.set(cell, false);
    });
    traverse_set(lattice, segment.from, segment.to, bits, is_kept);
  }
  REQUIRE(bits.tiles().values() == expected.tiles().values());
}

TEST_CASE("A walk of many thousand cells is exact too", "[grid]") {
  Random random(3);
  const Lattice<2> lattice(0.01);
  struct {
    [[nodiscard]] CellBits::Word word(const Index<2>&) const { return ~CellBits::Word{0}; }
    void clear(const Index<2>&, CellBits::Word) {}
  } everywhere;
  for (int draw = 0; draw < 20; ++draw) {
    const Segment segment{{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)},
                          {random.uniform(-100.0, 100.0), random.uniform(-100.0, 100.0)}};
    const Segment moved{segment.from, segment.from + segment.to};
    std::vector<Index<2>> met;
    traverse_set(lattice, moved.from, moved.to, everywhere, [&](const Index<2>& cell) {
      met.push_back(cell);
      return true;
    });
    std::sort(met.begin(), met.end(), before);
    REQUIRE(met == expected_cells(lattice, moved, [](const Index<2>&) { return true; }));
  }
}
