#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/components.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/io/kth_xml.hpp"
#include "kth_text.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::KthText;
using io_test::refusal;
using io_test::two_rooms;

namespace {

const auto is_floor = [](FloorCell cell) { return cell == FloorCell::floor; };

FloorPlan plan_of(const KthText& text, double pixel_size_m = 0.05) {
  return read_kth_xml_text(text.text(), "x", {.pixel_size_m = pixel_size_m});
}

std::string plan_refusal(const KthText& text, double pixel_size_m = 0.05) {
  return refusal([&] { return plan_of(text, pixel_size_m); });
}

double floor_area_m2(const FloorPlan& plan) {
  return static_cast<double>(std::count_if(plan.values().begin(), plan.values().end(), is_floor)) *
         plan.resolution_m() * plan.resolution_m();
}

/// How many pieces of floor there are when even steps through corners count.
std::size_t pieces(const FloorPlan& plan) {
  return connected_components(plan, Adjacency::corners, is_floor).sizes.size();
}

/// No floor touches solid cells or the border of the plan: there is a wall all around it.
bool floor_is_enclosed(const FloorPlan& plan) {
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (plan[cell] != FloorCell::floor) continue;
    for (const Index<2>& step : neighbor_steps<2>(Adjacency::faces)) {
      if (plan.value(plan.index_at(cell) + step) == FloorCell::solid) return false;
    }
  }
  return true;
}

FloorCell at(const FloorPlan& plan, double x_m, double y_m) {
  return plan.value(plan.lattice().index_of({x_m, y_m}));
}

/// The floor cells from (x, y_low) to (x, y_high), in metres.
double open_width_m(const FloorPlan& plan, double x_m, double y_low_m, double y_high_m) {
  double width_m = 0.0;
  const Index<2> low = plan.lattice().index_of({x_m, y_low_m});
  const Index<2> high = plan.lattice().index_of({x_m, y_high_m});
  for (Index<2> cell = low; cell.y() <= high.y(); ++cell.y())
    width_m += is_floor(plan.value(cell)) ? plan.resolution_m() : 0.0;
  return width_m;
}

}  // namespace

TEST_CASE("KTH raster: two rooms, a wall and an open door") {
  const FloorPlan plan = plan_of(two_rooms(KthText(), 0.2));
  CHECK(pieces(plan) == 1);
  CHECK(floor_is_enclosed(plan));
  CHECK(at(plan, 2, 1.5) == FloorCell::floor);
  CHECK(at(plan, 6, 1.5) == FloorCell::floor);
  CHECK(at(plan, 4.1, 1.5) == FloorCell::floor);
  CHECK(at(plan, 4.1, 0.5) == FloorCell::solid);  // within the wall
  CHECK(at(plan, 4.0, 0.5) == FloorCell::wall);
  CHECK(at(plan, 4.2, 0.5) == FloorCell::wall);
  CHECK(at(plan, 4.1, 1.1) == FloorCell::wall);  // the sides of the door
  CHECK(at(plan, 4.1, 1.9) == FloorCell::wall);
  CHECK(at(plan, 2, 3.0) == FloorCell::wall);  // a window
  CHECK(at(plan, -0.2, 1.0) == FloorCell::solid);
  CHECK(at(plan, -50.0, 1.0) == FloorCell::solid);
  // A wall takes half a pixel of each side.
  for (const double x_m : {4.0, 4.05, 4.1, 4.15, 4.2})
    CHECK(open_width_m(plan, x_m, 0.5, 2.5) == Approx(0.75));
  CHECK(floor_area_m2(plan) == Approx(2 * 3.95 * 2.95 + 0.25 * 0.75));
}

TEST_CASE("KTH raster: doors stay open and walls closed at any angle and wall thickness") {
  Random random(11);
  for (int i = 0; i < 60; ++i) {
    const KthText frame(random.uniform(-3.14, 3.14), random.uniform(-1000, 1000),
                        random.uniform(-1000, 1000));
    const double wall_m = i % 3 == 0 ? 0.0 : random.uniform(0.01, 0.5);
    CAPTURE(i, wall_m);
    const FloorPlan open = plan_of(two_rooms(frame, wall_m));
    CHECK(pieces(open) == 1);
    CHECK(floor_is_enclosed(open));
    CHECK(std::abs(floor_area_m2(open) - (24.0 + 0.8 * wall_m)) < 0.05 * 30.0);
    // A disc of 0.3 m fits through the door of 0.8 m.
    const auto clearance_m =
        distance_transform_m(open, [](FloorCell cell) { return cell != FloorCell::floor; });
    CHECK(connected_components(clearance_m, Adjacency::faces, [](float m) {
            return m > 0.3F;
          }).sizes.size() == 1);

    const FloorPlan closed = plan_of(two_rooms(frame, wall_m, "Wall", "Wall"));
    CHECK(pieces(closed) == 2);
    CHECK(floor_is_enclosed(closed));
  }
}

TEST_CASE("KTH raster: a door that only one room knows is open, one to nowhere is closed") {
  CHECK(pieces(plan_of(two_rooms(KthText(), 0.2, "right", "Wall"))) == 1);
  CHECK(pieces(plan_of(two_rooms(KthText(), 0.2, "Wall", "left"))) == 1);
  const FloorPlan nowhere = plan_of(two_rooms(KthText(), 0.0, "stairs", "Wall"));
  CHECK(pieces(nowhere) == 2);
  CHECK(floor_is_enclosed(nowhere));
}

