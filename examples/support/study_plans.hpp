/// Large floor plans drawn for this project after what Seo et al. say of theirs, section VI-C and Figs. 14 to 17: sizes, numbers of rooms and
/// their kind are the paper's, everything else is ours. Doors are for a robot of radius 0.4 m (the paper's, a Clearpath Warthog, is 1.4 m wide).
#pragma once

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/simulation/plan_drawing.hpp"

namespace examples {

inline constexpr double study_pixel_m = 0.2;
inline constexpr double study_robot_radius_m = 0.4;  ///< of the robot that gets everywhere

namespace study {

using incognita::Along;
using incognita::FloorCell;
using incognita::FloorPlan;
using incognita::WallParams;
using Area = incognita::Box<incognita::Point<2>>;

/// Equal rooms side by side along an axis: a wall at front_m with a door to each, and walls between them from there to back_m. Doors lie
/// left and right of the middle by turns.
inline void draw_rooms(FloorPlan& plan, const WallParams& walls, Along along, double from_m, double to_m, double front_m, double back_m,
                       int count) {
  const Along across = along == Along::x ? Along::y : Along::x;
  const double pitch_m = (to_m - from_m) / count;
  std::vector<double> doors_m;
  for (int i = 0; i < count; ++i) {
    doors_m.push_back(from_m + (i + (i % 2 == 0 ? 0.3 : 0.7)) * pitch_m);
    if (i > 0) draw_wall(plan, walls, across, from_m + i * pitch_m, std::min(front_m, back_m), std::max(front_m, back_m), {});
  }
  draw_wall(plan, walls, along, front_m, from_m, to_m, doors_m);
}

/// Two rows of rooms back to back between two corridors along x.
inline void draw_lane(FloorPlan& plan, const WallParams& walls, const Area& area_m, int below, int above) {
  const double middle_m = 0.5 * (area_m.lower.y() + area_m.upper.y());
  const double from_m = area_m.lower.x();
  const double to_m = area_m.upper.x();
  draw_rooms(plan, walls, Along::x, from_m, to_m, area_m.lower.y(), middle_m, below);
  draw_rooms(plan, walls, Along::x, from_m, to_m, area_m.upper.y(), middle_m, above);
  draw_wall(plan, walls, Along::x, middle_m, from_m, to_m, {});
  for (const double end_m : {from_m, to_m}) draw_wall(plan, walls, Along::y, end_m, area_m.lower.y() - 0.2, area_m.upper.y() + 0.2, {});
}

/// Blocks of a size in rows and columns, the lower left corner of the first at `first_m`.
inline void draw_grid(FloorPlan& plan, const incognita::Point<2>& first_m, const incognita::Point<2>& pitch_m, int columns, int rows,
                      const incognita::Point<2>& size_m) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const incognita::Point<2> lower_m = first_m + incognita::Point<2>(column * pitch_m.x(), row * pitch_m.y());
      fill_area(plan, {lower_m, lower_m + size_m}, FloorCell::wall);
    }
  }
}

}  // namespace study

/// 125 x 169 m: four long corridors, joined at their ends, with eight rooms at each and nothing in them.
[[nodiscard]] inline incognita::FloorPlan rooms_32() {
  using incognita::Along;
  constexpr incognita::WallParams walls{.wall_m = 0.4, .door_m = 2.0};
  incognita::FloorPlan plan = incognita::walled_floor({125.0, 169.0}, study_pixel_m, walls.wall_m);
  study::draw_rooms(plan, walls, Along::y, 0.0, 169.0, 20.8, 0.0, 4);
  study::draw_rooms(plan, walls, Along::y, 0.0, 169.0, 104.2, 125.0, 4);
  constexpr double first_m = 5.4;
  constexpr double room_m = 19.8;
  for (int column = 0; column < 3; ++column) {
    const double left_m = 26.2 + 26.0 * column;
    const double right_m = left_m + 20.6;
    std::vector<double> left_doors_m;
    std::vector<double> right_doors_m;
    for (int room = 0; room < 8; ++room) {
      const double lower_m = first_m + room * room_m;
      (room % 2 == column % 2 ? left_doors_m : right_doors_m).push_back(lower_m + (room % 4 < 2 ? 6.0 : 13.8));
      draw_wall(plan, walls, Along::x, lower_m, left_m, right_m, {});
    }
    const double last_m = first_m + 8 * room_m;
    draw_wall(plan, walls, Along::x, last_m, left_m - 0.2, right_m + 0.2, {});
    draw_wall(plan, walls, Along::y, left_m, first_m - 0.2, last_m, left_doors_m);
    draw_wall(plan, walls, Along::y, right_m, first_m - 0.2, last_m, right_doors_m);
  }
  return plan;
}

