// Explores office floors by every strategy and measure of Isleyen et al., section V, and compares how far the robot drives.
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "office_exploration/experiments.hpp"
#include "office_exploration/figures.hpp"
#include "office_exploration/options.hpp"
#include "office_exploration/tables.hpp"
#include "support/chart.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"

namespace office_exploration {
namespace {

std::vector<Series> chosen_experiments(const Options& options) {
  const auto starts = static_cast<std::size_t>(options.poses);
  std::vector<Series> all;
  const auto add = [&](const char* name, auto&& experiment) {
    if (options.experiment != name && options.experiment != "all") return;
    for (Series& series : experiment(starts)) all.push_back(std::move(series));
  };
  add("utility", utility_experiment);
  add("strategy", strategy_experiment);
  add("turtlebot", turtlebot_experiment);
  return all;
}

void run(const Options& options) {
  examples::require_gnuplot();  // what would fail minutes later fails now
  std::vector<Series> all = chosen_experiments(options);
  const std::vector<Figure> figures = figures_of(all);
  std::vector<std::string> files{"runs.csv", "curves.csv"};
  for (const Figure& figure : figures) {
    files.push_back(figure.name + ".png");
    files.push_back(figure.name + "_ways.png");
  }
  examples::OutputFolder output(options.output, files);

  std::function<void(std::size_t, std::size_t)> report;
  if (!options.quiet) report = examples::progress_of("missions");
  run_trials(all, options.threads, report);

  write_runs(output.staged("runs.csv"), all);
  write_curves(output.staged("curves.csv"), all);
  for (const Figure& figure : figures) {
    draw_curves(output.staged(figure.name + ".png"), figure);
    draw_ways(output.staged(figure.name + "_ways.png"), figure);
  }
  output.publish();
  if (options.quiet) return;
  print_table(all);
  std::printf("Results are in %s\n", output.path().string().c_str());
}

}  // namespace
}  // namespace office_exploration

int main(int argc, char** argv) {
  CLI::App app("Robots that know their pose and see 1.5 m explore office floors, by every strategy, measure of\n"
               "information and cost of navigation of Isleyen et al., section V. Writes runs.csv, curves.csv, and of\n"
               "each world the mapped percentage over the distance and the robots' ways as PNG.");
  return examples::run_program("office_exploration", app,
                               [&] { office_exploration::run(office_exploration::parse_options(app, argc, argv)); });
}
