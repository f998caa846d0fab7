/// The entropy of many cells, and how much of it a change of their log-odds takes away.
#pragma once

#include <cstddef>
#include <span>

#include "incognita/core/error.hpp"
#include "incognita/entropy/log_odds_table.hpp"

namespace incognita {

/// The sum of the entropies, in nats, of a range of log-odds (float); cells are independent. `entropy` is an
/// EntropyTable or any EntropyMeasure. Added in the range's order, so the same range gives the same bits.
template <class LogOddsRange, class Entropy>
[[nodiscard]] double entropy_sum(const LogOddsRange& log_odds, const Entropy& entropy) {
  double sum_nats = 0.0;
  for (const float l : log_odds) sum_nats += entropy_of_log_odds(entropy, l);
  return sum_nats;
}

/// The information gain, in nats, of cells whose log-odds change from before[i] to after[i]: the sum of
/// H(before[i]) - H(after[i]) (Seo et al., (16); (18) with a behavioral entropy). Negative when the cells
/// become less certain. Added in order. Throws std::invalid_argument when the lengths differ.
template <class Entropy>
[[nodiscard]] double entropy_change(std::span<const float> before_log_odds,
                                    std::span<const float> after_log_odds, const Entropy& entropy) {
  require(before_log_odds.size() == after_log_odds.size(), "entropy_change", "the number of cells after",
          static_cast<double>(after_log_odds.size()), "the number before");
  double gain_nats = 0.0;
  for (std::size_t i = 0; i < before_log_odds.size(); ++i) {
    gain_nats +=
        entropy_of_log_odds(entropy, before_log_odds[i]) - entropy_of_log_odds(entropy, after_log_odds[i]);
  }
  return gain_nats;
}

}  // namespace incognita
