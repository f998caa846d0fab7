/// Polygons as text: a line each, its corners as "x,y" in metres with white space between them.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/geometry/polygon.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "incognita/io/text_lines.hpp"

namespace incognita {

/// The polygons in a text, as "0,0 4,0 4,2.5" for a triangle. Empty lines and comments (#) are skipped. `file` is only named in
/// errors. Throws InputError, which names the line, for a corner that is not two finite numbers and for a polygon with fewer than
/// three, and when there is no polygon.
[[nodiscard]] inline std::vector<Polygon> parse_polygons(std::string_view text, const std::filesystem::path& file) {
  std::vector<Polygon> polygons;
  detail::for_each_line(text, [&](std::size_t number, std::string_view line) {
    const auto fail = [&](const std::string& problem) {
      throw InputError(file, "line " + std::to_string(number) + problem);
    };
    Polygon polygon;
    for (std::string_view word = detail::take_word(line); !word.empty(); word = detail::take_word(line)) {
      const std::size_t comma = word.find(',');
      const auto x_m = parse_number(word.substr(0, comma));
      const auto y_m = comma == word.npos ? std::nullopt : parse_number(word.substr(comma + 1));
      if (!x_m || !y_m || !std::isfinite(*x_m) || !std::isfinite(*y_m)) {
        fail(" has the corner " + shown(word) + ", but must have corners of two finite numbers: x,y");
      }
      polygon.emplace_back(*x_m, *y_m);
    }
    if (polygon.size() < 3) fail(" has " + std::to_string(polygon.size()) + " corners, but a polygon must have 3 or more");
    polygons.push_back(std::move(polygon));
  });
  if (polygons.empty()) throw InputError(file, "holds no polygons");
  return polygons;
}

/// Reads a file of polygons of at most 16 MiB; see parse_polygons.
[[nodiscard]] inline std::vector<Polygon> read_polygons(const std::filesystem::path& file) {
  return parse_polygons(read_file(file, std::size_t{1} << 24), file);
}

}  // namespace incognita
