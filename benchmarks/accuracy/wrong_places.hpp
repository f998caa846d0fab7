/// What happens to a robot that is somewhere else than it thinks.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "accuracy/localisation.hpp"
#include "incognita/map/occupancy.hpp"

namespace accuracy {

enum class Mishap : std::uint8_t { none, kidnapped, slipped, blinded, dazzled };

inline constexpr std::array mishaps{Mishap::none, Mishap::kidnapped, Mishap::slipped, Mishap::blinded,
                                    Mishap::dazzled};

[[nodiscard]] constexpr std::string_view to_string(Mishap mishap) {
  switch (mishap) {
    case Mishap::none:
      return "nothing (control)";
    case Mishap::kidnapped:
      return "driven 3 m without odometry";
    case Mishap::slipped:
      return "odometry says 1 m, the robot stands";
    case Mishap::blinded:
      return "10 s of scans without readings (NaN)";
    case Mishap::dazzled:
      return "10 s of scans all clear (10 m)";
  }
  return "unknown";
}

/// How the mishaps of one kind ended, 20 scans after each.
struct Outcomes {
  int count = 0;
  int recovered = 0;         ///< within 0.15 m, and the scan trusted
  int lost = 0;              ///< not that, and the filter says so
  int doubtful = 0;          ///< not that, scans are not trusted yet
  int mistaken = 0;          ///< not that, and the scan trusted
  double error_max_m = 0.0;  ///< of the mistaken
  double flipped_share_max =
      0.0;  ///< of the cells known before: those that changed from free to occupied or back

  Outcomes& operator+=(const Outcomes& other) {
    count += other.count;
    recovered += other.recovered;
    lost += other.lost;
    doubtful += other.doubtful;
    mistaken += other.mistaken;
    error_max_m = std::max(error_max_m, other.error_max_m);
    flipped_share_max = std::max(flipped_share_max, other.flipped_share_max);
    return *this;
  }
};

using OutcomesByMishap = std::array<Outcomes, mishaps.size()>;

/// Of the cells that `before` knows, the share that `after` has in the other class.
[[nodiscard]] inline double flipped_share(const incognita::Map<>& before, const incognita::Map<>& after) {
  const incognita::OccupancyThresholds thresholds;
  std::size_t known = 0;
  std::size_t flipped = 0;
  for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(before.grid().size());
       ++offset) {
    const incognita::Occupancy was = thresholds.classify(before.log_odds(offset));
    if (was == incognita::Occupancy::unknown) continue;
    ++known;
    const incognita::Occupancy is = thresholds.classify(after.log_odds(before.grid().index_at(offset)));
    if (is != was && is != incognita::Occupancy::unknown) ++flipped;
  }
  return known == 0 ? 0.0 : static_cast<double>(flipped) / static_cast<double>(known);
}

/// One mishap, to copies of everything: the rest of the drive does not know.
class MishapTrial {
 public:
  MishapTrial(const Mission& mission, std::size_t next_command, const incognita::Pose2& T_map_start,
              incognita::Simulator simulator, Localiser localiser)
      : mission_(mission),
        next_command_(next_command),
        T_map_start_(T_map_start),
        simulator_(std::move(simulator)),
        localiser_(std::move(localiser)) {}

  /// A count of 0 where the drive is over too soon.
  [[nodiscard]] Outcomes run(Mishap mishap) {
    constexpr double recovered_m = 0.15;
    constexpr int scans = 20;
    constexpr double blinded_s = 10.0;
    const incognita::Map<> before = localiser_.map();
    if (mishap == Mishap::kidnapped) carry(3.0);
    if (mishap == Mishap::slipped) localiser_.move({1.0, 0.0, 0.0}, 1.0);
    if (mishap == Mishap::blinded) blind(blinded_s, std::numeric_limits<double>::quiet_NaN());
    if (mishap == Mishap::dazzled) blind(blinded_s, simulator_.scan().range_max_m());
    incognita::CorrectionReport report;
    for (int scan = 0; scan < scans; ++scan) {
      drive_to_next_scan(true);
      report = localiser_.observe(simulator_.scan()).correction;
    }
    if (is_over_) return {};
    const double error_m = incognita::distance(localiser_.belief().pose.position(),
                                               (T_map_start_ * simulator_.T_start_robot()).position());
    Outcomes outcome;
    outcome.count = 1;
    outcome.flipped_share_max = flipped_share(before, localiser_.map());
    if (report.trusted && error_m < recovered_m) {
      outcome.recovered = 1;
    } else if (report.trusted) {
      outcome.mistaken = 1;
      outcome.error_max_m = error_m;
    } else {
      (report.lost ? outcome.lost : outcome.doubtful) = 1;
    }
    return outcome;
  }

 private:
  void drive_to_next_scan(bool has_odometry) {
    do {
      is_over_ = is_over_ || next_command_ >= mission_.commands.size();
      if (is_over_) return;
      const incognita::Pose2 increment = simulator_.step(mission_.commands[next_command_++]);
      if (has_odometry) localiser_.move(increment, step_s({}));
    } while (!simulator_.scan_is_new());
  }

  void carry(double distance_m) {
    const double end_m = simulator_.distance_m() + distance_m;
    while (simulator_.distance_m() < end_m && !is_over_) drive_to_next_scan(false);
  }

  void blind(double duration_s, double range_m) {
    incognita::Scan<2> scan = simulator_.scan();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, range_m);
    const double end_s = simulator_.time_s() + duration_s;
    while (simulator_.time_s() < end_s && !is_over_) {
      drive_to_next_scan(true);
      localiser_.observe(scan);
    }
  }

  const Mission& mission_;
  std::size_t next_command_;
  incognita::Pose2 T_map_start_;
  incognita::Simulator simulator_;
  Localiser localiser_;
  bool is_over_ = false;
};

/// Each mishap at every interval_s of a replay with the defaults.
[[nodiscard]] inline OutcomesByMishap try_mishaps(const incognita::World& world, const Mission& mission,
                                                  std::uint64_t seed, double interval_s) {
  const incognita::SimulatorParams simulated;
  incognita::Simulator simulator(world, mission.T_world_start, simulated, seed);
  const incognita::Pose2 T_map_start = random_frame(seed);
  incognita::LoopClosingDvlEkf::Params params;
  params.start.pose = T_map_start;
  Localiser localiser{incognita::LoopClosingDvlEkf(params)};
  localiser.observe(simulator.scan());
  OutcomesByMishap outcomes;
  const auto interval = static_cast<std::size_t>(interval_s * simulated.steps_per_s);
  for (std::size_t done = 1; done <= mission.commands.size(); ++done) {
    localiser.move(simulator.step(mission.commands[done - 1]), step_s(simulated));
    if (simulator.scan_is_new()) localiser.observe(simulator.scan());
    if (done % interval != 0) continue;
    for (std::size_t kind = 0; kind < mishaps.size(); ++kind) {
      outcomes[kind] += MishapTrial(mission, done, T_map_start, simulator, localiser).run(mishaps[kind]);
    }
  }
  return outcomes;
}

}  // namespace accuracy
