/// The command line of kth_explorer.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <Eigen/Core>

#include "support/arguments.hpp"
#include "support/exploration_names.hpp"

namespace kth_explorer {

struct Options {
  std::string map_file;  ///< empty: the embedded floor plan
  std::string cells = "tbayes";
  std::string frontiers = "classical";
  std::string entropy = "behavioral";
  double alpha = 1.0;
  std::string filter = "dvl-ekf";
  std::string compass = "on";
  std::string loops = "on";
  std::string strategy = "last-mile";
  std::string information = "big";
  std::string navigation = "geodesic";
  double robot_radius_m = 0.2;
  std::optional<std::array<double, 4>> bounds_m;  ///< x0, y0, x1, y1 in the map file's frame
  std::string no_go_file;                         ///< empty: no no-go areas
  bool returns = false;
  std::string save_file;    ///< empty: the mission is not saved
  std::string resume_file;  ///< empty: the mission begins
  double duration_s = 1800.0;
  std::uint64_t seed = 1;
  std::optional<Eigen::Vector2d> start_m;  ///< in the map file's frame
  double resolution_m = 0.1;
  int threads = 0;
  std::string output = "output/kth_explorer";
  bool records = false;
  bool reports = false;  ///< and records
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  std::string start;
  std::string bounds;
  app.option_defaults()->group("Input");
  app.add_option("--map", options.map_file, "floor plan; without it, the embedded office floor of 55 x 25 m")
      ->type_name("FILE.yaml|FILE.xml")
      ->check(examples::refuse_empty);
  app.option_defaults()->group("Belief");
  app.add_option("--cells", options.cells, "how a cell of the belief is updated")
      ->check(CLI::IsMember({"tbayes", "log-odds", "dispersion"}))
      ->capture_default_str();
  app.option_defaults()->group("Decision");
  app.add_option("--frontiers", options.frontiers,
                 "what is gone to: where known floor ends, or also where the uncertainty of what was seen leaps (with --cells\n"
                 "dispersion and --information uniform, size or entropy)")
      ->check(CLI::IsMember({"classical", "uncertain"}))
      ->capture_default_str();
  app.add_option("--entropy", options.entropy, "what uncertainty is measured by")
      ->check(CLI::IsMember({"behavioral", "shannon", "renyi", "tsallis"}))
      ->capture_default_str();
  app.add_option("--alpha", options.alpha, "parameter of the entropy (q of tsallis; shannon has none), > 0")
      ->type_name("A")
      ->capture_default_str();
  app.option_defaults()->group("Filter");
  app.add_option("--filter", options.filter, "how the pose is estimated; none: odometry has no noise, so that the pose is known")
      ->check(CLI::IsMember({"dvl-ekf", "dead-reckoning", "none"}))
      ->capture_default_str();
  app.add_option("--compass", options.compass, "whether the filter takes headings from walls that stand at right angles")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--loops", options.loops, "whether the map is put right when the robot returns to where it was")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.option_defaults()->group("Decision");
  app.add_option("--strategy", options.strategy,
                 "plan anew at a viewpoint, as soon as it is no longer informative, or every second if enough was learned")
      ->check(CLI::IsMember(examples::names_of<incognita::Strategy>()))
      ->capture_default_str();
  app.add_option("--information", options.information,
                 "what a frontier is worth: 1 (with geodesic, the nearest is gone to), its size, its entropy, the information\n"
                 "gain of the path to it, or its order of magnitude, which leaves less behind")
      ->check(CLI::IsMember(examples::names_of<incognita::FrontierInformation>()))
      ->capture_default_str();
  app.add_option("--navigation", options.navigation, "what that is divided by: nothing, the straight line, or the cost of the way")
      ->check(CLI::IsMember(examples::names_of<incognita::NavigationCost>()))
      ->capture_default_str();
  app.option_defaults()->group("Mission");
  app.add_option("--duration", options.duration_s, "longest exploration, in simulated seconds, > 0; the way back comes after it")
      ->type_name("S")
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of the noise and of the start")
      ->type_name("N")
      ->check(examples::refuse_bad_seed)
      ->capture_default_str();
  app.option_defaults()->group("Input");
  app.add_option("--start", start, "start in the map file's frame, in metres; without it, a seeded place in the largest region")
      ->type_name("X,Y")
      ->check(examples::refuse_empty);
  app.option_defaults()->group("Mission");
  app.add_option("--radius", options.robot_radius_m, "of the robot, in metres, in (0, 5]: what it cannot reach is not gone to")
      ->type_name("M")
      ->capture_default_str();
  app.option_defaults()->group("Input");
  app.add_option("--bounds", bounds, "box in the map file's frame, in metres, that the robot stays in and explores")
      ->type_name("X0,Y0,X1,Y1")
      ->check(examples::refuse_empty);
  app.add_option("--no-go", options.no_go_file,
                 "polygons in the map file's frame that it keeps out of: a line each, as 0,0 4,0 4,2.5")
      ->type_name("FILE")
      ->check(examples::refuse_empty);
  app.option_defaults()->group("Mission");
  app.add_flag("--return", options.returns, "drive back to the start in the end");
  app.add_option("--save", options.save_file, "write the mission to a file where the exploration ends, before the way back")
      ->type_name("FILE")
      ->check(examples::refuse_empty);
  app.add_option("--resume", options.resume_file,
                 "go on with a mission that was saved with the same map, seed and options; --duration counts from its first start")
      ->type_name("FILE")
      ->check(examples::refuse_empty);
  app.option_defaults()->group("Belief");
  app.add_option("--resolution", options.resolution_m, "side of a cell of the belief, in metres, 0.02 to 1")
      ->type_name("M")
      ->capture_default_str();
  app.option_defaults()->group("Output");
  app.add_option("--threads", options.threads, "threads for the evaluation of candidates; 0: as many as OpenMP takes")
      ->type_name("N")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_option("--output", options.output, "folder for the results")->type_name("DIR")->capture_default_str();
  app.add_flag("--record", options.records, "write recording.incognita as well, as the run goes: what is needed to look at it again");
  app.add_flag("--report", options.reports, "write report.html as well, a replay to be looked at in a browser, and the recording that it is made of");
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.parse(argc, argv);

  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw CLI::ValidationError(what);
  };
  const auto shown = [](double value) { return CLI::detail::to_string(value); };
  require(std::isfinite(options.alpha) && options.alpha > 0.0,
          "--alpha: " + shown(options.alpha) + " is not finite and > 0");
  require(std::isfinite(options.duration_s) && options.duration_s > 0.0 && options.duration_s <= 1e7,
          "--duration: " + shown(options.duration_s) + " s is not in (0, 1e7]");
  require(options.resolution_m >= 0.02 && options.resolution_m <= 1.0,
          "--resolution: " + shown(options.resolution_m) + " m is not in 0.02..1");
  require(options.robot_radius_m > 0.0 && options.robot_radius_m <= 5.0,
          "--radius: " + shown(options.robot_radius_m) + " m is not in (0, 5]");
  if (options.frontiers == "uncertain") {
    require(options.cells == "dispersion", "--frontiers uncertain needs --cells dispersion, not " + options.cells);
    require(!incognita::is_of_path(examples::named<incognita::FrontierInformation>(options.information)),
            "--frontiers uncertain needs --information uniform, size or entropy, not " + options.information);
  }
  if (!bounds.empty()) {
    options.bounds_m = examples::parse_numbers<4>("--bounds", bounds, "X0,Y0,X1,Y1 with finite numbers in metres");
    const auto [x0_m, y0_m, x1_m, y1_m] = *options.bounds_m;
    require(x0_m < x1_m && y0_m < y1_m, "--bounds: \"" + bounds + "\" must have X0 < X1 and Y0 < Y1");
  }
  if (!start.empty()) {
    const auto [x_m, y_m] = examples::parse_numbers<2>("--start", start, "X,Y with finite numbers in metres");
    options.start_m = Eigen::Vector2d(x_m, y_m);
  }
  return options;
}

}  // namespace kth_explorer
