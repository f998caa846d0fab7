/// Beliefs to ROS map_server maps, and back as the prior of a new map.
#pragma once

#include <filesystem>
#include <utility>

#include "incognita/io/belief.hpp"
#include "incognita/io/map_server.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/prior.hpp"

namespace incognita {

/// How a belief is written as a map_server map.
struct BeliefImageParams {
  MapMode mode = MapMode::trinary;      ///< what pixels say
  MapImage format = MapImage::png;      ///< of the image
  OccupancyThresholds thresholds = {};  ///< of trinary mode
};

/// Writes a belief as `yaml_file` and an image of the same name beside it, cut to the cells that say
/// something, in the map's frame:
/// - trinary: free, occupied and unknown by the thresholds; what navigation takes;
/// - scale: the probability to 1/510, unknown transparent, hence PNG;
/// - raw: the probability in percent, unknown 255.
/// Throws as write_map_server does: InputError when a file cannot be written, std::invalid_argument for a map
/// that says nothing, bad thresholds, or unknown cells in scale mode as PGM.
template <class Cell>
void write_belief_map_server(const std::filesystem::path& yaml_file, const Map<Cell, 2>& map,
                             const BeliefImageParams& params = {}) {
  if (params.mode != MapMode::trinary) {
    write_map_server(yaml_file, belief_probabilities(map), params.mode, params.format);
    return;
  }
  write_map_server(
      yaml_file, belief_occupancy(map, params.thresholds),
      [](Occupancy occupancy) {
        if (occupancy == Occupancy::unknown) return unknown_probability;
        return occupancy == Occupancy::occupied ? 1.0F : 0.0F;
      },
      MapMode::trinary, params.format);
}

/// A map that believes a map_server map, of any mode, resolution and origin, before its first scan; see
/// map_with_prior. Throws InputError, and std::invalid_argument for bad parameters.
template <class Cell = TBayes>
[[nodiscard]] Map<Cell, 2> read_prior_map_server(const std::filesystem::path& yaml_file,
                                                 const MapParams& map_params = {},
                                                 const PriorParams& prior = {}, Cell cell = Cell{}) {
  return map_with_prior<Cell>(read_map_server(yaml_file), map_params, prior, std::move(cell));
}

}  // namespace incognita
