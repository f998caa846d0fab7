/// Tables of numbers from CSV files.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"

namespace plot {

/// One column; NaN where the file has nothing.
using Column = std::vector<double>;

/// The values of a line between commas.
[[nodiscard]] inline std::vector<std::string_view> values_of(std::string_view line) {
  std::vector<std::string_view> values;
  while (true) {
    const std::size_t comma = std::min(line.find(','), line.size());
    values.push_back(line.substr(0, comma));
    if (comma == line.size()) return values;
    line.remove_prefix(comma + 1);
  }
}

/// The columns of these names, in their order, of the text of a CSV file: a line of names, then lines with as many values. Other columns may
/// hold anything. `file` is only named in errors. Throws InputError, which names the line and the column, where a column is missing, a line
/// has more or fewer values, or one is neither empty nor a finite number.
[[nodiscard]] inline std::vector<Column> parse_csv(std::string_view text, const std::filesystem::path& file,
                                                   const std::vector<std::string>& names) {
  using incognita::InputError;
  const auto take_line = [&] {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  };
  const std::string_view first = take_line();
  const std::vector<std::string_view> header = values_of(first);
  std::vector<std::size_t> places;
  for (const std::string& name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found == header.end()) {
      throw InputError(file, "line 1 is " + incognita::shown(first) + ", but must name the column \"" + name + "\"");
    }
    places.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<Column> columns(names.size());
  for (std::size_t number = 2; !text.empty(); ++number) {
    const std::string_view line = take_line();
    const std::vector<std::string_view> values = values_of(line);
    if (values.size() != header.size()) {
      throw InputError(file, "line " + std::to_string(number) + " is " + incognita::shown(line) + " with " + std::to_string(values.size()) +
                                 " values, but must have " + std::to_string(header.size()) + " as line 1");
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::string_view value = values[places[i]];
      const std::optional<double> parsed =
          value.empty() ? std::optional(std::numeric_limits<double>::quiet_NaN()) : incognita::parse_number(value);
      if (!parsed || (!value.empty() && !std::isfinite(*parsed))) {
        throw InputError(file, "line " + std::to_string(number) + ": " + names[i] + " is " + incognita::shown(value) +
                                   ", but must be a finite number or empty");
      }
      columns[i].push_back(*parsed);
    }
  }
  return columns;
}

/// Reads a CSV file of at most 64 MiB; see parse_csv.
[[nodiscard]] inline std::vector<Column> read_csv(const std::filesystem::path& file, const std::vector<std::string>& names) {
  return parse_csv(incognita::read_file(file, std::size_t{1} << 26), file, names);
}

/// Throws InputError, which names the line, unless there is a row and the column only grows; it may stay as it is if `may_stay`.
inline void require_ascending(const std::filesystem::path& file, const std::string& name, const Column& column, bool may_stay) {
  if (column.empty()) throw incognita::InputError(file, "holds no rows, but must have one after the line of names");
  for (std::size_t i = 0; i < column.size(); ++i) {
    const auto fail = [&](const std::string& what) {
      throw incognita::InputError(file, "line " + std::to_string(i + 2) + ": " + name + " is " + what);
    };
    if (std::isnan(column[i])) fail("empty, but must be a number");
    if (i == 0 || column[i] > column[i - 1] || (may_stay && column[i] == column[i - 1])) continue;
    fail(incognita::format_number(column[i]) + ", but must be " + (may_stay ? ">= " : "> ") + incognita::format_number(column[i - 1]) +
         ", that of the line before");
  }
}

}  // namespace plot
