/// Poses of different trajectories that belong to one instant.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "incognita/core/error.hpp"

namespace incognita {

/// Throws std::invalid_argument unless the times never fall.
inline void require_ascending(const char* where, std::span<const double> times_s) {
  const auto fall = std::is_sorted_until(times_s.begin(), times_s.end());
  if (fall == times_s.end()) return;
  const auto place = std::to_string(fall - times_s.begin());
  throw_invalid(where, "times_s[" + place + ']', *fall, "in ascending order, >= " + std::to_string(*(fall - 1)) + " before it");
}

/// The index of the stamp nearest to `time_s` among ascending ones (the first of equals), if it is not
/// farther than tolerance_s. O(log n).
[[nodiscard]] inline std::optional<std::size_t> find_stamp(std::span<const double> times_s, double time_s,
                                                           double tolerance_s) {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  auto nearest = after;
  if (after == times_s.end() || (after != times_s.begin() && time_s - *(after - 1) <= *after - time_s)) {
    if (after == times_s.begin()) return std::nullopt;
    nearest = std::lower_bound(times_s.begin(), after, *(after - 1));
  }
  if (!(std::abs(*nearest - time_s) <= tolerance_s)) return std::nullopt;
  return static_cast<std::size_t>(nearest - times_s.begin());
}

}  // namespace incognita
