/// Robot logs as logs of CARMEN.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/robot_log.hpp"

namespace incognita {

/// The messages that scans become.
enum class CarmenMessage {
  robot_laser,  ///< ROBOTLASER1, which says at which angles its beams lie
  front_laser   ///< FLASER, which does not: only for the layouts of default_beam_angles
};

/// How a log is written.
struct CarmenWriterParams {
  CarmenMessage message = CarmenMessage::robot_laser;  ///< that scans become
  /// What readings that say nothing (NaN, infinite, not positive) are written as, for programs that do not know
  /// "nan": a code above all other readings, > 0. Without it, as nan.
  std::optional<double> no_return_m;
};

namespace detail {

/// The angles of a planar laser's beams. Throws std::invalid_argument unless they are evenly spaced to 1e-6 rad.
[[nodiscard]] inline BeamAngles beam_angles_of(const BeamPattern<2>& beams) {
  beams.validate();
  const auto& directions = beams.directions;
  if (directions.empty()) throw std::invalid_argument("write_carmen_log: the log has no beams");
  BeamAngles angles{std::atan2(directions[0].y(), directions[0].x()), 0.0};
  if (directions.size() == 1) return angles;
  double turned_rad = 0.0;
  for (std::size_t beam = 1; beam < directions.size(); ++beam) {
    const auto& a = directions[beam - 1];
    const auto& b = directions[beam];
    turned_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
  }
  angles.increment_rad = turned_rad / static_cast<double>(directions.size() - 1);
  for (std::size_t beam = 0; beam < directions.size(); ++beam) {
    const double angle_rad = angles.first_rad + angles.increment_rad * static_cast<double>(beam);
    const double off_rad =
        std::abs(angle_between_rad(angle_rad, std::atan2(directions[beam].y(), directions[beam].x())));
    require(off_rad <= 1e-6, "write_carmen_log", "a beam's distance from even spacing, in radians,", off_rad, "<= 1e-6");
  }
  return angles;
}

[[nodiscard]] inline std::string carmen_pose_text(const Pose2& pose) {
  const auto require_near = [](const char* field, double value) {
    require(std::abs(value) <= log_position_max_m, "write_carmen_log", field, value, "within 1e6");
  };
  require_near("x of a pose", pose.x_m);
  require_near("y of a pose", pose.y_m);
  require_near("yaw of a pose", pose.yaw_rad);
  return format_number(pose.x_m) + ' ' + format_number(pose.y_m) + ' ' + format_number(pose.yaw_rad);
}

}  // namespace detail

/// The text of a CARMEN log: for each scan an ODOM message and one of the laser, with every digit, in metres,
/// radians and seconds. Velocities, which a log does not hold, are 0; the host is "incognita".
///
/// parse_carmen_log gives the log back. What a log does not say is detected when it is read, so give it
/// `usable_m`, and `no_return_m` where there is one (else any range above usable_m), if readings at the largest
/// range are to stay clear: many equal readings there look like a code for no return (detect_range_limits).
///
/// Throws std::invalid_argument for a log that the reader would refuse: without scans, with scans of other than
/// one reading a beam, with beams that are not evenly spaced (or, as FLASER, not laid out by default_beam_angles),
/// times or poses that are not finite and within 1e15 and 1e6, and for a no_return_m that a reading reaches.
[[nodiscard]] inline std::string carmen_log_text(const RobotLog& log, const CarmenWriterParams& params = {}) {
  const std::size_t beams = log.beams.directions.size();
  const BeamAngles angles = detail::beam_angles_of(log.beams);
  const auto require_count = [](const char* field, std::size_t count, std::size_t count_max) {
    require(count >= 1 && count <= count_max, "write_carmen_log", field, static_cast<double>(count),
            "1 to " + std::to_string(count_max));
  };
  require_count("the number of beams", beams, log_beams_max);
  require_count("the number of scans", log.scans.size(), log_scans_max);
  require_count("the number of readings", beams * log.scans.size(), log_readings_max);
  if (params.no_return_m) require_positive("write_carmen_log", "no_return_m", *params.no_return_m);
  const bool is_front = params.message == CarmenMessage::front_laser;
  if (is_front) {
    const std::optional<BeamAngles> awaited = default_beam_angles(beams);
    if (!awaited || std::abs(angle_between_rad(awaited->first_rad, angles.first_rad)) > 1e-6 ||
        std::abs(awaited->increment_rad - angles.increment_rad) > 1e-8) {
      throw std::invalid_argument(
          "write_carmen_log: FLASER holds only 180, 181, 360 or 361 beams over 180 degrees from the right on; "
          "write ROBOTLASER1");
    }
  }
  const double range_max_m = params.no_return_m.value_or(log.beams.range_max_m);
  const std::string laser = "0 " + format_number(angles.first_rad) + ' ' +
                            format_number(angles.increment_rad * static_cast<double>(beams - 1)) + ' ' +
                            format_number(angles.increment_rad) + ' ' + format_number(range_max_m) + " 0 0 ";

  std::string text = "# CARMEN log by incognita\n";
  for (const LogScan& scan : log.scans) {
    if (scan.ranges_m.size() != beams) {
      throw std::invalid_argument("write_carmen_log: a scan has " + std::to_string(scan.ranges_m.size()) +
                                  " readings, but must have one for each of " + std::to_string(beams) + " beams");
    }
    require(std::abs(scan.time_s) <= 1e15, "write_carmen_log", "a time", scan.time_s, "within 1e15");
    const std::string time = format_number(scan.time_s);
    const std::string odometry = detail::carmen_pose_text(scan.T_odom_robot);
    const std::string place = detail::carmen_pose_text(scan.T_odom_robot * log.T_robot_laser) + ' ' + odometry;
    const std::string end = time + " incognita " + time + '\n';
    text += "ODOM " + odometry + " 0 0 0 " + end;
    text += is_front ? "FLASER " : "ROBOTLASER1 " + laser;
    text += std::to_string(beams);
    for (const double range_m : scan.ranges_m) {
      const bool says_nothing = !(std::isfinite(range_m) && range_m > 0.0);
      if (params.no_return_m) {
        require(says_nothing || range_m < *params.no_return_m, "write_carmen_log", "a reading", range_m, "< no_return_m");
      }
      text += ' ';
      text += !says_nothing ? format_number(range_m) : params.no_return_m ? format_number(*params.no_return_m) : "nan";
    }
    text += (is_front ? " " : " 0 ") + place + ' ' + (is_front ? "" : "0 0 0 0 0 ") + end;
  }
  return text;
}

/// Writes a CARMEN log, which replaces one that is there only when complete; see carmen_log_text. Throws
/// InputError when it cannot be written.
inline void write_carmen_log(const std::filesystem::path& file, const RobotLog& log,
                             const CarmenWriterParams& params = {}) {
  write_file_atomically(file, carmen_log_text(log, params));
}

}  // namespace incognita
