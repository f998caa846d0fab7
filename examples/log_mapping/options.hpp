/// The command line of log_mapping.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "incognita/geometry/pose2.hpp"
#include "incognita/io/robot_log.hpp"
#include "support/arguments.hpp"

namespace log_mapping {

inline constexpr double rad_per_deg = std::numbers::pi / 180.0;

struct Options {
  std::string log_file;
  std::string reference_file;  ///< empty: none
  std::string relations_file;  ///< empty: none
  double frame_angle_rad = 0.0;
  double resolution_m = 0.1;
  std::string compass = "on";
  std::string loops = "on";
  incognita::RobotLogParams log;
  std::string output = "output/log_mapping";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  double frame_angle_deg = 0.0;
  std::string beams;
  std::string laser;
  std::optional<double> no_return_m;
  std::optional<double> usable_range_m;
  std::string no_return_is = "invalid";
  app.option_defaults()->group("Input");
  app.add_option("--log", options.log_file,
                 "scans with odometry: JSON by time, or CARMEN (FLASER, ROBOTLASER1)")
      ->type_name("FILE.json|FILE.log")
      ->required()
      ->check(examples::refuse_empty);
  app.add_option("--reference", options.reference_file,
                 "the same scans at better poses, for ate_rmse_m and a drawing")
      ->type_name("FILE.json")
      ->check(examples::refuse_empty);
  app.add_option("--relations", options.relations_file,
                 "true relations between poses, lines of t1 t2 x y z roll pitch yaw (s, m, rad)")
      ->type_name("FILE.txt")
      ->check(examples::refuse_empty);
  app.option_defaults()->group("Belief");
  app.add_option("--frame-angle-deg", frame_angle_deg,
                 "heading at the start in the map's frame, in degrees: turns the walls against the cells")
      ->type_name("A")
      ->capture_default_str();
  app.add_option("--resolution", options.resolution_m, "side of a cell of the belief, in metres, 0.02 to 1")
      ->type_name("M")
      ->capture_default_str();
  app.option_defaults()->group("Filter");
  app.add_option("--compass", options.compass, "whether headings are taken from walls that stand at right angles")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.add_option("--loops", options.loops, "whether the map is put right when the robot returns to where it was")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  app.option_defaults()->group("Readings");
  app.add_option("--beams", beams,
                 "angle of the first reading and step to the next, in degrees, counter-clockwise; without it "
                 "as the log "
                 "says, or -90 and 1 (180, 181 readings) or 0.5 (360, 361)")
      ->type_name("FIRST,STEP")
      ->check(examples::refuse_empty);
  app.add_option(
         "--laser", laser,
         "pose of the laser on the robot, in metres and degrees; without it as the log says, or 0,0,0")
      ->type_name("X,Y,YAW")
      ->check(examples::refuse_empty);
  app.add_option(
         "--no-return", no_return_m,
         "readings of this many metres or more mean that nothing came back; without it, found from a pile of "
         "readings at the top of the scale")
      ->type_name("M");
  app.add_option(
         "--usable-range", usable_range_m,
         "longer readings, in metres, count as free up to here; without it, all but those without return")
      ->type_name("M");
  app.add_option("--no-return-is", no_return_is,
                 "what no return means: invalid (nothing: it can be glass, black or the sun) or clear (free "
                 "up to the "
                 "usable range)")
      ->check(CLI::IsMember({"invalid", "clear"}))
      ->capture_default_str();
  app.option_defaults()->group("Output");
  app.add_option("--output", options.output, "folder for the results")
      ->type_name("DIR")
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.parse(argc, argv);

  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw CLI::ValidationError(what);
  };
  const auto shown = [](double value) { return CLI::detail::to_string(value); };
  require(std::abs(frame_angle_deg) <= 360.0,
          "--frame-angle-deg: " + shown(frame_angle_deg) + " is not in -360..360");
  options.frame_angle_rad = frame_angle_deg * rad_per_deg;
  require(options.resolution_m >= 0.02 && options.resolution_m <= 1.0,
          "--resolution: " + shown(options.resolution_m) + " m is not in 0.02..1");
  for (const auto& [name, range_m] :
       {std::pair{"--no-return", no_return_m}, {"--usable-range", usable_range_m}}) {
    if (range_m)
      require(*range_m > 0.0 && *range_m <= 1e4,
              std::string(name) + ": " + shown(*range_m) + " m is not in (0, 1e4]");
  }
  options.log.no_return_m = no_return_m;
  options.log.usable_m = usable_range_m;
  options.log.no_return_is_clear = no_return_is == "clear";
  if (!beams.empty()) {
    const auto [first_deg, step_deg] =
        examples::parse_numbers<2>("--beams", beams, "FIRST,STEP with finite numbers in degrees");
    require(
        step_deg != 0.0 && std::abs(step_deg) <= 360.0 && std::abs(first_deg) <= 360.0,
        "--beams: \"" + beams + "\" is not a first angle in -360..360 and a step of up to 360 other than 0");
    options.log.beams = incognita::BeamAngles{first_deg * rad_per_deg, step_deg * rad_per_deg};
  }
  if (!laser.empty()) {
    const auto [x_m, y_m, yaw_deg] =
        examples::parse_numbers<3>("--laser", laser, "X,Y,YAW with finite numbers in metres and degrees");
    require(std::hypot(x_m, y_m) <= 100.0 && std::abs(yaw_deg) <= 360.0,
            "--laser: \"" + laser + "\" is not within 100 m and 360 degrees");
    options.log.T_robot_laser = incognita::Pose2{x_m, y_m, incognita::wrap_angle_rad(yaw_deg * rad_per_deg)};
  }
  return options;
}

}  // namespace log_mapping
