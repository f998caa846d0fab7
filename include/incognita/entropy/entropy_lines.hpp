/// An entropy by straight lines over log-odds, and its sum over many cells: what entropy_sum does with a table.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace incognita::detail {

/// H(l) / H(0) = offset + slope |l| on each of many short intervals of |l|: of one length up to 4, of twice that up to
/// 12, of four times that up to 28, and so on, so that an interval is known by the upper bits of the float |l| + 4.
/// Errors are relative to a cell's own entropy; as entropies are not negative, a sum is relatively no worse than the
/// worst cell in it, be all of them saturated. A value; safe to read from many threads at once.
class EntropyLines {
 public:
  /// The largest error of a cell, relative to its entropy, or to 1e-30 H(0) where that is more.
  static constexpr double relative_error_max = 8e-5;

  /// How many cells sum() takes at once: in floats, before a double takes them.
  static constexpr std::size_t chunk = 512;

  /// Takes the fewest lines that keep the error, 1,300 (11 kB) to 11,000 (85 kB) for log-odds up to 22. There are none
  /// when that does not do: for entropies with jumps, and those that bend within hundredths of log-odds. Calls
  /// relative_entropy(l), which is H(l) / H(0), twice for each line that it tries.
  template <class RelativeEntropy>
  void fit(const RelativeEntropy& relative_entropy, double log_odds_max) {
    if (!(log_odds_max <= 1000.0)) return;
    log_odds_max_ = static_cast<float>(log_odds_max);
    for (row_shift_ = 14; row_shift_ >= 11; --row_shift_) {
      if (try_fit(relative_entropy)) return;
    }
    lines_.clear();
  }

  [[nodiscard]] bool empty() const { return lines_.empty(); }

  /// The sum of H(l) / H(0) over at most `chunk` cells; not to be asked when empty(). NaN counts as log_odds_max. Cells
  /// i, i + lanes, i + 2 lanes, ... are added in floats, then these sums and the cells left over in doubles, in order.
  [[nodiscard]] double sum(const float* log_odds, std::size_t count) const {
    // In two passes, as compilers that see the rows in a register take them out one by one, which is slower.
    alignas(64) float magnitudes[chunk];
    alignas(64) std::uint32_t rows[chunk];
    const std::size_t in_vectors = count - count % lanes;
    for (std::size_t i = 0; i < in_vectors; i += lanes) locate(load(log_odds + i), magnitudes + i, rows + i);
    if (in_vectors < count) {
      float rest[lanes] = {};
      std::copy(log_odds + in_vectors, log_odds + count, rest);
      locate(load(rest), magnitudes + in_vectors, rows + in_vectors);
    }
    const Line* const lines = lines_.data();
    Floats sums{};
    for (std::size_t i = 0; i < in_vectors; i += lanes) {
      const LinesOfLanes found = look_up(lines, rows + i);
      sums += found.offset + found.slope * load(magnitudes + i);
    }
    double sum = 0.0;
    for (std::size_t lane = 0; lane < lanes; ++lane) sum += static_cast<double>(sums[lane]);
    for (std::size_t i = in_vectors; i < count; ++i) {
      const Line& line = lines[rows[i]];
      sum += static_cast<double>(line.offset + line.slope * magnitudes[i]);
    }
    return sum;
  }

 private:
  struct Line {
    float offset;
    float slope;
  };

  // Wider vectors gain nothing: what takes time are the loads of the lines.
#if defined(__AVX2__)
  static constexpr std::size_t lanes = 8;
#else
  static constexpr std::size_t lanes = 4;
#endif
  static_assert(chunk % lanes == 0);
  using Floats [[gnu::vector_size(lanes * sizeof(float))]] = float;
  using Ints [[gnu::vector_size(lanes * sizeof(float))]] = std::int32_t;
  using FourFloats [[gnu::vector_size(4 * sizeof(float))]] = float;
  using TwoDoubles [[gnu::vector_size(2 * sizeof(double))]] = double;

  struct LinesOfLanes {
    Floats offset;
    Floats slope;
  };

  static constexpr float base = 4.0F;

  [[nodiscard]] std::int32_t first_row() const { return std::bit_cast<std::int32_t>(base) >> row_shift_; }

