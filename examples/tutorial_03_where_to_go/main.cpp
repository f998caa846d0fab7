/// Tutorial 3, docs/tutorials/03_where_to_go.md: frontiers, views of them and what each way there would tell, without an Explorer.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/map/map.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/world.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"

namespace {

constexpr double kRange_m = 5.0;  // of the robot's sensor

/// A way to look at a frontier.
struct Way {
  incognita::Frontier<2> frontier;
  incognita::Polyline path;
  double gain_nats = 0.0;    ///< predicted
  double truth_nats = 0.0;   ///< what driving there told indeed
};

std::vector<Way> ways_to_look(const incognita::Map<>& map, const Eigen::Vector2d& robot_m) {
  using namespace incognita;
  // 1. The belief in three words, and where the free part of it ends.
  const OccupancyGrid<2> occupancy = classify(map);
  const std::vector<Frontier<2>> frontiers = find_frontiers(occupancy);

  // 2. What it costs a robot of 0.2 m to get anywhere.
  const Grid<float, 2> clearance_m = distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; });
  const TravelCostField field(occupancy, clearance_m, robot_m, TravelParams{});

  // 3. From where each frontier is seen, among the places that can be reached. A cell less than the sensor's range.
  const CellBits free = free_cells(occupancy);
  const ReliableVisibility visibility(occupancy, free, {kRange_m - 0.15, 0.05});
  const std::vector<Index<2>> frontier_cells = detect_frontier(occupancy);
  const auto is_frontier = [&](const Index<2>& cell) {
    return std::binary_search(frontier_cells.begin(), frontier_cells.end(), cell, is_stored_before<2>);
  };
  const auto is_reached = [&](const Index<2>& cell) { return field.reaches(cell); };
  ViewpointSearch search;
  std::vector<Way> ways;
  for (const FrontierView& view : find_views(frontiers, is_frontier, is_reached, visibility, 0.01, search)) {
    const std::vector<Eigen::Vector2d> path_m = shorten_path(field, find_path(field, view.viewpoint));
    ways.push_back({frontiers[view.region], Polyline(path_m)});
  }
  return ways;
}

void predict_gains(incognita::Map<>& map, const incognita::PoseBelief& robot, std::vector<Way>& ways) {
  using namespace incognita;
  DvlEkf::Params filter_params;
  filter_params.start = robot;
  const DvlEkf filter(filter_params);                // predicts how the pose's covariance grows on the way
  const EntropyTable entropy{Behavioral(1.0)};       // what a cell's uncertainty is, by its log-odds
  GainParams params;
  params.range_max_m = kRange_m;
  GainWorkspace<TBayes> workspace;                   // scratch, for the next call too
  for (const Way& way : ways) {                      // prediction does not grow the map, so make room for it first
    for (const Eigen::Vector2d& corner_m : way.path.points_m()) {
      map.reserve(Box<Eigen::Vector2d>{corner_m, corner_m}.padded(kRange_m + 1.0));
    }
  }
  for (Way& way : ways) way.gain_nats = information_gain(map, entropy, filter, way.path, params, workspace);
  std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.gain_nats > b.gain_nats; });
}

/// The entropy that is gone when the way was really driven, a scan every 0.1 m.
double driven_nats(incognita::Map<> map, const incognita::EntropyTable& entropy, const incognita::World& world, const Way& way) {
  using namespace incognita;
  const auto total_nats = [&] { return map_entropy_nats(map, entropy); };
  // Room first, so that cells that nothing was measured of count before and after.
  for (const Eigen::Vector2d& corner_m : way.path.points_m()) {
    map.reserve(Box<Eigen::Vector2d>{corner_m, corner_m}.padded(kRange_m + 2.0));
  }
  const double before_nats = total_nats();
  RangeSensor sensor({circular_beams(360, kRange_m), 0.01}, 2);
  for (const Eigen::Vector2d& at_m : resample_path(way.path, 0.1)) {
    const Pose2 pose{at_m.x(), at_m.y(), 0.0};
    map.update(sensor.measure(world, pose), pose, diagonal_covariance(1e-4, 1e-4, 1e-4));
  }
  return before_nats - total_nats();
}

/// From yellow to dark red.
examples::Color color_of(double share) { return {1.0 - 0.45 * share, 0.8 * (1.0 - share), 0.0}; }

void draw(const std::filesystem::path& file, const incognita::Map<>& map, const Eigen::Vector2d& robot_m, const std::vector<Way>& ways) {
  examples::Drawing drawing = examples::building_drawing();
  examples::draw_belief(drawing, map, incognita::Pose2{});
  const double most_nats = ways.front().gain_nats;
  for (const Way& way : ways) {
    const examples::Color color = color_of(way.gain_nats / most_nats);
    for (const incognita::Index<2>& cell : way.frontier.cells) drawing.disc(map.lattice().center_m(cell), 0.07, color);
    drawing.polyline(way.path.points_m(), color, 3.0);
  }
  for (const Way& way : ways) {
    const examples::Color color = color_of(way.gain_nats / most_nats);
    drawing.marker(way.path.points_m().back(), color);
    drawing.text(way.path.points_m().back(), std::to_string(std::lround(way.gain_nats)), {0.1, 0.1, 0.1}, 15.0);
  }
  constexpr examples::Color robot{0.1, 0.3, 0.85};
  drawing.marker(robot_m, robot, 9.0);
  using examples::Swatch;
  drawing.legend({{"robot", robot, Swatch::dot},
                  {"frontier, way and viewpoint: little gain", color_of(0.0), Swatch::line},
                  {"much", color_of(1.0), Swatch::line},
                  {"never measured", examples::never_seen, Swatch::area}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  using namespace incognita;
  // Half a map: the first poses of the tour, known.
  const World world(examples::tutorial_building());
  const Eigen::Matrix3d covariance = diagonal_covariance(1e-4, 1e-4, 1e-4);
  RangeSensor sensor({circular_beams(360, kRange_m), 0.01}, 1);
  Map<> map;
  PoseBelief robot{{}, covariance};
  for (const Pose2& pose : examples::poses_along({{2.5, 2.6}, {2.5, 4.7}, {6.0, 4.7}})) {
    map.update(sensor.measure(world, pose), pose, covariance);
    robot.pose = pose;
  }

  std::vector<Way> ways = ways_to_look(map, robot.pose.position());
  predict_gains(map, robot, ways);
  for (Way& way : ways) way.truth_nats = driven_nats(map, EntropyTable{Behavioral(1.0)}, world, way);
  std::printf("   gain    true  way to  (nats, nats, m)\n");
  for (const Way& way : ways) {
    const Eigen::Vector2d& goal_m = way.path.points_m().back();
    std::printf("way %6.0f  %6.0f  %4.1f, %3.1f  %4.1f m\n", way.gain_nats, way.truth_nats, goal_m.x(), goal_m.y(), way.path.length_m());
  }
  draw(output.staged("where_to_go.png"), map, robot.pose.position(), ways);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Ranks the ways to the frontiers of a half finished map by what they are predicted to tell.");
  return examples::run_tutorial("tutorial_03_where_to_go", app, argc, argv, run);
}
