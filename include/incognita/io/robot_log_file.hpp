/// Robot logs from files of any format that the library reads.
#pragma once

#include <filesystem>
#include <string>

#include "incognita/io/carmen_log.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/intel_json.hpp"
#include "incognita/io/robot_log.hpp"

namespace incognita {

/// Reads a log: .json is an object of scans by time, .log, .clf and .carmen are logs of CARMEN. Throws
/// InputError, and std::invalid_argument for bad parameters.
[[nodiscard]] inline RobotLog read_robot_log(const std::filesystem::path& file,
                                             const RobotLogParams& params = {}) {
  const std::string extension = file.extension().string();
  if (extension == ".json") return read_intel_json(file, params);
  if (extension == ".log" || extension == ".clf" || extension == ".carmen")
    return read_carmen_log(file, params);
  throw InputError(file,
                   "is not a robot's log: its name must end in .json or in .log, .clf or .carmen (CARMEN)");
}

}  // namespace incognita
