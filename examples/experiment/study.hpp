/// What a study compares: maps, methods, and trials of each with each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "experiment/settings.hpp"

namespace experiment {

/// A floor plan and where it is from.
struct StudyMap {
  std::string name;
  std::filesystem::path file;       ///< of a floor plan; empty when it is drawn
  std::string plan;                 ///< the name of one that is drawn; empty when it is read
  double width_m = 0.0;             ///< of one that is generated
  double height_m = 0.0;            ///< likewise
  std::uint64_t plan_seed = 1;      ///< likewise
  std::optional<double> corridor_max_m;  ///< floor that is no wider may be a corridor; none where nothing is asked of corridors
};

struct StudyMethod {
  std::string name;
  std::string what;   ///< in words
  std::string where;  ///< file and line of the study
};

/// Every start with every seed. Start n is a pose drawn on the map with n as the seed, seed n the noise of sensors and odometry.
struct TrialGroup {
  std::string name;
  std::vector<int> starts;
  std::vector<int> seeds;
};

/// What a claim compares: what one method has of a metric on average, or by how much two differ on average, without sign.
using Side = std::vector<std::size_t>;

/// That one side has less (or more) of something than another.
struct Claim {
  std::string says;
  std::string metric;
  Side better;  ///< what is said to have less, or more ...
  Side worse;   ///< ... than this
  bool is_less = true;
  std::vector<std::size_t> maps;  ///< where it is said to hold
  bool is_of_ratios = false;      ///< of better / worse, by its logarithm, instead of better - worse
};

/// One mission: indices into the study, and which trial.
struct Unit {
  std::size_t map;
  std::size_t method;
  int start;
  int seed;
};

struct Study {
  std::filesystem::path file;
  std::string title;
  std::vector<StudyMap> maps;
  std::vector<StudyMethod> methods;
  std::vector<TrialGroup> trials;
  std::vector<Claim> claims;
  std::vector<std::string> tables;  ///< metrics
  std::vector<std::string> curves;  ///< what is drawn over time
  std::vector<Settings> settings;   ///< of each map with each method, the methods of a map one after the other

  /// "A5", or "|A5 - A4|".
  [[nodiscard]] std::string name_of(const Side& side) const {
    const std::string& first = methods[side.front()].name;
    return side.size() == 1 ? first : '|' + first + " - " + methods[side.back()].name + '|';
  }

  [[nodiscard]] const Settings& settings_of(const Unit& unit) const { return settings[unit.map * methods.size() + unit.method]; }

  /// "map/method/start/seed".
  [[nodiscard]] std::string name_of(const Unit& unit) const {
    return maps[unit.map].name + '/' + methods[unit.method].name + '/' + std::to_string(unit.start) + '/' + std::to_string(unit.seed);
  }

  /// All units, each once, in an order that gets to every map and method early.
  [[nodiscard]] std::vector<Unit> units() const {
    std::vector<Unit> all;
    std::set<std::tuple<std::size_t, std::size_t, int, int>> seen;
    for (const TrialGroup& group : trials) {
      for (const int start : group.starts) {
        for (const int seed : group.seeds) {
          for (std::size_t map = 0; map < maps.size(); ++map) {
            for (std::size_t method = 0; method < methods.size(); ++method) {
              if (seen.emplace(map, method, start, seed).second) all.push_back({map, method, start, seed});
            }
          }
        }
      }
    }
    return all;
  }
};

}  // namespace experiment
