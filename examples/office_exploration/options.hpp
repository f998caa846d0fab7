/// The command line of office_exploration.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>

#include "support/arguments.hpp"

namespace office_exploration {

struct Options {
  std::string experiment = "all";
  int poses = 8;
  int threads = 0;
  std::string output = "output/office_exploration";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  app.add_option("--experiment", options.experiment,
                 "utility: information and navigation costs; strategy: strategies in both offices; turtlebot: a cluttered "
                 "room")
      ->check(CLI::IsMember({"utility", "strategy", "turtlebot", "all"}))
      ->capture_default_str();
  app.add_option("--poses", options.poses, "initial poses in each world, 1 to 100")
      ->type_name("N")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  examples::add_trial_options(app, "missions", options.threads, options.output, options.quiet);
  app.parse(argc, argv);
  return options;
}

}  // namespace office_exploration
