/// What a generated building is like, and its lengths in cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/core/random.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// An office building, by default. Lengths are rounded to whole cells.
struct BuildingParams {
  Point<2> size_m{55.0, 25.0};     ///< with the outer walls
  double resolution_m = 0.05;      ///< of the plan; at most sides_max_cells along an axis
  double robot_radius_m = 0.2;     ///< >= 0: a disc so large gets to every place where it fits
  double wall_m = 0.2;             ///< thickness, one cell or more
  double door_m = 0.9;             ///< width; wider than the robot by two cells or more. Those of halls are twice as wide
  double corridor_m = 2.0;         ///< width, at least that of a door
  double main_corridor_m = 3.0;    ///< width of those of large parts of a building, at least that of a corridor
  double room_side_min_m = 2.5;    ///< no room is narrower or shorter; wider than a door by two cells or more
  double room_depth_max_m = 7.0;   ///< away from the corridor, at least room_side_min_m; some rooms of small buildings are half as deep again
  double room_width_max_m = 12.0;  ///< along the corridor, at least room_side_min_m; the last of a row may be wider
  double hall_side_max_m = 40.0;   ///< > 0; halls are half as long again at most
  double hall_chance = 0.2;        ///< probability that a part of the building that may be a hall is one, 0 to 1
  double furniture_share = 0.5;    ///< 0, none, to 1, as much as there is room for

  static constexpr int sides_max_cells = 40000;  ///< 2 km at 0.05 m

  /// Throws std::invalid_argument for values out of their bounds, and for a building that is too small for two rooms with a corridor between.
  void validate() const;
};

namespace detail {

/// The lengths of a building in cells.
struct BuildingCells {
  explicit BuildingCells(const BuildingParams& params)
      : resolution_m(params.resolution_m),
        size(of(params.size_m.x()), of(params.size_m.y())),
        wall(of(params.wall_m)),
        // A gap of 2 radii and a cell holds a row of centres that a disc is clear on; one more for rounding.
        passage(static_cast<int>(std::ceil(2.0 * params.robot_radius_m / params.resolution_m)) + 2),
        door(of(params.door_m)),
        corridor(of(params.corridor_m)),
        main_corridor(of(params.main_corridor_m)),
        side_min(of(params.room_side_min_m)),
        depth_max(of(params.room_depth_max_m)),
        width_max(of(params.room_width_max_m)),
        hall_side_max(of(params.hall_side_max_m)) {}

  /// A length in metres in cells.
  [[nodiscard]] int of(double length_m) const {
    return static_cast<int>(std::lround(std::min(length_m / resolution_m, 2.0 * BuildingParams::sides_max_cells)));
  }

  double resolution_m;
  Index<2> size;
  int wall;
  int passage;  ///< the least gap that the robot passes
  int door;
  int corridor;
  int main_corridor;
  int side_min;
  int depth_max;
  int width_max;
  int hall_side_max;
};

/// Uniform in {low, ..., high}; low when there is nothing between.
[[nodiscard]] inline int draw_between(Random& random, int low, int high) {
  return high > low ? low + static_cast<int>(random.index(static_cast<std::uint64_t>(high - low) + 1)) : low;
}

/// Uniform between two shares of a length.
[[nodiscard]] inline int draw_share(Random& random, int length, double low, double high) {
  return static_cast<int>(random.uniform(low, high) * length);
}

/// True with a probability.
[[nodiscard]] inline bool happens(Random& random, double probability) { return random.uniform() < probability; }

}  // namespace detail

inline void BuildingParams::validate() const {
  const std::string where = "BuildingParams";
  require_positive(where, "resolution_m", resolution_m);
  require_non_negative(where, "robot_radius_m", robot_radius_m);
  for (int axis = 0; axis < 2; ++axis) {
    require_positive(where, "size_m", size_m[axis]);
    require(size_m[axis] <= sides_max_cells * resolution_m, where, "size_m", size_m[axis], "at most " + std::to_string(sides_max_cells) + " cells");
  }
  for (const auto& [field, length_m] : {std::pair{"wall_m", wall_m}, {"door_m", door_m}, {"corridor_m", corridor_m},
                                        {"main_corridor_m", main_corridor_m}, {"room_side_min_m", room_side_min_m},
                                        {"room_depth_max_m", room_depth_max_m}, {"room_width_max_m", room_width_max_m},
                                        {"hall_side_max_m", hall_side_max_m}}) {
    require_positive(where, field, length_m);
  }
  for (const auto& [field, share] : {std::pair{"hall_chance", hall_chance}, {"furniture_share", furniture_share}}) {
    require(share >= 0.0 && share <= 1.0, where, field, share, "0 to 1");
  }

  require(robot_radius_m <= sides_max_cells * resolution_m, where, "robot_radius_m", robot_radius_m, "smaller than the building");
  const detail::BuildingCells cells(*this);
  const auto at_least = [&](const char* field, double length_m, int length, int least, const std::string& why) {
    if (length >= least) return;
    std::ostringstream bound;
    bound << "at least " << least * resolution_m << ", " << why;
    throw_invalid(where, field, length_m, bound.str());
  };
  at_least("wall_m", wall_m, cells.wall, 1, "a cell");
  at_least("door_m", door_m, cells.door, cells.passage, "the robot's diameter and two cells");
  at_least("corridor_m", corridor_m, cells.corridor, cells.door, "the width of a door");
  at_least("main_corridor_m", main_corridor_m, cells.main_corridor, cells.corridor, "the width of a corridor");
  at_least("room_side_min_m", room_side_min_m, cells.side_min, cells.door + 2, "the width of a door and two cells");
  at_least("room_depth_max_m", room_depth_max_m, cells.depth_max, cells.side_min, "room_side_min_m");
  at_least("room_width_max_m", room_width_max_m, cells.width_max, cells.side_min, "room_side_min_m");
  for (int axis = 0; axis < 2; ++axis) {
    at_least("size_m", size_m[axis], cells.size[axis], 2 * cells.side_min + cells.corridor + 4 * cells.wall,
             "two rooms, a corridor between and four walls");
  }
}

}  // namespace incognita
