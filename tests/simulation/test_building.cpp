#include <catch2/catch.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "incognita/grid/components.hpp"
#include "incognita/simulation/building.hpp"
#include "incognita/simulation/world.hpp"

using namespace incognita;

namespace {

bool is_floor(FloorCell cell) { return cell == FloorCell::floor; }

/// Whether every cell of a box, as far as it lies in the plan, is what is asked for.
template <class Holds>
bool all_of(const FloorPlan& plan, const IndexBox<2>& box, Holds&& holds) {
  for (int y = box.lower.y(); y < box.upper.y(); ++y) {
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      if (!holds(plan.value({x, y}))) return false;
    }
  }
  return true;
}

std::size_t area_cells(const IndexBox<2>& box) { return static_cast<std::size_t>(box.extent().prod()); }

BuildingParams drawn_params(Random& random, double side_max_m) {
  BuildingParams params;
  params.resolution_m = random.uniform(0.05, 0.13);
  params.robot_radius_m = random.uniform(0.1, 0.45);
  params.wall_m = random.uniform(0.08, 0.4);
  params.door_m = 2.0 * params.robot_radius_m + 3.0 * params.resolution_m + random.uniform(0.0, 0.8);
  params.corridor_m = params.door_m + 0.2 + random.uniform(0.0, 1.5);
  params.main_corridor_m = params.corridor_m + 0.2 + random.uniform(0.0, 1.5);
  params.room_side_min_m = std::max(2.0, params.door_m + 0.4) + random.uniform(0.0, 1.0);
  params.room_depth_max_m = params.room_side_min_m + 0.2 + random.uniform(0.0, 6.0);
  params.room_width_max_m = params.room_side_min_m + 0.2 + random.uniform(0.0, 12.0);
  params.hall_chance = random.uniform();
  params.furniture_share = random.uniform();
  const double side_min_m = 2.0 * params.room_side_min_m + params.corridor_m + 4.0 * params.wall_m + 0.5;
  params.size_m.x() = random.uniform(side_min_m, side_max_m);
  params.size_m.y() = random.uniform(side_min_m, side_max_m);
  return params;
}

/// A disc of the robot's size gets from everywhere to everywhere, and into every room and corridor.
void check_connected(const BuildingLayout& layout, const FloorPlan& plan, double radius_m) {
  const Grid<std::uint8_t, 2> positions = disc_positions(World(plan), radius_m);
  const Components<2> regions = connected_components(positions, Adjacency::faces, [](std::uint8_t is_clear) { return is_clear != 0; });
  REQUIRE(regions.sizes.size() == 1);
  const auto is_entered = [&](const IndexBox<2>& box) {
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        if (positions.value({x, y}) != 0) return true;
      }
    }
    return false;
  };
  for (const IndexBox<2>& corridor : layout.corridors) REQUIRE(is_entered(corridor));
  for (const BuildingRoom& room : layout.rooms) {
    REQUIRE(is_entered(room.floor));
    for (const IndexBox<2>& door : room.doors) REQUIRE(is_entered(door));
  }
}

/// Rooms and corridors lie apart, furniture on the floor, and walls around all.
void check_consistent(const BuildingLayout& layout, const FloorPlan& plan, int wall_cells) {
  std::size_t floor_cells = 0;
  std::set<std::tuple<int, int, int, int>> doors;
  for (const IndexBox<2>& corridor : layout.corridors) {
    floor_cells += area_cells(corridor);
    REQUIRE(all_of(plan, corridor, is_floor));
  }
  for (const BuildingRoom& room : layout.rooms) {
    floor_cells += area_cells(room.floor);
    REQUIRE_FALSE(room.doors.empty());
    for (const IndexBox<2>& obstacle : room.obstacles) {
      REQUIRE(room.floor.contains(obstacle));
      REQUIRE(all_of(plan, obstacle, [](FloorCell cell) { return cell == FloorCell::wall; }));
      floor_cells -= area_cells(obstacle);
    }
    for (const IndexBox<2>& door : room.doors) {
      if (doors.emplace(door.lower.x(), door.lower.y(), door.upper.x(), door.upper.y()).second) floor_cells += area_cells(door);
      // It opens on both sides.
      const int through = door.upper.x() <= room.floor.lower.x() || door.lower.x() >= room.floor.upper.x() ? 0 : 1;
      IndexBox<2> opening = door;
      --opening.lower[through];
      ++opening.upper[through];
      REQUIRE(all_of(plan, opening, is_floor));
    }
  }
  REQUIRE(static_cast<std::size_t>(std::count(plan.values().begin(), plan.values().end(), FloorCell::floor)) == floor_cells);

  const IndexBox<2> inside = plan.box().padded(-wall_cells);
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (!inside.contains(plan.index_at(cell))) REQUIRE(plan[cell] == FloorCell::wall);
  }
}

