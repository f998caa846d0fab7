/// All that a mission was made with, by name.
#pragma once


#include <nlohmann/json.hpp>

#include "incognita/exploration/explorer_params.hpp"
#include "kth_explorer/options.hpp"

namespace kth_explorer {

/// The options of the command line, then the parameters of the parts that have any, a group each. A duration that is not bounded is null.
template <class Explorer>
[[nodiscard]] nlohmann::ordered_json parameters_json(const Explorer& explorer, const Options& options) {
  nlohmann::ordered_json json;
  auto& mission = json["mission"];
  mission["map"] = map_name(options);
  mission["seed"] = options.seed;
  mission["duration_s"] = options.duration_s;
  mission["cells"] = options.cells;
  mission["frontiers"] = options.frontiers;
  mission["entropy"] = options.entropy;
  if (options.entropy != "shannon") mission["alpha"] = options.alpha;
  mission["filter"] = options.filter;
  mission["compass"] = options.compass;
  mission["loops"] = options.loops;
  mission["returns"] = options.returns;

  const incognita::ExplorerParams& params = explorer.params();
  json["map"] = {{"resolution_m", explorer.map().resolution_m()},
                 {"hit_push_m", explorer.map().hit_push_m()},
                 {"blocked_above", explorer.map().blocked_above()},
                 {"free_below", params.thresholds.free_below},
                 {"occupied_above", params.thresholds.occupied_above}};
  json["decision"] = {{"strategy", options.strategy},
                      {"information", options.information},
                      {"navigation", options.navigation},
                      {"travel_offset_m", params.travel_offset_m},
                      {"candidates_max", params.candidates_max},
                      {"visibility_tolerance_m", params.visibility_tolerance_m},
                      {"information_min_m2", params.information_min_m2},
                      {"gain_min_cells", params.gain_min_cells},
                      {"decision_interval_s", params.decision_interval_s},
                      {"blocked_max_s", params.blocked_max_s},
                      {"position_sigma_max_m", params.position_sigma_max_m},
                      {"lost_max_s", params.lost_max_s}};
  json["gain"] = {{"pose_spacing_m", params.gain.pose_spacing_m},
                  {"beams", params.gain.beams},
                  {"range_max_m", params.gain.range_max_m},
                  {"speed_m_per_s", params.gain.speed_m_per_s},
                  {"scan_rate_hz", params.gain.scan_rate_hz}};
  json["travel"] = {{"robot_radius_m", params.travel.robot_radius_m},
                    {"margin_m", params.travel.margin_m},
                    {"clearance_soft_m", params.travel.clearance_soft_m},
                    {"clearance_weight", params.travel.clearance_weight},
                    {"escape_radius_m", params.travel.escape_radius_m},
                    {"escape_cost_per_m", params.travel.escape_cost_per_m}};
  json["follow"] = {{"speed_max_m_per_s", params.follow.speed_max_m_per_s},
                    {"turn_rate_max_rad_per_s", params.follow.turn_rate_max_rad_per_s},
                    {"deceleration_m_per_s2", params.follow.deceleration_m_per_s2},
                    {"lookahead_m", params.follow.lookahead_m},
                    {"aside_max_m", params.follow.aside_max_m},
                    {"goal_tolerance_m", params.follow.goal_tolerance_m}};
  json["guard"] = {{"margin_m", params.guard.margin_m},
                   {"creep_margin_m", params.guard.creep_margin_m},
                   {"creep_speed_m_per_s", params.guard.creep_speed_m_per_s},
                   {"reaction_time_s", params.guard.reaction_time_s}};
  return json;
}

}  // namespace kth_explorer
