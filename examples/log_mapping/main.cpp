// Maps a log of a real robot, scans and odometry, and reports how well that went.
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/robot_log_file.hpp"
#include "log_mapping/evaluation.hpp"
#include "log_mapping/mapping.hpp"
#include "log_mapping/options.hpp"
#include "log_mapping/results.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace log_mapping {
namespace {

void print_table(const nlohmann::ordered_json& metrics, const std::filesystem::path& folder) {
  for (const char* key :
       {"scans", "duration_s", "distance_m", "relations_matched", "relations_translation_mean_m",
        "relations_rotation_mean_deg", "ate_rmse_m", "lost_scans", "wall_time_s", "real_time_factor"}) {
    const auto& value = metrics.at(key);
    if (value.is_null()) continue;
    std::printf("  %-28s %.6g\n", key, value.get<double>());
  }
  std::printf("Results are in %s\n", folder.string().c_str());
}

Trajectory odometry_of(const incognita::RobotLog& log) {
  Trajectory trajectory;
  for (const incognita::LogScan& scan : log.scans) trajectory.push_back({scan.time_s, scan.T_odom_robot});
  return trajectory;
}

void run(const Options& options) {
  using namespace incognita;
  // All input is read before anything is written.
  const RobotLog log = read_robot_log(options.log_file, options.log);
  Trajectory reference;
  if (!options.reference_file.empty())
    reference = odometry_of(read_intel_json(options.reference_file, options.log));
  std::vector<PoseRelation> relations;
  if (!options.relations_file.empty()) relations = read_relations(options.relations_file);
  examples::OutputFolder output(options.output,
                                {"metrics.json", "trajectory_estimated.tum", "trajectory_odometry.tum",
                                 "trajectory_reference.tum", "map.yaml", "map.png", "overview.png"});

  MapParams map_params;
  map_params.resolution_m = options.resolution_m;
  LoopClosingDvlEkf::Params filter_params = log_filter_params();
  filter_params.start.pose = Pose2{0.0, 0.0, wrap_angle_rad(options.frame_angle_rad)} * log.T_robot_laser;
  filter_params.uses_compass = options.compass == "on";
  filter_params.loops.closes_loops = options.loops == "on";
  LogSlam slam{LoopClosingDvlEkf(filter_params), Map<>(map_params)};
  const MappingRecord record = map_log(log, options.log_file, slam);

  Evaluation evaluation;
  if (!relations.empty()) {
    const auto error = [&](const Trajectory& trajectory) {
      const Stamped stamped(trajectory);
      return relations_error(stamped.times_s, stamped.poses, relations);
    };
    evaluation.relations = error(record.estimated);
    evaluation.odometry_relations = error(record.odometry);
  }
  if (!reference.empty()) evaluation.reference = compare(record.estimated, reference, options.reference_file);

  const OccupancyThresholds thresholds;
  const nlohmann::ordered_json metrics = metrics_json(options, log, record, evaluation);
  write_file_atomically(output.staged("metrics.json"), metrics.dump(2) + "\n");
  write_tum(output.staged("trajectory_estimated.tum"), record.estimated);
  write_tum(output.staged("trajectory_odometry.tum"), record.odometry);
  if (evaluation.reference)
    write_tum(output.staged("trajectory_reference.tum"), evaluation.reference->reference);
  examples::write_map(output.staged("map.yaml"), slam.map(), thresholds);
  draw_overview(output.staged("overview.png"), slam.map(), record, evaluation, thresholds);
  output.publish();
  if (!options.quiet) print_table(metrics, output.path());
}

}  // namespace
}  // namespace log_mapping

int main(int argc, char** argv) {
  CLI::App app(
      "Maps the log of a robot with a planar laser by its raw odometry and its scans. Writes metrics.json, "
      "map.yaml\n"
      "and map.png, overview.png and trajectory_estimated.tum, trajectory_odometry.tum and, with a "
      "reference,\n"
      "trajectory_reference.tum (turned and shifted onto the estimate), all in the frame of the map, which "
      "is\n"
      "the robot's first pose.");
  return examples::run_program("log_mapping", app,
                               [&] { log_mapping::run(log_mapping::parse_options(app, argc, argv)); });
}
