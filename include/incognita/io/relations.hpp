/// Relations between a robot's poses, as published with the metric of Kümmerle et al. (2009).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/text_lines.hpp"
#include "incognita/metrics/relations_error.hpp"

namespace incognita {

/// The relations in a text: a line each, "t1 t2 x y z roll pitch yaw" in seconds, metres and radians, the
/// pose at t2 in the frame of the pose at t1. Empty lines and comments (#) are skipped; height, roll and
/// pitch are dropped. `file` is only named in errors. Throws InputError, which names the line, unless each
/// holds eight finite numbers and there is one.
[[nodiscard]] inline std::vector<PoseRelation> parse_relations(std::string_view text,
                                                               const std::filesystem::path& file) {
  std::vector<PoseRelation> relations;
  detail::for_each_line(text, [&](std::size_t number, std::string_view line) {
    std::array<double, 8> numbers{};
    std::string_view unread = line;
    bool whole = true;
    for (double& value : numbers) {
      const std::optional<double> parsed = parse_number(detail::take_word(unread));
      whole = whole && parsed && std::isfinite(*parsed);
      if (whole) value = *parsed;
    }
    if (!whole || !detail::take_word(unread).empty()) {
      throw InputError(file, "line " + std::to_string(number) + " is " + shown(line) +
                                 ", but must be eight finite numbers: t1 t2 x y z roll pitch yaw");
    }
    const auto [from_s, to_s, x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad] = numbers;
    static_cast<void>(z_m), static_cast<void>(roll_rad), static_cast<void>(pitch_rad);
    relations.push_back({from_s, to_s, {x_m, y_m, wrap_angle_rad(yaw_rad)}});
  });
  if (relations.empty()) throw InputError(file, "holds no relations");
  return relations;
}

/// Reads a file of relations of at most 64 MiB; see parse_relations.
[[nodiscard]] inline std::vector<PoseRelation> read_relations(const std::filesystem::path& file) {
  return parse_relations(read_file(file, std::size_t{1} << 26), file);
}

}  // namespace incognita
