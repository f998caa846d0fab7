/// The files that a mapped log leaves.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "incognita/io/robot_log.hpp"
#include "log_mapping/evaluation.hpp"
#include "log_mapping/mapping.hpp"
#include "log_mapping/options.hpp"
#include "support/belief_output.hpp"
#include "support/drawing.hpp"

namespace log_mapping {

/// What is not known is null.
[[nodiscard]] inline nlohmann::ordered_json metrics_json(const Options& options,
                                                         const incognita::RobotLog& log,
                                                         const MappingRecord& record,
                                                         const Evaluation& evaluation) {
  nlohmann::ordered_json json;
  const auto file_name = [](const std::string& file) {
    return file.empty() ? nlohmann::ordered_json()
                        : nlohmann::ordered_json(std::filesystem::path(file).filename().string());
  };
  json["log"] = file_name(options.log_file);
  json["reference"] = file_name(options.reference_file);
  json["relations"] = file_name(options.relations_file);
  json["scans"] = log.scans.size();
  json["beams"] = log.beams.directions.size();
  json["duration_s"] = log.duration_s();
  json["distance_m"] = record.distance_m;
  const auto add_relations = [&](const std::string& prefix,
                                 const std::optional<incognita::RelationsError>& error) {
    for (const char* key : {"translation_mean_m", "rotation_mean_deg"}) json[prefix + key] = nullptr;
    if (!error || error->matched == 0) return;
    json[prefix + "translation_mean_m"] = error->translation_mean_m;
    json[prefix + "rotation_mean_deg"] = error->rotation_mean_rad / rad_per_deg;
  };
  json["relations_matched"] = nullptr;
  if (evaluation.relations) json["relations_matched"] = evaluation.relations->matched;
  add_relations("relations_", evaluation.relations);
  add_relations("odometry_relations_", evaluation.odometry_relations);
  json["ate_rmse_m"] = nullptr;
  if (evaluation.reference) json["ate_rmse_m"] = evaluation.reference->ate_rmse_m;
  json["lost_scans"] = record.lost_scans;
  json["wall_time_s"] = record.wall_time_s;
  json["real_time_factor"] = log.duration_s() / record.wall_time_s;
  json["compass"] = options.compass;
  json["loops"] = options.loops;
  json["resolution_m"] = options.resolution_m;
  json["frame_angle_deg"] = options.frame_angle_rad / rad_per_deg;
  json["laser_x_m"] = log.T_robot_laser.x_m;
  json["laser_y_m"] = log.T_robot_laser.y_m;
  json["laser_yaw_deg"] = log.T_robot_laser.yaw_rad / rad_per_deg;
  json["no_return_m"] = log.limits.no_return_m;  // infinite, which JSON calls null, where the log has no code
  json["no_return_is"] = options.log.no_return_is_clear ? "clear" : "invalid";
  json["usable_range_m"] = log.limits.usable_m;
  return json;
}

/// The belief with the estimated path and the aligned reference, cut to the walls and the path.
template <class Map>
void draw_overview(const std::filesystem::path& file, const Map& map, const MappingRecord& record,
                   const Evaluation& evaluation, const incognita::OccupancyThresholds& thresholds) {
  using namespace incognita;
  using examples::Color;
  using examples::Swatch;
  constexpr Color estimated_path{0.1, 0.3, 0.85};
  constexpr Color reference_path{0.1, 0.6, 0.2};
  constexpr Color start{0.75, 0.1, 0.6};

  const auto points = [](const Trajectory& trajectory) {
    std::vector<Point<2>> points_m;
    for (const TimedPose2& timed : trajectory) points_m.push_back(timed.pose.position());
    return points_m;
  };
  const std::vector<Point<2>> estimated_m = points(record.estimated);
  Box<Point<2>> world_m{estimated_m.front(), estimated_m.front()};
  for (const Point<2>& point_m : estimated_m) world_m.stretch_to(point_m);
  for (Offset cell = 0; cell < static_cast<Offset>(map.grid().size()); ++cell) {
    if (thresholds.classify(map.log_odds(cell)) != Occupancy::occupied) continue;
    world_m.stretch_to(map.lattice().center_m(map.grid().index_at(cell)));
  }
  const Point<2> margin_m = Point<2>::Constant(0.5);
  examples::Drawing drawing({world_m.lower - margin_m, world_m.upper + margin_m});
  examples::draw_belief(drawing, map, Pose2{});
  std::vector<examples::LegendEntry> legend{{"believed occupied", {0.0, 0.0, 0.0}, Swatch::area},
                                            {"free", {1.0, 1.0, 1.0}, Swatch::area},
                                            {"never seen", examples::never_seen, Swatch::area},
                                            {"estimated path", estimated_path, Swatch::line}};
  if (evaluation.reference) {
    drawing.polyline(points(evaluation.reference->reference), reference_path, 3.0);
    legend.push_back({"reference path, aligned", reference_path, Swatch::line});
  }
  drawing.polyline(estimated_m, estimated_path, 1.5);
  drawing.marker(estimated_m.front(), start);
  drawing.text(estimated_m.front(), "start", start);
  drawing.legend(legend);
  drawing.write_png(file);
}

}  // namespace log_mapping
