// A simulated robot explores a floor plan and reports how well it went.
#include <unistd.h>

#include <concepts>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/io/belief_numpy.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/io/polygons.hpp"
#include "incognita/io/recording_file.hpp"
#include "incognita/io/run_recorder.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/start.hpp"
#include "kth_explorer/allowed_floor.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"
#include "kth_explorer/options.hpp"
#include "kth_explorer/parameters.hpp"
#include "kth_explorer/results.hpp"
#include "kth_explorer/saved_mission.hpp"
#include "support/entropies.hpp"
#include "support/exploration_names.hpp"
#include "support/mission.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/report_html.hpp"
#include "support/steering.hpp"

namespace kth_explorer {
namespace {

incognita::World load_world(const Options& options) {
  return incognita::World(options.map_file.empty()
                              ? incognita::read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan")
                              : incognita::read_floor_plan(options.map_file));
}

incognita::AllowedArea allowed_area(const Options& options) {
  incognita::AllowedArea area;
  if (options.bounds_m) {
    const auto [x0_m, y0_m, x1_m, y1_m] = *options.bounds_m;
    area.bounds = {{x0_m, y0_m}, {x1_m, y0_m}, {x1_m, y1_m}, {x0_m, y1_m}};
  }
  if (!options.no_go_file.empty()) area.no_go = incognita::read_polygons(options.no_go_file);
  return area;
}

/// On the floor that the robot is asked to explore.
incognita::Pose2 start_pose(const Options& options, const incognita::World& floor) {
  incognita::Random random(options.seed);
  try {
    if (!options.start_m) return random_start(floor, options.robot_radius_m, random);
    check_start(floor, *options.start_m, options.robot_radius_m);
  } catch (const std::invalid_argument& error) {
    const std::string map = options.map_file.empty() ? "the embedded floor plan" : options.map_file;
    const bool is_part = options.bounds_m || !options.no_go_file.empty();
    throw std::invalid_argument((options.start_m ? "--start" : map) + ": " + error.what() +
                                (is_part ? " (what --bounds and --no-go close is an obstacle)" : ""));
  }
  return {options.start_m->x(), options.start_m->y(), random.uniform(-std::numbers::pi, std::numbers::pi)};
}

/// A bar that is drawn over on a terminal, a line every simulated minute elsewhere.
void print_progress(const examples::ProgressRecord& progress, double duration_s) {
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  const bool last = progress.time_s >= duration_s;
  if (!terminal && std::fmod(progress.time_s, 60.0) > 1e-6 && !last) return;
  char line[128];
  std::snprintf(line, sizeof line, "%5.0f s  explored %5.1f %%  position error %.3f m (3 sigma %.3f)  driven %.0f m",
                progress.time_s, 100.0 * progress.explored_fraction, progress.position_error_m, progress.three_sigma_m,
                progress.distance_m);
  if (!terminal) {
    std::cout << line << std::endl;
    return;
  }
  constexpr int width = 24;
  const int filled = static_cast<int>(width * progress.explored_fraction);
  std::cout << "\r[" << std::string(static_cast<std::size_t>(filled), '#')
            << std::string(static_cast<std::size_t>(width - filled), '.') << "] " << line << std::flush;
}

void print_table(const nlohmann::ordered_json& metrics, const std::filesystem::path& folder) {
  if (isatty(STDOUT_FILENO) == 1) std::cout << '\n';
  for (const char* key : {"stop_reason", "duration_s", "explored_fraction", "explored_area_m2", "distance_m", "returned", "collisions",
                          "decisions", "translation_rmse_m", "heading_rmse_rad", "nees_mean", "map_error",
                          "wall_time_s", "real_time_factor"}) {
    const auto& value = metrics.at(key);
    char text[48];
    if (value.is_number_float()) {
      std::snprintf(text, sizeof text, "%.4g", value.get<double>());
    } else {
      std::snprintf(text, sizeof text, "%s", value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    }
    std::printf("  %-20s %s\n", key, text);
  }
  std::printf("Results are in %s\n", folder.string().c_str());
}

template <class Filter>
Filter make_filter(const Options& options) {
  typename Filter::Params params;
  if constexpr (std::same_as<Filter, incognita::DeadReckoning>) {
    if (options.filter == "none") params.noise = {0.0, 0.0};
  }
  if constexpr (requires { params.uses_compass; }) params.uses_compass = options.compass == "on";
  if constexpr (requires { params.loops.closes_loops; }) params.loops.closes_loops = options.loops == "on";
  return Filter(params);
}

template <class Cell, class Filter>
void explore(const Options& options, incognita::Simulator& simulator, const incognita::RobotParams& robot,
             const incognita::World& floor, const incognita::AllowedArea& area, examples::OutputFolder& output) {
  using namespace incognita;
  ExplorerParams params;
  params.travel.robot_radius_m = robot.radius_m;
  params.guard.robot_radius_m = robot.radius_m;
  params.gain.range_max_m = simulator.scan().range_max_m();
  params.strategy = examples::named<Strategy>(options.strategy);
  params.information = examples::named<FrontierInformation>(options.information);
  params.navigation = examples::named<NavigationCost>(options.navigation);
  params.area = area.transformed(simulator.T_start_world());
  if (options.frontiers == "uncertain") params.uncertainty.emplace();
  params.threads = options.threads;
  MapParams map_params;
  map_params.resolution_m = options.resolution_m;
  Explorer<Map<Cell>, examples::Measure, Filter> explorer(params, Map<Cell>(map_params), examples::make_measure(options.entropy, options.alpha),
                                                make_filter<Filter>(options));

  std::function<void(const examples::ProgressRecord&)> report;
  if (!options.quiet) report = [&](const examples::ProgressRecord& p) { print_progress(p, options.duration_s); };
  const Pose2 T_world_start = simulator.T_start_world().inverse();
  const examples::MissionParams mission{options.duration_s, options.returns};
  const auto visible = visible_floor(floor, simulator.T_world_robot().position(), robot.radius_m, params.gain.range_max_m);
  examples::Steering steering(options.controller, options.robot_radius_m, explorer.map().lattice());
  examples::MissionRecord before;
  if (!options.resume_file.empty()) before = resumed_mission(options, explorer, simulator, steering);
  std::optional<RunRecorder> recorder;
  if (options.records || options.reports) {
    RecordingSetup setup;
    setup.parameters_json = parameters_json(explorer, steering, options).dump();
    setup.metric_names.assign(examples::recorded_metrics.begin(), examples::recorded_metrics.end());
    setup.plan = simulator.world().plan();
    setup.T_map_plan = simulator.T_start_world();
    recorder.emplace(output.growing("recording.incognita"), explorer, simulator.scan(), std::move(setup));
  }
  std::string saved;
  const auto save = [&](const examples::MissionRecord& now) {
    if (!options.save_file.empty()) saved = saved_mission(options, explorer, simulator, now, steering);
  };
  const examples::MissionRecord record =
      examples::run_mission(explorer, simulator, visible, mission, std::move(before), report, recorder ? &*recorder : nullptr, steering, save);

  const nlohmann::ordered_json metrics = metrics_json(record, options);
  if (recorder) recorder->ended({std::string(to_string(record.stop_reason)), metrics.dump()});
  if (options.reports) {
    const std::string name = options.map_file.empty() ? "embedded floor plan" : std::filesystem::path(options.map_file).filename().string();
    write_file_atomically(output.staged("report.html"), examples::report_html({{name, read_recording(recorder->file())}}));
  }
  write_file_atomically(output.staged("metrics.json"), metrics.dump(2) + "\n");
  write_file_atomically(output.staged("decisions.csv"), decisions_csv(record));
  write_file_atomically(output.staged("progress.csv"), progress_csv(record));
  write_tum(output.staged("trajectory_estimated.tum"), record.estimated);
  write_tum(output.staged("trajectory_true.tum"), record.truth);
  examples::write_map(output.staged("map.yaml"), explorer.map(), explorer.params().thresholds);
  write_belief_numpy(output.staged("belief"), explorer.map());
  draw_overview(output.staged("overview.png"), explorer.map(), simulator.world().plan(), area, T_world_start, record);
  output.publish();
  if (!options.save_file.empty()) write_file_atomically(options.save_file, saved);
  if (options.quiet) return;
  print_table(metrics, output.path());
  if (options.reports) std::printf("To look at it, open %s in a browser\n", (output.path() / "report.html").string().c_str());
}

void run(const Options& options) {
  using namespace incognita;
  SimulatorParams params;
  params.robot.radius_m = options.robot_radius_m;
  if (options.filter == "none") params.odometry = {0.0, 0.0};
  World world = load_world(options);
  const AllowedArea area = allowed_area(options);
  const World floor = allowed_floor(world, area);
  const Pose2 T_world_start = start_pose(options, floor);
  require_place_to_save(options);
  examples::OutputFolder output(options.output, {"metrics.json", "decisions.csv", "progress.csv", "trajectory_estimated.tum",
                                                 "trajectory_true.tum", "map.yaml", "map.png", "overview.png",
                                                 "belief_log_odds.npy", "belief_probability.npy", "belief_frame.json",
                                                 "recording.incognita", "report.html"});
  Simulator simulator(std::move(world), T_world_start, params, options.seed);
  const bool coupled = options.filter == "dvl-ekf";
  const auto explore_in = [&]<class Cell>(std::type_identity<Cell>) {
    coupled ? explore<Cell, LoopClosingDvlEkf>(options, simulator, params.robot, floor, area, output)
            : explore<Cell, DeadReckoning>(options, simulator, params.robot, floor, area, output);
  };
  if (options.cells == "tbayes") explore_in(std::type_identity<TBayes>());
  if (options.cells == "log-odds") explore_in(std::type_identity<LogOdds>());
  if (options.cells == "dispersion") explore_in(std::type_identity<Dispersion>());
}

}  // namespace
}  // namespace kth_explorer

int main(int argc, char** argv) {
  CLI::App app("A simulated robot explores a floor plan: it maps, localises, and decides where to go by the information\n"
               "it expects. Writes metrics.json, map.yaml and map.png, both trajectories, decisions.csv, progress.csv,\n"
               "overview.png and, for NumPy, belief_log_odds.npy, belief_probability.npy and belief_frame.json.");
  return examples::run_program("kth_explorer", app, [&] { kth_explorer::run(kth_explorer::parse_options(app, argc, argv)); });
}