TEST_CASE("KTH raster: a door into a room that stands in another") {
  KthText text(0.3);
  text.space("hall", {{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  text.space("booth", {{4, 4}, {6, 4}, {6, 4.6, "hall"}, {6, 5.4}, {6, 6}, {4, 6}});
  const FloorPlan plan = plan_of(text);
  CHECK(pieces(plan) == 1);
  CHECK(floor_is_enclosed(plan));
}

TEST_CASE("KTH raster: an open contour is closed by a wall") {
  KthText text(0.2);
  text.space("left", {{0, 0}, {4, 0, ""}, {4, 3}, {0, 3}});
  text.space("right", {{4, 0}, {8, 0}, {8, 3}, {4, 3, ""}});
  const FloorPlan plan = plan_of(text);
  CHECK(pieces(plan) == 2);
  CHECK(floor_is_enclosed(plan));
  CHECK(std::abs(floor_area_m2(plan) - 24.0) < 1.5);
}

TEST_CASE("KTH raster: contours of any shape, either way around") {
  const std::vector<io_test::Corner> l_shape{{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}};
  const FloorPlan forward = plan_of(KthText().space("l", l_shape));
  const FloorPlan backward = plan_of(KthText().space("l", {l_shape.rbegin(), l_shape.rend()}));
  CHECK(forward.values() == backward.values());
  CHECK(std::abs(floor_area_m2(forward) - 20.0) < 1.3);
  CHECK(at(forward, 4, 4) == FloorCell::solid);
  CHECK(at(forward, 1, 5) == FloorCell::floor);
}

TEST_CASE("KTH raster: pixel sizes") {
  const KthText rooms = two_rooms(KthText(0.4), 0.2);
  for (const double pixel_size_m : {0.01, 0.025, 0.1, 0.2}) {
    const FloorPlan plan = plan_of(rooms, pixel_size_m);
    CHECK(plan.resolution_m() == pixel_size_m);
    CHECK(floor_is_enclosed(plan));
    CHECK(std::abs(floor_area_m2(plan) - 24.16) < pixel_size_m * 30.0);
    CHECK(pieces(plan) == 1);
  }
  for (const double bad : std::vector<double>{0.0, -0.05, 1e-4, NAN, INFINITY}) {
    CHECK_THROWS_AS(plan_of(rooms, bad), std::invalid_argument);
  }
}

TEST_CASE("KTH raster: floors that are too large, or none, are refused") {
  const auto rectangle = [](double width_m, double height_m) {
    return KthText().space("r", {{0, 0}, {width_m, 0}, {width_m, height_m}, {0, height_m}});
  };
  CHECK(plan_refusal(rectangle(999, 20)).empty());
  CHECK_THAT(plan_refusal(rectangle(1001, 20)),
             Contains("measures 1001 x 20 m, but must have at most 1000 m a side"));
  CHECK_THAT(plan_refusal(rectangle(900, 900)), Contains("more than 67108864 pixels of 0.05 m"));
  CHECK_THAT(plan_refusal(rectangle(0.01, 0.01)), Contains("there is no floor"));
  KthText lines;
  CHECK_THAT(plan_refusal(lines.space("flat", {{0, 0}, {5, 0}, {9, 0}})), Contains("there is no floor"));
  KthText pile;
  for (int i = 0; i < 100; ++i) pile.space("r", {{0, 0}, {200, 0}, {200, 100}, {0, 100}});
  CHECK_THAT(plan_refusal(pile), Contains("lie on each other"));
}

TEST_CASE("KTH raster: spoilt files are read or refused") {
  const auto read = [](const std::string& xml) { return read_kth_xml_text(xml, "x", {.pixel_size_m = 0.2}); };
  CHECK(io_test::refused_when_spoilt(two_rooms(KthText(0.1), 0.2).text(), 2000, read) > 500);
}

TEST_CASE("KTH raster: a real floor") {
  const std::filesystem::path file =
      std::filesystem::path(INCOGNITA_DATA_DIR) / "kth_xml/A0043012_50045366.xml";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: there is no " << file);
    return;
  }
  const FloorPlan plan = read_kth_xml(file);
  const Index<2> extent = plan.box().extent();
  CHECK(extent.x() * 0.05 == Approx(54.3).margin(0.1));
  CHECK(extent.y() * 0.05 == Approx(25.6).margin(0.1));
  CHECK(floor_is_enclosed(plan));
  CHECK(floor_area_m2(plan) == Approx(1200).margin(20));
  CHECK(at(plan, 28.22, 29.2) == FloorCell::floor);  // the only door that no room leads back through

  // All 40 spaces hang together for a robot of 0.2 m radius, in two parts that no door joins.
  const auto clearance_m =
      distance_transform_m(plan, [](FloorCell cell) { return cell != FloorCell::floor; });
  const auto parts = connected_components(clearance_m, Adjacency::faces, [](float m) { return m > 0.225F; });
  REQUIRE(parts.sizes.size() == 2);
  const auto [small, large] = std::minmax(parts.sizes[0], parts.sizes[1]);
  CHECK(static_cast<double>(large) / static_cast<double>(small + large) == Approx(0.876).margin(0.005));
}
