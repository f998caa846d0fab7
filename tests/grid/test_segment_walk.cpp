#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/segment_walk.hpp"
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

void append_cells(std::vector<Index<2>>& to, const Index<2>& tile, CellBits::Word cells) {
  for (CellBits::Word left = cells; left != 0; left &= left - 1U) {
    to.push_back(CellBits::cell_of(tile, std::countr_zero(left)));
  }
}

/// The cells of a segment that are set, as the walk has them; sorted.
std::vector<Index<2>> walked_cells(const CellBits& bits, const Lattice<2>& lattice, const Segment& segment) {
  std::vector<Index<2>> cells;
  const Point<2> from = lattice.to_cells(segment.from);
  const Point<2> to = lattice.to_cells(segment.to);
  visit_set(bits, SegmentWalk(from, to, true), from, to, [&](const SegmentWalk::TileCells& tile) {
    append_cells(cells, tile.tile, tile.cells);
    return true;
  });
  std::sort(cells.begin(), cells.end(), before);
  return cells;
}

}  // namespace

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
        const auto met = walked_cells(*bits, lattice, segment);
        const auto expected = expected_cells(lattice, segment, [&](const Index<2>& cell) { return bits->get(cell); });
        CAPTURE(draw, offset_m, segment.from, segment.to);
        REQUIRE(met == expected);
      }
    }
  }
}

TEST_CASE("Of a segment's cells a walk tells the first that is set, and those before it, as traverse meets them", "[grid]") {
  Random random(4);
  const Lattice<2> lattice(kCell, {0.03, -0.015});
  const IndexBox<2> box{{-260, -260}, {260, 260}};
  CellBits all(lattice, true);
  all.grow_to_include(box);
  CellBits bits(lattice, false);
  bits.grow_to_include(box);
  for (int n = 0; n < 3000; ++n) {
    bits.set({static_cast<int>(random.uniform(-130.0, 130.0)), static_cast<int>(random.uniform(-130.0, 130.0))}, true);
  }
  int met = 0;
  for (int draw = 0; draw < 60000; ++draw) {
    const Segment segment = random_segment(random, draw % 7);
    std::optional<Index<2>> expected;
    std::vector<Index<2>> expected_before;
    traverse<2>(lattice, segment.from, segment.to, [&](const Index<2>& cell) {
      bits.get(cell) ? static_cast<void>(expected = cell) : expected_before.push_back(cell);
      return !expected;
    });
    std::sort(expected_before.begin(), expected_before.end(), before);

    const Point<2> from = lattice.to_cells(segment.from);
    const Point<2> to = lattice.to_cells(segment.to);
    const SegmentWalk walk(from, to, true);
    std::optional<Index<2>> first;
    std::vector<Index<2>> cells_before;
    visit_set(all, walk, from, to, [&](const SegmentWalk::TileCells& passed) {
      SegmentWalk::TileCells set = passed;
      set.cells &= bits.tiles()[passed.place];
      if (set.cells != 0) first = walk.first_of(set);
      append_cells(cells_before, passed.tile, first ? walk.cells_before(passed, *first) : passed.cells);
      return !first;
    });
    std::sort(cells_before.begin(), cells_before.end(), before);
    CAPTURE(draw, segment.from, segment.to);
    REQUIRE(first == expected);
    REQUIRE(cells_before == expected_before);
    met += static_cast<int>(first.has_value());
  }
  REQUIRE(met > 10000);
  REQUIRE(met < 50000);
}

TEST_CASE("Segments of many thousand cells are walked exactly", "[grid]") {
  Random random(5);
  const Lattice<2> lattice(0.01);
  for (int draw = 0; draw < 20; ++draw) {
    const Point<2> from{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)};
    const Segment segment{from, from + Point<2>(random.uniform(-60.0, 60.0), random.uniform(-60.0, 60.0))};
    CellBits all(lattice, true);
    Box<Point<2>> box{segment.from, segment.from};
    box.stretch_to(segment.to);
    all.grow_to_include(lattice.cells_of(box).padded(1));
    REQUIRE(walked_cells(all, lattice, segment) == expected_cells(lattice, segment, [](const Index<2>&) { return true; }));
  }
}
