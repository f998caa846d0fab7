/// One exploration in simulation, recorded step by step.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "incognita/exploration/explorer.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/io/run_recorder.hpp"
#include "incognita/io/tum.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/map_error.hpp"
#include "incognita/metrics/nees.hpp"
#include "incognita/metrics/trajectory_error.hpp"
#include "incognita/metrics/truth.hpp"
#include "incognita/simulation/simulator.hpp"
#include "support/drive.hpp"

namespace examples {

using Clock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct DecisionRecord {
  double time_s;
  std::size_t candidates;
  Eigen::Vector2d goal_m;  ///< in the robot's start frame
  double gain_nats;
  double runner_up_gain_nats;  ///< NaN when there was one candidate
  double evaluation_time_s;

  template <class Archive>
  void archive_state(Archive& archive) {
    archive(time_s, candidates, goal_m, gain_nats, runner_up_gain_nats, evaluation_time_s);
  }
};

struct ProgressRecord {
  double time_s;
  double explored_fraction;
  double entropy_drop_nats;  ///< Shannon entropy of a map of which nothing is known minus that of the map now
  double position_error_m;
  double three_sigma_m;
  double nees;  ///< NaN where the pose is known
  double distance_m;

  template <class Archive>
  void archive_state(Archive& archive) {
    archive(time_s, explored_fraction, entropy_drop_nats, position_error_m, three_sigma_m, nees, distance_m);
  }
};

/// What a recording of a mission has in each frame: those of a ProgressRecord, with how much the map has told instead of its entropy, which is
/// known only in the end, when it is known how many cells it touches.
inline constexpr std::array<const char*, 6> recorded_metrics{"explored_fraction", "information_bits", "position_error_m",
                                                             "three_sigma_m",     "nees",             "distance_m"};

[[nodiscard]] inline std::array<double, 6> recorded_values(const ProgressRecord& progress) {
  return {progress.explored_fraction, progress.entropy_drop_nats / std::numbers::ln2, progress.position_error_m,
          progress.three_sigma_m,     progress.nees,                                   progress.distance_m};
}

/// What the explorer took of the time on the wall; the rest is the simulator's and the metrics'.
struct ExplorerTimes {
  double observe_s = 0.0;  ///< estimation and mapping
  double decide_s = 0.0;
  double command_s = 0.0;

  template <class Archive>
  void archive_state(Archive& archive) {
    archive(observe_s, decide_s, command_s);
  }
};

struct MissionParams {
  double duration_s;
  bool returns;  ///< to the start, in the end
};

/// All that a mission leaves, in the robot's start frame. The way back is in both trajectories, in the collisions and in
/// return_distance_m; all else is of the exploration.
struct MissionRecord {
  std::vector<incognita::TimedPose2> estimated;
  std::vector<incognita::TimedPose2> truth;
  std::vector<DecisionRecord> decisions;
  std::vector<ProgressRecord> progress;
  std::vector<std::vector<Eigen::Vector2d>> last_frontiers;
  incognita::TrajectoryError trajectory_error;
  incognita::MeanNees nees;
  incognita::StopReason stop_reason = incognita::StopReason::out_of_time;
  std::optional<bool> has_returned;  ///< none when it was not asked to
  double return_distance_m = 0.0;
  std::size_t scans = 0;
  std::size_t collisions = 0;
  std::size_t touched_cells = 0;
  double distance_m = 0.0;
  double duration_s = 0.0;
  double map_error = 0.0;
  double map_uncertainty_bits_per_step = 0.0;
  double explored_fraction = 0.0;
  double floor_area_m2 = 0.0;
  double wall_time_s = 0.0;
  ExplorerTimes explorer_times;
  incognita::Twist2 command;  ///< the last of the exploration, held until the next scan

  /// The progress, to the second, when so much was explored; null when it never was.
  [[nodiscard]] const ProgressRecord* first_with_explored(double fraction) const {
    const auto found = std::find_if(progress.begin(), progress.end(),
                                    [=](const ProgressRecord& p) { return p.explored_fraction >= fraction; });
    return found == progress.end() ? nullptr : &*found;
  }

  /// What an exploration adds to as it goes on; the rest is found in its end.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(estimated, truth, decisions, progress, trajectory_error, nees, scans, wall_time_s, explorer_times, command);
  }
};

/// The map that the filter reads: its own where it keeps one (FilterWithMap), else the explorer's.
template <class Explorer>
[[nodiscard]] const auto& estimated_map(const Explorer& explorer) {
  if constexpr (requires { explorer.filter().map(); }) {
    return explorer.filter().map();
  } else {
    return explorer.map();
  }
}

