/// The command line of uncertainty_frontiers.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "support/arguments.hpp"

namespace uncertainty_frontiers {

struct Options {
  std::string experiment = "all";
  int seeds = 5;
  int threads = 0;
  std::string output = "output/uncertainty_frontiers";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  app.add_option("--experiment", options.experiment,
                 "figures: how uncertainty grows; corridors: the frontier that classical ones miss; hall: four planning systems "
                 "in four layouts")
      ->check(CLI::IsMember({"figures", "corridors", "hall", "all"}))
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "trials of each setting, 1 to 1000")
      ->type_name("N")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  examples::add_trial_options(app, "trials", options.threads, options.output, options.quiet);
  app.parse(argc, argv);
  return options;
}

}  // namespace uncertainty_frontiers
