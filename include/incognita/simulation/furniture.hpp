/// Furniture and columns for the rooms of a generated building, which a robot can drive around.
#pragma once

#include <algorithm>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/simulation/building_layout.hpp"
#include "incognita/simulation/building_params.hpp"

namespace incognita::detail {

/// Places boxes so that the floor stays in one piece: between a box and a wall or another box there is either no gap or one that the robot
/// passes; no box touches two opposite walls or another box, and none stands where somebody comes in by a door. So each is an island or a part
/// of the walls.
class Furnisher {
 public:
  Furnisher(const BuildingCells& cells, double furniture_share, Random& random)
      : cells_(cells), share_(furniture_share), random_(random) {}

  void furnish(BuildingRoom& room) {
    if (room.is_hall) {
      furnish_hall(room);
      return;
    }
    constexpr double empty_chance = 0.1;
    if (share_ == 0.0 || happens(random_, empty_chance)) return;
    const double style = random_.uniform();
    if (style < 0.25) place_table(room);
    if (style > 0.8) place_shelves(room);
    place_along_walls(room);
  }

 private:
  static constexpr double column_m = 0.5;
  static constexpr double aisle_m = 1.2;           // at least as wide are ways between furniture that stands in rows
  static constexpr double area_of_piece_m2 = 4.0;  // of a full room's floor for each piece that is tried

  /// Places a box if the floor stays in one piece.
  bool place(BuildingRoom& room, const IndexBox<2>& box) const {
    if (box.empty() || !room.floor.contains(box)) return false;
    for (int axis = 0; axis < 2; ++axis) {
      const int below = box.lower[axis] - room.floor.lower[axis];
      const int above = room.floor.upper[axis] - box.upper[axis];
      if (below == 0 && above == 0) return false;
      if ((below > 0 && below < cells_.passage) || (above > 0 && above < cells_.passage)) return false;
    }
    for (const IndexBox<2>& door : room.doors) {
      if (overlaps(box, door.padded(cells_.passage))) return false;
    }
    const IndexBox<2> around = box.padded(cells_.passage);
    for (const IndexBox<2>& other : room.obstacles) {
      if (overlaps(around, other)) return false;
    }
    room.obstacles.push_back(box);
    return true;
  }

  [[nodiscard]] static bool overlaps(const IndexBox<2>& a, const IndexBox<2>& b) {
    return (a.lower.array() < b.upper.array()).all() && (b.lower.array() < a.upper.array()).all();
  }

  /// A box of a size around a point in half cells.
  [[nodiscard]] static IndexBox<2> box_around(const Index<2>& twice_middle, const Index<2>& size) {
    const Index<2> lower((twice_middle.x() - size.x()) / 2, (twice_middle.y() - size.y()) / 2);
    return {lower, lower + size};
  }

  [[nodiscard]] Index<2> drawn_size(double length_min_m, double length_max_m, double depth_min_m, double depth_max_m) {
    const int length = std::max(1, cells_.of(random_.uniform(length_min_m, length_max_m)));
    const int depth = std::max(1, cells_.of(random_.uniform(depth_min_m, depth_max_m)));
    return {length, depth};
  }

  /// A table in the middle, along the room, with a way around it.
  void place_table(BuildingRoom& room) {
    const Index<2> extent = room.floor.extent();
    const int longer = extent.x() >= extent.y() ? 0 : 1;
    const int around = 2 * std::max(cells_.passage, cells_.of(0.9));
    Index<2> size = drawn_size(1.6, 5.0, 0.9, 1.6);
    if (longer == 1) std::swap(size[0], size[1]);
    place(room, box_around(room.floor.lower + room.floor.upper, size.cwiseMin((extent.array() - around).matrix())));
  }

