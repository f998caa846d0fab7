/// The estimator alone, over the commands of an earlier mission.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "accuracy/drive.hpp"
#include "accuracy/statistics.hpp"
#include "incognita/core/random.hpp"
#include "incognita/estimation/compass.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/map/map.hpp"

namespace accuracy {

/// The filter and the map it is coupled with, as an explorer holds them.
struct Localiser {
  incognita::DvlEkf filter;
  incognita::Map<> map;

  explicit Localiser(const incognita::DvlEkf::Params& params) : filter(params) {}

  /// Returns what the filter said of the scan.
  incognita::CorrectionReport observe(const incognita::Scan<2>& scan) {
    const incognita::CorrectionReport report = filter.correct(scan, map);
    if (report.trusted) {
      map.update(scan, filter.belief().pose, filter.belief().covariance);
      filter.learn(scan);
    }
    return report;
  }
};

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
};

struct Replay {
  DriveErrors errors;
  double estimator_us = 0.0;           ///< correct and learn, the median over scans
  double map_update_us = 0.0;          ///< the median over scans
  double untrusted_share = 0.0;        ///< of the scans
  double compass_mean_share = 0.0;     ///< Compass::mean_share, the mean over scans
  double compass_heading_share = 0.0;  ///< of the scans in which the compass gave a heading
};

/// Drives the commands of a mission again, with other noise, from a known start in another frame.
[[nodiscard]] inline Replay replay(const incognita::World& world, const Mission& mission,
                                   const ReplayParams& params) {
  using Clock = std::chrono::steady_clock;
  const auto us = [](Clock::duration duration) {
    return std::chrono::duration<double, std::micro>(duration).count();
  };
  constexpr double range_max_m = 10.0;
  constexpr std::uint64_t noise_seeds = 1000;  // far from the seeds of missions
  incognita::SimulatorParams simulated;
  simulated.sensor.beams = incognita::circular_beams(params.beams, range_max_m);
  incognita::Simulator simulator(world, mission.T_world_start, simulated, noise_seeds + params.seed);
  const incognita::Pose2 T_map_start = random_frame(params.seed);
  incognita::DvlEkf::Params filter_params;
  filter_params.start.pose = T_map_start;
  filter_params.uses_compass = params.uses_compass;
  Localiser localiser(filter_params);
  incognita::DvlEkf& filter = localiser.filter;
  incognita::Compass observer(filter_params.compass);  // sees what the filter's own compass sees

  Replay result;
  std::vector<double> estimator_us;
  std::vector<double> map_update_us;
  const auto observe = [&] {
    const incognita::Scan<2>& scan = simulator.scan();
    if (observer.measure(scan, filter.belief().pose.yaw_rad)) result.compass_heading_share += 1.0;
    result.compass_mean_share += observer.mean_share();
    const auto begin = Clock::now();
    const incognita::CorrectionReport report = filter.correct(scan, localiser.map);
    const auto corrected = Clock::now();
    if (!report.trusted) {
      estimator_us.push_back(us(corrected - begin));
      result.untrusted_share += 1.0;
      return;
    }
    localiser.map.update(scan, filter.belief().pose, filter.belief().covariance);
    const auto mapped = Clock::now();
    filter.learn(scan);
    const auto learned = Clock::now();
    estimator_us.push_back(us((corrected - begin) + (learned - mapped)));
    map_update_us.push_back(us(mapped - corrected));
  };
  observe();
  for (const incognita::Twist2& command : mission.commands) {
    filter.predict(simulator.step(command), step_s(simulated));
    if (simulator.scan_is_new()) observe();
    result.errors.add(filter.belief(), T_map_start * simulator.T_start_robot());
  }
  const auto scans = static_cast<double>(estimator_us.size());
  result.estimator_us = median(std::move(estimator_us));
  result.map_update_us = median(std::move(map_update_us));
  result.untrusted_share /= scans;
  result.compass_mean_share /= scans;
  result.compass_heading_share /= scans;
  return result;
}

}  // namespace accuracy