/// How many pieces of the building corridors enclose.
std::size_t ring_count(const BuildingLayout& layout) {
  BuildingLayout corridors = layout;
  corridors.rooms.clear();
  const Components<2> pieces = connected_components(draw_layout(corridors), Adjacency::corners, [](FloorCell cell) { return !is_floor(cell); });
  std::set<std::int32_t> outer;
  const IndexBox<2> inside = layout.outline.padded(-1);
  for (Offset cell = 0; cell < static_cast<Offset>(pieces.labels.size()); ++cell) {
    if (!inside.contains(pieces.labels.index_at(cell))) outer.insert(pieces.labels[cell]);
  }
  return pieces.sizes.size() - outer.size();
}

std::uint64_t hash_of(const FloorPlan& plan) {
  std::uint64_t hash = 14695981039346656037U;
  for (const FloorCell cell : plan.values()) hash = (hash ^ static_cast<std::uint64_t>(cell)) * 1099511628211U;
  return hash;
}

std::string refusal(const BuildingParams& params) {
  Random random(1);
  try {
    static_cast<void>(lay_out_building(params, random));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("Any building is closed, and a robot gets everywhere in it", "[simulation]") {
  Random random(1);
  for (int trial = 0; trial < 40; ++trial) {
    const BuildingParams params = drawn_params(random, trial < 35 ? 30.0 : 60.0);
    CAPTURE(trial, params.size_m.x(), params.size_m.y(), params.resolution_m, params.robot_radius_m, params.door_m);
    const BuildingLayout layout = lay_out_building(params, random);
    const FloorPlan plan = draw_layout(layout);
    check_consistent(layout, plan, static_cast<int>(std::lround(params.wall_m / params.resolution_m)));
    check_connected(layout, plan, params.robot_radius_m);
    const double floor_share =
        static_cast<double>(std::count(plan.values().begin(), plan.values().end(), FloorCell::floor)) / static_cast<double>(plan.size());
    CHECK(floor_share > 0.5);
    CHECK(floor_share < 0.97);
  }
}

TEST_CASE("No room is a sliver", "[simulation]") {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const BuildingParams params = drawn_params(random, 100.0);
    const BuildingLayout layout = lay_out_building(params, random);
    const int side_min = static_cast<int>(std::lround(params.room_side_min_m / params.resolution_m));
    for (const BuildingRoom& room : layout.rooms) REQUIRE(room.floor.extent().minCoeff() >= side_min);
  }
}

TEST_CASE("Corridors form rings", "[simulation]") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const Point<2>& size_m : {Point<2>(16.0, 40.0), Point<2>(30.0, 20.0), Point<2>(55.0, 25.0), Point<2>(90.0, 100.0)}) {
      BuildingParams params;
      params.size_m = size_m;
      params.resolution_m = 0.1;
      Random random(seed);
      const BuildingLayout layout = lay_out_building(params, random);
      // The first four close one ring, each other one more.
      REQUIRE(layout.corridors.size() >= 4);
      REQUIRE(ring_count(layout) == layout.corridors.size() - 3);
    }
  }
  BuildingParams params;
  params.size_m = {90.0, 10.0};  // too narrow for a ring
  Random random(1);
  const BuildingLayout narrow = lay_out_building(params, random);
  CHECK(narrow.corridors.size() == 1);
}

TEST_CASE("A seed gives its building again, on any machine", "[simulation]") {
  BuildingParams params;
  params.resolution_m = 0.1;
  Random one(7);
  Random same(7);
  Random other(8);
  const FloorPlan plan = make_building(params, one);
  CHECK(plan.values() == make_building(params, same).values());
  CHECK(one.uniform() == same.uniform());
  CHECK(plan.values() != make_building(params, other).values());
  CHECK(plan.resolution_m() == 0.1);
  CHECK(plan.box() == IndexBox<2>{{0, 0}, {550, 250}});
  CHECK(hash_of(plan) == 15138149552668939120U);
}

TEST_CASE("Halls and furniture are there as they are asked for", "[simulation]") {
  BuildingParams params;
  params.size_m = {80.0, 60.0};
  params.hall_chance = 0.0;
  params.furniture_share = 0.0;
  Random random(3);
  for (const BuildingRoom& room : lay_out_building(params, random).rooms) {
    REQUIRE_FALSE(room.is_hall);
    REQUIRE(room.obstacles.empty());
  }
  params.hall_chance = 1.0;
  const BuildingLayout halls = lay_out_building(params, random);
  const auto is_large = [&](const BuildingRoom& room) { return room.is_hall && room.floor.extent().minCoeff() * params.resolution_m > 10.0; };
  CHECK(std::count_if(halls.rooms.begin(), halls.rooms.end(), is_large) > 0);

  const auto furniture = [&](double share) {
    params.furniture_share = share;
    params.hall_chance = 0.0;
    Random same(4);
    std::size_t count = 0;
    for (const BuildingRoom& room : lay_out_building(params, same).rooms) count += room.obstacles.size();
    return count;
  };
  CHECK(furniture(0.2) > 10);
  CHECK(furniture(1.0) > 2 * furniture(0.2));
}

