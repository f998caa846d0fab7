/// The estimator alone, over the commands of an earlier mission.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "accuracy/drive.hpp"
#include "accuracy/people.hpp"
#include "accuracy/statistics.hpp"
#include "incognita/core/random.hpp"
#include "incognita/estimation/compass.hpp"
#include "incognita/estimation/slam.hpp"
#include "incognita/loops/loop_closure.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy.hpp"

namespace accuracy {

/// The filter and the map it is coupled with, as an explorer holds them.
using Localiser = incognita::Slam<incognita::Map<>, incognita::LoopClosingDvlEkf>;

/// The frame of the map of one replay: anywhere near the start, at any angle.
[[nodiscard]] inline incognita::Pose2 random_frame(std::uint64_t seed) {
  incognita::Random random(seed);
  const double x_m = random.uniform(-10.0, 10.0);
  const double y_m = random.uniform(-10.0, 10.0);
  return {x_m, y_m, random.uniform(-std::numbers::pi, std::numbers::pi)};
}

/// What differs between replays of one mission.
struct ReplayParams {
  std::uint64_t seed = 1;
  std::size_t beams = 360;
  bool uses_compass = true;
  bool closes_loops = true;
  bool has_people = false;
};

struct Replay {
  DriveErrors errors;
  double scan_median_us = 0.0;         ///< all that is done with a scan, estimator and map
  double scan_mean_us = 0.0;
  double untrusted_share = 0.0;        ///< of the scans
  double compass_share = 0.0;          ///< Compass::share, the mean over scans
  double compass_heading_share = 0.0;  ///< of the scans in which the compass gave a heading
  double wrongly_occupied_share = 0.0; ///< of the known cells further than 0.2 m from any wall
};

/// Of the cells that are known and truly free, 0.2 m and more from anything, the share that the map has as occupied.
[[nodiscard]] inline double wrongly_occupied_share(const incognita::Map<>& map, const incognita::World& world,
                                                   const incognita::Pose2& T_world_map) {
  constexpr double wall_m = 0.2;
  double known = 0.0;
  double wrong = 0.0;
  const incognita::OccupancyThresholds thresholds;
  for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(map.grid().size()); ++offset) {
    const incognita::Occupancy occupancy = thresholds.classify(map.log_odds(offset));
    if (occupancy == incognita::Occupancy::unknown) continue;
    const Eigen::Vector2d at_m = T_world_map * map.lattice().center_m(map.grid().index_at(offset));
    if (world.clearance_m(at_m) < wall_m) continue;
    known += 1.0;
    if (occupancy == incognita::Occupancy::occupied) wrong += 1.0;
  }
  return known > 0.0 ? wrong / known : 0.0;
}

/// Drives the commands of a mission again, with other noise, from a known start in another frame.
[[nodiscard]] inline Replay replay(const incognita::World& world, const Mission& mission,
                                   const ReplayParams& params) {
  using Clock = std::chrono::steady_clock;
  constexpr double range_max_m = 10.0;
  constexpr std::uint64_t noise_seeds = 1000;  // far from the seeds of missions
  incognita::SimulatorParams simulated;
  simulated.sensor.beams = incognita::circular_beams(params.beams, range_max_m);
  incognita::Simulator simulator(world, mission.T_world_start, simulated, noise_seeds + params.seed);
  People people(world, 2 * noise_seeds + params.seed);
  const incognita::Pose2 T_map_start = random_frame(params.seed);
  incognita::LoopClosingDvlEkf::Params filter_params;
  filter_params.start.pose = T_map_start;
  filter_params.uses_compass = params.uses_compass;
  filter_params.loops.closes_loops = params.closes_loops;
  Localiser localiser{incognita::LoopClosingDvlEkf(filter_params)};
  incognita::Compass observer(filter_params.compass);  // sees what the filter's own compass sees

  Replay result;
  std::vector<double> scan_us;
  const auto observe = [&] {
    incognita::Scan<2> scan = simulator.scan();
    if (params.has_people) {
      people.block(scan, mission.T_world_start * simulator.T_start_robot(), simulated.sensor.range_sigma_m);
    }
    if (observer.measure(scan, localiser.belief().pose.yaw_rad)) result.compass_heading_share += 1.0;
    result.compass_share += observer.share();
    const auto begin = Clock::now();
    const bool trusted = localiser.observe(scan).correction.trusted;
    scan_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    result.scan_mean_us += scan_us.back();
    if (!trusted) result.untrusted_share += 1.0;
  };
  observe();
  for (const incognita::Twist2& command : mission.commands) {
    localiser.move(simulator.step(command), step_s(simulated));
    people.walk(step_s(simulated));
    if (simulator.scan_is_new()) observe();
    result.errors.add(localiser.belief(), T_map_start * simulator.T_start_robot());
  }
  const auto scans = static_cast<double>(scan_us.size());
  result.scan_median_us = median(std::move(scan_us));
  result.scan_mean_us /= scans;
  result.untrusted_share /= scans;
  result.compass_share /= scans;
  result.compass_heading_share /= scans;
  result.wrongly_occupied_share =
      wrongly_occupied_share(localiser.map(), world, mission.T_world_start * T_map_start.inverse());
  return result;
}

}  // namespace accuracy
