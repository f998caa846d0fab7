/// What rows of a study rest on, so that those of another are not taken for its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiment/arena.hpp"
#include "experiment/study.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/read_file.hpp"

namespace experiment {

[[nodiscard]] inline nlohmann::json settings_json(const Settings& settings) {
  nlohmann::json json;
  for (const Field& field : fields()) {
    std::visit([&](auto member) { json[std::string(field.name)] = settings.*member; }, field.member);
  }
  return json;
}

/// The checksum of each map, and the settings of each method on it.
[[nodiscard]] inline nlohmann::json identity_json(const Study& study, const std::vector<Arena>& arenas) {
  nlohmann::json json;
  for (std::size_t map = 0; map < study.maps.size(); ++map) {
    nlohmann::json& of_map = json[study.maps[map].name];
    of_map["checksum"] = arenas[map].checksum;
    of_map["corridor_max_m"] = study.maps[map].corridor_max_m.value_or(0.0);
    for (std::size_t method = 0; method < study.methods.size(); ++method) {
      of_map["methods"][study.methods[method].name] = settings_json(study.settings_of({map, method, 1, 1}));
    }
  }
  return json;
}

/// Throws InputError, naming the first thing that differs, unless rows of `before` are rows of `now`: what both have must be equal. Maps,
/// methods and trials may have been added.
inline void require_same(const nlohmann::json& before, const nlohmann::json& now, const std::filesystem::path& file) {
  for (const auto& [map, of_map] : before.items()) {
    if (!now.contains(map)) continue;
    for (const char* key : {"checksum", "corridor_max_m"}) {
      if (of_map.at(key) != now[map][key]) throw incognita::InputError(file, "the map " + map + " has another " + key + " than when its rows were made");
    }
    for (const auto& [method, settings] : of_map.at("methods").items()) {
      if (!now[map]["methods"].contains(method)) continue;
      const nlohmann::json& settings_now = now[map]["methods"][method];
      for (const auto& [name, value] : settings_now.items()) {
        if (settings.contains(name) && settings[name] == value) continue;
        throw incognita::InputError(file, map + '/' + method + ": " + name + " is " + value.dump() + ", but was " +
                                              (settings.contains(name) ? settings[name].dump() : "not there") + " when its rows were made");
      }
    }
  }
}

[[nodiscard]] inline nlohmann::json read_identity(const std::filesystem::path& file) {
  try {
    return nlohmann::json::parse(incognita::read_file(file, 100'000'000));
  } catch (const nlohmann::json::exception& problem) {
    throw incognita::InputError(file, std::string("is not what a study has written: ") + problem.what());
  }
}

}  // namespace experiment
