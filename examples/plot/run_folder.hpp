/// What a run of kth_explorer has left in its folder.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"
#include "plot/csv_table.hpp"
#include "support/statistics.hpp"

namespace plot {

struct Run {
  std::filesystem::path folder;
  nlohmann::ordered_json metrics;
  // Of progress.csv
  Column time_s, explored_fraction, map_entropy_bits, position_error_m, three_sigma_m, nees, distance_m;
  double decision_time_s = 0.0;  ///< the median time that a decision took; NaN without decisions

  /// What the run ended with: a number of metrics.json, or decision_time_s. NaN where metrics.json has null or nothing.
  [[nodiscard]] double end_value(const std::string& key) const {
    if (key == "decision_time_s") return decision_time_s;
    const auto found = metrics.find(key);
    return found == metrics.end() || found->is_null() ? std::numeric_limits<double>::quiet_NaN() : found->get<double>();
  }
};

/// The numbers of metrics.json that are compared; null or absent where there is none to tell.
inline constexpr std::array end_keys{"explored_fraction",        "duration_s",         "distance_m",       "time_to_90_percent_s",
                                     "distance_to_90_percent_m", "translation_rmse_m", "heading_rmse_rad", "nees_mean",
                                     "map_error",                "collisions"};

/// The object that the text of metrics.json holds. `file` is only named in errors. Throws InputError, which names the line or the key.
[[nodiscard]] inline nlohmann::ordered_json parse_metrics(const std::string& text, const std::filesystem::path& file) {
  using incognita::InputError;
  nlohmann::ordered_json metrics;
  // What is nested without end would be shown without end.
  const auto require_shallow = [&](int depth, nlohmann::ordered_json::parse_event_t, const nlohmann::ordered_json&) {
    if (depth > 16) throw InputError(file, "nests deeper than 16 objects and arrays");
    return true;
  };
  try {
    metrics = nlohmann::ordered_json::parse(text, require_shallow);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t byte = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    throw InputError(file, "not valid JSON: cut off or malformed at line " + std::to_string(line) + ", byte " + std::to_string(byte));
  } catch (const nlohmann::json::exception&) {
    throw InputError(file, "not valid JSON: a number is out of range");
  }
  if (!metrics.is_object()) throw InputError(file, "is " + incognita::shown(metrics.dump()) + ", but must be an object of metrics");
  if (!metrics.contains("duration_s")) throw InputError(file, "lacks \"duration_s\", which ends the parameters of a run");
  for (const char* key : end_keys) {
    const auto found = metrics.find(key);
    if (found == metrics.end() || found->is_null() || found->is_number()) continue;
    throw InputError(file, '"' + std::string(key) + "\" is " + incognita::shown(found->dump()) + ", but must be a number or null");
  }
  return metrics;
}

/// Throws InputError for a folder, or a file in it, that is missing or malformed.
[[nodiscard]] inline Run read_run(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(folder, error);
  if (!std::filesystem::exists(status)) throw incognita::InputError(folder, "there is no such folder");
  if (!std::filesystem::is_directory(status)) throw incognita::InputError(folder, "is not a folder, but must be that of a run");
  Run run;
  run.folder = folder;
  const std::filesystem::path metrics = folder / "metrics.json";
  run.metrics = parse_metrics(incognita::read_file(metrics, std::size_t{1} << 20), metrics);
  const std::filesystem::path progress = folder / "progress.csv";
  std::vector<Column> columns = read_csv(
      progress, {"time_s", "explored_fraction", "map_entropy_bits", "position_error_m", "three_sigma_m", "nees", "distance_m"});
  std::size_t next = 0;
  for (Column* column : {&run.time_s, &run.explored_fraction, &run.map_entropy_bits, &run.position_error_m, &run.three_sigma_m, &run.nees,
                         &run.distance_m}) {
    *column = std::move(columns[next++]);
  }
  require_ascending(progress, "time_s", run.time_s, false);
  require_ascending(progress, "distance_m", run.distance_m, true);
  Column times_s = std::move(read_csv(folder / "decisions.csv", {"evaluation_time_s"}).front());
  times_s.erase(std::remove_if(times_s.begin(), times_s.end(), [](double time_s) { return std::isnan(time_s); }), times_s.end());
  run.decision_time_s = times_s.empty() ? std::numeric_limits<double>::quiet_NaN() : examples::median(std::move(times_s));
  return run;
}

}  // namespace plot
