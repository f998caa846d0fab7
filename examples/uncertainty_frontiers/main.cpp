// Shows what uncertainty maps and frontiers are good for, by the experiments of Sansoni et al., section 5.
#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "support/chart.hpp"
#include "support/output_folder.hpp"
#include "support/program.hpp"
#include "support/progress.hpp"
#include "uncertainty_frontiers/experiments.hpp"
#include "uncertainty_frontiers/figures.hpp"
#include "uncertainty_frontiers/options.hpp"
#include "uncertainty_frontiers/report.hpp"

namespace uncertainty_frontiers {
namespace {

void run(const Options& options) {
  examples::require_gnuplot();  // what would fail minutes later fails now
  const auto chosen = [&](const char* name) { return options.experiment == name || options.experiment == "all"; };
  std::vector<std::string> files;
  if (chosen("figures")) files.push_back("figures.png");
  if (chosen("corridors")) files.insert(files.end(), {"corridors_around.png", "corridors_home.png", "corridors.csv"});
  if (chosen("hall")) files.insert(files.end(), {"trials.csv", "siren.png", "siren_0.6.png", "maps.png"});
  examples::OutputFolder output(options.output, files);
  const auto seeds = static_cast<std::size_t>(options.seeds);

  if (chosen("figures")) draw_figures(output.staged("figures.png"));
  std::vector<CorridorDrive> drives;
  if (chosen("corridors")) {
    for (std::size_t seed = 1; seed <= seeds; ++seed) drives.push_back(corridor_drive(seed));
    draw_corridors(output.staged("corridors_around.png"), drives.front().around);
    draw_corridors(output.staged("corridors_home.png"), drives.front().home);
    write_corridors(output.staged("corridors.csv"), drives);
  }
  std::vector<Series> all;
  if (chosen("hall")) {
    all = hall_settings();
    std::function<void(std::size_t, std::size_t)> report;
    if (!options.quiet) report = examples::progress_of("trials");
    run_trials(all, seeds, options.threads, report);
    write_trials(output.staged("trials.csv"), all);
    draw_box_plots(output.staged("siren.png"), all, 1);
    draw_box_plots(output.staged("siren_0.6.png"), all, 0);
    draw_trials(output.staged("maps.png"), all);
  }
  output.publish();
  if (options.quiet) return;
  if (!drives.empty()) print_corridors(drives);
  if (!all.empty()) print_hall(all);
  std::printf("Results are in %s\n", output.path().string().c_str());
}

}  // namespace
}  // namespace uncertainty_frontiers

int main(int argc, char** argv) {
  CLI::App app("Robots that find their position by landmarks map corridors and a hall, and choose where to go by classical or\n"
               "by uncertainty frontiers (Sansoni et al., section 5). Writes tables as CSV, and uncertainty maps with\n"
               "frontiers and ways, and box plots of SiREn, as PNG.");
  return examples::run_program("uncertainty_frontiers", app,
                               [&] { uncertainty_frontiers::run(uncertainty_frontiers::parse_options(app, argc, argv)); });
}
