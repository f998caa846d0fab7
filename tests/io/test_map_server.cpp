#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/map_server.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;
using io_test::refusal;

namespace {

const float unknown = unknown_probability;

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool same(const ProbabilityGrid& a, const ProbabilityGrid& b, float tolerance = 0.0F) {
  return a.box().lower == b.box().lower && a.box().upper == b.box().upper &&
         std::equal(a.values().begin(), a.values().end(), b.values().begin(),
                    [tolerance](float x, float y) { return same(x, y) || std::abs(x - y) <= tolerance; });
}

/// What one pixel means.
float probability_of(const std::vector<std::uint8_t>& pixel, const MapMetadata& metadata) {
  const Image image{1, 1, static_cast<int>(pixel.size()), pixel};
  return probabilities_of(image, metadata)[0];
}

/// A map with all kinds of probabilities and unknown cells, its box away from zero.
ProbabilityGrid random_map(std::uint64_t seed) {
  Random random(seed);
  ProbabilityGrid map(Lattice<2>(0.1, Point<2>(0.03, -0.07)), {Index<2>(-7, 3), Index<2>(24, 20)}, unknown);
  for (float& value : map.values()) {
    const double draw = random.uniform(-0.2, 1.2);
    value = draw < 0.0 ? 0.0F : draw > 1.1 ? unknown : draw > 1.0 ? 1.0F : static_cast<float>(draw);
  }
  return map;
}

}  // namespace

TEST_CASE("map_server: trinary thresholds are compared exactly as in ROS") {
  const MapMetadata metadata;  // 0.65 and 0.196
  CHECK(probability_of({0}, metadata) == 1.0F);
  CHECK(probability_of({254}, metadata) == 0.0F);
  CHECK(probability_of({255}, metadata) == 0.0F);
  // (255 - 205) / 255 = 0.19608 lies just above 0.196.
  CHECK(std::isnan(probability_of({205}, metadata)));
  CHECK(probability_of({206}, metadata) == 0.0F);
  // 166 / 255 = 0.65098 lies above 0.65 and 165 / 255 = 0.64706 below.
  CHECK(probability_of({89}, metadata) == 1.0F);
  CHECK(std::isnan(probability_of({90}, metadata)));

  // A threshold that a pixel meets exactly keeps it unknown on both sides.
  MapMetadata border;
  border.occupied_thresh = 200.0 / 255.0;
  border.free_thresh = 100.0 / 255.0;
  CHECK(std::isnan(probability_of({55}, border)));
  CHECK(std::isnan(probability_of({155}, border)));
  CHECK(probability_of({54}, border) == 1.0F);
  CHECK(probability_of({156}, border) == 0.0F);
}

TEST_CASE("map_server: negate turns black and white around, thresholds stay") {
  MapMetadata metadata;
  metadata.negate = true;
  for (int grey = 0; grey < 256; ++grey) {
    const double p = grey / 255.0;
    const float expected = p > 0.65 ? 1.0F : p < 0.196 ? 0.0F : unknown;
    CHECK(same(probability_of({static_cast<std::uint8_t>(grey)}, metadata), expected));
  }
}

TEST_CASE("map_server: scale is linear between the thresholds") {
  MapMetadata metadata;
  metadata.mode = MapMode::scale;
  metadata.occupied_thresh = 0.8;
  metadata.free_thresh = 0.2;
  CHECK(probability_of({51}, metadata) == 1.0F);   // p = 0.8 exactly
  CHECK(probability_of({204}, metadata) == 0.0F);  // p = 0.2 exactly
  CHECK(probability_of({0}, metadata) == 1.0F);
  CHECK(probability_of({255}, metadata) == 0.0F);
  CHECK(probability_of({102}, metadata) == Approx(2.0 / 3.0));
  CHECK(probability_of({153}, metadata) == Approx(1.0 / 3.0));
  metadata.negate = true;
  CHECK(probability_of({153}, metadata) == Approx(2.0 / 3.0));
}

TEST_CASE("map_server: raw is percent, more is unknown, negate and thresholds do not count") {
  MapMetadata metadata;
  metadata.mode = MapMode::raw;
  for (const bool negate : {false, true}) {
    metadata.negate = negate;
    CHECK(probability_of({0}, metadata) == 0.0F);
    CHECK(probability_of({37}, metadata) == 0.37F);
    CHECK(probability_of({100}, metadata) == 1.0F);
    CHECK(std::isnan(probability_of({101}, metadata)));
    CHECK(std::isnan(probability_of({255}, metadata)));
  }
}

