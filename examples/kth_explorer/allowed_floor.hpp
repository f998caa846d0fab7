/// The part of a building that a robot is asked to explore.
#pragma once

#include <utility>

#include "incognita/planning/allowed_area.hpp"
#include "incognita/simulation/world.hpp"

namespace kth_explorer {

/// The world with all that is not allowed made solid: what a robot that keeps to the area can reach, and see without looking across
/// what is not allowed. The area is in the plan's frame.
[[nodiscard]] inline incognita::World allowed_floor(const incognita::World& world, const incognita::AllowedArea& area) {
  using incognita::Offset;
  incognita::FloorPlan plan = world.plan();
  if (area.is_everywhere()) return world;
  for (Offset pixel = 0; pixel < static_cast<Offset>(plan.size()); ++pixel) {
    if (area.clearance_m(plan.lattice().center_m(plan.index_at(pixel))) > 0.0) continue;
    plan[pixel] = incognita::FloorCell::solid;
  }
  return incognita::World(std::move(plan));
}

}  // namespace kth_explorer