  /// Desks, cabinets and boxes, most of them along walls.
  void place_along_walls(BuildingRoom& room) {
    const double area_m2 = room.floor.extent().prod() * cells_.resolution_m * cells_.resolution_m;
    const int tries = static_cast<int>(share_ * area_m2 / area_of_piece_m2 + random_.uniform());
    for (int i = 0; i < tries; ++i) {
      Index<2> size = happens(random_, 0.5) ? drawn_size(1.2, 2.0, 0.6, 0.9) : drawn_size(0.6, 2.4, 0.35, 0.5);
      const int axis = draw_between(random_, 0, 1);  // that the piece is longer along
      if (axis == 1) std::swap(size[0], size[1]);
      const Index<2> rest = room.floor.extent() - size;
      if (rest.minCoeff() < cells_.passage) continue;
      Index<2> at(draw_between(random_, 0, rest.x()), 0);
      at.y() = draw_between(random_, 0, rest.y());
      const double where = random_.uniform();
      if (where < 0.85) at[1 - axis] = happens(random_, 0.5) ? rest[1 - axis] : 0;  // its long side at a wall
      if (where < 0.35) at[axis] = happens(random_, 0.5) ? rest[axis] : 0;          // in a corner
      const Index<2> lower = room.floor.lower + at;
      place(room, {lower, lower + size});
    }
  }

  /// Shelves in rows, from the wall opposite of the first door.
  void place_shelves(BuildingRoom& room) {
    const IndexBox<2>& door = room.doors.front();
    const IndexBox<2>& floor = room.floor;
    const int across = door.upper.x() <= floor.lower.x() || door.lower.x() >= floor.upper.x() ? 0 : 1;
    const bool is_below = door.upper[across] <= floor.lower[across];
    const int aisle = std::max(cells_.passage, cells_.of(aisle_m));
    const int depth = std::max(1, cells_.of(0.5));
    IndexBox<2> shelf = floor;
    if (is_below) {
      shelf.lower[across] += aisle;
    } else {
      shelf.upper[across] -= aisle;
    }
    for (int at = floor.lower[1 - across]; at + depth <= floor.upper[1 - across]; at += depth + aisle) {
      shelf.lower[1 - across] = at;
      shelf.upper[1 - across] = at + depth;
      place(room, shelf);
    }
  }

  /// Columns in a regular grid; in the bays between them nothing, blocks, or long rows.
  void furnish_hall(BuildingRoom& hall) {
    const Index<2> extent = hall.floor.extent();
    const int spacing = cells_.of(random_.uniform(5.0, 8.0));
    const Index<2> bays(std::max(1, (extent.x() + spacing / 2) / spacing), std::max(1, (extent.y() + spacing / 2) / spacing));
    const int column = std::max(1, cells_.of(column_m));
    const auto line = [&](int axis, int twice_index) { return 2 * hall.floor.lower[axis] + twice_index * extent[axis] / bays[axis]; };
    for (int y = 1; y < bays.y(); ++y) {
      for (int x = 1; x < bays.x(); ++x) place(hall, box_around({line(0, 2 * x), line(1, 2 * y)}, {column, column}));
    }

    const double style = random_.uniform();
    if (style < 0.25) return;
    const int longer = extent.x() >= extent.y() ? 0 : 1;
    Index<2> size = drawn_size(1.6, 4.0, 0.8, 2.4);
    if (longer == 1) std::swap(size[0], size[1]);
    const bool has_rows = style > 0.7;
    const int margin = 2 * std::max(cells_.passage, cells_.of(aisle_m));
    for (int axis = 0; axis < 2; ++axis) size[axis] = std::min(size[axis], extent[axis] / bays[axis] - column - 2 * cells_.passage);
    if (size.minCoeff() < 1) return;
    if (has_rows) {
      // Rows of three bays with a way across after each.
      for (int row = 0; row < bays[1 - longer]; ++row) {
        for (int bay = 0; bay < bays[longer]; bay += 3) {
          if (!happens(random_, share_ + 0.3)) continue;
          const int last = std::min(bay + 3, bays[longer]);
          IndexBox<2> box;
          box.lower[longer] = line(longer, 2 * bay) / 2 + margin / 2;
          box.upper[longer] = line(longer, 2 * last) / 2 - margin / 2;
          box.lower[1 - longer] = (line(1 - longer, 2 * row + 1) - size[1 - longer]) / 2;
          box.upper[1 - longer] = box.lower[1 - longer] + size[1 - longer];
          place(hall, box);
        }
      }
      return;
    }
    for (int y = 0; y < bays.y(); ++y) {
      for (int x = 0; x < bays.x(); ++x) {
        if (happens(random_, share_)) place(hall, box_around({line(0, 2 * x + 1), line(1, 2 * y + 1)}, size));
      }
    }
  }

  const BuildingCells& cells_;
  double share_;
  Random& random_;
};

}  // namespace incognita::detail
