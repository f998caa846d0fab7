/// Runs that differ in nothing but their seed belong together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"
#include "plot/run_folder.hpp"

namespace plot {

/// More cannot be told from each other in a chart.
inline constexpr std::size_t groups_max = 12;

struct Group {
  std::string label;  ///< "alpha=0.2, strategy=online"; "all" when all runs belong together
  std::vector<const Run*> runs;

  /// For legends.
  [[nodiscard]] std::string title() const {
    return label + " (" + std::to_string(runs.size()) + (runs.size() == 1 ? " run)" : " runs)");
  }
};

/// A value as a label says it; "none" where there is none.
[[nodiscard]] inline std::string value_text(const Run& run, const std::string& key) {
  const auto found = run.metrics.find(key);
  if (found == run.metrics.end() || found->is_null()) return "none";
  if (found->is_number_float()) return incognita::format_number(found->get<double>());
  return incognita::one_line(found->is_string() ? found->get<std::string>() : found->dump(), 60);
}

/// The parameters that differ between runs, in the order of metrics.json, where they come before duration_s; never the seed.
[[nodiscard]] inline std::vector<std::string> differing_parameters(const std::vector<Run>& runs) {
  std::vector<std::string> keys;
  for (const Run& run : runs) {
    for (const auto& item : run.metrics.items()) {
      const std::string& key = item.key();
      if (key == "duration_s") break;
      if (key == "seed" || std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
      const std::string text = value_text(run, key);
      const bool differs = std::any_of(runs.begin(), runs.end(), [&](const Run& other) { return value_text(other, key) != text; });
      if (differs) keys.push_back(key);
    }
  }
  return keys;
}

/// Groups in the order of their first runs. `keys` tell them apart; where there are none, the parameters that differ do. Throws InputError
/// when a run lacks a key, and std::invalid_argument when there are more than groups_max.
[[nodiscard]] inline std::vector<Group> grouped(const std::vector<Run>& runs, std::vector<std::string> keys) {
  for (const std::string& key : keys) {
    for (const Run& run : runs) {
      if (run.metrics.contains(key)) continue;
      throw incognita::InputError(run.folder / "metrics.json", "lacks " + incognita::shown(key) + ", which --group names");
    }
  }
  if (keys.empty()) keys = differing_parameters(runs);
  std::vector<Group> groups;
  for (const Run& run : runs) {
    std::string label;
    for (const std::string& key : keys) label += (label.empty() ? "" : ", ") + key + '=' + value_text(run, key);
    if (keys.empty()) label = "all";
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return group.label == label; });
    (found == groups.end() ? groups.emplace_back(Group{label, {}}) : *found).runs.push_back(&run);
  }
  if (groups.size() > groups_max) {
    std::string names;
    for (const std::string& key : keys) names += (names.empty() ? "" : ", ") + key;
    throw std::invalid_argument("the runs make " + std::to_string(groups.size()) + " groups by " + names + ", but must make at most " +
                                std::to_string(groups_max) + "; choose a key by --group");
  }
  return groups;
}

}  // namespace plot
