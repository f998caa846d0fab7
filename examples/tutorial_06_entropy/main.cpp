/// Tutorial 6, docs/tutorials/06_entropy.md: an entropy of one's own, and what it changes.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/entropy/shannon.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/testing/entropy_laws.hpp"
#include "support/chart.hpp"
#include "support/tutorial.hpp"

namespace {

/// Twice the chance that two independent looks at the cell, each right with the cell's own probability, disagree: the Gini index,
/// scaled so that an unknown cell has ln 2 like the others.
struct Gini {
  double operator()(double p) const { return 4.0 * std::log(2.0) * p * (1.0 - p); }
};
static_assert(incognita::EntropyMeasure<Gini>);

/// The same as a lambda: whatever is copied and called with a probability will do.
constexpr auto gini = [](double p) { return 4.0 * std::log(2.0) * p * (1.0 - p); };
static_assert(incognita::EntropyMeasure<decltype(gini)>);

/// How an exploration went.
struct Mission {
  incognita::StopReason stopped;
  double distance_m;
  double to_90_percent_m;
};

template <class Entropy>
Mission explore(const Entropy& entropy, const incognita::Pose2& T_world_start, std::uint64_t seed) {
  incognita::ExplorerParams params;
  params.duration_max_s = 900.0;
  incognita::Explorer<incognita::Map<>, Entropy> explorer(params, incognita::Map<>{}, entropy);

  incognita::Simulator robot(incognita::World(examples::tutorial_building()), T_world_start, {}, seed);
  const incognita::Coverage coverage(incognita::visible_floor(robot.world(), T_world_start.position(), 0.2, 10.0), robot.T_start_world(),
                                     explorer.map().lattice());
  const auto is_known = [&](const incognita::Index<2>& cell) {
    return explorer.occupancy().grid().value(cell) != incognita::Occupancy::unknown;
  };
  incognita::Twist2 command;
  std::optional<double> most_m;
  while (!explorer.stopped()) {
    explorer.move(robot.step(command), 0.02);
    if (!robot.scan_is_new()) continue;
    explorer.observe(robot.scan());
    explorer.decide();
    command = explorer.command(robot.scan());
    if (!most_m && coverage.explored_fraction(is_known) >= 0.9) most_m = robot.distance_m();
  }
  return {*explorer.stopped(), robot.distance_m(), most_m.value_or(robot.distance_m())};
}

/// From several starts: one mission says little, since a robot that turns left where another turned right sees another building.
template <class Entropy>
void report(const std::string& name, const Entropy& entropy) {
  const std::vector<incognita::Pose2> starts{{1.5, 4.7, 0.4}, {13.0, 2.2, 2.0}, {4.0, 7.0, -1.0}};
  std::vector<double> whole_m;
  double to_90_percent_m = 0.0;
  int ended = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Mission mission = explore(entropy, starts[i], i + 1);
    whole_m.push_back(mission.distance_m);
    to_90_percent_m += mission.to_90_percent_m / static_cast<double>(starts.size());
    using incognita::StopReason;
    ended += mission.stopped == StopReason::complete || mission.stopped == StopReason::nothing_informative ? 1 : 0;
  }
  double mean_m = 0.0;
  for (const double m : whole_m) mean_m += m / static_cast<double>(whole_m.size());
  const auto [least, most] = std::minmax_element(whole_m.begin(), whole_m.end());
  std::printf("%s ended %d of %zu, %.1f m (%.1f to %.1f), %.1f m to 90 %%\n", name.c_str(), ended, starts.size(), mean_m, *least, *most, to_90_percent_m);
}

void draw(const std::filesystem::path& file) {
  examples::Chart curves{.title = "Uncertainty of a cell", .x_label = "probability that it is occupied", .y_label = "nats", .x_range = {{0.0, 1.0}}};
  examples::Chart loss{.title = "What a first look is worth", .x_label = "log-odds after the look", .y_label = "nats gained on an unknown cell", .x_range = {{0.0, 8.0}}};
  const auto add = [&](const std::string& name, const std::string& color, const auto& measure) {
    examples::Series curve{.name = name, .color = color};
    examples::Series gained{.name = name, .color = color};
    for (int i = 0; i <= 400; ++i) {
      curve.x.push_back(i / 400.0);
      curve.y.push_back(measure(i / 400.0));
      gained.x.push_back(i / 50.0);
      gained.y.push_back(measure(0.5) - incognita::entropy_of_log_odds(measure, i / 50.0));
    }
    curves.series.push_back(curve);
    loss.series.push_back(gained);
  };
  add("Gini", "#e6550d", Gini{});
  add("Shannon", "#000000", incognita::Shannon{});
  add("Behavioral(0.5)", "#2b8cbe", incognita::Behavioral(0.5));
  examples::write_chart_png(file, {curves, loss});
}

void run(examples::OutputFolder& output) {
  examples::require_gnuplot();
  const incognita::LawReport laws = incognita::check_entropy_laws(Gini{});
  if (!laws.holds()) throw std::runtime_error("Gini breaks the laws of an entropy:\n" + laws.text());
  std::printf("laws hold\n");

  const incognita::EntropyTable table(Gini{});
  std::printf("table_error_nats %.2e\ntable_end_nats %.2e\nfast_sum %d\n", table.max_error_nats(), table.end_nats(), table.has_fast_sum() ? 1 : 0);

  report("Gini", Gini{});
  report("Shannon", incognita::Shannon{});
  draw(output.staged("entropy.png"));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Explores by an entropy of one's own.");
  return examples::run_tutorial("tutorial_06_entropy", app, argc, argv, run);
}
