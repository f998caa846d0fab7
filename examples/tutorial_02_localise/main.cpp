/// Tutorial 2, docs/tutorials/02_localise.md: localisation in the map of tutorial 1, with odometry that is bad.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "incognita/io/carmen_log.hpp"
#include "support/belief_output.hpp"
#include "support/chart.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"
#include "tutorial_02_localise/localise.hpp"

namespace {

using namespace tutorial_localise;

void draw_errors(const std::filesystem::path& file, const std::vector<Instant>& instants) {
  examples::Series error{.name = "true error of the filter", .color = "#1a4dd9"};
  examples::Series bound{.name = "its own 3 sigma", .color = "#1a4dd9", .stroke = examples::Stroke::dashed};
  examples::Series ours{.name = "filter", .color = "#1a4dd9"};
  examples::Series odometry{.name = "odometry alone", .color = "#d94d1a"};
  for (const Instant& now : instants) {
    for (examples::Series* series : {&error, &bound, &ours, &odometry}) series->x.push_back(now.time_s);
    error.y.push_back(100.0 * distance_m(now.belief.pose, now.truth));
    bound.y.push_back(300.0 * incognita::position_sigma_m(now.belief.covariance));
    ours.y.push_back(distance_m(now.belief.pose, now.truth));
    odometry.y.push_back(distance_m(now.odometry, now.truth));
  }
  examples::write_chart_png(
      file, {{.title = "Position error and what the filter thinks of it", .x_label = "time (s)", .y_label = "cm", .series = {error, bound}},
             {.title = "Against odometry", .x_label = "time (s)", .y_label = "position error (m)", .series = {ours, odometry}}});
}

void draw_map(const std::filesystem::path& file, const incognita::Map<>& map, const std::vector<Instant>& instants) {
  // In the map's frame, where the building stands aslant.
  incognita::Box<Eigen::Vector2d> shown_m;
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(map.grid().size()); ++cell) {
    if (map.log_odds(cell) > 1.0F) shown_m.stretch_to(map.lattice().center_m(map.grid().index_at(cell)));
  }
  examples::Drawing drawing(shown_m.padded(0.4), 1000, 1048.0);
  examples::draw_belief(drawing, map, incognita::Pose2{});
  constexpr examples::Color true_path{0.1, 0.6, 0.2};
  constexpr examples::Color filter_path{0.1, 0.3, 0.85};
  constexpr examples::Color odometry_path{0.85, 0.3, 0.1};
  std::vector<Eigen::Vector2d> truth_m;
  std::vector<Eigen::Vector2d> filter_m;
  std::vector<Eigen::Vector2d> odometry_m;
  for (const Instant& now : instants) {
    truth_m.push_back(now.truth.position());
    filter_m.push_back(now.belief.pose.position());
    odometry_m.push_back(now.odometry.position());
  }
  drawing.polyline(odometry_m, odometry_path);
  drawing.polyline(truth_m, true_path, 5.0);
  drawing.polyline(filter_m, filter_path, 1.5);
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area},
                  {"never measured", examples::never_seen, Swatch::area},
                  {"true path", true_path, Swatch::line},
                  {"filter", filter_path, Swatch::line},
                  {"odometry alone", odometry_path, Swatch::line}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  examples::require_gnuplot();
  const incognita::World world(examples::tutorial_building());
  examples::write_recording(output.staged("scans.log"), world);
  const incognita::RobotLog log = incognita::read_carmen_log(output.staged("scans.log"));
  const Slam slam = learn(log);

  const incognita::Pose2 T_map_world = map_from_world(log);
  incognita::Simulator robot = robot_after(log, world, 1);
  const std::vector<Instant> instants = localise(slam, examples::moved(todays_route_m(), T_map_world), T_map_world, robot);
  const Score score = score_of(instants);
  std::printf("%zu scans in %.0f s\n", instants.size(), instants.back().time_s);
  std::printf("position_rmse_m %.3f\nposition_worst_m %.3f\nodometry_worst_m %.3f\n", score.rmse_m, score.worst_m, score.odometry_worst_m);
  std::printf("within_3_sigma %.3f\nnees %.2f\ncollisions %zu\n", score.within_3_sigma, score.nees, robot.collisions());
  draw_errors(output.staged("errors.png"), instants);
  draw_map(output.staged("localise.png"), slam.map(), instants);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Localises a robot with bad odometry in the map of a log.");
  return examples::run_tutorial("tutorial_02_localise", app, argc, argv, run);
}
