/// What rows say: values of a method on a map, differences or ratios on the same starts and seeds, and claims judged by them.
#pragma once

#include <algorithm>
#include <array>
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

/// The rows of a study by unit, which must live as long; those of other studies' units are left out.
class Results {
 public:
  Results(const Study& study, const std::vector<Row>& rows) {
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

  /// What the sides of a claim have in the same trial, better and worse: their values, of ratios the logarithms; of two methods, how much they differ.
  using Pair = std::array<double, 2>;

  /// A pair for each trial of a group on one map that both sides have; where it has several starts and several seeds, for each start their mean,
  /// as seeds from one start are alike.
  [[nodiscard]] std::vector<Pair> pairs(std::size_t map, const Claim& claim, const TrialGroup& group) const {
    std::map<std::tuple<std::size_t, int, int>, double> known;
    for (const Done& done : units_) {
      if (done.unit.map != map || !has(group, done.unit)) continue;
      const auto value = done.row->metric(claim.metric);
      if (value) known[{done.unit.method, done.unit.start, done.unit.seed}] = claim.is_of_ratios ? std::log(*value) : *value;
    }
    std::vector<Pair> all;
    for (const int start : group.starts) {
      std::vector<Pair> of_start;
      for (const int seed : group.seeds) {
        const auto value_of = [&](const Side& side) -> std::optional<double> {
          const auto first = known.find({side.front(), start, seed});
          const auto last = known.find({side.back(), start, seed});
          if (first == known.end() || last == known.end()) return std::nullopt;
          return side.size() == 1 ? first->second : first->second - last->second;
        };
        const auto better = value_of(claim.better);
        const auto worse = value_of(claim.worse);
        if (better && worse && std::isfinite(*better) && std::isfinite(*worse)) of_start.push_back({*better, *worse});
      }
      if (!are_grouped(group) || of_start.empty()) {
        all.insert(all.end(), of_start.begin(), of_start.end());
        continue;
      }
      Pair mean{};
      for (const Pair& pair : of_start) {
        mean[0] += pair[0] / static_cast<double>(of_start.size());
        mean[1] += pair[1] / static_cast<double>(of_start.size());
      }
      all.push_back(mean);
    }
    return all;
  }

  /// How many pairs a group has when all its trials are there.
  [[nodiscard]] static std::size_t pairs_max(const TrialGroup& group) {
    return are_grouped(group) ? group.starts.size() : group.starts.size() * group.seeds.size();
  }

 private:
  static bool are_grouped(const TrialGroup& group) { return group.starts.size() > 1 && group.seeds.size() > 1; }

  static bool has(const TrialGroup& group, const Unit& unit) {
    const auto contains = [](const std::vector<int>& all, int value) { return std::find(all.begin(), all.end(), value) != all.end(); };
    return contains(group.starts, unit.start) && contains(group.seeds, unit.seed);
  }

  std::vector<Done> units_;
};

enum class Verdict { holds, opposite, undecided };

struct Judgement {
  Verdict verdict = Verdict::undecided;
  std::size_t pairs = 0;
  examples::MeanInterval difference;  ///< better - worse; of ratios its logarithm; of two methods each, |mean difference| - |mean difference|
};

/// By the pairs of each map that is judged. A claim holds where the whole interval of the difference is on its side of 0, its opposite does where it is
/// on the other side, and it is undecided where 0 is within, or where there are too few pairs for an interval.
[[nodiscard]] inline Judgement judge(const Claim& claim, const std::vector<std::vector<Results::Pair>>& pairs_of_maps) {
  Judgement judgement;
  for (const auto& pairs : pairs_of_maps) judgement.pairs += pairs.size();
  const bool lacks_map = std::any_of(pairs_of_maps.begin(), pairs_of_maps.end(), [](const auto& pairs) { return pairs.empty(); });
  if (pairs_of_maps.empty() || lacks_map) return judgement;
  const bool is_of_differences = claim.better.size() > 1;
  judgement.difference = examples::bootstrapped(pairs_of_maps, [is_of_differences](const Results::Pair& means) {
    return is_of_differences ? std::abs(means[0]) - std::abs(means[1]) : means[0] - means[1];
  });
  if (const auto& interval = judgement.difference.interval) {
    const bool is_below = interval->high < 0.0;
    const bool is_above = interval->low > 0.0;
    if (is_below || is_above) judgement.verdict = is_below == claim.is_less ? Verdict::holds : Verdict::opposite;
  }
  return judgement;
}

[[nodiscard]] inline const char* words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return "holds";
    case Verdict::opposite: return "the opposite";
    case Verdict::undecided: return "undecided";
  }
  return "";
}

}  // namespace experiment
