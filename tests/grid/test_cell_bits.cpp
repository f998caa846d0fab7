#include <bit>
#include <catch2/catch.hpp>

#include "incognita/grid/cell_bits.hpp"

using namespace incognita;

TEST_CASE("Cells keep their bits when the tiles grow", "[grid]") {
  for (const bool fill : {false, true}) {
    CellBits bits(Lattice<2>(0.1), fill);
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
    REQUIRE(bits.get({100000, -100000}) == fill);  // there is no room, and no need
  }
}

TEST_CASE("A cell is found again by its tile and its bit", "[grid]") {
  for (int x = -17; x < 17; ++x) {
    for (int y = -17; y < 17; ++y) {
      const Index<2> cell(x, y);
      REQUIRE(std::popcount(CellBits::mask_of(cell)) == 1);
      REQUIRE(equal(CellBits::cell_of(CellBits::tile_of(cell), std::countr_zero(CellBits::mask_of(cell))), cell));
    }
  }
}
