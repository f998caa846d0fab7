/// The worlds of the experiments, drawn for this project in the spirit of Figs. 5 and 7 of Sansoni et al.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "incognita/simulation/world.hpp"
#include "support/drawn_plan.hpp"

namespace uncertainty_frontiers {

/// A building with landmarks in it.
struct Place {
  incognita::World world;
  std::vector<Eigen::Vector2d> landmarks_m;
};

/// Corridors 2 m wide around a block, and two that lead away from it; landmarks where the robot starts, at the lower left.
[[nodiscard]] inline Place corridors() {
  using examples::Area;
  incognita::FloorPlan plan = examples::walled_floor(20.0, 13.4);
  const auto block = [&](const Area& area) { examples::draw(plan, area, incognita::FloorCell::wall); };
  block({{2.1, 2.1}, {9.9, 7.9}});     // inside the ring
  block({{12.0, 0.0}, {20.0, 7.9}});   // right of it
  block({{0.0, 10.0}, {9.9, 13.4}});   // above it
  block({{12.0, 10.0}, {20.0, 13.4}});
  return {incognita::World(std::move(plan)), {{0.1, 1.0}, {1.0, 0.1}, {2.6, 0.1}}};
}

/// The teleoperated way of Fig. 6: around the block, and on to where the left corridor begins.
[[nodiscard]] inline std::vector<Eigen::Vector2d> way_around() {
  return {{1.0, 1.1}, {11.0, 1.1}, {11.0, 9.0}, {1.3, 9.0}};
}

/// On from there: down the left corridor, which closes the loop, and up again.
[[nodiscard]] inline std::vector<Eigen::Vector2d> way_home() { return {{1.0, 9.0}, {1.0, 1.3}, {1.0, 9.0}, {8.0, 9.0}}; }

inline constexpr double hall_width_m = 32.0;
inline constexpr double hall_height_m = 18.0;

/// A closed rectangle, corridors on the left, open on the right, landmarks all along its walls, or without those of the open
/// half.
[[nodiscard]] inline Place hall(bool complete) {
  using examples::Along;
  incognita::FloorPlan plan = examples::walled_floor(hall_width_m, hall_height_m);
  for (const double y_m : {4.5, 9.0, 13.5}) examples::draw_wall(plan, Along::x, y_m, 4.0, 16.0, {});
  std::vector<Eigen::Vector2d> landmarks_m;
  const auto add = [&](double x_m, double y_m) {
    if (complete || x_m < 17.0) landmarks_m.emplace_back(x_m, y_m);
  };
  for (const double x_m : {2.0, 6.0, 10.0, 14.0, 18.0, 22.0, 26.0, 30.0}) {
    add(x_m, 0.1);
    add(x_m, hall_height_m - 0.1);
  }
  for (const double y_m : {4.5, 9.0, 13.5}) {
    add(0.1, y_m);
    add(hall_width_m - 0.1, y_m);
  }
  return {incognita::World(std::move(plan)), std::move(landmarks_m)};
}

/// P_1, above, and P_2, below.
[[nodiscard]] inline Eigen::Vector2d start_m(int which) { return {10.0, which == 1 ? 15.7 : 2.3}; }

}  // namespace uncertainty_frontiers
