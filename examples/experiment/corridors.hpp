/// Which floor of a plan is corridor, and which is room.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/grid/components.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace experiment {

enum class FloorUse : std::uint8_t { none, room, corridor };

namespace detail {

/// For each cell, whether a count of the ones in the square of `side` cells whose lower corner is `shift` cells from it passes a test. Cells
/// beyond the grid are 0. O(cells).
template <class Test>
[[nodiscard]] inline incognita::Grid<std::uint8_t, 2> squares(const incognita::Grid<std::uint8_t, 2>& ones, int side, int shift, Test&& test) {
  using namespace incognita;
  const Index<2> lower = ones.box().lower;
  const Index<2> extent = ones.box().extent();
  const auto width = static_cast<std::size_t>(extent.x()) + 1;
  std::vector<std::int32_t> sums(width * (static_cast<std::size_t>(extent.y()) + 1), 0);
  const auto sum_to = [&](int x, int y) -> std::int32_t& {
    return sums[static_cast<std::size_t>(std::clamp(y, 0, extent.y())) * width + static_cast<std::size_t>(std::clamp(x, 0, extent.x()))];
  };
  for (int y = 0; y < extent.y(); ++y) {
    for (int x = 0; x < extent.x(); ++x) {
      sum_to(x + 1, y + 1) = sum_to(x, y + 1) + sum_to(x + 1, y) - sum_to(x, y) + ones.value(lower + Index<2>(x, y));
    }
  }
  Grid<std::uint8_t, 2> result(ones.lattice(), ones.box(), 0);
  for (int y = 0; y < extent.y(); ++y) {
    for (int x = 0; x < extent.x(); ++x) {
      const int from_x = x + shift;
      const int from_y = y + shift;
      const std::int32_t count = sum_to(from_x + side, from_y + side) - sum_to(from_x, from_y + side) - sum_to(from_x + side, from_y) + sum_to(from_x, from_y);
      result.set(lower + Index<2>(x, y), test(count) ? 1 : 0);
    }
  }
  return result;
}

/// Which obstacles are furniture or columns, by their labels: none longer than size_max_m, none as thin as a wall, and of full shape.
[[nodiscard]] inline std::vector<std::uint8_t> furniture(const incognita::FloorPlan& plan, const incognita::Components<2>& obstacles, double size_max_m) {
  using namespace incognita;
  constexpr double wall_max_m = 0.5;
  std::vector<IndexBox<2>> boxes(obstacles.sizes.size());
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (obstacles.labels[cell] == Components<2>::none) continue;
    const Index<2> index = plan.index_at(cell);
    IndexBox<2>& box = boxes[static_cast<std::size_t>(obstacles.labels[cell])];
    box = box.empty() ? IndexBox<2>{index, index + Index<2>(1, 1)} : enclosing_box(box, {index, index + Index<2>(1, 1)});
  }
  std::vector<std::uint8_t> is_furniture(boxes.size(), 0);
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    const Index<2> extent = boxes[n].extent();
    const double short_m = extent.minCoeff() * plan.resolution_m();
    const double long_m = extent.maxCoeff() * plan.resolution_m();
    const bool is_full = 2 * static_cast<long>(obstacles.sizes[n]) >= static_cast<long>(extent.x()) * extent.y();
    is_furniture[n] = short_m > wall_max_m && long_m <= size_max_m && is_full ? 1 : 0;
  }
  return is_furniture;
}

}  // namespace detail

/// Floor is corridor where no square of corridor_max_m, along the plan's axes, fits around it, and where such floor hangs together in a part that
/// is two and a half times as long as wide: its area over the square of its greatest width; else it is room. Furniture and columns up to that
/// size make no corridor of the floor beside them. O(cells).
[[nodiscard]] inline incognita::Grid<FloorUse, 2> floor_uses(const incognita::FloorPlan& plan, double corridor_max_m) {
  using namespace incognita;
  const Components<2> obstacles = connected_components(plan, Adjacency::corners, [](FloorCell cell) { return cell != FloorCell::floor; });
  const std::vector<std::uint8_t> is_furniture = detail::furniture(plan, obstacles, corridor_max_m);
  Grid<std::uint8_t, 2> open(plan.lattice(), plan.box(), 0);
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    const std::int32_t obstacle = obstacles.labels[cell];
    open[cell] = obstacle == Components<2>::none || is_furniture[static_cast<std::size_t>(obstacle)] != 0 ? 1 : 0;
  }
  const int side = std::max(1, static_cast<int>(std::lround(corridor_max_m / plan.resolution_m())));
  const auto corners = detail::squares(open, side, 0, [&](std::int32_t count) { return count == side * side; });
  const auto wide = detail::squares(corners, side, 1 - side, [](std::int32_t count) { return count > 0; });
  Grid<std::uint8_t, 2> narrow(plan.lattice(), plan.box(), 0);
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) narrow[cell] = open[cell] != 0 && wide[cell] == 0 ? 1 : 0;

  const Components<2> parts = connected_components(narrow, Adjacency::faces, [](std::uint8_t is_narrow) { return is_narrow != 0; });
  const Grid<float, 2> wall_m = distance_transform_m(open, [](std::uint8_t is_open) { return is_open == 0; });
  std::vector<float> half_width_m(parts.sizes.size(), 0.0F);
  const auto part_at = [&](Offset cell) { return static_cast<std::size_t>(parts.labels[cell]); };
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (parts.labels[cell] != Components<2>::none) half_width_m[part_at(cell)] = std::max(half_width_m[part_at(cell)], wall_m[cell]);
  }
  Grid<FloorUse, 2> uses(plan.lattice(), plan.box(), FloorUse::none);
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (plan[cell] != FloorCell::floor) continue;
    uses[cell] = FloorUse::room;
    if (parts.labels[cell] == Components<2>::none) continue;
    const double width_m = 2.0 * static_cast<double>(half_width_m[part_at(cell)]);
    const double area_m2 = static_cast<double>(parts.sizes[part_at(cell)]) * plan.resolution_m() * plan.resolution_m();
    if (area_m2 >= 2.5 * width_m * width_m) uses[cell] = FloorUse::corridor;
  }
  return uses;
}

}  // namespace experiment
