/// Missions that stop and go on: what the simulation and the results add to an explorer's own file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

#include "incognita/io/input_error.hpp"
#include "incognita/io/mission_file.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/simulation/simulator.hpp"
#include "kth_explorer/options.hpp"
#include "support/mission.hpp"
#include "support/output_folder.hpp"
#include "support/steering.hpp"

namespace kth_explorer {

/// The name of the floor plan, without the folder that it lies in.
[[nodiscard]] inline std::string map_name(const Options& options) {
  return options.map_file.empty() ? "embedded" : std::filesystem::path(options.map_file).filename().string();
}

/// What a mission that goes on must have in common with the one that was saved, beside the explorer's parameters.
struct MissionIdentity {
  std::string map;
  std::uint64_t seed;
  std::string controller;
  std::uint32_t floor_checksum;  ///< of the plan's pixels
  incognita::Pose2 T_start_world;

  MissionIdentity(const Options& options, const incognita::Simulator& simulator)
      : map(map_name(options)), seed(options.seed), controller(options.controller), T_start_world(simulator.T_start_world()) {
    incognita::StateWriter floor;
    floor(simulator.world().plan());
    floor_checksum = incognita::checksum(floor.bytes());
  }

  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("map, seed, controller, floor_checksum, T_start_world", map, seed, controller, floor_checksum, T_start_world);
  }
};

/// The simulator, the record and who steers, and that they belong together.
struct SimulatedPart {
  MissionIdentity identity;
  incognita::Simulator simulator;
  examples::MissionRecord record;
  examples::Steering steering;

  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("mission", identity);
    archive(simulator, record, steering);
  }
};

/// The content of the file of a mission.
template <class Explorer>
[[nodiscard]] std::string saved_mission(const Options& options, const Explorer& explorer, const incognita::Simulator& simulator,
                                        const examples::MissionRecord& record, const examples::Steering& steering) {
  incognita::StateWriter writer;
  writer(SimulatedPart{{options, simulator}, simulator, record, steering});
  incognita::StateWriter application;
  application(writer.parameters(), writer.bytes());
  return incognita::encode_mission(explorer, application.bytes());
}

/// Makes the explorer, the simulator and the steering those of options.resume_file, and returns the record. Throws InputError when it cannot be gone on
/// with.
template <class Explorer>
[[nodiscard]] examples::MissionRecord resumed_mission(const Options& options, Explorer& explorer, incognita::Simulator& simulator, examples::Steering& steering) {
  const std::string application = incognita::load_mission(options.resume_file, explorer);
  std::string parameters;
  std::string bytes;
  incognita::StateReader sections(application, "", options.resume_file);
  sections(parameters, bytes);
  sections.require_end();
  incognita::StateReader reader(bytes, parameters, options.resume_file);
  SimulatedPart part{{options, simulator}, simulator, {}, steering};
  reader(part);
  reader.require_end();
  if (part.simulator.time_s() > options.duration_s) {
    throw incognita::InputError(options.resume_file, "has lasted " + std::to_string(part.simulator.time_s()) +
                                                         " s, more than --duration asks for");
  }
  simulator = std::move(part.simulator);
  steering = std::move(part.steering);
  return std::move(part.record);
}

/// Throws OutputError when it is known before the mission that it could not be saved.
inline void require_place_to_save(const Options& options) {
  if (options.save_file.empty()) return;
  const std::filesystem::path file = std::filesystem::absolute(options.save_file).lexically_normal();
  const std::filesystem::path output = std::filesystem::absolute(options.output).lexically_normal();
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw examples::OutputError("cannot write " + options.save_file + ": it is a folder");
  if (file.parent_path() == output || std::filesystem::is_directory(file.parent_path(), ignored)) return;
  throw examples::OutputError("cannot write " + options.save_file + ": its folder is not there");
}

}  // namespace kth_explorer