TEST_CASE("Buildings that cannot be are refused before anything is made", "[simulation]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto said = [](auto&& change) {
    BuildingParams params;
    change(params);
    return refusal(params);
  };
  CHECK(refusal({}).empty());
  CHECK(said([](BuildingParams& p) { p.size_m.x() = nan; }) == "BuildingParams: size_m is nan, but must be finite and > 0");
  CHECK(said([](BuildingParams& p) { p.size_m.y() = 1e9; }) == "BuildingParams: size_m is 1e+09, but must be at most 40000 cells");
  CHECK(said([](BuildingParams& p) { p.size_m.y() = 7.0; }) ==
        "BuildingParams: size_m is 7, but must be at least 7.8, two rooms, a corridor between and four walls");
  CHECK(said([](BuildingParams& p) { p.resolution_m = 0.0; }) == "BuildingParams: resolution_m is 0, but must be finite and > 0");
  CHECK(said([](BuildingParams& p) { p.resolution_m = 0.5; }) == "BuildingParams: wall_m is 0.2, but must be at least 0.5, a cell");
  CHECK(said([](BuildingParams& p) { p.robot_radius_m = -0.1; }) == "BuildingParams: robot_radius_m is -0.1, but must be finite and >= 0");
  CHECK(said([](BuildingParams& p) { p.robot_radius_m = 1e300; }) ==
        "BuildingParams: robot_radius_m is 1e+300, but must be smaller than the building");
  CHECK(said([](BuildingParams& p) { p.robot_radius_m = 0.45; }) ==
        "BuildingParams: door_m is 0.9, but must be at least 1, the robot's diameter and two cells");
  CHECK(said([](BuildingParams& p) { p.corridor_m = 0.8; }) ==
        "BuildingParams: corridor_m is 0.8, but must be at least 0.9, the width of a door");
  CHECK(said([](BuildingParams& p) { p.main_corridor_m = 1.0; }) ==
        "BuildingParams: main_corridor_m is 1, but must be at least 2, the width of a corridor");
  CHECK(said([](BuildingParams& p) { p.room_side_min_m = 0.9; }) ==
        "BuildingParams: room_side_min_m is 0.9, but must be at least 1, the width of a door and two cells");
  CHECK(said([](BuildingParams& p) { p.room_depth_max_m = 2.0; }) ==
        "BuildingParams: room_depth_max_m is 2, but must be at least 2.5, room_side_min_m");
  CHECK(said([](BuildingParams& p) { p.room_width_max_m = -2.0; }) == "BuildingParams: room_width_max_m is -2, but must be finite and > 0");
  CHECK(said([](BuildingParams& p) { p.hall_side_max_m = nan; }) == "BuildingParams: hall_side_max_m is nan, but must be finite and > 0");
  CHECK(said([](BuildingParams& p) { p.hall_chance = 1.1; }) == "BuildingParams: hall_chance is 1.1, but must be 0 to 1");
  CHECK(said([](BuildingParams& p) { p.furniture_share = nan; }) == "BuildingParams: furniture_share is nan, but must be 0 to 1");
}

TEST_CASE("A building of a quarter of a square kilometre is made in seconds", "[.long]") {
  BuildingParams params;
  params.size_m = {500.0, 500.0};
  params.resolution_m = 0.1;
  Random random(1);
  const auto start = std::chrono::steady_clock::now();
  const BuildingLayout layout = lay_out_building(params, random);
  const FloorPlan plan = draw_layout(layout);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - start;
  WARN("500 x 500 m at 0.1 m in " << duration.count() << " s: " << layout.rooms.size() << " rooms, " << layout.corridors.size() << " corridors");
  CHECK(duration.count() < 5.0);
  check_consistent(layout, plan, 2);
  check_connected(layout, plan, params.robot_radius_m);
}

TEST_CASE("Many large buildings are closed, and a robot gets everywhere in them", "[.long]") {
  Random random(5);
  for (int trial = 0; trial < 400; ++trial) {
    const BuildingParams params = drawn_params(random, 150.0);
    CAPTURE(trial, params.size_m.x(), params.size_m.y(), params.resolution_m, params.robot_radius_m, params.door_m);
    const BuildingLayout layout = lay_out_building(params, random);
    const FloorPlan plan = draw_layout(layout);
    check_consistent(layout, plan, static_cast<int>(std::lround(params.wall_m / params.resolution_m)));
    check_connected(layout, plan, params.robot_radius_m);
  }
}
