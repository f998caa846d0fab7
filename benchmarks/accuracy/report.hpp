/// The tables of the report, as Markdown.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "accuracy/drive.hpp"
#include "accuracy/localisation.hpp"
#include "accuracy/statistics.hpp"
#include "accuracy/wrong_places.hpp"

namespace accuracy {

/// Replays of one mission that differ in their seeds alone.
struct ReplayGroup {
  std::string building;
  std::size_t beams = 0;
  bool uses_compass = true;
  bool closes_loops = true;
  bool has_people = false;
  std::vector<Replay> replays;
};

template <class Results, class Value>
[[nodiscard]] std::vector<double> values_of(const Results& results, const Value& value) {
  std::vector<double> values;
  for (const auto& result : results) values.push_back(value(result));
  return values;
}

/// "mean [low, high]".
[[nodiscard]] inline std::string with_interval(const std::vector<double>& values, int decimals) {
  const Summary summary = summarise(values);
  char text[96];
  std::snprintf(text, sizeof text, "%.*f [%.*f, %.*f]", decimals, summary.mean, decimals, summary.low,
                decimals, summary.high);
  return text;
}

inline void print_missions(const std::string& building, const std::vector<Mission>& missions) {
  for (std::size_t i = 0; i < missions.size(); ++i) {
    const Mission& mission = missions[i];
    std::printf("| %s | %zu | %.0f | %.0f | %s | %.4f | %.2f | %.2f |\n", building.c_str(), i + 1,
                mission.duration_s, mission.distance_m, mission.ended.c_str(),
                mission.errors.position_rmse_m(), 1e3 * mission.errors.heading_rmse_rad(),
                mission.errors.mean_position_nees());
  }
}

inline void print_missions_header() {
  std::printf(
      "\n## Missions\n\n"
      "An explorer with the defaults, 360 beams. The first mission of each building is replayed below.\n\n"
      "| building | mission | duration, s | driven, m | ended | position RMSE, m | heading RMSE, mrad | mean "
      "NEES |\n"
      "|---|---|---|---|---|---|---|---|\n");
}

/// One row a group. Costs are the median and the mean over a drive's scans, each then the median over the drives.
inline void print_replays(const std::vector<ReplayGroup>& groups) {
  std::printf(
      "| building | beams | compass | loops | position RMSE, m: mean [95 %%] | worst | heading RMSE, mrad: mean [95 "
      "%%] | worst "
      "| NEES: mean [95 %%] | worst | a scan, us: median | mean | scans not trusted |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const ReplayGroup& group : groups) {
    const auto position_m =
        values_of(group.replays, [](const Replay& r) { return r.errors.position_rmse_m(); });
    const auto heading_mrad =
        values_of(group.replays, [](const Replay& r) { return 1e3 * r.errors.heading_rmse_rad(); });
    const auto nees = values_of(group.replays, [](const Replay& r) { return r.errors.mean_position_nees(); });
    const auto untrusted = values_of(group.replays, [](const Replay& r) { return r.untrusted_share; });
    std::printf("| %s | %zu | %s | %s | %s | %.4f | %s | %.2f | %s | %.2f | %.0f | %.0f | %.2f %% |\n",
                group.building.c_str(), group.beams, group.uses_compass ? "on" : "off", group.closes_loops ? "on" : "off",
                with_interval(position_m, 4).c_str(), summarise(position_m).worst,
                with_interval(heading_mrad, 2).c_str(), summarise(heading_mrad).worst,
                with_interval(nees, 2).c_str(), summarise(nees).worst,
                median(values_of(group.replays, [](const Replay& r) { return r.scan_median_us; })),
                median(values_of(group.replays, [](const Replay& r) { return r.scan_mean_us; })),
                100.0 * summarise(untrusted).mean);
  }
}

/// What the compass makes of buildings, from the groups that use it.
inline void print_compass(const std::vector<ReplayGroup>& groups) {
  std::printf(
      "\n| building | beams | share of the walls along the dominant direction | scans with a heading |\n"
      "|---|---|---|---|\n");
  for (const ReplayGroup& group : groups) {
    if (!group.uses_compass || !group.closes_loops) continue;
    const auto share = values_of(group.replays, [](const Replay& r) { return r.compass_share; });
    const auto headings = values_of(group.replays, [](const Replay& r) { return r.compass_heading_share; });
    std::printf("| %s | %zu | %.2f | %.1f %% |\n", group.building.c_str(), group.beams, summarise(share).mean,
                100.0 * summarise(headings).mean);
  }
}

/// Groups with people against the same without.
inline void print_people(const std::vector<ReplayGroup>& without, const std::vector<ReplayGroup>& with) {
  std::printf(
      "| building | position RMSE without people, m | with, m | ratio | free cells wrongly occupied without | with, at "
      "most |\n"
      "|---|---|---|---|---|---|\n");
  for (std::size_t i = 0; i < with.size(); ++i) {
    const auto position_m = [](const ReplayGroup& group) {
      return summarise(values_of(group.replays, [](const Replay& r) { return r.errors.position_rmse_m(); })).mean;
    };
    const auto wrong = [](const ReplayGroup& group) {
      return 100.0 * summarise(values_of(group.replays, [](const Replay& r) { return r.wrongly_occupied_share; })).worst;
    };
    std::printf("| %s | %.4f | %.4f | %.2f | %.2f %% | %.2f %% |\n", with[i].building.c_str(), position_m(without[i]),
                position_m(with[i]), position_m(with[i]) / position_m(without[i]), wrong(without[i]), wrong(with[i]));
  }
}

inline void print_wrong_places_header(double interval_s) {
  std::printf(
      "\n## Wrong places\n\n"
      "At every %.0f s of the replayed mission, to a copy of robot, filter and map; judged by the 20th scan "
      "after. "
      "Recovered: that scan is trusted and the error below 0.15 m. Lost: the filter says so. Doubtful: it "
      "trusts no "
      "scan yet. Mistaken: it trusts the scan and is wrong. Flipped: of the cells known before, those then "
      "known "
      "as the opposite, at most.\n\n"
      "| building | what happens | times | recovered | lost | doubtful | mistaken | worst error, m | flipped "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      interval_s);
}

inline void print_wrong_places(const std::string& building, const OutcomesByMishap& outcomes) {
  for (std::size_t kind = 0; kind < mishaps.size(); ++kind) {
    const Outcomes& o = outcomes[kind];
    const std::string_view mishap = to_string(mishaps[kind]);
    std::printf("| %s | %.*s | %d | %d | %d | %d | %d | %.2f | %.3f %% |\n", building.c_str(),
                static_cast<int>(mishap.size()), mishap.data(), o.count, o.recovered, o.lost, o.doubtful,
                o.mistaken, o.error_max_m, 100.0 * o.flipped_share_max);
  }
}

}  // namespace accuracy
