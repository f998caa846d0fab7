/// Rounding down where no option promises SSE 4.1: std::floor is a call there.
#pragma once

namespace incognita {

/// The largest integer that is not larger than a number without a unit. The value must lie within the range of int.
[[nodiscard]] inline int floor_to_int(double value) {
  const int truncated = static_cast<int>(value);
  return truncated - static_cast<int>(value < static_cast<double>(truncated));
}

}  // namespace incognita
