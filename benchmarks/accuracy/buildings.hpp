/// Buildings that are hard on an estimator that likes straight walls along the axes.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace accuracy {

/// A raster of cells of 0.05 m from what lies at a point.
template <class CellAt>
[[nodiscard]] incognita::FloorPlan draw_plan(const Eigen::Vector2d& lower_m, const Eigen::Vector2d& upper_m,
                                             const CellAt& cell_at) {
  const incognita::Lattice<2> lattice(0.05, lower_m);
  incognita::FloorPlan plan(lattice, lattice.cells_of({lower_m, upper_m}), incognita::FloorCell::solid);
  for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(plan.size()); ++offset) {
    plan[offset] = cell_at(lattice.center_m(plan.index_at(offset)));
  }
  return plan;
}

/// The plan turned about its file's origin, each cell of the new raster as the nearest of the old one:
/// straight walls become staircases.
[[nodiscard]] inline incognita::FloorPlan turned_plan(const incognita::FloorPlan& plan, double turn_rad) {
  const double resolution_m = plan.lattice().resolution_m();
  const Eigen::Vector2d origin_m = plan.lattice().origin_m();
  const Eigen::Vector2d low_m = origin_m + resolution_m * plan.box().lower.cast<double>();
  const Eigen::Vector2d high_m = origin_m + resolution_m * plan.box().upper.cast<double>();
  const incognita::Pose2 turn{0.0, 0.0, turn_rad};
  Eigen::Vector2d lower_m = turn * low_m;
  Eigen::Vector2d upper_m = lower_m;
  for (const Eigen::Vector2d& corner_m :
       {Eigen::Vector2d(high_m.x(), low_m.y()), Eigen::Vector2d(low_m.x(), high_m.y()), high_m}) {
    lower_m = lower_m.cwiseMin(turn * corner_m);
    upper_m = upper_m.cwiseMax(turn * corner_m);
  }
  const incognita::Pose2 back = turn.inverse();
  return draw_plan(lower_m, upper_m, [&](const Eigen::Vector2d& at_m) {
    return plan.value(plan.lattice().index_of(back * at_m));
  });
}

/// A round room, a ring corridor of 2 m around it, and seven rooms around that: 24 m across, doors of 1.1 m.
[[nodiscard]] inline incognita::FloorPlan round_building() {
  constexpr int rooms = 7;
  constexpr double half_wall_m = 0.1;
  constexpr double half_door_m = 0.55;
  const auto cell_at = [](const Eigen::Vector2d& at_m) {
    using incognita::FloorCell;
    const double radius_m = at_m.norm();
    if (radius_m > 12.0) return radius_m > 12.0 + 2.0 * half_wall_m ? FloorCell::solid : FloorCell::wall;
    const double room_rad = 2.0 * std::numbers::pi / rooms;
    // From the wall between two rooms, and from the middle of a room, whichever is nearest.
    const double from_wall_rad = std::remainder(std::atan2(at_m.y(), at_m.x()), room_rad);
    const double from_middle_rad = 0.5 * room_rad - std::abs(from_wall_rad);
    const double from_door_m = radius_m * std::sin(from_middle_rad);
    if (std::abs(radius_m - 6.2) < half_wall_m && from_door_m > half_door_m) return FloorCell::wall;
    const bool is_inner_door = at_m.x() > 0.0 && std::abs(at_m.y()) < half_door_m;
    if (std::abs(radius_m - 4.1) < half_wall_m && !is_inner_door) return FloorCell::wall;
    const bool divides = radius_m > 6.2 && radius_m * std::abs(std::sin(from_wall_rad)) < half_wall_m;
    return divides ? FloorCell::wall : FloorCell::floor;
  };
  return draw_plan({-13.0, -13.0}, {13.0, 13.0}, cell_at);
}

/// Two wings at 30 degrees to each other, from a round hall: each a corridor of 2.2 m with four rooms on
/// either side, doors of 1.1 m.
[[nodiscard]] inline incognita::FloorPlan oblique_building() {
  using incognita::FloorCell;
  constexpr double wall_m = 0.2;
  constexpr double half_corridor_m = 1.1;
  constexpr double half_door_m = 0.55;
  constexpr double hall_m = 3.0;
  constexpr double room_m = 5.0;
  constexpr double length_m = hall_m + 4.0 * room_m;
  constexpr double half_width_m = 6.0;
  // A wing along the x axis.
  const auto wing_cell_at = [](const Eigen::Vector2d& at_m) {
    const double along_m = at_m.x() - hall_m;
    const double across_m = std::abs(at_m.y());
    if (at_m.x() < 0.0 || at_m.x() > length_m + wall_m || across_m > half_width_m + wall_m)
      return FloorCell::solid;
    if (across_m < half_corridor_m && at_m.x() < length_m) return FloorCell::floor;
    if (along_m < 0.0) return FloorCell::solid;
    if (at_m.x() > length_m || across_m > half_width_m) return FloorCell::wall;
    const double in_room_m = std::fmod(along_m, room_m);
    if (in_room_m < wall_m) return FloorCell::wall;
    const bool is_beside_corridor = across_m < half_corridor_m + wall_m;
    const bool is_door = std::abs(in_room_m - 0.5 * room_m) < half_door_m;
    return is_beside_corridor && !is_door ? FloorCell::wall : FloorCell::floor;
  };
  const incognita::Pose2 T_first_world{0.0, 0.0, -std::numbers::pi};
  const incognita::Pose2 T_second_world{0.0, 0.0, -std::numbers::pi / 6.0};
  const auto cell_at = [&](const Eigen::Vector2d& at_m) {
    const double radius_m = at_m.norm();
    const FloorCell first = wing_cell_at(T_first_world * at_m);
    const FloorCell second = wing_cell_at(T_second_world * at_m);
    if (radius_m < hall_m || first == FloorCell::floor || second == FloorCell::floor) return FloorCell::floor;
    const bool is_wall = first == FloorCell::wall || second == FloorCell::wall || radius_m < hall_m + wall_m;
    return is_wall ? FloorCell::wall : FloorCell::solid;
  };
  return draw_plan({-25.0, -9.0}, {25.0, 20.0}, cell_at);
}

}  // namespace accuracy
