/// The rooms of a generated building: rows of them in each block, with doors to the corridors beside it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/simulation/building_layout.hpp"
#include "incognita/simulation/building_params.hpp"
#include "incognita/simulation/corridor_net.hpp"

namespace incognita::detail {

/// Fills blocks with rooms.
class RoomRows {
 public:
  RoomRows(const BuildingCells& cells, Random& random) : cells_(cells), random_(random) {}

  /// A hall, or one row of rooms, or two back to back.
  void fill(const BuildingBlock& block) {
    if (block.is_hall) {
      add_hall(block);
      return;
    }
    const int longer = block.long_axis();
    const auto faces_at = [&](int axis) { return block.has_corridor[static_cast<std::size_t>(axis)]; };
    const auto has_any = [&](int axis) { return faces_at(axis)[0] || faces_at(axis)[1]; };
    const int across = has_any(1 - longer) ? 1 - longer : longer;
    const auto [is_below, is_above] = faces_at(across);
    const int depth = block.floor.extent()[across];
    if (is_below && is_above && depth > cells_.depth_max && depth >= 2 * cells_.side_min + cells_.wall) {
      const int rest = depth - cells_.wall;
      const int lower = std::clamp(draw_share(random_, rest, 0.42, 0.58), cells_.side_min, rest - cells_.side_min);
      IndexBox<2> below = block.floor;
      IndexBox<2> above = block.floor;
      below.upper[across] = below.lower[across] + lower;
      above.lower[across] = below.upper[across] + cells_.wall;
      add_row(below, across, true, false);
      add_row(above, across, false, true);
    } else {
      add_row(block.floor, across, is_below, is_above);
    }
  }

  /// All rooms until now.
  [[nodiscard]] std::vector<BuildingRoom> take() { return std::move(rooms_); }

 private:
  static constexpr double door_distance_m = 15.0;   // between those of a hall, about
  static constexpr double two_doors_m = 9.0;        // rooms wider than this have two
  static constexpr double through_chance = 0.15;    // that a room has doors to both corridors
  static constexpr double joined_chance = 0.12;     // that a door joins two neighbours
  static constexpr double anteroom_chance = 0.3;    // that a deep room is one behind another
  static constexpr double jamb_m = 0.2;             // between a door and the corner beside it

  void add_hall(const BuildingBlock& block) {
    BuildingRoom hall{.floor = block.floor, .is_hall = true, .doors = {}, .obstacles = {}};
    for (int axis = 0; axis < 2; ++axis) {
      const int length = hall.floor.extent()[1 - axis];
      const int doors = std::max(1, length / cells_.of(door_distance_m));
      const int width = std::min(2 * cells_.door, length - 2);
      for (int side = 0; side < 2; ++side) {
        if (!block.has_corridor[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)]) continue;
        for (int i = 0; i < doors; ++i) {
          const int middle = hall.floor.lower[1 - axis] + (2 * i + 1) * length / (2 * doors);
          hall.doors.push_back(door_box(hall.floor, axis, side, middle - width / 2, width));
        }
      }
    }
    rooms_.push_back(std::move(hall));
  }

  /// Rooms side by side; `across` is the axis that points to their corridors.
  void add_row(const IndexBox<2>& row, int across, bool is_below, bool is_above) {
    const int along = 1 - across;
    const int depth = row.extent()[across];
    const int narrowest = std::max(cells_.side_min, depth * 2 / 5);
    int rest = row.extent()[along];
    int width = 0;
    int alike = 0;  // rooms still to come that are as wide as the last
    bool is_first = true;
    IndexBox<2> room = row;
    while (rest > 0) {
      if (alike-- <= 0) {
        // Most are narrow, and narrow ones come in series.
        const double u = random_.uniform();
        width = std::max(narrowest, cells_.side_min + static_cast<int>(u * u * (cells_.width_max - cells_.side_min)));
        alike = u < 0.6 ? draw_between(random_, 0, 4) : 0;
      }
      int taken = std::min(width, rest);
      if (rest - taken < narrowest + cells_.wall) {
        taken = rest >= 2 * narrowest + cells_.wall && rest > width ? (rest - cells_.wall) / 2 : rest;
        width = taken;
        alike = 1;
      }
      room.upper[along] = room.lower[along] + taken;
      const std::size_t before = rooms_.size();
      add_room(room, across, is_below, is_above);
      if (!is_first && happens(random_, joined_chance)) join(front_, before, along);
      front_ = before;
      is_first = false;
      rest -= taken + cells_.wall;
      room.lower[along] = room.upper[along] + cells_.wall;
    }
  }

