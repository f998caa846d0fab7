/// The maps of a study as worlds.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "experiment/corridors.hpp"
#include "experiment/plans.hpp"
#include "experiment/study.hpp"
#include "incognita/io/checksum.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/world.hpp"

namespace experiment {

/// A floor plan that missions drive in, what its floor is used for, and what of it can be seen.
class Arena {
 public:
  incognita::World world;
  incognita::Grid<FloorUse, 2> uses;  ///< empty where nothing is asked of corridors
  std::uint32_t checksum;  ///< of the plan's pixels, and where they lie

  explicit Arena(const StudyMap& map)
      : world(load_plan(map)),
        uses(map.corridor_max_m ? floor_uses(world.plan(), *map.corridor_max_m) : incognita::Grid<FloorUse, 2>(world.plan().lattice())) {
    incognita::StateWriter writer;
    const auto& lattice = world.plan().lattice();
    writer(world.plan(), lattice.resolution_m(), lattice.origin_m().x(), lattice.origin_m().y());
    checksum = incognita::checksum(writer.bytes());
  }

  /// The floor that a robot can see of what it can reach from a start, which must be one of start_of_trial(): these lie in one region, so that
  /// it is found once for all. The reference is good as long as the arena. Safe from many threads.
  [[nodiscard]] const incognita::Grid<std::uint8_t, 2>& visible_floor(const Eigen::Vector2d& start_m, double radius_m, double range_max_m) const {
    const std::lock_guard lock(visible_->mutex);
    const auto found = visible_->floors.find({radius_m, range_max_m});
    if (found != visible_->floors.end()) return found->second;
    auto visible = incognita::visible_floor(world, start_m, radius_m, range_max_m);
    return visible_->floors.emplace(std::pair(radius_m, range_max_m), std::move(visible)).first->second;
  }

 private:
  struct VisibleFloors {
    std::mutex mutex;
    std::map<std::pair<double, double>, incognita::Grid<std::uint8_t, 2>> floors;  ///< by radius and range
  };
  std::unique_ptr<VisibleFloors> visible_ = std::make_unique<VisibleFloors>();
};

}  // namespace experiment
