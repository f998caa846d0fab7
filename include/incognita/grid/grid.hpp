/// A dense grid of values that grows in any direction.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

namespace detail {

inline constexpr std::int64_t cell_count_max = std::numeric_limits<int>::max();

/// The cells of a box, or cell_count_max + 1 when there are more.
template <class Cells>
[[nodiscard]] std::int64_t cell_count(const Cells& box) {
  if (box.empty()) return 0;
  std::int64_t count = 1;
  for (int axis = 0; axis < box.lower.size(); ++axis) {
    const std::int64_t extent = std::int64_t{box.upper[axis]} - std::int64_t{box.lower[axis]};
    if (extent > cell_count_max / count) return cell_count_max + 1;
    count *= extent;
  }
  return count;
}

template <class Cells>
[[nodiscard]] std::int64_t checked_cell_count(const Cells& box) {
  const std::int64_t count = cell_count(box);
  if (count > cell_count_max) {
    throw std::length_error("Grid: the box is " + box_text(box) + ", but must have at most " + std::to_string(cell_count_max) + " cells");
  }
  return count;
}

/// `grown`, which holds `box`, with each side that moves moved by at least one of `parts` of the box's extent, as far as indices go.
template <class Cells>
[[nodiscard]] Cells with_margins(const Cells& box, Cells grown, int parts) {
  using Limits = std::numeric_limits<int>;
  for (int axis = 0; axis < box.lower.size() && !box.empty(); ++axis) {
    const std::int64_t lower = box.lower[axis];
    const std::int64_t upper = box.upper[axis];
    const std::int64_t margin = (upper - lower) / parts;
    if (grown.lower[axis] < lower) {
      const std::int64_t moved = std::max<std::int64_t>(lower - margin, Limits::min());
      grown.lower[axis] = std::min(grown.lower[axis], static_cast<int>(moved));
    }
    if (grown.upper[axis] > upper) {
      const std::int64_t moved = std::min<std::int64_t>(upper + margin, Limits::max());
      grown.upper[axis] = std::max(grown.upper[axis], static_cast<int>(moved));
    }
  }
  return grown;
}

}  // namespace detail

/// The place of a cell in a grid's storage. Valid until the grid grows.
using Offset = std::ptrdiff_t;

template <class Value, int Dim>
class Grid;

/// For archives of states, see docs/mission_file.md: a grid whose values can be found again. When loading, each is the fill value. Throws
/// what the archive throws.
template <class Archive, class Value, int Dim>
void archive_box(Archive& archive, Grid<Value, Dim>& grid) {
  constexpr int reach = 1 << 30;  // so far from index 0 nobody's arithmetic overflows
  IndexBox<Dim> box = grid.box();
  archive(box);
  if constexpr (Archive::is_loading) {
    for (int axis = 0; axis < Dim; ++axis) {
      const bool is_within = box.lower[axis] >= -reach && box.upper[axis] <= reach && box.lower[axis] <= box.upper[axis];
      archive.require(is_within, "a grid reaches too far");
    }
    archive.claim(static_cast<std::uint64_t>(detail::cell_count(box)), sizeof(Value));
    grid.clear_to(box);
  }
}

/// Values on a box of lattice cells, x fastest. A cell keeps its index for ever: growing moves the storage, not the
/// world. Offsets are for hot loops; they change when the grid grows. Safe to read from many threads at once.
template <class Value, int Dim>
class Grid {
  static_assert(!std::is_same_v<Value, bool>, "use std::uint8_t: cells are addressed one by one");

 public:
  static constexpr int dimension = Dim;  ///< of the lattice
  /// No grid holds more cells than this: a wild coordinate must not ask for all of the memory.
  static constexpr std::int64_t cell_count_max = detail::cell_count_max;

  /// Cells of `box`, each `fill`. Throws std::length_error above cell_count_max.
  explicit Grid(const Lattice<Dim>& lattice, const IndexBox<Dim>& box = {}, Value fill = Value{})
      : lattice_(lattice), fill_(fill) {
    clear_to(box);
  }

  [[nodiscard]] const Lattice<Dim>& lattice() const { return lattice_; }  ///< where the cells are
  [[nodiscard]] double resolution_m() const { return lattice_.resolution_m(); }  ///< the side of a cell
  [[nodiscard]] const IndexBox<Dim>& box() const { return box_; }  ///< the cells that are stored
  [[nodiscard]] std::size_t size() const { return values_.size(); }  ///< how many
  /// How far apart in storage two neighbours along `axis` are.
  [[nodiscard]] Offset stride(int axis) const { return stride_[static_cast<std::size_t>(axis)]; }