  /// One room, or two of which the second is entered through the first; the first is that at the corridor.
  void add_room(IndexBox<2> floor, int across, bool is_below, bool is_above) {
    const bool is_through = is_below && is_above && happens(random_, through_chance);
    int side = is_below ? 0 : 1;
    if (is_below && is_above && happens(random_, 0.5)) side = 1;
    const int rest = floor.extent()[across] - cells_.wall;
    const bool has_back = !is_through && rest >= 2 * cells_.side_min && happens(random_, anteroom_chance);
    IndexBox<2> back = floor;
    if (has_back) {
      const int front_depth = std::clamp(draw_share(random_, rest, 0.4, 0.6), cells_.side_min, rest - cells_.side_min);
      if (side == 0) {
        floor.upper[across] = floor.lower[across] + front_depth;
        back.lower[across] = floor.upper[across] + cells_.wall;
      } else {
        floor.lower[across] = floor.upper[across] - front_depth;
        back.upper[across] = floor.lower[across] - cells_.wall;
      }
    }
    BuildingRoom room{.floor = floor, .is_hall = false, .doors = {}, .obstacles = {}};
    add_doors(room, across, side);
    if (is_through) add_doors(room, across, 1 - side);
    if (has_back) {
      BuildingRoom behind{.floor = back, .is_hall = false, .doors = {}, .obstacles = {}};
      behind.doors.push_back(drawn_door(floor, across, 1 - side, floor.lower[1 - across], floor.upper[1 - across]));
      room.doors.push_back(behind.doors.back());
      rooms_.push_back(std::move(room));
      rooms_.push_back(std::move(behind));
    } else {
      rooms_.push_back(std::move(room));
    }
  }

  /// One door in the wall at a side of a room, or one at either end of a long wall.
  void add_doors(BuildingRoom& room, int across, int side) {
    const int low = room.floor.lower[1 - across];
    const int high = room.floor.upper[1 - across];
    if (high - low > cells_.of(two_doors_m) && happens(random_, 0.5)) {
      const int third = (high - low) / 3;
      room.doors.push_back(drawn_door(room.floor, across, side, low, low + third));
      room.doors.push_back(drawn_door(room.floor, across, side, high - third, high));
    } else {
      room.doors.push_back(drawn_door(room.floor, across, side, low, high));
    }
  }

  /// A door between two rooms of a row, where they lie side by side.
  void join(std::size_t first, std::size_t second, int along) {
    BuildingRoom& a = rooms_[first];
    BuildingRoom& b = rooms_[second];
    const int low = std::max(a.floor.lower[1 - along], b.floor.lower[1 - along]);
    const int high = std::min(a.floor.upper[1 - along], b.floor.upper[1 - along]);
    if (high - low < cells_.door + 2) return;
    const IndexBox<2> door = drawn_door(a.floor, along, 1, low, high);
    a.doors.push_back(door);
    b.doors.push_back(door);
  }

  /// A door between low and high along a wall, most often beside one of its ends.
  [[nodiscard]] IndexBox<2> drawn_door(const IndexBox<2>& floor, int across, int side, int low, int high) {
    const int width = std::min(cells_.door, high - low);
    const int spare = high - low - width;
    const int jamb = std::min(std::max(1, cells_.of(jamb_m)), spare / 2);
    const double u = random_.uniform();
    int at = low + jamb;
    if (u > 0.4) at = high - jamb - width;
    if (u > 0.8) at = draw_between(random_, low + jamb, high - jamb - width);
    return door_box(floor, across, side, at, width);
  }

  /// The gap in a wall: `across` is the axis that leads through it.
  [[nodiscard]] IndexBox<2> door_box(const IndexBox<2>& floor, int across, int side, int at, int width) const {
    IndexBox<2> door;
    door.lower[1 - across] = at;
    door.upper[1 - across] = at + width;
    door.lower[across] = side == 0 ? floor.lower[across] - cells_.wall : floor.upper[across];
    door.upper[across] = door.lower[across] + cells_.wall;
    return door;
  }

  const BuildingCells& cells_;
  Random& random_;
  std::vector<BuildingRoom> rooms_;
  std::size_t front_ = 0;  // the room at the corridor that was added before the last
};

}  // namespace incognita::detail
