#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "incognita/io/kth_doors.hpp"
#include "kth_text.hpp"

using namespace incognita;

namespace {

/// The passage from the portal of the first space that has one.
std::optional<detail::Polygon> first_passage(const io_test::KthText& text) {
  const KthFloor floor = parse_kth_floor(text.text(), "x");
  const detail::KthDoors doors(floor);
  for (const KthSegment& segment : floor.spaces[0].contours[0]) {
    if (segment.type == KthSegmentType::portal) return doors.passage(floor.spaces[0], segment);
  }
  return std::nullopt;
}

void check_corners(const std::optional<detail::Polygon>& passage, const detail::Polygon& expected) {
  REQUIRE(passage.has_value());
  REQUIRE(passage->size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(((*passage)[i] - expected[i]).norm() < 1e-12);
}

}  // namespace

TEST_CASE("a passage leads to the portal that leads back") {
  check_corners(first_passage(io_test::two_rooms(io_test::KthText(), 0.2)),
                {{4, 1.1}, {4, 1.9}, {4.2, 1.9}, {4.2, 1.1}});
  check_corners(first_passage(io_test::two_rooms(io_test::KthText(), 0.0)),
                {{4, 1.1}, {4, 1.9}, {4, 1.9}, {4, 1.1}});
  CHECK_FALSE(first_passage(io_test::two_rooms(io_test::KthText(), 2.5)).has_value());
}

TEST_CASE("a passage does not cross itself, whichever way the other portal runs") {
  io_test::KthText text;
  text.space("left", {{0, 0}, {4, 0}, {4, 1, "right"}, {4, 2}, {4, 3}, {0, 3}});
  text.space("right", {{5, 3}, {9, 3}, {9, 0}, {5, 0}, {5, 1, "left"}, {5, 2}});
  check_corners(first_passage(text), {{4, 1}, {4, 2}, {5, 2}, {5, 1}});
}

TEST_CASE("of two portals that lead back, the nearest counts") {
  for (const double low_m : {1.0, 2.1}) {
    io_test::KthText text;
    text.space("left", {{0, 0}, {4, 0}, {4, low_m, "right"}, {4, low_m + 0.8}, {4, 3}, {0, 3}});
    text.space(
        "right",
        {{4.2, 0}, {9, 0}, {9, 3}, {4.2, 3}, {4.2, 2.9, "left"}, {4.2, 2.2}, {4.2, 1.9, "left"}, {4.2, 1.2}});
    const double other_m = low_m < 2.0 ? 1.2 : 2.2;
    check_corners(first_passage(text), {{4, low_m}, {4, low_m + 0.8}, {4.2, other_m + 0.7}, {4.2, other_m}});
  }
}

TEST_CASE("without a portal that leads back, the passage goes straight to the room behind") {
  check_corners(first_passage(io_test::two_rooms(io_test::KthText(), 0.3, "right", "Wall")),
                {{4, 1.1}, {4, 1.9}, {4.3, 1.9}, {4.3, 1.1}});
  CHECK_FALSE(first_passage(io_test::two_rooms(io_test::KthText(), 2.1, "right", "Wall")).has_value());
  // A booth in the midst of the hall that its door leads to.
  io_test::KthText text;
  text.space("booth", {{4, 4}, {6, 4}, {6, 4.5, "hall"}, {6, 5.5}, {6, 6}, {4, 6}});
  text.space("hall", {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  check_corners(first_passage(text), {{6, 4.5}, {6, 5.5}, {6, 5.5}, {6, 4.5}});
}

TEST_CASE("a portal to nowhere, or to its own room, has no passage") {
  CHECK_FALSE(first_passage(io_test::two_rooms(io_test::KthText(), 0.2, "stairs", "Wall")).has_value());
  CHECK_FALSE(first_passage(io_test::two_rooms(io_test::KthText(), 0.2, "left", "Wall")).has_value());
}

TEST_CASE("a point inside of a space") {
  const KthFloor floor = parse_kth_floor(io_test::two_rooms(io_test::KthText(), 0.2).text(), "x");
  CHECK(detail::contains(floor.spaces[0], {1, 1}));
  CHECK_FALSE(detail::contains(floor.spaces[0], {5, 1}));
  CHECK_FALSE(detail::contains(floor.spaces[0], {1, -1}));
  CHECK(detail::contains(floor.spaces[1], {5, 1}));
}
