/// Logs of CARMEN, the robot navigation toolkit, in which most of the public laser data of the 2000s came
/// out.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/robot_log.hpp"
#include "incognita/io/text_lines.hpp"

namespace incognita {

namespace detail {

/// One scan as a line of a CARMEN log gives it.
struct CarmenScan {
  LogScan scan;
  Pose2 T_world_laser;
  std::optional<BeamAngles> angles;
};

/// Reads the words of one message, with errors that name the line and the field.
class CarmenLine {
 public:
  CarmenLine(const std::filesystem::path& file, std::size_t number, std::string_view line)
      : file_(file), number_(number), unread_(line), message_(take_word(unread_)) {}

  [[nodiscard]] std::string_view message() const { return message_; }

  /// FLASER n r1..rn x y theta odom_x odom_y odom_theta ipc_timestamp ...
  [[nodiscard]] CarmenScan front_laser() {
    CarmenScan read;
    read_ranges(read.scan);
    read.T_world_laser = pose("the laser's pose");
    read.scan.T_odom_robot = pose("the odometry");
    read.scan.time_s = value("the time", 1e15);
    return read;
  }

  /// ROBOTLASER1 type start_angle field_of_view angular_resolution maximum_range accuracy remission_mode n
  /// r1..rn m v1..vm x y theta odom_x odom_y odom_theta tv rv forward_safety side_safety turn_axis timestamp
  /// ...
  [[nodiscard]] CarmenScan robot_laser() {
    CarmenScan read;
    static_cast<void>(value("the laser's type", 1e15));
    const double first_rad = value("the start angle", 100.0);
    static_cast<void>(value("the field of view", 100.0));
    const double increment_rad = value("the angular resolution", 100.0);
    read.angles = BeamAngles{first_rad, increment_rad};
    for (const char* what : {"the maximum range", "the accuracy", "the remission mode"}) {
      static_cast<void>(value(what, 1e15));
    }
    read_ranges(read.scan);
    for (std::size_t left = count("the number of remissions"); left > 0; --left) {
      static_cast<void>(value("a remission", 1e15));
    }
    read.T_world_laser = pose("the laser's pose");
    read.scan.T_odom_robot = pose("the robot's pose");
    for (int i = 0; i < 5; ++i) static_cast<void>(value("a velocity or a margin", 1e15));
    read.scan.time_s = value("the time", 1e15);
    return read;
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(file_, "line " + std::to_string(number_) + " (" + std::string(message_) + "): " + what);
  }

 private:
  [[nodiscard]] std::string_view word(const char* what) {
    const std::string_view next = take_word(unread_);
    if (next.empty()) fail(std::string("ends before ") + what);
    return next;
  }

  [[nodiscard]] double value(const char* what, double magnitude_max) {
    const std::string_view text = word(what);
    const std::optional<double> number = parse_number(text);
    if (number && std::abs(*number) <= magnitude_max) return *number;
    fail(std::string(what) + " is " + shown(text) + ", but must be a number within " +
         format_number(magnitude_max));
  }

  [[nodiscard]] std::size_t count(const char* what) {
    const std::string_view text = word(what);
    const std::optional<double> number = parse_number(text);
    if (number && *number >= 0.0 && *number <= static_cast<double>(log_beams_max) &&
        *number == std::floor(*number)) {
      return static_cast<std::size_t>(*number);
    }
    fail(std::string(what) + " is " + shown(text) + ", but must be a whole number up to " +
         std::to_string(log_beams_max));
  }

  /// Readings may be nan or inf: they say nothing.
  void read_ranges(LogScan& scan) {
    const std::size_t size = count("the number of readings");
    if (size == 0) fail("has no readings");
    scan.ranges_m.reserve(size);
    while (scan.ranges_m.size() < size) {
      const std::string_view text = word("its last reading");
      const std::optional<double> range_m = parse_number(text);
      if (!range_m) fail("a reading is " + shown(text) + ", but must be a number");
      scan.ranges_m.push_back(*range_m);
    }
  }