TEST_CASE("map_server: colours are averaged, and alpha as ROS does it") {
  MapMetadata metadata;
  CHECK(std::isnan(probability_of({255, 255, 0}, metadata)));  // 170: p = 0.33
  CHECK(probability_of({0, 0, 200}, metadata) == 1.0F);
  // 205, 205, 206: the mean is not rounded, p = 0.19477 is free.
  CHECK(probability_of({205, 205, 206}, metadata) == 0.0F);
  // Trinary counts alpha as a channel: opaque black is (0 + 0 + 0 + 255) / 4, p = 0.75.
  CHECK(probability_of({0, 0, 0, 255}, metadata) == 1.0F);
  CHECK(probability_of({0, 255}, metadata) == 1.0F);
  CHECK(std::isnan(probability_of({255, 255, 255, 0}, metadata)));  // p = 0.25
  CHECK(std::isnan(probability_of({255, 0}, metadata)));
  // Scale: any transparency is unknown, alpha does not count.
  metadata.mode = MapMode::scale;
  CHECK(std::isnan(probability_of({0, 0, 0, 254}, metadata)));
  CHECK(std::isnan(probability_of({0, 0}, metadata)));
  CHECK(probability_of({0, 255}, metadata) == 1.0F);
  CHECK(probability_of({90, 90, 90, 255}, metadata) == probability_of({90}, metadata));
  metadata.mode = MapMode::raw;
  CHECK(probability_of({30, 0}, metadata) == 0.3F);
  CHECK(probability_of({30, 40, 50, 7}, metadata) == 0.4F);
}

TEST_CASE("map_server: the last row of the image is the lowest row of the map") {
  const io_test::TemporaryFolder folder;
  static_cast<void>(folder.with("m.pgm", "P2 2 3 255\n0 205\n254 254\n254 0\n"));
  const auto yaml = folder.with("m.yaml",
                                "image: m.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\nnegate: 0\n"
                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const ProbabilityGrid map = read_map_server(yaml);
  CHECK(map.resolution_m() == 0.5);
  CHECK(map.lattice().origin_m() == Point<2>(-1.0, 2.0));
  CHECK(map.box().upper == Index<2>(2, 3));
  CHECK(map.value({0, 2}) == 1.0F);
  CHECK(std::isnan(map.value({1, 2})));
  CHECK(map.value({0, 0}) == 0.0F);
  CHECK(map.value({1, 0}) == 1.0F);
  CHECK(std::isnan(map.value({5, 5})));

  const FloorPlan plan = floor_plan_of(map);
  CHECK(plan.value({0, 2}) == FloorCell::wall);
  CHECK(plan.value({1, 2}) == FloorCell::solid);
  CHECK(plan.value({0, 0}) == FloorCell::floor);
  CHECK(plan.value({-1, 0}) == FloorCell::solid);
  CHECK(plan.value(plan.lattice().index_of({-0.9, 3.4})) == FloorCell::wall);
}

TEST_CASE("map_server: a floor plan's thresholds") {
  ProbabilityGrid map(Lattice<2>(1.0), {Index<2>(0, 0), Index<2>(5, 1)}, unknown);
  map.values() = {0.64F, 0.66F, 0.1975F, 0.19F, unknown};
  using enum FloorCell;
  CHECK(floor_plan_of(map).values() == std::vector<FloorCell>{solid, wall, solid, floor, solid});
  CHECK(floor_plan_of(map, {.wall_above = 0.5, .floor_below = 0.2}).values() ==
        std::vector<FloorCell>{wall, wall, floor, floor, solid});
}

TEST_CASE("map_server: maps come back in every mode and both formats") {
  const io_test::TemporaryFolder folder;
  const ProbabilityGrid map = random_map(1);
  ProbabilityGrid trinary = map;
  for (float& p : trinary.values()) p = p > 0.65F ? 1.0F : p < 0.196F ? 0.0F : unknown;
  ProbabilityGrid known = map;
  for (float& p : known.values()) p = std::isnan(p) ? 0.5F : p;

  // The file's grid starts at cell (0, 0), with the box's corner as its origin.
  const auto moved = [&](ProbabilityGrid grid) {
    ProbabilityGrid at_zero(grid.lattice(), {Index<2>::Zero(), grid.box().extent()}, unknown);
    at_zero.values() = grid.values();
    return at_zero;
  };
  const auto written = [&](const ProbabilityGrid& grid, MapMode mode, MapImage format) {
    write_map_server(folder / "m.yaml", grid, mode, format);
    const ProbabilityGrid back = read_map_server(folder / "m.yaml");
    CHECK(back.resolution_m() == 0.1);
    CHECK((back.lattice().origin_m() - Point<2>(0.03 - 0.7, -0.07 + 0.3)).norm() < 1e-15);
    return back;
  };
  CHECK(same(written(map, MapMode::trinary, MapImage::png), moved(trinary)));
  CHECK(same(written(map, MapMode::trinary, MapImage::pgm), moved(trinary)));
  CHECK(same(written(map, MapMode::scale, MapImage::png), moved(map), 0.5F / 255.0F + 1e-6F));
  CHECK(same(written(known, MapMode::scale, MapImage::pgm), moved(known), 0.5F / 255.0F + 1e-6F));
  CHECK(same(written(map, MapMode::raw, MapImage::png), moved(map), 0.005F + 1e-6F));
  CHECK(same(written(map, MapMode::raw, MapImage::pgm), moved(map), 0.005F + 1e-6F));
  CHECK(folder.names() == std::vector<std::string>{"m.pgm", "m.png", "m.yaml"});
}

TEST_CASE("map_server: a trinary map is written with map_saver's grey values") {
  const io_test::TemporaryFolder folder;
  Grid<int, 2> cells(Lattice<2>(0.05), {Index<2>(0, 0), Index<2>(2, 2)});
  cells.values() = {0, 1, 2, 3};
  write_map_server(folder / "m.yml", cells, [](int cell) {
    return std::vector<double>{0.1, 0.9, 0.5, NAN}.at(static_cast<std::size_t>(cell));
  });
  CHECK(read_png(folder / "m.png").values == std::vector<std::uint8_t>{205, 205, 254, 0});
}

TEST_CASE("map_server: maps that cannot be written") {
  const io_test::TemporaryFolder folder;
  ProbabilityGrid map(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(2, 1)}, unknown);
  CHECK_THROWS_AS(write_map_server(folder / "m.yaml", ProbabilityGrid(Lattice<2>(0.1))),
                  std::invalid_argument);
  CHECK_THROWS_AS(write_map_server(folder / "m.yaml", map, MapMode::scale, MapImage::pgm),
                  std::invalid_argument);
  map.values() = {0.5F, 1.5F};
  CHECK_THROWS_AS(write_map_server(folder / "m.yaml", map), std::invalid_argument);
  map.values() = {0.5F, -0.1F};
  CHECK_THROWS_AS(write_map_server(folder / "m.yaml", map), std::invalid_argument);
  CHECK(folder.names().empty());
  map.values() = {0.0F, 1.0F};
  const auto write_refusal = [&map](const std::filesystem::path& yaml) {
    return refusal([&] {
      write_map_server(yaml, map);
      return 0;
    });
  };
  CHECK_THAT(write_refusal("/proc/none/m.yaml"), Contains("cannot be written"));
  CHECK_THAT(write_refusal(folder / "missing/m.yaml"), Contains("cannot be written"));
}

