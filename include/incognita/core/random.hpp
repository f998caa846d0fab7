/// Seeded random numbers that are the same with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace incognita {

/// A stream of random draws. The standard fixes the engine's sequence but not its distributions, so the distributions
/// are written out here. Not thread safe: give each thread its own stream.
class Random {
 public:
  /// The same seed gives the same draws.
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), with 53 random bits.
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1.0p-53; }

  /// Uniform in [low, high), of any unit.
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /// Standard normal, without a unit (Box and Muller); each call takes two uniform draws, so streams stay aligned.
  [[nodiscard]] double normal() {
    const double radius = std::sqrt(-2.0 * std::log1p(-uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

  /// Normal with the given mean and standard deviation, of any unit.
  [[nodiscard]] double normal(double mean, double sigma) { return mean + sigma * normal(); }

  /// Uniform in {0, ..., count - 1}; count > 0. The bias is below count / 2^53.
  [[nodiscard]] std::uint64_t index(std::uint64_t count) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(engine_);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace incognita
