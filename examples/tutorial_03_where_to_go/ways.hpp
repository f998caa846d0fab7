/// Frontiers, views of them and what each way there is predicted to tell, without an Explorer.
#pragma once

#include <algorithm>
#include <vector>

#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/frontier_view.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "incognita/frontier/frontier.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/map/map.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/world.hpp"
#include "support/tutorial_recording.hpp"

namespace tutorial_ways {

inline constexpr double range_max_m = 5.0;  // of the robot's sensor

/// A way to look at a frontier.
struct Way {
  incognita::Frontier<2> frontier;
  incognita::Polyline path;
  double gain_nats = 0.0;    ///< predicted
  double truth_nats = 0.0;   ///< what driving there told indeed
};

[[nodiscard]] inline std::vector<Way> ways_to_look(const incognita::Map<>& map, const Eigen::Vector2d& robot_m) {
  using namespace incognita;
  // 1. The belief in three words, and where the free part of it ends.
  const OccupancyGrid<2> occupancy = classify(map);
  const std::vector<Frontier<2>> frontiers = find_frontiers(occupancy);

  // 2. What it costs a robot of 0.2 m to get anywhere.
  const Grid<float, 2> clearance_m = distance_transform_m(occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; });
  const TravelCostField field(occupancy, clearance_m, robot_m, TravelParams{});

  // 3. From where each frontier is seen, among the places that can be reached. A cell less than the sensor's range.
  const CellBits free = free_cells(occupancy);
  const ReliableVisibility visibility(occupancy, free, {range_max_m - 0.15, 0.05});
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

inline void predict_gains(incognita::Map<>& map, const incognita::PoseBelief& robot, const incognita::EntropyTable& entropy, std::vector<Way>& ways) {
  using namespace incognita;
  DvlEkf::Params filter_params;
  filter_params.start = robot;
  const DvlEkf filter(filter_params);                // predicts how the pose's covariance grows on the way
  GainParams params;
  params.range_max_m = range_max_m;
  GainWorkspace<TBayes> workspace;                   // scratch, for the next call too
  for (const Way& way : ways) {                      // prediction does not grow the map, so make room for it first
    for (const Eigen::Vector2d& corner_m : way.path.points_m()) {
      map.reserve(Box<Eigen::Vector2d>{corner_m, corner_m}.padded(range_max_m + 1.0));
    }
  }
  for (Way& way : ways) way.gain_nats = information_gain(map, entropy, filter, way.path, params, workspace);
  std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.gain_nats > b.gain_nats; });
}

/// Half a map: the first poses of a tour, known. Returns where the robot is then.
[[nodiscard]] inline incognita::PoseBelief map_half(const incognita::World& world, incognita::Map<>& map) {
  const Eigen::Matrix3d covariance = incognita::diagonal_covariance(1e-4, 1e-4, 1e-4);
  incognita::RangeSensor sensor({incognita::circular_beams(360, range_max_m), 0.01}, 1);
  incognita::PoseBelief robot{{}, covariance};
  for (const incognita::Pose2& pose : examples::poses_along({{2.5, 2.6}, {2.5, 4.7}, {6.0, 4.7}})) {
    map.update(sensor.measure(world, pose), pose, covariance);
    robot.pose = pose;
  }
  return robot;
}

}  // namespace tutorial_ways
