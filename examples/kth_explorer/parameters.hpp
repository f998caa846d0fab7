/// All that a mission was made with, by name.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "incognita/io/state_archive.hpp"
#include "kth_explorer/options.hpp"
#include "kth_explorer/saved_mission.hpp"
#include "support/steering.hpp"

namespace kth_explorer {

/// The options of the command line as "mission", then the parameters of the explorer's parts and of the controller, a group each; what a part was given by the
/// parameters of another is listed with those alone.
template <class Explorer>
[[nodiscard]] nlohmann::ordered_json parameters_json(const Explorer& explorer, const examples::Steering& steering, const Options& options) {
  nlohmann::ordered_json json;
  auto& mission = json["mission"];
  mission["map"] = map_name(options);
  mission["seed"] = options.seed;
  mission["duration_s"] = options.duration_s;
  mission["cells"] = options.cells;
  mission["frontiers"] = options.frontiers;
  mission["entropy"] = options.entropy;
  if (options.entropy != "shannon") mission["alpha"] = options.alpha;
  mission["filter"] = options.filter;
  mission["compass"] = options.compass;
  mission["loops"] = options.loops;
  mission["strategy"] = options.strategy;
  mission["information"] = options.information;
  mission["navigation"] = options.navigation;
  mission["controller"] = options.controller;
  mission["returns"] = options.returns;

  incognita::StateWriter writer;
  writer(explorer, steering);
  const std::string all = '\n' + writer.parameters();
  const auto is_listed_of = [&](const char* part, std::string_view line) {
    return all.find('\n' + (part + std::string(line)) + '\n') != std::string::npos;
  };
  std::string_view lines = writer.parameters();
  while (!lines.empty()) {  // GROUP.NAME = VALUE
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    if (is_listed_of("explorer.", line) || is_listed_of("filter.", line)) continue;
    const std::size_t dot = line.find('.');
    const std::size_t equals = line.find(" = ");
    const std::string_view text = line.substr(equals + 3);
    auto& value = json[std::string(line.substr(0, dot))][std::string(line.substr(dot + 1, equals - dot - 1))];
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
    value = is_number ? nlohmann::ordered_json(number) : nlohmann::ordered_json(std::string(text));
  }
  return json;
}

}  // namespace kth_explorer
