/// Floor plans from files of any format that the library reads.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/grid/floor_plan.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/io/map_server.hpp"

namespace incognita {

/// Reads a floor plan: .yaml or .yml is a map_server map, .xml a KTH floor (at 0.05 m a pixel). Throws
/// InputError.
[[nodiscard]] inline FloorPlan read_floor_plan(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".yaml" || extension == ".yml") return floor_plan_of(read_map_server(file));
  if (extension == ".xml") return read_kth_xml(file);
  throw InputError(file,
                   "is not a floor plan: its name must end in .yaml, .yml (ROS map_server) or .xml (KTH)");
}

}  // namespace incognita
