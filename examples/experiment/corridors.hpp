/// Which floor of a plan is corridor, and which is room.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/grid/components.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace experiment {

enum class FloorUse : std::uint8_t { none, room, corridor };

/// Floor that keeps further than half of door_max_m from walls falls apart at doors. A part is a corridor where it is at least four times
/// as long as wide: area over width squared, its width twice the greatest distance to a wall; else it is a room. Floor nearer to walls, in
/// doors too, is of the part that reaches it first. O(cells).
[[nodiscard]] inline incognita::Grid<FloorUse, 2> floor_uses(const incognita::FloorPlan& plan, double door_max_m) {
  using namespace incognita;
  const Grid<float, 2> wall_m = distance_transform_m(plan, [](FloorCell cell) { return cell != FloorCell::floor; });
  const auto deep_m = static_cast<float>(0.5 * door_max_m + plan.resolution_m());
  const Components<2> parts = connected_components(wall_m, Adjacency::faces, [&](float m) { return m > deep_m; });
  std::vector<float> half_width_m(parts.sizes.size(), 0.0F);
  const auto part_at = [&](Offset cell) { return static_cast<std::size_t>(parts.labels[cell]); };
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (parts.labels[cell] != Components<2>::none) half_width_m[part_at(cell)] = std::max(half_width_m[part_at(cell)], wall_m[cell]);
  }
  Grid<FloorUse, 2> uses(plan.lattice(), plan.box(), FloorUse::none);
  std::vector<Index<2>> edge;
  for (Offset cell = 0; cell < static_cast<Offset>(plan.size()); ++cell) {
    if (parts.labels[cell] == Components<2>::none) continue;
    const double width_m = 2.0 * static_cast<double>(half_width_m[part_at(cell)]);
    // The part lacks deep_m on each side.
    const double inner_m = std::max(width_m - 2.0 * static_cast<double>(deep_m), plan.resolution_m());
    const double area_m2 = static_cast<double>(parts.sizes[part_at(cell)]) * plan.resolution_m() * plan.resolution_m();
    const double length_m = area_m2 / inner_m;
    uses[cell] = length_m >= 4.0 * width_m ? FloorUse::corridor : FloorUse::room;
    edge.push_back(uses.index_at(cell));
  }
  for (std::vector<Index<2>> next; !edge.empty(); edge.swap(next), next.clear()) {
    for (const Index<2>& cell : edge) {
      for (const Index<2>& step : neighbor_steps<2>(Adjacency::faces)) {
        const Index<2> beside = sum(cell, step);
        if (!uses.contains(beside) || uses.value(beside) != FloorUse::none || plan.value(beside) != FloorCell::floor) continue;
        uses.set(beside, uses.value(cell));
        next.push_back(beside);
      }
    }
  }
  return uses;
}

}  // namespace experiment