/// 220 x 291 m, after the maps of the DARPA Subterranean Challenge: halls and chambers in rock, short passages, pillars and rubble.
[[nodiscard]] inline incognita::FloorPlan underground() {
  using study::Area;
  incognita::FloorPlan plan(incognita::Lattice<2>(study_pixel_m), {{0, 0}, {1100, 1455}}, incognita::FloorCell::solid);
  const std::vector<Area> open_m{
      // Halls and chambers, from the lower left on; a few are two rectangles.
      {{6, 6}, {66, 52}}, {{80, 6}, {112, 30}}, {{80, 42}, {98, 56}}, {{126, 6}, {176, 40}}, {{150, 34}, {176, 58}}, {{190, 6}, {214, 26}},
      {{190, 38}, {214, 62}}, {{6, 66}, {30, 92}}, {{42, 68}, {70, 84}}, {{84, 72}, {150, 124}}, {{164, 74}, {184, 92}},
      {{196, 76}, {214, 112}}, {{6, 106}, {52, 140}}, {{62, 98}, {74, 116}}, {{164, 104}, {182, 122}}, {{62, 136}, {84, 158}},
      {{98, 138}, {122, 156}}, {{136, 136}, {178, 176}}, {{190, 126}, {214, 150}}, {{6, 154}, {48, 206}}, {{62, 172}, {110, 220}},
      {{40, 180}, {50, 198}}, {{124, 190}, {142, 208}}, {{156, 190}, {214, 232}}, {{190, 162}, {214, 178}}, {{6, 222}, {36, 244}},
      {{50, 236}, {76, 256}}, {{6, 258}, {38, 285}}, {{52, 268}, {104, 285}}, {{92, 232}, {106, 254}}, {{118, 222}, {142, 246}},
      {{118, 258}, {170, 285}}, {{184, 246}, {214, 270}}, {{180, 276}, {202, 285}},
      // Passages along x.
      {{66, 16}, {80, 20}}, {{66, 46}, {80, 49}}, {{112, 14}, {126, 19}}, {{98, 48}, {150, 51}}, {{176, 14}, {190, 18}}, {{176, 48}, {190, 52}},
      {{30, 75}, {42, 78}}, {{70, 76}, {84, 80}}, {{150, 82}, {164, 86}}, {{184, 82}, {196, 85}}, {{52, 108}, {62, 111}}, {{74, 108}, {84, 111}},
      {{150, 112}, {164, 115}}, {{182, 108}, {196, 111}}, {{84, 146}, {98, 149}}, {{122, 146}, {136, 150}}, {{178, 138}, {190, 142}},
      {{178, 168}, {190, 171}}, {{48, 186}, {62, 190}}, {{110, 198}, {124, 201}}, {{142, 198}, {156, 202}}, {{36, 232}, {50, 240}},
      {{38, 276}, {52, 279}}, {{76, 242}, {92, 245}}, {{106, 238}, {118, 241}}, {{104, 274}, {118, 278}}, {{170, 262}, {184, 266}},
      {{170, 279}, {180, 282}}, {{142, 224}, {156, 228}},
      // Passages along y.
      {{16, 52}, {20, 66}}, {{54, 52}, {57, 68}}, {{88, 30}, {92, 42}}, {{160, 58}, {164, 70}}, {{100, 51}, {104, 72}}, {{200, 26}, {204, 38}},
      {{203, 62}, {206, 76}}, {{18, 92}, {21, 106}}, {{172, 92}, {175, 104}}, {{112, 124}, {115, 138}}, {{24, 140}, {28, 154}}, {{70, 158}, {74, 172}},
      {{150, 124}, {153, 136}}, {{203, 112}, {206, 126}}, {{201, 150}, {204, 162}}, {{160, 176}, {164, 190}}, {{204, 178}, {207, 190}},
      {{18, 206}, {22, 222}}, {{20, 244}, {23, 258}}, {{66, 220}, {69, 236}}, {{98, 220}, {101, 232}}, {{62, 256}, {66, 268}}, {{128, 208}, {131, 222}},
      {{130, 246}, {134, 258}}, {{196, 232}, {200, 246}}, {{190, 270}, {193, 276}},
      // Where two of them meet.
      {{150, 112}, {153, 126}}, {{160, 66}, {172, 70}}, {{169, 66}, {172, 76}}};
  for (const Area& area_m : open_m) fill_area(plan, area_m, incognita::FloorCell::floor);

  study::draw_grid(plan, {17, 16}, {12, 12}, 4, 3, {1.6, 1.6});  // pillars
  study::draw_grid(plan, {94, 82}, {15, 12}, 4, 4, {2.4, 2.4});
  study::draw_grid(plan, {72, 182}, {13, 13}, 3, 3, {2, 2});
  study::draw_grid(plan, {168, 200}, {12, 12}, 4, 3, {1.6, 1.6});
  draw_blocks(plan, {{{136, 14}, {142, 20}},     {{152, 10}, {154, 24}},   {{160, 26}, {168, 32}},   {{156, 42}, {166, 46}},   {{12, 74}, {16, 84}},
                     {{88, 14}, {96, 18}},       {{102, 20}, {106, 26}},   {{104, 94}, {112, 96}},   {{126, 106}, {140, 108}}, {{14, 114}, {24, 118}},
                     {{32, 122}, {36, 134}},     {{42, 112}, {46, 116}},   {{144, 144}, {152, 152}}, {{160, 158}, {172, 162}}, {{166, 142}, {170, 148}},
                     {{12, 164}, {18, 184}},     {{26, 170}, {38, 172}},   {{30, 186}, {34, 200}},   {{12, 194}, {22, 198}},   {{196, 132}, {202, 138}},
                     {{200, 88}, {202, 100}},    {{68, 142}, {74, 150}},   {{60, 242}, {68, 250}},   {{14, 266}, {26, 272}},   {{62, 274}, {70, 280}},
                     {{84, 272}, {88, 280}},     {{126, 264}, {136, 270}}, {{146, 272}, {160, 276}}, {{192, 254}, {204, 258}}, {{124, 230}, {130, 236}},
                     {{196, 44}, {206, 50}},     {{106, 146}, {114, 150}}, {{86, 200}, {104, 202}},  {{180, 222}, {192, 224}}});

  // Rock shows as a wall where light meets it.
  const incognita::Grid<float, 2> from_floor_m =
      incognita::distance_transform_m(plan, [](incognita::FloorCell cell) { return cell == incognita::FloorCell::floor; });
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(plan.size()); ++cell) {
    if (plan[cell] == incognita::FloorCell::solid && from_floor_m[cell] < 0.5F) plan[cell] = incognita::FloorCell::wall;
  }
  return plan;
}

