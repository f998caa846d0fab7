/// The mixing of bits that seeded streams are made by.
#pragma once

#include <cstdint>

namespace incognita {

/// What SplitMix64 adds to its state from one word to the next (Steele et al. 2014).
inline constexpr std::uint64_t split_mix_increment = 0x9E3779B97F4A7C15ULL;

/// The word that SplitMix64 makes of a state (Steele et al. 2014): a bijection, of which a change of any bit changes half of the others. O(1).
[[nodiscard]] constexpr std::uint64_t split_mixed(std::uint64_t state) {
  state = (state ^ (state >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  state = (state ^ (state >> 27U)) * 0x94D049BB133111EBULL;
  return state ^ (state >> 31U);
}

}  // namespace incognita
