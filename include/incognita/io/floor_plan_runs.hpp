/// Floor plans as bytes: runs of equal cells, a byte each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "incognita/grid/floor_plan.hpp"
#include "incognita/io/bytes.hpp"

namespace incognita {

/// The longest run: a byte holds a kind of cell in its highest two bits, and how many follow the first in the others. So no bytes ask for
/// more than 64 times their number.
inline constexpr std::size_t floor_run_max = 64;

/// Cells of floor plans, as of beliefs, have indices from minus this to this.
inline constexpr int recorded_cell_max = 1 << 28;

/// The plan's lattice and box, then its runs in the order of storage: docs/recording.md. O(cells).
inline void put_floor_plan(ByteWriter& bytes, const FloorPlan& plan) {
  bytes.number(plan.resolution_m());
  for (int axis = 0; axis < 2; ++axis) bytes.number(plan.lattice().origin_m()[axis]);
  for (int axis = 0; axis < 2; ++axis) bytes.signed_varint(plan.box().lower[axis]);
  for (int axis = 0; axis < 2; ++axis) bytes.varint(static_cast<std::uint64_t>(plan.box().upper[axis] - plan.box().lower[axis]));
  const auto& cells = plan.values();
  for (std::size_t first = 0; first < cells.size();) {
    std::size_t last = first + 1;
    while (last < cells.size() && last - first < floor_run_max && cells[last] == cells[first]) ++last;
    bytes.number(static_cast<std::uint8_t>(static_cast<std::size_t>(cells[first]) << 6U | (last - first - 1)));
    first = last;
  }
}

/// Takes what put_floor_plan wrote. Throws InputError when it is no such plan. Allocates a byte a cell, at most floor_run_max times the bytes that
/// are left.
[[nodiscard]] inline FloorPlan take_floor_plan(ByteReader& bytes) {
  const auto resolution_m = bytes.finite<double>("a resolution");
  if (!(resolution_m > 0.0)) bytes.fail("a resolution of " + std::to_string(resolution_m) + ", which must be > 0");
  Point<2> origin_m;
  for (int axis = 0; axis < 2; ++axis) origin_m[axis] = bytes.finite<double>("an origin");
  IndexBox<2> box;
  for (int axis = 0; axis < 2; ++axis) box.lower[axis] = bytes.small_varint(recorded_cell_max);
  std::uint64_t count = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const std::uint64_t extent = bytes.varint();
    if (extent > static_cast<std::uint64_t>(recorded_cell_max)) {
      bytes.fail("a floor plan of " + std::to_string(extent) + " cells along an axis, which must be at most " + std::to_string(recorded_cell_max));
    }
    box.upper[axis] = box.lower[axis] + static_cast<int>(extent);
    count *= extent;
  }
  if (count > std::min<std::uint64_t>(bytes.left() * floor_run_max, FloorPlan::cell_count_max)) {
    bytes.fail("a floor plan of " + std::to_string(count) + " cells, though only " + std::to_string(bytes.left()) + " bytes follow");
  }
  FloorPlan plan(Lattice<2>(resolution_m, origin_m), box, FloorCell::solid);
  auto& cells = plan.values();
  for (std::size_t first = 0; first < cells.size();) {
    const auto run = bytes.number<std::uint8_t>();
    const auto kind = static_cast<std::uint8_t>(run >> 6U);
    const std::size_t length = (run & (floor_run_max - 1)) + 1;
    if (kind > static_cast<std::uint8_t>(FloorCell::solid)) bytes.fail("a cell of no known kind in a floor plan");
    if (length > cells.size() - first) bytes.fail("a run of " + std::to_string(length) + " cells beyond the end of a floor plan");
    std::fill_n(cells.begin() + static_cast<Offset>(first), length, static_cast<FloorCell>(kind));
    first += length;
  }
  return plan;
}

}  // namespace incognita
