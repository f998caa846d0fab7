/// What a robot with a planar laser wrote down: scans, each with the odometry at its instant.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// A scan and where odometry had the robot.
struct LogScan {
  double time_s = 0.0;           ///< of its stamp
  Pose2 T_odom_robot;            ///< when it was taken
  std::vector<double> ranges_m;  ///< one a beam, as Scan<2> takes them
};

/// The angles of a planar laser's beams, evenly spaced.
struct BeamAngles {
  double first_rad = 0.0;      ///< of the first reading, from the laser's x axis, counter-clockwise
  double increment_rad = 0.0;  ///< from one reading to the next
};

/// Which readings of a log say something.
struct RangeLimits {
  /// Readings at or above it are codes for "nothing came back"; infinite where the log has none.
  double no_return_m = std::numeric_limits<double>::infinity();
  /// A surface farther than this is not trusted to lie where it reads; what is nearer is free.
  double usable_m = 0.0;
};

/// How a log is read; what is not given is detected.
struct RobotLogParams {
  std::optional<BeamAngles> beams;     ///< see default_beam_angles
  std::optional<Pose2> T_robot_laser;  ///< without it as the log says, and the identity where it does not
  std::optional<double> no_return_m;   ///< see detect_range_limits; > 0
  std::optional<double> usable_m;      ///< see detect_range_limits; > 0
  /// What no return means. false: nothing, so it is invalid. The code of a laser stands for an open space,
  /// and also for glass, a mirror, a black wall, the sun or an error of its receiver, which are no free
  /// space. true: free up to usable_m, for a laser that is known to miss nothing within it.
  bool no_return_is_clear = false;

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    if (beams) {
      require(std::isfinite(beams->first_rad), "RobotLogParams", "beams.first_rad", beams->first_rad,
              "finite");
      require(std::isfinite(beams->increment_rad), "RobotLogParams", "beams.increment_rad",
              beams->increment_rad, "finite");
    }
    if (T_robot_laser) require_finite_pose("RobotLogParams", "T_robot_laser", *T_robot_laser);
    if (no_return_m) require_positive("RobotLogParams", "no_return_m", *no_return_m);
    if (usable_m) require_positive("RobotLogParams", "usable_m", *usable_m);
  }
};

/// A log, ready to be mapped: Scan<2>(beams, scans[i].ranges_m). It holds at least one scan, in the order of
/// time.
struct RobotLog {
  BeamPattern<2> beams;        ///< in the laser's frame
  Pose2 T_robot_laser;         ///< where the laser is mounted
  RangeLimits limits;          ///< what was applied to the readings
  std::vector<LogScan> scans;  ///< in the order of time

  [[nodiscard]] double duration_s() const { return scans.back().time_s - scans.front().time_s; }  ///< from the first scan to the last
};

/// No log has more scans, nor a scan more readings: a hostile file must not ask for all of the memory.
inline constexpr std::size_t log_scans_max = std::size_t{1} << 20;
/// Of a scan.
inline constexpr std::size_t log_beams_max = 10000;
/// Of a log.
inline constexpr std::size_t log_readings_max = std::size_t{1} << 26;
/// No robot is farther from the origin of its odometry.
inline constexpr double log_position_max_m = 1e6;

/// How the readings of a SICK LMS, which most of the public logs come from, are laid out: over 180 degrees,
/// to the right first. 181 and 361 readings have both ends, 180 and 360 all but the last. Nothing for other
/// numbers.
[[nodiscard]] inline std::optional<BeamAngles> default_beam_angles(std::size_t count) {
  constexpr double degree_rad = std::numbers::pi / 180.0;
  if (count == 180 || count == 181) return BeamAngles{-90.0 * degree_rad, degree_rad};
  if (count == 360 || count == 361) return BeamAngles{-90.0 * degree_rad, 0.5 * degree_rad};
  return std::nullopt;
}

