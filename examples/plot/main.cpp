// Draws how runs of kth_explorer went, with the spread of those that differ in their seeds alone.
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "incognita/io/input_error.hpp"
#include "plot/comparison.hpp"
#include "plot/figures.hpp"
#include "plot/groups.hpp"
#include "plot/options.hpp"
#include "plot/run_folder.hpp"
#include "plot/table.hpp"
#include "support/chart.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"

namespace plot {
namespace {

/// Throws InputError for a folder that is given twice: its run would count twice.
std::vector<Run> read_runs(const std::vector<std::string>& folders) {
  std::vector<Run> runs;
  for (const std::string& folder : folders) {
    runs.push_back(read_run(folder));
    for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
      std::error_code ignored;
      if (std::filesystem::equivalent(runs[i].folder, folder, ignored)) {
        throw incognita::InputError(folder, "is given twice, but must count once");
      }
    }
  }
  return runs;
}

void run(const Options& options) {
  examples::require_gnuplot();
  const std::vector<Run> runs = read_runs(options.folders);
  const Comparison comparison = compared(grouped(runs, options.keys));
  examples::OutputFolder output(options.output, {"explored.png", "entropy.png", "error.png", "nees.png", "summary.png", "plot.csv"});
  write_table(output.staged("plot.csv"), comparison);
  draw_explored(output.staged("explored.png"), comparison);
  draw_entropy(output.staged("entropy.png"), comparison);
  draw_error(output.staged("error.png"), comparison);
  draw_nees(output.staged("nees.png"), comparison);
  draw_summary(output.staged("summary.png"), comparison);
  output.publish();
  if (options.quiet) return;
  for (const Group& group : comparison.groups) std::printf("  %s\n", group.title().c_str());
  std::printf("Results are in %s\n", output.path().string().c_str());
}

}  // namespace
}  // namespace plot

int main(int argc, char** argv) {
  CLI::App app(
      "Draws how runs of kth_explorer went: explored floor, entropy of the map, error of the position under 3 sigma, NEES, and what they "
      "ended with. Runs that differ in their seeds alone make a group; of each group the median and the quartiles are drawn, or, of fewer "
      "than 4 runs, the range from the least to the greatest. A curve ends where its run ended: from there on the band is of the runs that are left. "
      "Writes explored.png, entropy.png, error.png, nees.png, summary.png, and their numbers as plot.csv.");
  return examples::run_program("plot", app, [&] { plot::run(plot::parse_options(app, argc, argv)); });
}
