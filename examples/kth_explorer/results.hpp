/// The files that a mission leaves.
#pragma once

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "incognita/io/atomic_file.hpp"
#include "incognita/io/tum.hpp"
#include "incognita/planning/allowed_area.hpp"
#include "kth_explorer/options.hpp"
#include "kth_explorer/saved_mission.hpp"
#include "support/belief_output.hpp"
#include "support/drawing.hpp"
#include "support/mission.hpp"

namespace kth_explorer {

/// Values separated by commas, to six digits; NaN is left empty.
class CsvText {
 public:
  explicit CsvText(const char* header) : text_(std::string(header) + '\n') {}

  void row(std::initializer_list<double> values) {
    const char* separator = "";
    for (const double value : values) {
      char number[32] = "";
      if (!std::isnan(value)) std::snprintf(number, sizeof number, "%.6g", value);
      text_ += separator;
      text_ += number;
      separator = ",";
    }
    text_ += '\n';
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

[[nodiscard]] inline std::string decisions_csv(const examples::MissionRecord& record) {
  CsvText csv("time_s,candidates,goal_x_m,goal_y_m,big_nats,runner_up_big_nats,evaluation_time_s");
  for (const examples::DecisionRecord& d : record.decisions) {
    csv.row({d.time_s, static_cast<double>(d.candidates), d.goal_m.x(), d.goal_m.y(), d.gain_nats,
             d.runner_up_gain_nats, d.evaluation_time_s});
  }
  return csv.text();
}

/// The entropy counts the cells that the map touches in the end, so that it only falls.
[[nodiscard]] inline std::string progress_csv(const examples::MissionRecord& record) {
  CsvText csv("time_s,explored_fraction,map_entropy_bits,position_error_m,three_sigma_m,nees,distance_m");
  const double start_bits = static_cast<double>(record.touched_cells);
  for (const examples::ProgressRecord& p : record.progress) {
    csv.row({p.time_s, p.explored_fraction, start_bits - p.entropy_drop_nats / std::numbers::ln2, p.position_error_m,
             p.three_sigma_m, p.nees, p.distance_m});
  }
  return csv.text();
}

[[nodiscard]] inline nlohmann::ordered_json metrics_json(const examples::MissionRecord& record, const Options& options) {
  nlohmann::ordered_json json;
  // Parameters come before duration_s, results from there on: by this order plot tells what runs differ in.
  json["map"] = map_name(options);
  json["seed"] = options.seed;
  json["cells"] = options.cells;
  json["frontiers"] = options.frontiers;
  json["entropy"] = options.entropy;
  json["alpha"] = options.entropy == "shannon" ? nlohmann::ordered_json() : nlohmann::ordered_json(options.alpha);
  json["filter"] = options.filter;
  json["compass"] = options.compass;
  json["loops"] = options.loops;
  json["controller"] = options.controller;
  json["robot_radius_m"] = options.robot_radius_m;
  json["strategy"] = options.strategy;
  json["information"] = options.information;
  json["navigation"] = options.navigation;
  json["resolution_m"] = options.resolution_m;
  json["duration_s"] = record.duration_s;
  json["scans"] = record.scans;
  json["distance_m"] = record.distance_m;
  json["collisions"] = record.collisions;
  json["decisions"] = record.decisions.size();
  json["stop_reason"] = std::string(to_string(record.stop_reason));
  json["returned"] = record.has_returned ? nlohmann::ordered_json(*record.has_returned) : nlohmann::ordered_json();
  json["return_distance_m"] = record.has_returned ? nlohmann::ordered_json(record.return_distance_m) : nlohmann::ordered_json();
  json["translation_rmse_m"] = record.trajectory_error.translation_rmse_m();
  json["translation_mae_m"] = record.trajectory_error.translation_mae_m();
  json["heading_rmse_rad"] = record.trajectory_error.heading_rmse_rad();
  json["nees_mean"] = record.nees.count() == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(record.nees.position());
  json["map_error"] = record.map_error;
  json["map_uncertainty_bits_per_step"] = record.map_uncertainty_bits_per_step;
  json["explored_fraction"] = record.explored_fraction;
  const examples::ProgressRecord* const most = record.first_with_explored(0.9);
  json["time_to_90_percent_s"] = most == nullptr ? nlohmann::ordered_json() : nlohmann::ordered_json(most->time_s);
  json["distance_to_90_percent_m"] = most == nullptr ? nlohmann::ordered_json() : nlohmann::ordered_json(most->distance_m);
  json["touched_cells"] = record.touched_cells;
  json["explored_area_m2"] = record.explored_fraction * record.floor_area_m2;
  json["wall_time_s"] = record.wall_time_s;
  json["real_time_factor"] = record.duration_s / record.wall_time_s;
  json["threads"] = incognita::worker_count(options.threads);
  return json;
}

/// The belief under the true walls, with both trajectories, in the plan's own frame.
template <class Map>
void draw_overview(const std::filesystem::path& file, const Map& map, const incognita::FloorPlan& plan,
                   const incognita::AllowedArea& area, const incognita::Pose2& T_world_start, const examples::MissionRecord& record) {
  using incognita::FloorCell;
  using examples::Color;
  constexpr Color wall{0.85, 0.25, 0.1, 0.55};
  constexpr Color true_path{0.1, 0.55, 0.2};
  constexpr Color estimated_path{0.1, 0.3, 0.85};
  constexpr Color start{0.75, 0.1, 0.6};
  constexpr Color frontier{1.0, 0.6, 0.0};
  constexpr Color closed{0.9, 0.1, 0.5};

  const auto& box = plan.box();
  const double resolution_m = plan.resolution_m();
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.5);
  const Eigen::Vector2d origin = plan.lattice().origin_m();
  examples::Drawing drawing({origin + box.lower.template cast<double>() * resolution_m - margin,
                             origin + box.upper.template cast<double>() * resolution_m + margin});
  examples::draw_belief(drawing, map, T_world_start);
  drawing.raster(plan, incognita::Pose2{}, [&](FloorCell cell) { return cell == FloorCell::wall ? wall : examples::transparent; });

  const auto in_world = [&](const std::vector<incognita::TimedPose2>& trajectory) {
    std::vector<Eigen::Vector2d> points_m;
    for (const auto& timed : trajectory) points_m.push_back(T_world_start * timed.pose.position());
    return points_m;
  };
  drawing.polyline(in_world(record.truth), true_path, 4.0);
  drawing.polyline(in_world(record.estimated), estimated_path, 1.5);
  for (const auto& cells_m : record.last_frontiers) {
    for (const Eigen::Vector2d& cell_m : cells_m) drawing.disc(T_world_start * cell_m, map.resolution_m(), frontier);
  }
  const auto outline = [&](incognita::Polygon corners_m) {
    if (corners_m.empty()) return;
    corners_m.push_back(corners_m.front());
    drawing.polyline(corners_m, closed, 3.0);
  };
  outline(area.bounds);
  for (const incognita::Polygon& polygon : area.no_go) outline(polygon);
  drawing.marker(T_world_start.position(), start);
  drawing.text(T_world_start.position(), "start", start);
  using examples::Swatch;
  std::vector<examples::LegendEntry> legend{
      {"believed occupied", {0.0, 0.0, 0.0}, Swatch::area},
      {"free", {1.0, 1.0, 1.0}, Swatch::area},
      {"never seen", examples::never_seen, Swatch::area},
      {"true wall", wall, Swatch::area},
      {"true path", true_path, Swatch::line},
      {"estimated path", estimated_path, Swatch::line},
      {"last frontiers", frontier, Swatch::dot}};
  if (!area.is_everywhere()) legend.push_back({"bounds and no-go", closed, Swatch::line});
  drawing.legend(legend);
  drawing.write_png(file);
}

}  // namespace kth_explorer
