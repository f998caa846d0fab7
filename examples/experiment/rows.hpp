/// Rows of results.jsonl: which unit, and what it came to.
#pragma once

#include <array>
#include <cstddef>
#include <exception>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiment/study.hpp"
#include "incognita/io/input_error.hpp"

namespace experiment {

/// Tells units apart by the names in a row.
using UnitKey = std::tuple<std::string, std::string, int, int>;

[[nodiscard]] inline UnitKey key_of(const Study& study, const Unit& unit) {
  return {study.maps[unit.map].name, study.methods[unit.method].name, unit.start, unit.seed};
}

/// A row without its line feed; `result` are members of an object, without braces.
[[nodiscard]] inline std::string row_text(const Study& study, const Unit& unit, const std::string& result) {
  nlohmann::ordered_json head;
  head["map"] = study.maps[unit.map].name;
  head["method"] = study.methods[unit.method].name;
  head["start"] = unit.start;
  head["seed"] = unit.seed;
  std::string text = head.dump();
  text.pop_back();
  return text + ',' + result + '}';
}

/// What stands in a row instead of results when a mission has failed.
[[nodiscard]] inline std::string failure_text(const std::string& reason) {
  const std::string text = nlohmann::ordered_json{{"failed", reason}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return text.substr(1, text.size() - 2);
}

/// What run() returns, or why it has failed.
template <class Run>
[[nodiscard]] std::string result_of(Run&& run) {
  try {
    return run();
  } catch (const std::exception& error) {
    return failure_text(error.what());
  }
}

/// Throws what nlohmann::json throws.
[[nodiscard]] inline UnitKey key_in(const nlohmann::json& json) {
  return {json.at("map").get<std::string>(), json.at("method").get<std::string>(), json.at("start").get<int>(), json.at("seed").get<int>()};
}

struct Row {
  UnitKey key;
  nlohmann::json json;

  [[nodiscard]] bool has_failed() const { return json.contains("failed"); }

  /// None where it has failed, or has none.
  [[nodiscard]] std::optional<double> metric(const std::string& name) const {
    if (has_failed()) return std::nullopt;
    const auto& metrics = json.at("metrics");
    const auto value = metrics.find(name);
    return value != metrics.end() && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  }
};

/// Throws InputError, naming the line, for a line that is no row.
[[nodiscard]] inline std::vector<Row> parsed_rows(const std::vector<std::string>& lines, const std::string& file) {
  std::vector<Row> rows;
  std::set<UnitKey> seen;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    const auto fail = [&](const std::string& problem) { throw incognita::InputError(file + ':' + std::to_string(n + 1), problem); };
    try {
      nlohmann::json json = nlohmann::json::parse(lines[n]);
      UnitKey key = key_in(json);
      if (!json.contains("failed")) static_cast<void>(json.at("metrics").at("explored_fraction").get<double>());
      if (!seen.insert(key).second) fail("is a row of a unit that has one already");
      rows.push_back({std::move(key), std::move(json)});
    } catch (const nlohmann::json::exception& problem) {
      fail(std::string("is not a row of results: ") + problem.what());
    }
  }
  return rows;
}

/// What a row of costs says, and in which words.
inline constexpr std::array<std::array<const char*, 2>, 6> cost_figures{{{"wall_s", "a mission, s"},
                                                                        {"observe_ms_per_scan", "estimation and mapping, ms a scan"},
                                                                        {"decide_ms_per_scan", "deciding, ms a scan"},
                                                                        {"decide_ms_per_decision", "ms a decision"},
                                                                        {"command_ms_per_scan", "steering, ms a scan"},
                                                                        {"simulator_ms_per_scan", "simulator and metrics, ms a scan"}}};

/// What each unit took.
using Costs = std::map<UnitKey, nlohmann::json>;

/// Of lines of costs.jsonl; where a unit has several, as it was run again, the last. Throws InputError, naming the line, for one that is none.
[[nodiscard]] inline Costs parsed_costs(const std::vector<std::string>& lines, const std::string& file) {
  Costs costs;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    try {
      nlohmann::json json = nlohmann::json::parse(lines[n]);
      for (const auto& [name, words] : cost_figures) static_cast<void>(json.at(name).get<double>());
      UnitKey key = key_in(json);
      costs.insert_or_assign(std::move(key), std::move(json));
    } catch (const nlohmann::json::exception& problem) {
      throw incognita::InputError(file + ':' + std::to_string(n + 1), std::string("is not a row of costs: ") + problem.what());
    }
  }
  return costs;
}

}  // namespace experiment
