/// Counting cells of flags, for the tests of truth.
#pragma once

#include <cstddef>
#include <cstdint>

#include "incognita/grid/grid.hpp"

/// How many cells are 1.
inline std::size_t count_set(const incognita::Grid<std::uint8_t, 2>& cells) {
  std::size_t sum = 0;
  for (const std::uint8_t cell : cells.values()) sum += cell;
  return sum;
}
