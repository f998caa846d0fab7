/// What rows say: values of a method on a map, differences or ratios on the same starts and seeds, and claims judged by them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "experiment/rows.hpp"
#include "experiment/study.hpp"
#include "support/bootstrap.hpp"

namespace experiment {

/// The rows of a study by unit; those of other studies' units are left out.
class Results {
 public:
  Results(const Study& study, const std::vector<Row>& rows) : study_(study) {
    std::map<UnitKey, const Row*> by_key;
    for (const Row& row : rows) by_key[row.key] = &row;
    for (const Unit& unit : study.units()) {
      const auto found = by_key.find(key_of(study, unit));
      if (found != by_key.end()) units_.push_back({unit, found->second});
    }
  }

  struct Done {
    Unit unit;
    const Row* row;
  };

  [[nodiscard]] const std::vector<Done>& all() const { return units_; }

  /// The rows of a method on a map that have not failed; of one group of trials, or of all.
  [[nodiscard]] std::vector<Done> of(std::size_t map, std::size_t method, const TrialGroup* group = nullptr) const {
    std::vector<Done> done;
    for (const Done& each : units_) {
      if (each.unit.map != map || each.unit.method != method || each.row->has_failed()) continue;
      if (group == nullptr || has(*group, each.unit)) done.push_back(each);
    }
    return done;
  }

  /// Values of a metric, of those that have one.
  [[nodiscard]] std::vector<double> values(std::size_t map, std::size_t method, const std::string& metric,
                                           const TrialGroup* group = nullptr) const {
    std::vector<double> values;
    for (const Done& done : of(map, method, group)) {
      if (const auto value = done.row->metric(metric)) values.push_back(*value);
    }
    return values;
  }

  /// What `better` has beyond `worse` for each start and seed of a group that has both, on one map; of ratios the logarithms, of those that have one.
  [[nodiscard]] std::vector<double> differences(std::size_t map, const Claim& claim, const TrialGroup& group) const {
    std::map<std::tuple<std::size_t, int, int>, double> known;
    for (const Done& done : units_) {
      if (done.unit.map != map || !has(group, done.unit)) continue;
      if (const auto value = done.row->metric(claim.metric)) known[{done.unit.method, done.unit.start, done.unit.seed}] = *value;
    }
    std::vector<double> differences;
    for (const int start : group.starts) {
      for (const int seed : group.seeds) {
        const auto value_of = [&](const Side& side) -> std::optional<double> {
          const auto first = known.find({side.front(), start, seed});
          const auto last = known.find({side.back(), start, seed});
          if (first == known.end() || last == known.end()) return std::nullopt;
          return side.size() == 1 ? first->second : std::abs(first->second - last->second);
        };
        const auto better = value_of(claim.better);
        const auto worse = value_of(claim.worse);
        if (!better || !worse) continue;
        const double difference = claim.is_of_ratios ? std::log(*better / *worse) : *better - *worse;
        if (std::isfinite(difference)) differences.push_back(difference);
      }
    }
    return differences;
  }

 private:
  static bool has(const TrialGroup& group, const Unit& unit) {
    const auto contains = [](const std::vector<int>& all, int value) { return std::find(all.begin(), all.end(), value) != all.end(); };
    return contains(group.starts, unit.start) && contains(group.seeds, unit.seed);
  }

  const Study& study_;
  std::vector<Done> units_;
};

enum class Verdict { holds, does_not_hold, undecided };

struct Judgement {
  Verdict verdict = Verdict::undecided;
  std::size_t pairs = 0;
  examples::MeanInterval difference;  ///< better - worse, or the logarithm of better / worse
};

/// By the differences on the same starts and seeds, of each map that is judged. A claim holds where the whole interval of their mean is on its
/// side of 0, does not where it is on the other side, and is undecided where 0 is within, or where there are too few pairs for an interval.
[[nodiscard]] inline Judgement judge(const Claim& claim, const std::vector<std::vector<double>>& differences_of_maps) {
  Judgement judgement;
  const bool lacks_map = std::any_of(differences_of_maps.begin(), differences_of_maps.end(), [](const auto& of_map) { return of_map.empty(); });
  if (differences_of_maps.empty() || lacks_map) return judgement;
  for (const std::vector<double>& differences : differences_of_maps) judgement.pairs += differences.size();
  judgement.difference = examples::bootstrapped_mean(differences_of_maps);
  if (const auto& interval = judgement.difference.interval) {
    const bool is_below = interval->high < 0.0;
    const bool is_above = interval->low > 0.0;
    if (is_below || is_above) judgement.verdict = is_below == claim.is_less ? Verdict::holds : Verdict::does_not_hold;
  }
  return judgement;
}

[[nodiscard]] inline const char* words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return "holds";
    case Verdict::does_not_hold: return "the opposite";
    case Verdict::undecided: return "undecided";
  }
  return "";
}

}  // namespace experiment