/// 180 x 48 m: two corridors from end to end, four across, rooms at all of them.
[[nodiscard]] inline incognita::FloorPlan long_corridors() {
  using incognita::Along;
  constexpr incognita::WallParams walls{.wall_m = 0.4, .door_m = 1.6};
  incognita::FloorPlan plan = incognita::walled_floor({180.0, 48.0}, study_pixel_m, walls.wall_m);
  study::draw_rooms(plan, walls, Along::x, 0.0, 180.0, 9.0, 0.0, 16);
  study::draw_rooms(plan, walls, Along::x, 0.0, 180.0, 39.0, 48.0, 14);
  study::draw_lane(plan, walls, {{4.0, 13.0}, {58.0, 35.0}}, 5, 6);
  study::draw_lane(plan, walls, {{62.0, 13.0}, {118.0, 35.0}}, 6, 4);
  study::draw_lane(plan, walls, {{122.0, 13.0}, {176.0, 35.0}}, 4, 6);
  return plan;
}

/// 186 x 168 m: nine rooms side by side, each so large that a scanner of 25 m sees no wall from its middle.
[[nodiscard]] inline incognita::FloorPlan room_cluster() {
  using incognita::Along;
  constexpr incognita::WallParams walls{.wall_m = 0.4, .door_m = 3.0};
  incognita::FloorPlan plan = incognita::walled_floor({186.0, 168.0}, study_pixel_m, walls.wall_m);
  draw_wall(plan, walls, Along::y, 58.0, 0.0, 168.0, {30.0, 70.0, 146.0});
  draw_wall(plan, walls, Along::y, 126.0, 0.0, 168.0, {12.0, 92.0, 132.0});
  draw_wall(plan, walls, Along::x, 54.0, 0.0, 58.0, {44.0});
  draw_wall(plan, walls, Along::x, 56.0, 58.0, 126.0, {80.0, 118.0});
  draw_wall(plan, walls, Along::x, 52.0, 126.0, 186.0, {150.0});
  draw_wall(plan, walls, Along::x, 112.0, 0.0, 58.0, {16.0});
  draw_wall(plan, walls, Along::x, 110.0, 58.0, 126.0, {100.0});
  draw_wall(plan, walls, Along::x, 114.0, 126.0, 186.0, {136.0, 172.0});
  return plan;
}