  /// Whether a cell is stored.
  [[nodiscard]] bool contains(const Index<Dim>& index) const { return box_.contains(index); }

  /// The storage place of a cell of the box; the index is not checked.
  [[nodiscard]] Offset offset_of(const Index<Dim>& index) const {
    Offset offset = index[0] - box_.lower[0];
    for (int axis = 1; axis < Dim; ++axis) offset += (index[axis] - box_.lower[axis]) * stride(axis);
    return offset;
  }

  /// The cell of a storage place; the offset is not checked.
  [[nodiscard]] Index<Dim> index_at(Offset offset) const {
    Index<Dim> index;
    for (int axis = Dim - 1; axis > 0; --axis) {
      index[axis] = static_cast<int>(offset / stride(axis)) + box_.lower[axis];
      offset %= stride(axis);
    }
    index[0] = static_cast<int>(offset) + box_.lower[0];
    return index;
  }

  [[nodiscard]] Value& operator[](Offset offset) { return values_[static_cast<std::size_t>(offset)]; }  ///< not checked
  [[nodiscard]] const Value& operator[](Offset offset) const { return values_[static_cast<std::size_t>(offset)]; }  ///< not checked

  /// The value of a cell, the fill value outside of the box.
  [[nodiscard]] const Value& value(const Index<Dim>& index) const {
    return contains(index) ? (*this)[offset_of(index)] : fill_;
  }

  /// Sets a cell of the box; throws std::out_of_range outside of it.
  void set(const Index<Dim>& index, const Value& value) {
    if (!contains(index)) {
      throw std::out_of_range("Grid::set: the index is " + tuple_text(index) + ", but must lie in the grid's box, " + box_text(box_));
    }
    (*this)[offset_of(index)] = value;
  }

  [[nodiscard]] const std::vector<Value>& values() const { return values_; }  ///< in storage order, x fastest
  [[nodiscard]] std::vector<Value>& values() { return values_; }  ///< to be changed, not resized

  /// Makes the grid one of `box`, each cell the fill value, in the storage that it has if that is enough. Throws
  /// std::length_error above cell_count_max.
  void clear_to(const IndexBox<Dim>& box) {
    const auto count = static_cast<std::size_t>(detail::checked_cell_count(box));
    values_.reserve(count);  // may throw, the grid is then as it was
    resize(box);
    values_.assign(count, fill_);
  }

  /// Makes room for `needed`; new cells hold the fill value. A side that must move moves by at least one of `parts`
  /// of the grid's extent, so a robot that leaves it step by step costs amortised O(parts) per new cell. Returns whether the
  /// storage moved. Throws std::length_error above cell_count_max and std::bad_alloc; the grid is then unchanged.
  bool grow_to_include(const IndexBox<Dim>& needed, int parts = 2) {
    if (box_.contains(needed)) return false;
    IndexBox<Dim> grown = enclosing_box(box_, needed);
    if (const IndexBox<Dim> roomy = detail::with_margins(box_, grown, parts); detail::cell_count(roomy) <= cell_count_max) grown = roomy;
    move_to(grown);
    return true;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive_box(archive, *this);
    archive.each(values_);
  }

 private:
  /// The same cells in a box that holds the present one.
  void move_to(const IndexBox<Dim>& box) {
    Grid larger(lattice_, box, fill_);
    if (!box_.empty()) copy_rows_to(larger);
    *this = std::move(larger);
  }

  void resize(const IndexBox<Dim>& box) {
    static_cast<void>(detail::checked_cell_count(box));
    box_ = box.empty() ? IndexBox<Dim>{} : box;
    Offset stride = 1;
    for (int axis = 0; axis < Dim; ++axis) {
      stride_[static_cast<std::size_t>(axis)] = stride;
      stride *= box_.upper[axis] - box_.lower[axis];
    }
  }

  void copy_rows_to(Grid& larger) const {
    const Offset row_length = box_.upper[0] - box_.lower[0];
    for (Offset row = 0; row < static_cast<Offset>(values_.size()); row += row_length) {
      std::copy_n(values_.begin() + row, row_length,
                  larger.values_.begin() + larger.offset_of(index_at(row)));
    }
  }

  Lattice<Dim> lattice_;
  IndexBox<Dim> box_;
  std::array<Offset, static_cast<std::size_t>(Dim)> stride_{};
  Value fill_;
  std::vector<Value> values_;
};

}  // namespace incognita