/// Drives `explorer` in `simulator` until it stops or duration_s is over, and then back if asked to. `visible` is the floor that it could see
/// of what it is asked to explore (visible_floor), in the map file's frame, and `record` that of what has been explored, of a simulator that is not at its start. steering(explorer, scan) is what the robot
/// is told (OwnCommand, Steering). `report` is called once a simulated second of the exploration, at_end(record) where it ends, before the way back. `recorder` follows the explorer, the way back included, unless it
/// is null.
template <class Explorer, class Steering, class AtEnd>
[[nodiscard]] MissionRecord run_mission(Explorer& explorer, incognita::Simulator& simulator, const incognita::Grid<std::uint8_t, 2>& visible,
                                        const MissionParams& params, MissionRecord record,
                                        const std::function<void(const ProgressRecord&)>& report, incognita::RunRecorder* recorder,
                                        Steering& steering, AtEnd&& at_end) {
  using namespace incognita;
  const Clock::time_point begin = Clock::now();
  const Pose2& T_start_world = simulator.T_start_world();
  const Coverage coverage(visible, T_start_world, explorer.map().lattice());
  constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto is_known = [&](const Index<2>& cell) {
    return explorer.occupancy().grid().value(cell) != Occupancy::unknown;
  };
  EntropyLayer information(estimated_map(explorer).lattice(), EntropyTable(Shannon{}));
  information.rebuild(estimated_map(explorer));

  // Of a pose that is known there is nothing to say.
  const auto is_estimated = [&] { return position_sigma_m(explorer.belief().covariance) > 0.0; };
  const auto progress = [&] {
    const PoseBelief& belief = explorer.belief();
    const Pose2 truth = simulator.T_start_robot();
    return ProgressRecord{simulator.time_s(),
                          coverage.explored_fraction(is_known),
                          information.information_nats(),
                          (belief.pose.position() - truth.position()).norm(),
                          3.0 * position_sigma_m(belief.covariance),
                          is_estimated() ? position_nees(belief.pose, truth, belief.covariance) : not_a_number,
                          simulator.distance_m()};
  };
  const auto recorded = [&] { return recorded_values(progress()); };
  const auto observe = [&] {
    const Clock::time_point start = Clock::now();
    explorer.observe(simulator.scan());
    record.explorer_times.observe_s += seconds_since(start);
    if (explorer.last_scan().is_redrawn) {
      information.rebuild(estimated_map(explorer));
    } else if (explorer.correction().trusted) {
      information.follow(estimated_map(explorer));
    }
    if (recorder != nullptr) recorder->observed(explorer, simulator.scan(), simulator.T_start_robot(), recorded);
  };
  // How long it took, when it was decided.
  const auto decide = [&]() -> std::optional<double> {
    const Clock::time_point start = Clock::now();
    const bool has_decided = explorer.decide();
    const double took_s = seconds_since(start);
    record.explorer_times.decide_s += took_s;
    if (!has_decided) return std::nullopt;
    if (recorder != nullptr) recorder->decided(explorer);
    return took_s;
  };
  const auto observe_and_decide = [&] {
    observe();
    ++record.scans;
    const std::optional<double> took_s = decide();
    if (!took_s) return;
    if (const Candidate* chosen = explorer.decision().chosen()) {
      const auto& candidates = explorer.decision().candidates;
      record.decisions.push_back({simulator.time_s(), candidates.size(), chosen->goal_m(), chosen->gain_nats,
                                  candidates.size() > 1 ? candidates[1].gain_nats
                                                        : not_a_number,
                                  *took_s});
    }
  };
  const auto remember_poses = [&] {
    record.estimated.push_back({simulator.time_s(), explorer.belief().pose});
    record.truth.push_back({simulator.time_s(), simulator.T_start_robot()});
  };
  const auto steer = [&](Explorer& of, const Scan<2>& scan) {
    const Clock::time_point start = Clock::now();
    const Twist2 command = steering(of, scan);
    record.explorer_times.command_s += seconds_since(start);
    return command;
  };
  const auto on_scan = [&] {
    observe_and_decide();
    remember_poses();
  };
  if (simulator.steps() == 0) {
    on_scan();
    record.command = steer(explorer, simulator.scan());
  }
  drive_on(explorer, simulator, record.command, params.duration_s, on_scan, [&] {
    const Pose2 truth = simulator.T_start_robot();
    record.trajectory_error.add(explorer.belief().pose, truth);
    if (is_estimated()) record.nees.add(explorer.belief().pose, truth, explorer.belief().covariance);
    if (simulator.steps() % 50 == 0) {
      record.progress.push_back(progress());
      if (report) report(record.progress.back());
    }
  }, steer);
  record.wall_time_s += seconds_since(begin);
  at_end(record);
  const ProgressRecord last = progress();
  if (record.progress.empty() || record.progress.back().time_s < last.time_s) record.progress.push_back(last);
  record.stop_reason = explorer.stopped().value_or(StopReason::out_of_time);
  record.distance_m = simulator.distance_m();
  record.duration_s = simulator.time_s();

  record.explored_fraction = last.explored_fraction;
  record.floor_area_m2 = coverage.floor_area_m2();
  record.map_uncertainty_bits_per_step = map_uncertainty_bits_per_step(last.entropy_drop_nats, 0.0, simulator.steps());
  const auto& estimated = estimated_map(explorer);
  const MapError error = map_error(estimated, truly_occupied_cells(simulator.world().plan(), T_start_world, estimated.lattice()));
  record.map_error = error.value();
  record.touched_cells = error.occupied_count() + error.free_count();
  for (const Frontier<2>& frontier : explorer.frontiers()) {
    std::vector<Eigen::Vector2d>& cells_m = record.last_frontiers.emplace_back();
    for (const Index<2>& cell : frontier.cells) cells_m.push_back(explorer.map().lattice().center_m(cell));
  }

  if (params.returns) {
    constexpr double longest_s = 3600.0;  // the explorer gives up long before
    explorer.return_to_start();
    const auto observe_and_go_on = [&] {
      observe();
      decide();
      remember_poses();
    };
    drive(explorer, simulator, simulator.time_s() + longest_s, observe_and_go_on, [] {}, steer);
    record.has_returned = explorer.stopped() == StopReason::returned;
    record.return_distance_m = simulator.distance_m() - record.distance_m;
  }
  record.collisions = simulator.collisions();
  if (recorder != nullptr) recorder->record(explorer, simulator.scan(), simulator.T_start_robot(), recorded);
  return record;
}

}  // namespace examples
