/// The command line of plot.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "support/arguments.hpp"

namespace plot {

struct Options {
  std::vector<std::string> folders;
  std::vector<std::string> keys;  ///< of metrics.json that tell groups apart; empty: all parameters that differ
  std::string output = "output/plot";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  app.add_option("runs", options.folders, "folders of runs, as kth_explorer writes them")
      ->type_name("DIR")
      ->required()
      ->check(examples::refuse_empty);
  app.add_option("--group", options.keys,
                 "key of metrics.json whose values tell groups apart; more than one by commas, or by more of these. Without it, all "
                 "parameters that differ but the seed")
      ->type_name("KEY")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(examples::refuse_empty);
  app.add_option("--output", options.output, "folder for the results")
      ->type_name("DIR")
      ->check(examples::refuse_empty)
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.parse(argc, argv);
  return options;
}

}  // namespace plot