  [[nodiscard]] double start_of(std::int32_t row) const {
    const auto start = std::bit_cast<float>((row + first_row()) << row_shift_);
    return static_cast<double>(start) - static_cast<double>(base);
  }

  template <class RelativeEntropy>
  [[nodiscard]] bool try_fit(const RelativeEntropy& relative_entropy) {
    const auto end = static_cast<double>(log_odds_max_);
    const std::int32_t last = (std::bit_cast<std::int32_t>(log_odds_max_ + base) >> row_shift_) - first_row();
    lines_.clear();
    double from = 0.0;
    double at_from = 1.0;
    for (std::int32_t row = 0; row <= last; ++row) {
      const double to = row == last ? end : start_of(row + 1);
      const double middle = 0.5 * (from + to);
      const double at_middle = relative_entropy(middle);
      const double at_to = relative_entropy(to);
      const double slope = to > from ? (at_to - at_from) / (to - from) : 0.0;
      // Halfway between the chord and the curve. But unknown cells are exact.
      double offset = at_from - slope * from;
      if (row > 0) offset += 0.5 * (at_middle - (offset + slope * middle));
      const auto is_near = [&](double log_odds, double exact) {
        return std::abs(offset + slope * log_odds - exact) <= relative_error_max * std::max(exact, 1e-30);
      };
      if (!is_near(from, at_from) || !is_near(middle, at_middle) || !is_near(to, at_to)) return false;
      lines_.push_back({static_cast<float>(offset), static_cast<float>(slope)});
      from = to;
      at_from = at_to;
    }
    return true;
  }

  void locate(const Floats& log_odds, float* magnitudes, std::uint32_t* rows) const {
    // As integers, where NaN is more than infinity.
    const Ints bits = std::bit_cast<Ints>(log_odds) & 0x7FFFFFFF;
    const Ints end_bits = Ints{} + std::bit_cast<std::int32_t>(log_odds_max_);
    const auto magnitude = std::bit_cast<Floats>(bits < end_bits ? bits : end_bits);
    const Ints row = (std::bit_cast<Ints>(magnitude + base) >> row_shift_) - first_row();
    __builtin_memcpy(magnitudes, &magnitude, sizeof(magnitude));
    __builtin_memcpy(rows, &row, sizeof(row));
  }

  [[nodiscard]] static LinesOfLanes look_up(const Line* lines, const std::uint32_t* rows) {
    const FourFloats a = two_lines(lines, rows[0], rows[1]);
    const FourFloats b = two_lines(lines, rows[2], rows[3]);
#if defined(__AVX2__)
    const FourFloats c = two_lines(lines, rows[4], rows[5]);
    const FourFloats d = two_lines(lines, rows[6], rows[7]);
    const Floats ac = __builtin_shufflevector(a, c, 0, 1, 2, 3, 4, 5, 6, 7);
    const Floats bd = __builtin_shufflevector(b, d, 0, 1, 2, 3, 4, 5, 6, 7);
    return {__builtin_shufflevector(ac, bd, 0, 2, 8, 10, 4, 6, 12, 14),
            __builtin_shufflevector(ac, bd, 1, 3, 9, 11, 5, 7, 13, 15)};
#else
    return {__builtin_shufflevector(a, b, 0, 2, 4, 6), __builtin_shufflevector(a, b, 1, 3, 5, 7)};
#endif
  }

  /// A line is loaded like one double, half of a register.
  [[nodiscard]] static FourFloats two_lines(const Line* lines, std::uint32_t one, std::uint32_t other) {
    double line;
    double other_line;
    __builtin_memcpy(&line, lines + one, sizeof(line));
    __builtin_memcpy(&other_line, lines + other, sizeof(other_line));
    return std::bit_cast<FourFloats>(TwoDoubles{line, other_line});
  }

  [[nodiscard]] static Floats load(const float* from) {
    Floats loaded;
    __builtin_memcpy(&loaded, from, sizeof(loaded));
    return loaded;
  }

  std::vector<Line> lines_;
  std::int32_t row_shift_ = 0;
  float log_odds_max_ = 0.0F;
};

}  // namespace incognita::detail