TEST_CASE("map_server: a map without its image, or with a bad one, is refused by the image's name") {
  const io_test::TemporaryFolder folder;
  write_map_server(folder / "m.yaml", random_map(2));
  const std::string png = io_test::content_of(folder / "m.png");
  const auto read_refusal = [&] { return refusal([&] { return read_map_server(folder / "m.yaml"); }); };
  CHECK(read_refusal().empty());
  static_cast<void>(folder.with("m.png", png.substr(0, png.size() / 2)));
  CHECK_THAT(read_refusal(), Contains("m.png: not a valid PNG"));
  std::filesystem::remove(folder / "m.png");
  CHECK_THAT(read_refusal(), Contains("m.png: there is no such file"));
  std::filesystem::create_directory(folder / "m.png");
  CHECK_THAT(read_refusal(), Contains("m.png: is a folder"));
  CHECK_THAT(refusal([&] { return read_map_server(folder.path()); }), Contains("is a folder"));
}

TEST_CASE("map_server: real maps") {
  const std::filesystem::path data = INCOGNITA_DATA_DIR;
  if (!std::filesystem::exists(data)) {
    WARN("skipped: there is no " << data);
    return;
  }
  const auto count = [](const FloorPlan& plan, FloorCell cell) {
    return std::count(plan.values().begin(), plan.values().end(), cell);
  };
  const FloorPlan turtlebot = floor_plan_of(read_map_server(data / "ros_maps/map.yaml"));
  CHECK(turtlebot.box().upper == Index<2>(384, 384));
  CHECK(turtlebot.lattice().origin_m() == Point<2>(-10.0, -10.0));
  CHECK(turtlebot.resolution_m() == 0.05);
  CHECK(count(turtlebot, FloorCell::wall) == 795);
  CHECK(count(turtlebot, FloorCell::floor) == 7939);
  CHECK(turtlebot.value(turtlebot.lattice().index_of({-2.0, -0.5})) ==
        FloorCell::floor);  // where its robots start

  MapMetadata willow;
  willow.resolution_m = 0.1;
  const ProbabilityGrid office = probabilities_of(read_image(data / "ros_maps/willow-full.pgm"), willow);
  CHECK(office.box().upper == Index<2>(584, 526));
  CHECK(std::count(office.values().begin(), office.values().end(), 0.0F) >
        100000);  // greys of 250 to 253 are free

  for (const char* name : {"50010535_PLAN1", "50015848", "50052749", "50052751", "50052753"}) {
    const FloorPlan plan = floor_plan_of(read_map_server(data / "kth" / (std::string(name) + ".yaml")));
    CHECK(count(plan, FloorCell::floor) > count(plan, FloorCell::wall));
    CHECK(count(plan, FloorCell::solid) > 0);  // 205
  }
}