  [[nodiscard]] Pose2 pose(const char* what) {
    const double x_m = value(what, log_position_max_m);
    const double y_m = value(what, log_position_max_m);
    return {x_m, y_m, wrap_angle_rad(value(what, log_position_max_m))};
  }

  const std::filesystem::path& file_;
  std::size_t number_;
  std::string_view unread_;
  std::string_view message_;
};

/// Where the laser sits on the robot, if its poses tell: all lines must agree, and within 2 m. In logs whose
/// laser's poses were corrected afterwards they do not agree, and then nothing is known.
[[nodiscard]] inline Pose2 laser_mounting(const std::vector<CarmenScan>& scans) {
  const auto mounting = [](const CarmenScan& read) {
    return read.scan.T_odom_robot.inverse() * read.T_world_laser;
  };
  const Pose2 first = mounting(scans.front());
  const bool agree = std::all_of(scans.begin(), scans.end(), [&](const CarmenScan& read) {
    const Pose2 other = mounting(read);
    // Positions are written to a few digits, so that their difference jumps.
    return (other.position() - first.position()).norm() <= 0.005 &&
           std::abs(angle_between_rad(first.yaw_rad, other.yaw_rad)) <= 0.005;
  });
  return agree && first.position().norm() <= 2.0 ? first : Pose2{};
}

}  // namespace detail

/// The log that the text of a CARMEN log file holds: the FLASER messages or, when the first scan is one, the
/// ROBOTLASER1 messages; all others (ODOM, PARAM, rear lasers, ...) are skipped, as are comments. Odometry is
/// the one in the message. The angles of FLASER are not in the file: see default_beam_angles. `file` is only
/// named in errors. Throws InputError, which names the line, and std::invalid_argument for bad parameters.
[[nodiscard]] inline RobotLog parse_carmen_log(std::string_view text, const std::filesystem::path& file,
                                               const RobotLogParams& params = {}) {
  params.validate();
  std::vector<detail::CarmenScan> read;
  std::string_view kind;
  std::size_t readings = 0;
  detail::for_each_line(text, [&](std::size_t number, std::string_view content) {
    detail::CarmenLine line(file, number, content);
    if (line.message() != "FLASER" && line.message() != "ROBOTLASER1") return;
    if (kind.empty()) kind = line.message();
    if (line.message() != kind) return;
    if (read.size() == log_scans_max) line.fail("is one scan more than " + std::to_string(log_scans_max));
    read.push_back(kind == "FLASER" ? line.front_laser() : line.robot_laser());
    const std::size_t beams = read.back().scan.ranges_m.size();
    if (beams != read.front().scan.ranges_m.size()) {
      line.fail("has " + std::to_string(beams) + " readings, but must have " +
                std::to_string(read.front().scan.ranges_m.size()) + " as the first scan");
    }
    readings += beams;
    if (readings > log_readings_max)
      line.fail("makes more than " + std::to_string(log_readings_max) + " readings");
  });
  if (read.empty()) throw InputError(file, "holds no FLASER or ROBOTLASER1 message");

  const Pose2 T_robot_laser = detail::laser_mounting(read);
  const std::optional<BeamAngles> angles = read.front().angles;
  std::vector<LogScan> scans;
  scans.reserve(read.size());
  for (detail::CarmenScan& one : read) scans.push_back(std::move(one.scan));
  return detail::finish_log(std::move(scans), params, angles, T_robot_laser, file);
}

/// Reads a CARMEN log of at most 512 MiB; see parse_carmen_log.
[[nodiscard]] inline RobotLog read_carmen_log(const std::filesystem::path& file,
                                              const RobotLogParams& params = {}) {
  return parse_carmen_log(read_file(file, std::size_t{1} << 29), file, params);
}

}  // namespace incognita
