/// Entropy as a function of log-odds: exact for any measure, and from a table for the inner loops.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/entropy/concept.hpp"
#include "incognita/entropy/entropy_lines.hpp"

namespace incognita {

/// The entropy in nats of a cell with natural log-odds l = ln(p / (1 - p)). Exact to rounding for large |l|
/// too, where p = 1 / (1 + e^-l) would round to 1; symmetric to the bit. Infinite log-odds give 0, NaN gives
/// NaN.
template <EntropyMeasure Measure>
[[nodiscard]] double entropy_of_log_odds(const Measure& measure, double log_odds) {
  return measure(1.0 / (1.0 + std::exp(std::abs(log_odds))));
}

/// Parameters of an EntropyTable.
struct EntropyTableParams {
  /// The table covers [-log_odds_max, log_odds_max]; beyond, cells have the entropy of the end.
  double log_odds_max = 22.0;
  /// Equal steps on [0, log_odds_max]. The default takes 32 kB.
  std::size_t intervals = 4096;
};

/// Any entropy as a function of log-odds by linear interpolation. Symmetric to the bit, and exact at log-odds
/// 0, so an unknown cell has the measure's own value at p = 1/2. For sums over many cells it keeps a second table, in
/// floats. A plain value; const calls are safe from several threads.
class EntropyTable {
 public:
  using Params = EntropyTableParams;  ///< so that a table's parameters go by one name

  /// Calls the measure 2 * intervals + 1 times, and for the sums up to 45,000 times more (0.1 to 3 ms). Throws
  /// std::invalid_argument when log_odds_max is not finite and positive, intervals is not in 1..1000000, or the
  /// measure is not finite and non-negative.
  template <EntropyMeasure Measure>
  explicit EntropyTable(const Measure& measure, const Params& params = {})
      : log_odds_max_(params.log_odds_max),
        steps_per_log_odds_(static_cast<double>(params.intervals) / params.log_odds_max) {
    require_positive("EntropyTable", "log_odds_max", params.log_odds_max);
    require(params.intervals >= 1 && params.intervals <= 1'000'000, "EntropyTable", "intervals",
            static_cast<double>(params.intervals), "in 1..1000000");
    const auto at_step = [&](double step) {
      const double entropy_nats = entropy_of_log_odds(measure, step / steps_per_log_odds_);
      require_non_negative("EntropyTable", "the measure's value", entropy_nats);
      return entropy_nats;
    };
    // The last value is there twice, so that the end needs no branch.
    values_nats_.resize(params.intervals + 2);
    values_nats_[0] = at_step(0.0);
    for (std::size_t i = 0; i < params.intervals; ++i) {
      values_nats_[i + 1] = at_step(static_cast<double>(i + 1));
      const double middle_nats = 0.5 * (values_nats_[i] + values_nats_[i + 1]);
      const double error_nats = std::abs(at_step(static_cast<double>(i) + 0.5) - middle_nats);
      max_error_nats_ = std::max(max_error_nats_, 2.0 * error_nats);
    }
    values_nats_.back() = values_nats_[params.intervals];
    const double scale = 1.0 / unknown_nats();
    lines_.fit([&](double log_odds) { return entropy_of_log_odds(measure, log_odds) * scale; }, params.log_odds_max);
  }

  /// The entropy in nats. NaN counts as the end of the table.
  [[nodiscard]] double operator()(float log_odds) const {
    // In this order std::min takes its first argument when the second is NaN.
    const double step =
        std::min(log_odds_max_, std::abs(static_cast<double>(log_odds))) * steps_per_log_odds_;
    const auto below = static_cast<std::ptrdiff_t>(step);
    const double* const values = values_nats_.data() + below;
    return values[0] + (step - static_cast<double>(below)) * (values[1] - values[0]);
  }

  /// Cells store floats. A double would be narrowed, and a table would pass for a measure of probabilities.
  double operator()(double) const = delete;

  /// A bound on the error for |log-odds| <= log_odds_max: twice the largest error found in the middle of an
  /// interval. Where the entropy has no inflection within an interval, the error is concave or convex and
  /// zero at both ends, so nowhere more than twice its middle; where it has one, the error is far smaller,
  /// because the curvature is. So it holds for any entropy that is smooth on the scale of an interval: here,
  /// tested for alpha from 0.05 to 50. Beyond log_odds_max the error is at most end_nats(), if the entropy
  /// only falls from there on.
  [[nodiscard]] double max_error_nats() const { return max_error_nats_; }

  /// Whether entropy_sum takes the fast way, within 1e-4 of the sum. All of Shannon, Renyi and Tsallis do, tested for
  /// parameters from 0.05 to 50, and Behavioral up to 10. Otherwise it adds what operator() gives.
  [[nodiscard]] bool has_fast_sum() const { return !lines_.empty(); }

  /// What entropy_sum adds up, relative to unknown_nats().
  [[nodiscard]] const detail::EntropyLines& lines() const { return lines_; }

  /// The entropy at log-odds 0.
  [[nodiscard]] double unknown_nats() const { return values_nats_.front(); }

  /// The entropy at the table's ends and beyond.
  [[nodiscard]] double end_nats() const { return values_nats_.back(); }

  [[nodiscard]] double log_odds_max() const { return log_odds_max_; }  ///< the end of the table

  /// For archives of states, see docs/mission_file.md: what tells one entropy from another.
  template <class Fields>
  void list_fields(Fields& fields) const {
    const auto at = [&](float log_odds) { return static_cast<float>((*this)(log_odds)); };
    fields("log_odds_max, nats_at_0, nats_at_1, nats_at_2, nats_at_4, nats_at_8", log_odds_max_, at(0.0F), at(1.0F), at(2.0F), at(4.0F),
           at(8.0F));
  }

 private:
  std::vector<double> values_nats_;
  double log_odds_max_;
  double steps_per_log_odds_;
  double max_error_nats_ = 0.0;
  detail::EntropyLines lines_;
};

/// The table's entropy, so that generic code may take a measure or a table.
[[nodiscard]] inline double entropy_of_log_odds(const EntropyTable& table, float log_odds) {
  return table(log_odds);
}

}  // namespace incognita