/// The limits that the readings themselves tell. Lasers mark a missing return by a code at the top of their
/// scale (a SICK LMS by 8183 to 8191, in centimetres or in millimetres), or clip it to their range. Either
/// shows as a pile: readings within 0.2 % of the largest are codes when there are at least 10 of them and
/// they are ten times as dense as those down to nine tenths of it. Where a far wall passes for a code, only
/// what lies within 0.2 % of it is lost. All other readings are usable: usable_m lies just above the largest
/// of them. Where no others are there are no codes. Values that are not finite or not positive are ignored;
/// without any other, usable_m is 0.
[[nodiscard]] inline RangeLimits detect_range_limits(const std::vector<LogScan>& scans) {
  constexpr double infinite_m = std::numeric_limits<double>::infinity();
  const auto largest_below = [&](double bound_m) {
    double largest_m = 0.0;
    for (const LogScan& scan : scans) {
      for (const double range_m : scan.ranges_m) {
        if (range_m < bound_m) largest_m = std::max(largest_m, range_m);
      }
    }
    return largest_m;
  };
  const auto usable = [&](double largest_m) {
    return largest_m > 0.0 ? std::nextafter(largest_m, infinite_m) : 0.0;
  };

  constexpr double pile = 0.998;
  constexpr double below = 0.9;
  const double largest_m = largest_below(infinite_m);
  std::size_t in_pile = 0;
  std::size_t under_pile = 0;
  double lowest_m = largest_m;
  for (const LogScan& scan : scans) {
    for (const double range_m : scan.ranges_m) {
      if (!(range_m > 0.0 && range_m <= largest_m) || range_m < below * largest_m) continue;
      if (range_m < pile * largest_m) {
        ++under_pile;
        continue;
      }
      ++in_pile;
      lowest_m = std::min(lowest_m, range_m);
    }
  }
  // Densities are counts over widths: 0.2 % and 9.8 % of the largest.
  const bool ten_times_as_dense =
      static_cast<double>(in_pile) / (1.0 - pile) >= 10.0 * static_cast<double>(under_pile) / (pile - below);
  const double largest_usable_m = largest_below(lowest_m);
  if (in_pile < 10 || !ten_times_as_dense || largest_usable_m == 0.0) return {infinite_m, usable(largest_m)};
  return {lowest_m, usable(largest_usable_m)};
}

namespace detail {

/// Brings what a file held into the order of time and applies the limits. `scans` are as read, all with as
/// many readings as `beams.directions`; `file` is named in errors.
[[nodiscard]] inline RobotLog finish_log(std::vector<LogScan> scans, const RobotLogParams& params,
                                         std::optional<BeamAngles> angles, const Pose2& T_robot_laser,
                                         const std::filesystem::path& file) {
  const std::size_t beam_count = scans.empty() ? 0 : scans.front().ranges_m.size();
  if (beam_count == 0) throw InputError(file, "holds no scans");
  if (params.beams) angles = params.beams;
  if (!angles) angles = default_beam_angles(beam_count);
  if (!angles) {
    throw InputError(
        file, "scans have " + std::to_string(beam_count) +
                  " readings, whose angles are known for 180, 181, 360 and 361 only: give the angle of "
                  "the first reading and the increment");
  }
  std::stable_sort(scans.begin(), scans.end(),
                   [](const LogScan& a, const LogScan& b) { return a.time_s < b.time_s; });

  RobotLog log;
  log.T_robot_laser = params.T_robot_laser.value_or(T_robot_laser);
  log.limits = detect_range_limits(scans);
  if (params.no_return_m) {
    log.limits.no_return_m = *params.no_return_m;
    log.limits.usable_m = std::min(log.limits.usable_m, *params.no_return_m);
  }
  if (params.usable_m) log.limits.usable_m = *params.usable_m;
  if (!(log.limits.usable_m > 0.0)) {
    throw InputError(file, "not one reading is finite, > 0 and less than the code for no return, " +
                               format_number(log.limits.no_return_m) + " m");
  }
  for (LogScan& scan : scans) {
    for (double& range_m : scan.ranges_m) {
      if (range_m >= log.limits.no_return_m) {
        range_m = params.no_return_is_clear ? log.limits.usable_m : std::numeric_limits<double>::quiet_NaN();
      } else if (range_m > log.limits.usable_m) {
        range_m = log.limits.usable_m;
      }
    }
  }
  log.beams = planar_beams(beam_count, angles->first_rad, angles->increment_rad, log.limits.usable_m);
  log.scans = std::move(scans);
  return log;
}

}  // namespace detail

}  // namespace incognita
