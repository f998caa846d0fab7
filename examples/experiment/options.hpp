/// The command line of experiment.
#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "support/arguments.hpp"

namespace experiment {

struct Options {
  std::string study;  ///< a file, or the name of a study that is shipped
  std::string data;   ///< empty: maps lie beside the study
  bool resumes = false;
  bool reports = false;  ///< alone
  int threads = 0;
  std::string output = "output/experiment";
  bool quiet = false;
};

/// Throws CLI::ParseError; one whose exit code is 0 asks for the help text.
[[nodiscard]] inline Options parse_options(CLI::App& app, int argc, char** argv) {
  Options options;
  app.add_option("study", options.study, "a study in TOML, or one that is shipped: quick, ablation, ablation-paper, cells, coupling, alpha, scaling")
      ->type_name("STUDY")
      ->required()
      ->check(examples::refuse_empty);
  app.add_option("--data", options.data, "folder of maps that do not lie beside the study")
      ->type_name("DIR")
      ->envname("INCOGNITA_DATA_DIR");
  app.add_flag("--resume", options.resumes, "go on where a study in the output folder has stopped");
  app.add_flag("--report", options.reports, "run nothing, write the report of what is there again");
  examples::add_trial_options(app, "missions", options.threads, options.output, options.quiet);
  app.parse(argc, argv);
  return options;
}

/// The file of a study; names of those that are shipped are looked for in `shipped`.
[[nodiscard]] inline std::filesystem::path study_file(const std::string& study, const std::filesystem::path& shipped) {
  const std::filesystem::path named = shipped / (study + ".toml");
  std::error_code error;
  return std::filesystem::is_regular_file(named, error) ? named : std::filesystem::path(study);
}

}  // namespace experiment
