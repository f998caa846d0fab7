/// Trajectories in the format of the TUM RGB-D benchmark: a line per pose, "time x y z qx qy qz qw", in seconds and
/// metres, the scalar of the quaternion last. evo reads what is written: `evo_ape tum true.tum estimated.tum`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/geometry/pose2.hpp"
#include "incognita/io/atomic_file.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

/// Where a robot was at a time, in the trajectory's own frame.
struct TimedPose2 {
  double time_s = 0.0;  ///< of its stamp
  Pose2 pose;           ///< T_frame_robot

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(time_s, pose);
  }
};

namespace detail {

/// The eight numbers of a line; nothing unless there are eight and all are finite.
[[nodiscard]] inline std::optional<std::array<double, 8>> parse_tum_line(std::string_view line) {
  constexpr std::string_view space = " \t\r";
  std::array<double, 8> numbers{};
  std::size_t count = 0;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
    if (line.empty()) break;
    const std::string_view word = line.substr(0, line.find_first_of(space));
    const std::optional<double> number = parse_number(word);
    if (count == numbers.size() || !number || !std::isfinite(*number)) return std::nullopt;
    numbers[count++] = *number;
    line.remove_prefix(word.size());
  }
  if (count != numbers.size()) return std::nullopt;
  return numbers;
}

}  // namespace detail

/// Reads the text of a TUM file; empty lines and those that start with # are skipped. Height, roll and pitch
/// are dropped: a pose is projected onto the plane. `file` is only named in errors. Throws InputError, which
/// names the line, unless each line holds eight finite numbers and a quaternion whose length is 1 to 0.01.
[[nodiscard]] inline std::vector<TimedPose2> parse_tum(std::string_view text,
                                                       const std::filesystem::path& file) {
  std::vector<TimedPose2> trajectory;
  for (std::size_t line_number = 1; !text.empty(); ++line_number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos || line[start] == '#') continue;
    const auto numbers = detail::parse_tum_line(line);
    if (!numbers) {
      throw InputError(file, "line " + std::to_string(line_number) + " is " + shown(line) +
                                 ", but must be eight finite numbers: time x y z qx qy qz qw");
    }
    const auto [time_s, x_m, y_m, z_m, qx, qy, qz, qw] = *numbers;
    static_cast<void>(z_m);
    const double length = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
    if (!(std::abs(length - 1.0) <= 0.01)) {
      throw InputError(file, "line " + std::to_string(line_number) + " has a quaternion of length " +
                                 format_number(length) + ", but must have one of 1");
    }
    const double yaw_rad = std::atan2(2.0 * (qw * qz + qx * qy), qw * qw + qx * qx - qy * qy - qz * qz);
    trajectory.push_back({time_s, {x_m, y_m, yaw_rad}});
  }
  return trajectory;
}

/// The text of a TUM file: eight numbers a line with one space between them and none at the end, as evo asks for;
/// times are written as they are, so evo wants them to ascend. Poses read back are the same to 1e-15 in x and y and to 1e-9 rad in yaw.
[[nodiscard]] inline std::string tum_text(const std::vector<TimedPose2>& trajectory) {
  std::string text;
  for (const TimedPose2& timed : trajectory) {
    const double qz = std::sin(0.5 * timed.pose.yaw_rad);
    const double qw = std::cos(0.5 * timed.pose.yaw_rad);
    text += format_number(timed.time_s) + ' ' + format_number(timed.pose.x_m) + ' ' +
            format_number(timed.pose.y_m) + " 0 0 0 " + format_number(qz) + ' ' + format_number(qw) + '\n';
  }
  return text;
}

/// Reads a TUM file of at most 128 MiB; see parse_tum.
[[nodiscard]] inline std::vector<TimedPose2> read_tum(const std::filesystem::path& file) {
  return parse_tum(read_file(file, std::size_t{1} << 27), file);
}

/// Writes a TUM file, which replaces one that is there only when complete. Throws InputError.
inline void write_tum(const std::filesystem::path& file, const std::vector<TimedPose2>& trajectory) {
  write_file_atomically(file, tum_text(trajectory));
}

}  // namespace incognita
