/// A belief over the occupancy of the world as a file and in a picture.
#pragma once

#include <filesystem>

#include "incognita/geometry/pose2.hpp"
#include "incognita/io/belief_map_server.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"
#include "support/drawing.hpp"

namespace examples {

/// Unknown is a bluish grey, so that it is told from what is half known.
inline constexpr Color never_seen{0.78, 0.81, 0.85};

/// From white (free) to black (occupied).
[[nodiscard]] inline Color belief_color(float log_odds) {
  if (log_odds == 0.0F) return never_seen;
  const double free = 1.0 - incognita::probability_of_log_odds(static_cast<double>(log_odds));
  return {free, free, free};
}

/// Draws the cells from white (free) to black (occupied).
template <class Map>
void draw_belief(Drawing& drawing, const Map& map, const incognita::Pose2& T_world_map) {
  drawing.raster(map.grid(), T_world_map, [](const typename Map::State& state) { return belief_color(Map::CellType::log_odds(state)); });
}

/// The map as map_server takes it: free, occupied and unknown by the thresholds, cut to what says something.
template <class Map>
void write_map(const std::filesystem::path& yaml_file, const Map& map,
               const incognita::OccupancyThresholds& thresholds) {
  incognita::write_belief_map_server(yaml_file, map, {.thresholds = thresholds});
}

}  // namespace examples
