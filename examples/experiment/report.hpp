/// The report of a study, as Markdown beside its pictures.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiment/analysis.hpp"
#include "experiment/figures.hpp"
#include "incognita/io/atomic_file.hpp"
#include "support/output_folder.hpp"

namespace experiment {

namespace detail {

[[nodiscard]] inline std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

[[nodiscard]] inline std::string interval_text(const examples::MeanInterval& mean) {
  if (!mean.interval) return digits(mean.mean);
  return digits(mean.mean) + " [" + digits(mean.interval->low) + ", " + digits(mean.interval->high) + ']';
}

/// The ratio that is the mean of logarithms.
[[nodiscard]] inline examples::MeanInterval ratio_of(examples::MeanInterval logarithm) {
  if (logarithm.interval) logarithm.interval = examples::Interval{std::exp(logarithm.interval->low), std::exp(logarithm.interval->high)};
  logarithm.mean = std::exp(logarithm.mean);
  return logarithm;
}

/// The methods' means with their intervals, and the medians; how many missions have a value, where not all have.
[[nodiscard]] inline std::string table_text(const Study& study, const Results& results, std::size_t map, const TrialGroup& group) {
  std::string text = "| method | missions |";
  for (const std::string& metric : study.tables) text += ' ' + metric + " |";
  text += "\n|---|---|";
  for (std::size_t n = 0; n < study.tables.size(); ++n) text += "---|";
  text += '\n';
  for (std::size_t method = 0; method < study.methods.size(); ++method) {
    const std::vector<Results::Done> done = results.of(map, method, &group);
    const std::size_t missions = done.size();
    const auto lost = std::count_if(done.begin(), done.end(), [](const auto& each) { return each.row->json.at("stop_reason") == "lost"; });
    text += "| " + study.methods[method].name + " | " + std::to_string(missions) + (lost > 0 ? ", " + std::to_string(lost) + " lost" : "") + " |";
    for (const std::string& metric : study.tables) {
      const std::vector<double> values = results.values(map, method, metric, &group);
      if (!values.empty()) text += ' ' + interval_text(examples::bootstrapped_mean(values)) + ", median " + digits(examples::median(values));
      if (values.size() < missions) text += " (of " + std::to_string(values.size()) + ')';
      text += " |";
    }
    text += '\n';
  }
  return text;
}

/// A table for each group of trials: a row a claim, a column a map.
[[nodiscard]] inline std::string claims_text(const Study& study, const Results& results) {
  std::string text =
      "By differences on the same starts and seeds: a claim **holds** where the 95 % bootstrap interval of their mean is on its side of 0, the "
      "**opposite** does where it is on the other; else, and with fewer than " +
      std::to_string(examples::interval_values_min) +
      " pairs on a map, it is undecided. Where nothing is true, one interval in twenty still leaves 0 out. All maps count alike, whatever their "
      "size. Ratios (/) are judged by the mean of their logarithms, for which an error ten times as large is as bad as one a tenth is good; their side "
      "is that of 1.\n\n";
  for (const TrialGroup& group : study.trials) {
    text += "Trials \"" + group.name + "\":\n\n| claim | difference or ratio of |";
    std::string rule = "|---|---|";
    for (const StudyMap& map : study.maps) {
      text += ' ' + map.name + " |";
      rule += "---|";
    }
    text += " all maps |\n" + rule + "---|\n";
    for (const Claim& claim : study.claims) {
      text += "| " + claim.says + " | " + claim.metric + ", " + study.name_of(claim.better) + (claim.is_of_ratios ? " / " : " - ") + study.name_of(claim.worse) +
              " |";
      const auto cell = [&](const std::vector<std::vector<Results::Pair>>& pairs) {
        const Judgement judgement = judge(claim, pairs);
        const std::size_t pairs_max = pairs.size() * Results::pairs_max(group);
        const examples::MeanInterval shown = claim.is_of_ratios ? ratio_of(judgement.difference) : judgement.difference;
        text += std::string(" **") + words_of(judgement.verdict) + "** " + (judgement.pairs > 0 ? interval_text(shown) + ", " : "") +
                std::to_string(judgement.pairs) + (judgement.pairs < pairs_max ? " of " + std::to_string(pairs_max) : "") + " pairs |";
      };
      std::vector<std::vector<Results::Pair>> of_all;
      for (std::size_t map = 0; map < study.maps.size(); ++map) {
        if (std::find(claim.maps.begin(), claim.maps.end(), map) == claim.maps.end()) {
          text += " |";
          continue;
        }
        of_all.push_back(results.pairs(map, claim, group));
        cell({of_all.back()});
      }
      cell(of_all);
      text += '\n';
    }
    text += '\n';
  }
  return text;
}

/// Why missions have ended, and what has failed.
[[nodiscard]] inline std::string endings_text(const Study& study, const Results& results) {
  std::map<std::string, std::size_t> endings;
  std::string failures;
  for (const Results::Done& done : results.all()) {
    if (done.row->has_failed()) {
      failures += "- " + study.name_of(done.unit) + ": " + done.row->json.at("failed").get<std::string>() + '\n';
    } else {
      ++endings[done.row->json.at("stop_reason").get<std::string>()];
    }
  }
  std::string text = std::to_string(results.all().size()) + " of " + std::to_string(study.units().size()) + " missions are in this report.";
  const char* separator = " They ended as ";
  for (const auto& [reason, count] : endings) {
    text += separator + reason + " (" + std::to_string(count) + ")";
    separator = ", ";
  }
  text += endings.empty() ? "\n" : ".\n";
  return failures.empty() ? text : text + "\nFailed, and in no table:\n\n" + failures;
}

/// What missions took: medians over the trials, of those that a cost is known of.
[[nodiscard]] inline std::string costs_text(const Study& study, const Results& results, const Costs& costs) {
  std::string text =
      "Medians of the time on the wall; a mission has one thread, and as many ran side by side as the study had threads or ranks.\n\n| map | "
      "method | missions |";
  std::string rule = "|---|---|---|";
  for (const auto& [name, words] : cost_figures) {
    text += std::string(" ") + words + " |";
    rule += "---|";
  }
  text += '\n' + rule + '\n';
  for (std::size_t map = 0; map < study.maps.size(); ++map) {
    for (std::size_t method = 0; method < study.methods.size(); ++method) {
      std::vector<const nlohmann::json*> known;
      for (const Results::Done& done : results.of(map, method)) {
        if (const auto cost = costs.find(done.row->key); cost != costs.end()) known.push_back(&cost->second);
      }
      if (known.empty()) continue;
      text += "| " + study.maps[map].name + " | " + study.methods[method].name + " | " + std::to_string(known.size()) + " |";
      for (const auto& [name, words] : cost_figures) {
        std::vector<double> values;
        for (const nlohmann::json* cost : known) values.push_back(cost->at(name).get<double>());
        text += ' ' + digits(examples::median(values)) + " |";
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace detail

/// Writes report.md and its pictures into a folder. Throws what drawing and writing throw; files appear when all are complete.
inline void write_report(const Study& study, const std::vector<Arena>& arenas, const std::vector<Row>& rows, const Costs& costs,
                         const std::filesystem::path& folder) {
  const Results results(study, rows);
  examples::OutputFolder output(folder);
  std::string text = "# " + study.title + "\n\n" + detail::endings_text(study, results) + "\n| method | what |\n|---|---|\n";
  for (const StudyMethod& method : study.methods) text += "| " + method.name + " | " + method.what + " |\n";
  text += '\n';
  if (!study.claims.empty()) text += "## Claims\n\n" + detail::claims_text(study, results);
  for (std::size_t map = 0; map < study.maps.size(); ++map) {
    const std::string& name = study.maps[map].name;
    text += "## " + name + "\n\n";
    bool has_rows = false;
    for (std::size_t method = 0; method < study.methods.size(); ++method) has_rows = has_rows || !results.of(map, method).empty();
    if (!has_rows) {
      text += "No mission has been finished here.\n\n";
      continue;
    }
    for (const TrialGroup& group : study.trials) {
      text += "Trials \"" + group.name + "\", means [95 % bootstrap intervals]:\n\n" + detail::table_text(study, results, map, group) + '\n';
    }
    const std::string of_group = ", of the trials \"" + study.trials.front().name + "\"";
    const auto picture = [&](const std::string& kind, const std::string& says, auto&& draw) {
      const std::string file = name + '_' + kind + ".png";
      draw(output.staged(file));
      text += "![" + says + "](" + file + ")\n\n";
    };
    if (!study.curves.empty()) {
      picture("curves", "Medians over time, from quartile to quartile" + of_group, [&](const auto& file) { draw_curves(file, study, results, map); });
    }
    if (!study.tables.empty()) {
      picture("boxes", "Boxes from quartile to quartile, whiskers to the extremes" + of_group, [&](const auto& file) { draw_boxes(file, study, results, map); });
    }
    picture("ways", "The ways of the first trial that all methods have", [&](const auto& file) { draw_ways(file, study, results, arenas[map], map); });
  }
  if (!costs.empty()) text += "## Cost\n\n" + detail::costs_text(study, results, costs);
  incognita::write_file_atomically(output.staged("report.md"), text);
  output.publish();
}

}  // namespace experiment
