/// The command line of report.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "support/arguments.hpp"

namespace report {

struct Options {
  std::vector<std::string> recordings;  ///< one, or two to be put side by side
  std::string output = "output/report/report.html";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  std::string recording;
  std::vector<std::string> pair;
  app.add_option("RECORDING", recording, "recording of a run, as kth_explorer --record writes it")->check(examples::refuse_empty);
  app.add_option("--compare", pair, "puts two runs side by side, instead of RECORDING")
      ->type_name("A B")
      ->expected(2)
      ->check(examples::refuse_empty);
  app.add_option("--output", options.output, "the page, or a folder for report.html")
      ->type_name("FILE.html|DIR")
      ->check(examples::refuse_empty)
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "print nothing but errors");
  app.parse(argc, argv);
  if (recording.empty() == pair.empty()) throw CLI::ValidationError("RECORDING or --compare A B is needed, and not both");
  options.recordings = pair.empty() ? std::vector<std::string>{recording} : pair;
  return options;
}

}  // namespace report
