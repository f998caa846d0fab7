/// The numbers of the charts as a CSV file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "plot/comparison.hpp"
#include "support/csv.hpp"

namespace plot {

/// A value of a CSV file, in quotes where it holds a comma or quotes.
[[nodiscard]] inline std::string csv_value(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

/// A row for each place of each curve, and one for each quantity at the end, in the units of metrics.json and progress.csv.
inline void write_table(const std::filesystem::path& path, const Comparison& comparison) {
  examples::write_csv(path, "group,quantity,over,at,runs,low,median,high", [&](std::ostream& out) {
    for (std::size_t i = 0; i < comparison.groups.size(); ++i) {
      const Group& group = comparison.groups[i];
      const std::string label = csv_value(group.label);
      const auto write = [&](const char* quantity, const char* over, const Band& band) {
        for (std::size_t k = 0; k < band.at.size(); ++k) {
          out << label << ',' << quantity << ',' << over << ',' << band.at[k] << ',' << band.runs[k] << ',' << band.low[k] << ','
              << band.median[k] << ',' << band.high[k] << '\n';
        }
      };
      const GroupBands& bands = comparison.bands[i];
      write("explored_fraction", "time_s", bands.explored_over_time);
      write("explored_fraction", "distance_m", bands.explored_over_distance);
      write("map_entropy_bits", "time_s", bands.entropy);
      write("position_error_m", "time_s", bands.error);
      write("three_sigma_m", "time_s", bands.three_sigma);
      write("nees", "time_s", bands.nees);
      std::vector<std::string> keys(end_keys.begin(), end_keys.end());
      keys.push_back("decision_time_s");
      for (const std::string& key : keys) {
        const std::vector<double> values = end_values(group, key);
        if (values.empty()) continue;
        const examples::Spread spread = examples::spread_of(values);
        const bool has_quartiles = values.size() >= examples::quartile_values_min;
        out << label << ',' << key << ",end,," << values.size() << ',' << (has_quartiles ? spread.lower_quartile : spread.least) << ','
            << spread.median << ',' << (has_quartiles ? spread.upper_quartile : spread.greatest) << '\n';
      }
    }
  });
}

}  // namespace plot
