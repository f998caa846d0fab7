/// Tutorial 2, docs/tutorials/02_localise.md: localisation in the map of tutorial 1, with odometry that is bad.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/map/map.hpp"
#include "incognita/metrics/nees.hpp"
#include "incognita/planning/follow.hpp"
#include "incognita/simulation/simulator.hpp"
#include "support/belief_output.hpp"
#include "support/chart.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"

namespace {

constexpr double kFrameTurn_rad = 0.5;  // of the map's frame against the walls

using Slam = incognita::Slam<incognita::Map<>, incognita::DvlEkf>;

/// Yesterday: the log's poses are good, and filter and map learn from its scans.
Slam learn(const incognita::RobotLog& log) {
  incognita::DvlEkf::Params params;
  params.start.pose = {0.0, 0.0, kFrameTurn_rad};  // the first pose of the log in the map's frame, which you choose
  Slam slam{incognita::DvlEkf(params)};
  const incognita::LogScan* before = &log.scans.front();
  for (const incognita::LogScan& entry : log.scans) {
    slam.move(before->T_odom_robot.inverse() * entry.T_odom_robot, entry.time_s - before->time_s);
    slam.observe(incognita::Scan<2>(log.beams, entry.ranges_m));
    before = &entry;
  }
  return slam;
}

/// What is written down at each scan, in the map's frame.
struct Instant {
  double time_s;
  incognita::Pose2 truth;
  incognita::PoseBelief belief;
  incognita::Pose2 odometry;
};

/// Today: odometry drifts, nothing is learned, and the pose is corrected by the map alone.
std::vector<Instant> localise(const Slam& slam, const std::vector<Eigen::Vector2d>& route_m, const incognita::Pose2& T_map_world,
                              incognita::Simulator& robot) {
  incognita::DvlEkf filter = slam.filter();
  const incognita::Map<>& map = slam.map();
  incognita::DeadReckoning::Params from_here;
  from_here.start = filter.belief();
  incognita::DeadReckoning odometry(from_here);

  incognita::PathFollower follower(route_m, incognita::FollowParams{});
  std::vector<Instant> instants;
  while (!follower.is_finished() && robot.time_s() < 300.0) {
    const incognita::Pose2 increment = robot.step(follower.command(filter.belief().pose));
    filter.predict(increment, 0.02);
    odometry.predict(increment, 0.02);
    if (!robot.scan_is_new()) continue;
    const incognita::CorrectionReport report = filter.correct(robot.scan(), map);
    if (report.lost) std::printf("lost at %.1f s\n", robot.time_s());
    instants.push_back({robot.time_s(), T_map_world * robot.T_world_robot(), filter.belief(), odometry.belief().pose});
  }
  return instants;
}

double distance_m(const incognita::Pose2& a, const incognita::Pose2& b) { return (a.position() - b.position()).norm(); }

void report(const std::vector<Instant>& instants) {
  double squares_m2 = 0.0;
  double worst_m = 0.0;
  double odometry_worst_m = 0.0;
  std::size_t within = 0;
  incognita::MeanNees nees;
  for (const Instant& now : instants) {
    const double error_m = distance_m(now.belief.pose, now.truth);
    squares_m2 += error_m * error_m;
    worst_m = std::max(worst_m, error_m);
    odometry_worst_m = std::max(odometry_worst_m, distance_m(now.odometry, now.truth));
    within += error_m <= 3.0 * incognita::position_sigma_m(now.belief.covariance) ? 1 : 0;
    nees.add(now.belief.pose, now.truth, now.belief.covariance);
  }
  const auto count = static_cast<double>(instants.size());
  std::printf("%zu scans in %.0f s\n", instants.size(), instants.back().time_s);
  std::printf("position_rmse_m %.3f\nposition_worst_m %.3f\nodometry_worst_m %.3f\n", std::sqrt(squares_m2 / count), worst_m,
              odometry_worst_m);
  std::printf("within_3_sigma %.3f\nnees %.2f\n", static_cast<double>(within) / count, nees.position());
}

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

  incognita::SimulatorParams params;
  params.odometry = {0.15, 0.1};  // sigmas of speed (m/s) and turn rate (rad/s), three and five times the usual
  params.sensor.beams = log.beams;
  const incognita::Pose2 T_world_start = log.scans.back().T_odom_robot;  // where the log ends
  incognita::Simulator robot(world, T_world_start, params, 1);
  // The log's poses are in the building's frame; the map's is turned against it.
  const incognita::Pose2 T_map_world = incognita::Pose2{0.0, 0.0, kFrameTurn_rad} * log.scans.front().T_odom_robot.inverse();
  const std::vector<Eigen::Vector2d> route_m{{1.0, 4.7},  {4.0, 4.7},  {4.0, 6.6},  {6.6, 7.4},  {9.4, 7.4}, {11.5, 6.4}, {11.5, 4.7},
                                             {13.0, 4.7}, {13.0, 2.2}, {13.0, 4.7}, {8.0, 4.7}, {8.0, 2.6}, {8.0, 4.7},  {1.0, 4.7}};
  const std::vector<Instant> instants = localise(slam, examples::moved(route_m, T_map_world), T_map_world, robot);
  report(instants);
  std::printf("collisions %zu\n", robot.collisions());
  draw_errors(output.staged("errors.png"), instants);
  draw_map(output.staged("localise.png"), slam.map(), instants);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Localises a robot with bad odometry in the map of a log.");
  return examples::run_tutorial("tutorial_02_localise", app, argc, argv, run);
}
