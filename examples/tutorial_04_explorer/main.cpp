/// Tutorial 4, docs/tutorials/04_explorer.md: the whole explorer, with options, in an unknown building and back.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "incognita/exploration/explorer.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/simulator.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"

namespace {

using Explorer = incognita::Explorer<incognita::Map<>, incognita::Behavioral, incognita::LoopClosingDvlEkf>;

Explorer make_explorer() {
  incognita::ExplorerParams params;
  params.travel.robot_radius_m = 0.25;  // where paths may run ...
  params.guard.robot_radius_m = 0.25;   // ... and when to brake before what the scan shows
  params.follow.speed_max_m_per_s = 0.8;
  params.gain.range_max_m = 8.0;        // of the sensor, and so of what viewpoints see
  params.gain.speed_m_per_s = 0.8;
  params.information = incognita::FrontierInformation::log_big;  // finish what is at hand first
  params.duration_max_s = 900.0;
  incognita::MapParams map_params;
  map_params.resolution_m = 0.1;
  return Explorer(params, incognita::Map<>(map_params), incognita::Behavioral(0.7));
}

struct Drive {
  std::vector<Eigen::Vector2d> believed_m;  ///< in the map's frame, as all here
  std::vector<Eigen::Vector2d> goals_m;
  double worst_error_m = 0.0;

  void note(const Eigen::Vector2d& believed, const Eigen::Vector2d& truth) {
    believed_m.push_back(believed);
    worst_error_m = std::max(worst_error_m, (believed - truth).norm());
  }
};

/// Until the explorer stops, for whatever reason.
void drive(Explorer& explorer, incognita::Simulator& robot, Drive& driven) {
  incognita::Twist2 command;
  while (!explorer.stopped()) {
    explorer.move(robot.step(command), 0.02);  // odometry at 50 Hz ...
    if (!robot.scan_is_new()) continue;        // ... a scan at 10 Hz
    explorer.observe(robot.scan());
    if (explorer.decide() && explorer.goal()) driven.goals_m.push_back(*explorer.goal());
    command = explorer.command(robot.scan());
    driven.note(explorer.belief().pose.position(), robot.T_start_robot().position());
  }
}

void draw(const std::filesystem::path& file, const Explorer& explorer, const incognita::Simulator& robot, const Drive& driven) {
  const incognita::Pose2 T_world_map = robot.T_start_world().inverse();
  examples::Drawing drawing = examples::building_drawing();
  examples::draw_belief(drawing, explorer.map(), T_world_map);
  examples::draw_true_walls(drawing, robot.world().plan());
  constexpr examples::Color path{0.1, 0.3, 0.85};
  constexpr examples::Color goal{1.0, 0.6, 0.0};
  constexpr examples::Color start{0.75, 0.1, 0.6};
  drawing.polyline(examples::moved(driven.believed_m, T_world_map), path, 1.5);
  for (const Eigen::Vector2d& goal_m : driven.goals_m) drawing.marker(T_world_map * goal_m, goal, 5.0);
  drawing.marker(T_world_map.position(), start, 8.0);
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area},
                  {"true wall", examples::true_wall, Swatch::area},
                  {"never seen", examples::never_seen, Swatch::area},
                  {"path", path, Swatch::line},
                  {"goal", goal, Swatch::dot},
                  {"start, end", start, Swatch::dot}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  incognita::SimulatorParams sim;
  sim.robot.radius_m = 0.25;
  sim.robot.speed_max_m_per_s = 0.8;
  sim.sensor.beams = incognita::circular_beams(360, 8.0);
  const incognita::Pose2 T_world_start{1.5, 4.7, 0.4};
  incognita::Simulator robot(incognita::World(examples::tutorial_building()), T_world_start, sim, 1);

  Explorer explorer = make_explorer();
  Drive driven;
  drive(explorer, robot, driven);
  std::printf("explored: %s after %.0f s and %.1f m\n", to_string(*explorer.stopped()).data(), robot.time_s(), robot.distance_m());

  explorer.return_to_start();
  drive(explorer, robot, driven);
  std::printf("back: %s after %.0f s and %.1f m\n", to_string(*explorer.stopped()).data(), robot.time_s(), robot.distance_m());

  const incognita::Coverage coverage(incognita::visible_floor(robot.world(), T_world_start.position(), 0.25, 8.0),
                                     robot.T_start_world(), explorer.map().lattice());
  const double known = coverage.explored_fraction([&](const incognita::Index<2>& cell) {
    return explorer.occupancy().grid().value(cell) != incognita::Occupancy::unknown;
  });
  std::printf("explored_fraction %.3f\ncollisions %zu\nworst_error_m %.3f\nhome_m %.3f\n", known, robot.collisions(),
              driven.worst_error_m, robot.T_start_robot().position().norm());
  draw(output.staged("explorer.png"), explorer, robot, driven);
  examples::write_map(output.staged("map.yaml"), explorer.map(), explorer.params().thresholds);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Explores a building that it does not know, and comes back.");
  return examples::run_tutorial("tutorial_04_explorer", app, argc, argv, run);
}
