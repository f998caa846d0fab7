/// The maps of a study as worlds.
#pragma once

#include <cstdint>

#include "experiment/corridors.hpp"
#include "experiment/plans.hpp"
#include "experiment/study.hpp"
#include "incognita/io/checksum.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/simulation/world.hpp"

namespace experiment {

/// A floor plan that missions drive in, and what its floor is used for.
struct Arena {
  incognita::World world;
  incognita::Grid<FloorUse, 2> uses;  ///< empty where nothing is asked of corridors
  std::uint32_t checksum;  ///< of the plan's pixels

  explicit Arena(const StudyMap& map) : world(load_plan(map)), uses(map.corridor_max_m ? floor_uses(world.plan(), *map.corridor_max_m) : incognita::Grid<FloorUse, 2>(world.plan().lattice())) {
    incognita::StateWriter writer;
    writer(world.plan());
    checksum = incognita::checksum(writer.bytes());
  }
};

}  // namespace experiment
