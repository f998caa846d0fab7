#include <catch2/catch.hpp>

#include "incognita/core/random.hpp"
#include "incognita/geometry/box.hpp"

using namespace incognita;

namespace {

using CellBox = Box<Eigen::Vector2i>;

CellBox random_box(Random& random) {
  const auto draw = [&] { return static_cast<int>(random.index(7)) - 3; };
  return {{draw(), draw()}, {draw(), draw()}};
}

}  // namespace

TEST_CASE("A box holds its lower corner and not its upper one", "[geometry]") {
  const Box<Eigen::Vector2d> box{{0.0, -1.0}, {2.0, 1.0}};
  REQUIRE(box.contains(Eigen::Vector2d(0.0, -1.0)));
  REQUIRE_FALSE(box.contains(Eigen::Vector2d(2.0, 0.0)));
  REQUIRE_FALSE(box.contains(Eigen::Vector2d(0.0, 1.0)));
  REQUIRE(box.extent() == Eigen::Vector2d(2.0, 2.0));
  REQUIRE(CellBox{}.empty());
  REQUIRE(CellBox{{0, 0}, {5, 0}}.empty());
}

TEST_CASE("Containment and enclosing boxes agree with the sets of cells", "[geometry]") {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const CellBox a = random_box(random);
    const CellBox b = random_box(random);
    const CellBox both = enclosing_box(a, b);
    bool b_in_a = true;
    bool any = false;
    for (int x = -4; x <= 4; ++x) {
      for (int y = -4; y <= 4; ++y) {
        const Eigen::Vector2i cell(x, y);
        if (b.contains(cell) && !a.contains(cell)) b_in_a = false;
        if (a.contains(cell) || b.contains(cell)) {
          any = true;
          REQUIRE(both.contains(cell));
        }
      }
    }
    REQUIRE(a.contains(b) == b_in_a);
    REQUIRE(both.empty() == !any);
    REQUIRE(both.contains(a));
    REQUIRE(both.contains(b));
    // Smallest: each side is a side of one of the two.
    for (int axis = 0; any && axis < 2; ++axis) {
      const auto touches = [&](const CellBox& box, auto corner) {
        return !box.empty() && corner(box)[axis] == corner(both)[axis];
      };
      const auto lower = [](const CellBox& box) { return box.lower; };
      const auto upper = [](const CellBox& box) { return box.upper; };
      REQUIRE((touches(a, lower) || touches(b, lower)));
      REQUIRE((touches(a, upper) || touches(b, upper)));
    }
  }
}
