#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "incognita/core/counter_random.hpp"

using namespace incognita;

TEST_CASE("The words are those of SplitMix64, in any order", "[core]") {
  // Its first words from the state 0, as published with the generator.
  const auto mixed = [](std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31U);
  };
  REQUIRE(mixed(0x9E3779B97F4A7C15ULL) == 0xE220A8397B1DCDAFULL);
  for (const std::uint64_t seed : {0ULL, 1ULL, 123456789ULL}) {
    const CounterRandom random(seed);
    std::uint64_t state = mixed(seed + 0x9E3779B97F4A7C15ULL);
    std::vector<std::uint64_t> words;
    for (int i = 0; i < 50; ++i) words.push_back(mixed(state += 0x9E3779B97F4A7C15ULL));
    for (std::size_t i = words.size(); i-- > 0;) CHECK(random.word(i) == words[i]);
  }
  CHECK(CounterRandom(1).word(0) != CounterRandom(2).word(0));
}

TEST_CASE("Pairs of normal draws are those of Box and Muller's formula", "[core]") {
  const CounterRandom random(7);
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const NormalPair pair = random.normal_pair(n);
    const double uniform = static_cast<double>((random.word(2 * n) >> 11U) + 1U) * 0x1.0p-53;
    const std::uint64_t bits = random.word(2 * n + 1);
    const double angle_rad = std::numbers::pi / 2.0 * (static_cast<double>(bits >> 11U) * 0x1.0p-53 - 0.5);
    const std::array<double, 2> mirrored{std::sin(angle_rad), (bits & 2U) != 0 ? -std::cos(angle_rad) : std::cos(angle_rad)};
    const double radius = std::sqrt(-2.0 * std::log(uniform));
    CHECK(pair.first == Approx(radius * mirrored[(bits & 1U) != 0 ? 0 : 1]).margin(1e-8));
    CHECK(pair.second == Approx(radius * mirrored[(bits & 1U) != 0 ? 1 : 0]).margin(1e-8));
  }
}

TEST_CASE("Normal draws by number have the normal distribution, and pairs no correlation", "[core]") {
  const CounterRandom random(3);
  constexpr std::size_t count = 200000;
  std::vector<double> draws;
  double product = 0.0;
  double neighbours = 0.0;
  NormalPair before{};
  for (std::uint64_t n = 0; n < count / 2; ++n) {
    const NormalPair pair = random.normal_pair(n);
    draws.push_back(pair.first);
    draws.push_back(pair.second);
    product += pair.first * pair.second;
    neighbours += pair.first * before.first;
    before = pair;
  }
  const double bound = 4.5 / std::sqrt(static_cast<double>(count / 2));  // standard deviations of a mean
  CHECK(std::abs(product / (count / 2)) < bound);
  CHECK(std::abs(neighbours / (count / 2)) < bound);
  std::sort(draws.begin(), draws.end());
  double furthest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double below = 0.5 * std::erfc(-draws[i] / std::numbers::sqrt2);
    furthest = std::max(furthest, std::abs(below - (static_cast<double>(i) + 0.5) / count));
  }
  CHECK(furthest < 1.95 / std::sqrt(static_cast<double>(count)));  // Kolmogorov's bound for one seed in 1000
  CHECK(draws.front() < -4.0);
  CHECK(draws.back() > 4.0);
}