/// 160 x 120 m: a large open area with columns and desks, narrow corridors, and small rooms.
[[nodiscard]] inline incognita::FloorPlan open_office() {
  using incognita::Along;
  constexpr incognita::WallParams walls{.wall_m = 0.2, .door_m = 1.6};
  constexpr incognita::WallParams open_walls{.wall_m = 0.2, .door_m = 4.0};
  incognita::FloorPlan plan = incognita::walled_floor({160.0, 120.0}, study_pixel_m, walls.wall_m);
  // Rooms along the outer walls; the corridors below and above run from end to end.
  study::draw_rooms(plan, walls, Along::x, 0.0, 160.0, 6.1, 0.0, 26);
  study::draw_rooms(plan, walls, Along::x, 0.0, 160.0, 113.9, 120.0, 24);
  study::draw_rooms(plan, walls, Along::y, 8.7, 111.3, 6.1, 0.0, 17);
  study::draw_rooms(plan, walls, Along::y, 8.7, 111.3, 153.9, 160.0, 16);
  for (const double y_m : {8.7, 111.3}) {
    draw_wall(plan, walls, Along::x, y_m, 0.0, 6.2, {});
    draw_wall(plan, walls, Along::x, y_m, 153.8, 160.0, {});
  }
  // Lanes on the right, one below and one above the open area.
  for (int lane = 0; lane < 7; ++lane) {
    const double lower_m = 8.7 + 15.0 * lane;
    study::draw_lane(plan, walls, {{80.7, lower_m}, {151.3, lower_m + 12.4}}, 11 + lane % 3, 13 - lane % 4);
  }
  study::draw_lane(plan, walls, {{8.7, 8.7}, {78.1, 21.1}}, 12, 10);
  study::draw_lane(plan, walls, {{8.7, 98.7}, {78.1, 111.1}}, 11, 12);
  draw_wall(plan, open_walls, Along::x, 23.7, 8.6, 78.2, {20.0, 44.0, 66.0});
  draw_wall(plan, open_walls, Along::x, 96.1, 8.6, 78.2, {16.0, 40.0, 70.0});
  draw_wall(plan, open_walls, Along::y, 8.7, 23.6, 96.2, {34.0, 60.0, 86.0});
  draw_wall(plan, open_walls, Along::y, 78.1, 23.6, 96.2, {38.0, 52.6, 68.0, 83.0});
  study::draw_grid(plan, {19.4, 35.0}, {12.0, 12.0}, 5, 5, {0.8, 0.8});
  study::draw_grid(plan, {24.0, 39.6}, {12.0, 12.0}, 4, 1, {3.2, 1.6});
  study::draw_grid(plan, {24.0, 75.6}, {12.0, 12.0}, 4, 1, {3.2, 1.6});
  return plan;
}

/// The names of the plans, as command lines have them.
inline constexpr std::array<std::string_view, 5> study_plan_names{"rooms-32", "underground", "long-corridors", "room-cluster", "open-office"};

/// A plan by its name. Throws std::invalid_argument for another.
[[nodiscard]] inline incognita::FloorPlan study_plan(std::string_view name) {
  if (name == "rooms-32") return rooms_32();
  if (name == "underground") return underground();
  if (name == "long-corridors") return long_corridors();
  if (name == "room-cluster") return room_cluster();
  if (name == "open-office") return open_office();
  incognita::throw_invalid("study_plan", "the name", name, "one of study_plan_names");
}

}  // namespace examples
