/// Seeded random numbers that may be drawn in any order, and so by any thread.
#pragma once

#include <cmath>
#include <cstdint>

#include "incognita/core/fast_log.hpp"
#include "incognita/core/split_mix.hpp"

namespace incognita {

/// Two draws that are independent of each other, without a unit.
struct NormalPair {
  double first;   ///< standard normal, without a unit
  double second;  ///< likewise, without a unit
};

/// Random draws by their number: the same seed and number give the same draw, whoever asks for it and when. The words are those of
/// SplitMix64 (Steele et al. 2014), which reaches any of them at once. Safe to use from many threads.
class CounterRandom {
 public:
  /// The same seed gives the same draws; neighbouring seeds give unrelated ones.
  explicit CounterRandom(std::uint64_t seed) : key_(split_mixed(seed + split_mix_increment)) {}

  /// 64 random bits, the `number`th of the stream.
  [[nodiscard]] std::uint64_t word(std::uint64_t number) const { return split_mixed(key_ + (number + 1) * split_mix_increment); }

  /// The `number`th pair of normal draws, of the words 2 number and 2 number + 1 (Box and Muller). Without a branch or a call; their
  /// distribution is that of exact arithmetic to 1e-9.
  [[nodiscard]] NormalPair normal_pair(std::uint64_t number) const {
    const double uniform = static_cast<double>((word(2 * number) >> 11U) + 1U) * 0x1.0p-53;  // in (0, 1]
    const double radius = std::sqrt(-2.0 * fast_log(uniform));
    // A direction: one within an eighth of a turn of the x axis, by series, and then which of the four axes that is.
    const std::uint64_t bits = word(2 * number + 1);
    constexpr double quarter_turn_rad = 1.5707963267948966;
    const double angle_rad = quarter_turn_rad * (static_cast<double>(bits >> 11U) * 0x1.0p-53 - 0.5);
    const double square = angle_rad * angle_rad;
    const double sine = angle_rad * (1.0 - square / 6 * (1.0 - square / 20 * (1.0 - square / 42 * (1.0 - square / 72))));
    const double cosine = 1.0 - square / 2 * (1.0 - square / 12 * (1.0 - square / 30 * (1.0 - square / 56 * (1.0 - square / 90))));
    const bool is_upright = (bits & 1U) != 0;
    const double along = (bits & 2U) != 0 ? -cosine : cosine;
    return {radius * (is_upright ? sine : along), radius * (is_upright ? along : sine)};
  }

 private:
  std::uint64_t key_;
};

}  // namespace incognita
