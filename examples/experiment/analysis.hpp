/// What rows say: values of a method on a map, differences on the same starts and seeds, and claims judged by them.
#pragma once

#include <algorithm>
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

  /// value of `a` - value of `b` for each start and seed that both have, on a map or, for none, on all.
  [[nodiscard]] std::vector<double> differences(std::optional<std::size_t> map, std::size_t a, std::size_t b,
                                                const std::string& metric) const {
    std::map<std::tuple<std::size_t, int, int>, double> of_b;
    std::vector<double> differences;
    for (std::size_t m = 0; m < study_.maps.size(); ++m) {
      if (map && *map != m) continue;
      for (const Done& done : of(m, b)) {
        if (const auto value = done.row->metric(metric)) of_b[{m, done.unit.start, done.unit.seed}] = *value;
      }
      for (const Done& done : of(m, a)) {
        const auto value = done.row->metric(metric);
        const auto other = of_b.find({m, done.unit.start, done.unit.seed});
        if (value && other != of_b.end()) differences.push_back(*value - other->second);
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
  examples::MeanInterval difference;  ///< better - worse
};

/// A claim holds where the whole interval of the mean paired difference is on its side of 0, does not where it is on the other side, and
/// is undecided where 0 is within, or there are fewer than three pairs.
[[nodiscard]] inline Judgement judge(const Claim& claim, const Study& study, const Results& results, std::optional<std::size_t> map) {
  const auto method_of = [&](const std::string& name) {
    std::size_t n = 0;
    while (study.methods[n].name != name) ++n;
    return n;
  };
  const std::vector<double> differences = results.differences(map, method_of(claim.better), method_of(claim.worse), claim.metric);
  Judgement judgement;
  judgement.pairs = differences.size();
  if (differences.size() < 3) return judgement;
  judgement.difference = examples::bootstrapped_mean(differences);
  const bool is_below = judgement.difference.high < 0.0;
  const bool is_above = judgement.difference.low > 0.0;
  if (is_below || is_above) judgement.verdict = is_below == claim.is_less ? Verdict::holds : Verdict::does_not_hold;
  return judgement;
}

[[nodiscard]] inline const char* words_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds: return "holds";
    case Verdict::does_not_hold: return "does not hold: the opposite does";
    case Verdict::undecided: return "undecided";
  }
  return "";
}

}  // namespace experiment
