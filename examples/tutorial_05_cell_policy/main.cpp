/// Tutorial 5, docs/tutorials/05_cell_policy.md: a cell policy of one's own, which sees glass.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/exploration/explorer.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/testing/cell_policy_laws.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"
#include "tutorial_05_cell_policy/counting.hpp"
#include "tutorial_05_cell_policy/glass.hpp"

namespace {

constexpr double kReflected = 0.3;  // of the beams that meet a pane

/// A map by a tour whose poses are known.
template <class Cell>
incognita::Map<Cell> toured() {
  incognita::Map<Cell> map;
  GlassScanner scanner(incognita::circular_beams(360, 10.0), kReflected);
  for (const incognita::Pose2& pose : examples::poses_along(examples::recorded_route_m())) {
    map.update(scanner.measure(pose), pose, incognita::diagonal_covariance(1e-4, 1e-4, 1e-4));
  }
  return map;
}

/// How the cells of the panes are classified: free, unknown and occupied columns along them.
template <class Map>
void report_panes(const std::string& name, const Map& map) {
  const incognita::OccupancyThresholds thresholds;
  int columns = 0;
  int occupied = 0;
  int open = 0;
  for (const examples::Area& pane : {upper_pane, lower_pane}) {
    for (double x_m = pane.lower.x() + 0.05; x_m < pane.upper.x(); x_m += 0.1) {
      // A pane is as thick as a cell and lies on the border of two: it is seen when one of them is occupied, open when both are free.
      int occupied_here = 0;
      int free_here = 0;
      for (const double y_m : {pane.lower.y(), pane.upper.y()}) {
        const auto occupancy = thresholds.classify(map.log_odds(map.lattice().index_of({x_m, y_m})));
        occupied_here += occupancy == incognita::Occupancy::occupied ? 1 : 0;
        free_here += occupancy == incognita::Occupancy::free ? 1 : 0;
      }
      ++columns;
      occupied += occupied_here > 0 ? 1 : 0;
      open += free_here == 2 ? 1 : 0;
    }
  }
  std::printf("%s %.2f seen, %.2f taken for open\n", name.c_str(), static_cast<double>(occupied) / columns, static_cast<double>(open) / columns);
}

template <class Cell>
void explore(const std::string& name, const incognita::Pose2& T_world_start) {
  incognita::ExplorerParams params;
  params.duration_max_s = 600.0;
  incognita::Explorer<incognita::Map<Cell>> explorer(params);
  incognita::Simulator robot(incognita::World(examples::tutorial_building()), T_world_start, {}, 1);
  GlassScanner scanner(incognita::circular_beams(360, 10.0), kReflected);
  incognita::Twist2 command;
  while (!explorer.stopped()) {
    explorer.move(robot.step(command), 0.02);
    if (!robot.scan_is_new()) continue;
    const incognita::Scan<2>& scan = scanner.measure(robot.T_world_robot());
    explorer.observe(scan);
    explorer.decide();
    command = explorer.command(scan);
  }
  std::printf("%s explorer: %s after %.0f s and %.1f m, %zu collisions, error %.3f m\n", name.c_str(), to_string(*explorer.stopped()).data(), robot.time_s(),
              robot.distance_m(), robot.collisions(), (explorer.belief().pose.position() - robot.T_start_robot().position()).norm());
}

void draw(const std::filesystem::path& file, const incognita::Map<Counting>& counting, const incognita::Map<>& t_bayes,
          const incognita::Map<incognita::LogOdds>& log_odds) {
  constexpr examples::Color glass{1.0, 0.55, 0.0};
  const examples::Area view{{4.0, 2.6}, {12.0, 6.8}};
  examples::Drawing drawing({{-0.2, -0.2}, {25.0, 4.9}}, 1100, 1148.0);
  const auto part = [&](const auto& map, double left_m, const std::string& title) {
    const Eigen::Vector2d shift_m = Eigen::Vector2d(left_m, 0.0) - view.lower;
    examples::draw_part(drawing, map, view, shift_m, title);
    // Beside the panes, so as not to cover their cells.
    for (const auto& [pane, beside_m] : {std::pair{upper_pane, 0.3}, std::pair{lower_pane, -0.3}}) {
      const Eigen::Vector2d offset_m = shift_m + Eigen::Vector2d(0.0, beside_m);
      drawing.polyline({pane.lower + offset_m, Eigen::Vector2d(pane.upper.x(), pane.lower.y()) + offset_m}, glass, 4.0);
    }
  };
  part(counting, 0.0, "Counting");
  part(t_bayes, 8.4, "TBayes");
  part(log_odds, 16.8, "LogOdds");
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area}, {"free", {1.0, 1.0, 1.0}, Swatch::area}, {"beside this line the wall is glass", glass, Swatch::line}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  const incognita::LawReport laws = incognita::check_cell_policy_laws(Counting{});
  if (!laws.holds()) throw std::runtime_error("Counting breaks the laws of a cell policy:\n" + laws.text());
  std::printf("laws hold\n");

  const auto counting = toured<Counting>();
  const auto log_odds = toured<incognita::LogOdds>();
  const auto t_bayes = toured<incognita::TBayes>();
  report_panes("Counting", counting);
  report_panes("LogOdds", log_odds);
  report_panes("TBayes", t_bayes);

  const Counting policy;
  const auto& grid = counting.grid();
  for (const incognita::Point<2>& at_m : {incognita::Point<2>(6.3, 5.58), incognita::Point<2>(4.4, 3.78), incognita::Point<2>(4.0, 4.7)}) {
    const Counting::State state = grid.value(counting.lattice().index_of(at_m));
    std::printf("share at %.1f, %.1f: %.3f +- %.3f (%d hits, %d passes)\n", at_m.x(), at_m.y(), policy.mean(state), policy.sigma(state), state.hits, state.passes);
  }
  explore<Counting>("Counting", {1.5, 4.7, 0.4});
  explore<incognita::LogOdds>("LogOdds", {1.5, 4.7, 0.4});
  explore<incognita::TBayes>("TBayes", {1.5, 4.7, 0.4});

  draw(output.staged("cell_policy.png"), counting, t_bayes, log_odds);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps a building with panes of glass by a cell policy of one's own.");
  return examples::run_tutorial("tutorial_05_cell_policy", app, argc, argv, run);
}
