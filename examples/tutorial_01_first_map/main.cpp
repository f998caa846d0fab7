/// Tutorial 1, docs/tutorials/01_first_map.md: a first map from scans whose poses are known.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/estimation/pose_belief.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/map/map.hpp"
#include "incognita/metrics/map_error.hpp"
#include "incognita/metrics/truth.hpp"
#include "incognita/simulation/world.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"

namespace {

incognita::Map<> map_of(const incognita::RobotLog& log) {
  incognita::Map<> map;  // T-BayesMap cells of 0.1 m
  const Eigen::Matrix3d covariance = incognita::diagonal_covariance(1e-4, 1e-4, 1e-4);  // 0.01 m, 0.01 rad
  std::size_t used = 0;
  std::size_t ignored = 0;
  for (const incognita::LogScan& entry : log.scans) {
    const incognita::Scan<2> scan(log.beams, entry.ranges_m);
    const incognita::Pose2 T_map_laser = entry.T_odom_robot * log.T_robot_laser;
    const incognita::ScanReport report = map.update(scan, T_map_laser, covariance);
    used += report.beams_used;
    ignored += report.beams_ignored;
  }
  std::printf("%zu scans, %zu beams used, %zu ignored\n", log.scans.size(), used, ignored);
  return map;
}

void draw(const std::filesystem::path& file, const incognita::Map<>& map, const incognita::RobotLog& log) {
  const Eigen::Vector2d first_m = log.scans.front().T_odom_robot.position();
  incognita::Box<Eigen::Vector2d> shown_m{first_m, first_m};
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(map.grid().size()); ++cell) {
    if (map.log_odds(cell) > 1.0F) shown_m.stretch_to(map.lattice().center_m(map.grid().index_at(cell)));
  }
  examples::Drawing drawing(shown_m.padded(0.3), 1000, 1048.0);
  examples::draw_belief(drawing, map, incognita::Pose2{});
  constexpr examples::Color path{0.1, 0.3, 0.85};
  std::vector<Eigen::Vector2d> points_m;
  for (const incognita::LogScan& entry : log.scans) points_m.push_back(entry.T_odom_robot.position());
  drawing.polyline(points_m, path);
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area},
                  {"free", {1.0, 1.0, 1.0}, Swatch::area},
                  {"never measured", examples::never_seen, Swatch::area},
                  {"poses of the log", path, Swatch::line}});
  drawing.write_png(file);
}

void run(const std::string& given_log, examples::OutputFolder& output) {
  std::filesystem::path file = given_log;
  const incognita::World world(examples::tutorial_building());
  if (given_log.empty()) {
    file = output.staged("scans.log");
    examples::write_recording(file, world);
  }

  const incognita::RobotLog log = incognita::read_carmen_log(file);
  std::printf("%zu beams, no return from %.2f m, usable up to %.2f m\n", log.beams.directions.size(), log.limits.no_return_m,
              log.limits.usable_m);
  const incognita::Map<> map = map_of(log);
  draw(output.staged("first_map.png"), map, log);
  examples::write_map(output.staged("map.yaml"), map, incognita::OccupancyThresholds{});

  if (given_log.empty()) {
    const auto truth = incognita::truly_occupied_cells(world.plan(), incognita::Pose2{}, map.lattice());
    std::printf("map_error %.3f\n", incognita::map_error(map, truth).value());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Makes a map from scans with known poses: a log of your own, or else one of a simulated drive, written first.");
  std::string log_file;
  app.add_option("--log", log_file, "scans with poses: a CARMEN log (FLASER, ROBOTLASER1)")
      ->type_name("FILE")
      ->check(examples::refuse_empty);
  return examples::run_tutorial("tutorial_01_first_map", app, argc, argv,
                                [&](examples::OutputFolder& output) { run(log_file, output); });
}
