/// A building that a simulated robot drives in.
#pragma once

#include <utility>

#include "incognita/grid/floor_plan.hpp"
#include "incognita/sensor/obstacle_field.hpp"

namespace incognita {

/// A floor plan at its own resolution and in its file's frame, with exact ranges and collisions against its
/// pixels' squares: walls and what is solid stop robots and light alike, and outside of the plan everything
/// is solid. Immutable: safe from many threads.
class World : public ObstacleField {
 public:
  /// All but floor blocks. O(cells).
  explicit World(FloorPlan plan)
      : ObstacleField(plan, [](FloorCell cell) { return cell != FloorCell::floor; }),
        plan_(std::move(plan)) {}

  [[nodiscard]] const FloorPlan& plan() const { return plan_; }  ///< as given

 private:
  FloorPlan plan_;
};

}  // namespace incognita
