#include "experiment/trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "experiment/heading_aid.hpp"
#include "incognita/core/split_mix.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/filter_with_map.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/map/cells/exact_pose.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/simulation/start.hpp"
#include "support/entropies.hpp"
#include "support/exploration_names.hpp"
#include "support/mission.hpp"
#include "support/steering.hpp"

namespace experiment {
namespace {

using namespace incognita;
using Json = nlohmann::ordered_json;

double squared(double root) { return root * root; }

TBayes make_t_bayes(const Settings& settings) {
  TBayes::Params params = settings.rule == "literal" ? TBayes::literal_params() : TBayes::Params{};
  params.hits_max = settings.hits_max;
  params.dvl = {squared(settings.cell_occupied_m), squared(settings.cell_unoccupied_m)};
  return TBayes(params);
}

LogOdds make_log_odds(const Settings& settings) {
  LogOdds::Params params;
  params.hits_win = settings.hits_win;
  return LogOdds(params);
}

template <class Cell>
Map<Cell> make_map(const Settings& settings, const Cell& cell) {
  MapParams params;
  params.resolution_m = settings.resolution_m;
  return Map<Cell>(params, cell);
}

DeadReckoning make_dead_reckoning(const Settings& settings) {
  DeadReckoning::Params params;
  if (settings.filter == "none") params.noise = {0.0, 0.0};
  return DeadReckoning(params);
}

DvlEkf::Params make_ekf_params(const Settings& settings) {
  DvlEkf::Params params;
  params.coupled = settings.filter == "coupled";
  params.form = settings.form == "ray" ? DvlEkf::Form::ray : DvlEkf::Form::registration;
  params.uses_compass = settings.compass;
  if (!settings.doubts_scans) {
    params.consistency.share_min = 0.0;    // no scan contradicts the map,
    params.relocation.share_margin = 1.0;  // nor is any unusual
  }
  params.registration.gamma = settings.gamma;
  params.registration.dvl = {squared(settings.filter_occupied_m), squared(settings.filter_unoccupied_m)};
  params.imagined.tempering = settings.imagined_tempering == "hits" ? Tempering::hits : Tempering::beams;
  params.ray.gamma = settings.gamma;
  params.ray.dvl = params.registration.dvl;
  return params;
}

HeadingAidedEkf make_ekf(const Settings& settings, const Simulator& simulator, std::uint64_t noise) {
  std::function<double()> compass;
  if (settings.heading_sigma_rad > 0.0) {
    // Copies of the filter draw from the same stream, as they would read the same compass.
    const auto random = std::make_shared<Random>(noise);
    compass = [&simulator, random, sigma_rad = settings.heading_sigma_rad] {
      return wrap_angle_rad(simulator.T_start_robot().yaw_rad + random->normal(0.0, sigma_rad));
    };
  }
  return HeadingAidedEkf(DvlEkf(make_ekf_params(settings)), std::move(compass), settings.heading_sigma_rad);
}

ExplorerParams make_explorer_params(const Settings& settings) {
  ExplorerParams params;
  params.travel.robot_radius_m = settings.robot_radius_m;
  params.guard.robot_radius_m = settings.robot_radius_m;
  params.follow.speed_max_m_per_s = settings.speed_max_m_per_s;
  params.gain.range_max_m = settings.range_max_m;
  params.gain.speed_m_per_s = settings.speed_max_m_per_s;
  params.gain.pose_spacing_m = settings.gain_pose_spacing_m;
  params.gain.beams = settings.gain_beams;
  params.strategy = examples::named<Strategy>(settings.strategy);
  params.information = examples::named<FrontierInformation>(settings.information);
  params.navigation = examples::named<NavigationCost>(settings.navigation);
  params.candidates_max = settings.candidates_max;
  params.position_sigma_max_m = settings.position_sigma_max_m;
  params.threads = 1;
  return params;
}

SimulatorParams make_simulator_params(const Settings& settings) {
  SimulatorParams params;
  params.robot.radius_m = settings.robot_radius_m;
  params.robot.speed_max_m_per_s = settings.speed_max_m_per_s;
  params.odometry = {settings.odometry_speed_sigma_m_per_s, settings.odometry_turn_rate_sigma_rad_per_s};
  if (settings.filter == "none") params.odometry = {0.0, 0.0};
  params.sensor.beams = circular_beams(static_cast<std::size_t>(settings.beams), settings.range_max_m);
  params.sensor.range_sigma_m = settings.range_sigma_m;
  return params;
}

/// So many digits as matter.
double rounded(double value, double step) { return std::isfinite(value) ? std::round(value / step) * step : value; }

/// A share of the time, by where the robot truly was at each scan.
double corridor_share(const examples::MissionRecord& record, const Arena& arena, const Pose2& T_world_start) {
  std::size_t corridor = 0;
  for (const TimedPose2& timed : record.truth) {
    const Index<2> cell = arena.uses.lattice().index_of(T_world_start * timed.pose.position());
    corridor += arena.uses.value(cell) == FloorUse::corridor ? 1 : 0;
  }
  return static_cast<double>(corridor) / static_cast<double>(std::max<std::size_t>(record.truth.size(), 1));
}

/// A mission that has ended stays at what it had explored.
double explored_share_of_time(const examples::MissionRecord& record, double duration_s) {
  double sum_s = 0.0;
  double since_s = 0.0;
  double explored = 0.0;
  for (const examples::ProgressRecord& progress : record.progress) {
    sum_s += explored * (progress.time_s - since_s);
    since_s = progress.time_s;
    explored = progress.explored_fraction;
  }
  return (sum_s + explored * std::max(0.0, duration_s - since_s)) / duration_s;
}

/// About a hundred values of each curve.
Json curves_of(const examples::MissionRecord& record, double duration_s) {
  const double step_s = std::max(1.0, std::ceil(duration_s / 100.0));
  Json curves;
  curves["step_s"] = step_s;
  for (const char* name : examples::recorded_metrics) curves[name] = Json::array();
  double next_s = step_s;
  for (const examples::ProgressRecord& progress : record.progress) {
    if (progress.time_s < next_s - 1e-6) continue;
    next_s += step_s;
    const auto values = examples::recorded_values(progress);
    for (std::size_t n = 0; n < values.size(); ++n) curves[examples::recorded_metrics[n]].push_back(rounded(values[n], 1e-6));
  }
  return curves;
}

/// Where the robot truly was, every other second, in the plan's frame.
Json way_of(const examples::MissionRecord& record, const Pose2& T_world_start) {
  Json way = Json::array();
  double next_s = 0.0;
  for (const TimedPose2& timed : record.truth) {
    if (timed.time_s < next_s - 1e-6) continue;
    next_s += 2.0;
    const Eigen::Vector2d place_m = T_world_start * timed.pose.position();
    way.push_back({rounded(place_m.x(), 0.01), rounded(place_m.y(), 0.01)});
  }
  return way;
}

/// Without its braces.
std::string members_of(const Json& json) {
  const std::string object = json.dump();
  return object.substr(1, object.size() - 2);
}

std::string row_of(const examples::MissionRecord& record, const Arena& arena, const Settings& settings, const Pose2& T_world_start) {
  Json row;
  row["stop_reason"] = std::string(to_string(record.stop_reason));
  Json& metrics = row["metrics"];
  metrics["translation_rmse_m"] = record.trajectory_error.translation_rmse_m();
  metrics["translation_mae_m"] = record.trajectory_error.translation_mae_m();
  metrics["heading_rmse_rad"] = record.trajectory_error.heading_rmse_rad();
  metrics["nees"] = record.nees.count() > 0 ? Json(record.nees.position()) : Json();
  metrics["map_error"] = record.map_error;
  // The paper's T is the time that was given, also where the robot was done before.
  metrics["bits_per_step"] = record.map_uncertainty_bits_per_step * record.duration_s / settings.duration_s;
  metrics["end_s"] = rounded(record.duration_s, 1e-3);
  metrics["explored_fraction"] = record.explored_fraction;
  metrics["explored_share_of_time"] = explored_share_of_time(record, settings.duration_s);
  const examples::ProgressRecord* const most = record.first_with_explored(0.9);
  metrics["time_to_90_percent_s"] = most != nullptr ? Json(most->time_s) : Json();
  metrics["distance_m"] = record.distance_m;
  metrics["decisions"] = record.decisions.size();
  metrics["collisions"] = record.collisions;
  metrics["corridor_share"] = arena.uses.box().empty() ? Json() : Json(corridor_share(record, arena, T_world_start));
  row["curves"] = curves_of(record, settings.duration_s);
  row["way_m"] = way_of(record, T_world_start);
  return members_of(row);
}

std::string cost_of(const examples::MissionRecord& record) {
  const double ms_per_scan = 1e3 / static_cast<double>(std::max<std::size_t>(record.scans, 1));
  const double ms_per_decision = 1e3 / static_cast<double>(std::max<std::size_t>(record.decisions.size(), 1));
  const examples::ExplorerTimes& times = record.explorer_times;
  Json cost;
  cost["wall_s"] = record.wall_time_s;
  cost["observe_ms_per_scan"] = times.observe_s * ms_per_scan;
  cost["decide_ms_per_scan"] = times.decide_s * ms_per_scan;
  cost["decide_ms_per_decision"] = times.decide_s * ms_per_decision;
  cost["command_ms_per_scan"] = times.command_s * ms_per_scan;
  cost["simulator_ms_per_scan"] = (record.wall_time_s - times.observe_s - times.decide_s - times.command_s) * ms_per_scan;
  return members_of(cost);
}

template <class DecisionMap, class Filter>
examples::MissionRecord explore(const Arena& arena, const Settings& settings, Simulator& simulator, DecisionMap map, Filter filter) {
  Explorer<DecisionMap, examples::Measure, Filter> explorer(make_explorer_params(settings), std::move(map),
                                                            examples::make_measure(settings.entropy, settings.alpha), std::move(filter));
  const auto& visible = arena.visible_floor(simulator.T_world_robot().position(), settings.robot_radius_m, settings.range_max_m);
  examples::Steering steering(settings.controller, settings.robot_radius_m, explorer.map().lattice(), settings.speed_max_m_per_s);
  return examples::run_mission(explorer, simulator, visible, {settings.duration_s, false}, {}, nullptr, nullptr, steering, [](const auto&) {});
}

}  // namespace

void require_possible(const Settings& settings) {
  make_explorer_params(settings).validate();
  static_cast<void>(make_map(settings, make_t_bayes(settings)));
  static_cast<void>(make_log_odds(settings));
  static_cast<void>(DvlEkf(make_ekf_params(settings)));
  static_cast<void>(examples::make_measure(settings.entropy, settings.alpha));
}

Pose2 start_of_trial(const Arena& arena, const Settings& settings, int start) {
  Random places(static_cast<std::uint64_t>(start));
  return random_start(arena.world, settings.robot_radius_m, places);
}

TrialText run_trial(const Arena& arena, const Settings& settings, int start, int seed) {
  const Pose2 T_world_start = start_of_trial(arena, settings, start);
  // Of each start and seed, and the same for all methods.
  const std::uint64_t noise = split_mixed(static_cast<std::uint64_t>(seed) + static_cast<std::uint64_t>(start) * split_mix_increment);
  Simulator simulator(arena.world, T_world_start, make_simulator_params(settings), noise);
  const auto record = [&] {
    const bool is_ekf = settings.filter == "coupled" || settings.filter == "decoupled";
    const auto with_map = [&](auto map) {
      return is_ekf ? explore(arena, settings, simulator, std::move(map), make_ekf(settings, simulator, noise))
                    : explore(arena, settings, simulator, std::move(map), make_dead_reckoning(settings));
    };
    if (settings.decision_cells == "same") {
      return settings.cells == "log-odds" ? with_map(make_map(settings, make_log_odds(settings)))
                                          : with_map(make_map(settings, make_t_bayes(settings)));
    }
    const auto with_both = [&](auto decision_map) {
      return explore(arena, settings, simulator, std::move(decision_map),
                     FilterWithMap<Map<TBayes>, HeadingAidedEkf>(make_ekf(settings, simulator, noise), make_map(settings, make_t_bayes(settings))));
    };
    return settings.decision_cells == "log-odds" ? with_both(make_map(settings, make_log_odds(settings)))
                                                 : with_both(make_map(settings, ExactPose<TBayes>(make_t_bayes(settings))));
  }();
  return {row_of(record, arena, settings, T_world_start), cost_of(record)};
}

}  // namespace experiment
