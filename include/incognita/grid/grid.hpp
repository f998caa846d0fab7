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

#include "incognita/grid/lattice.hpp"

namespace incognita {

/// The place of a cell in a grid's storage. Valid until the grid grows.
using Offset = std::ptrdiff_t;

/// Values on a box of lattice cells, x fastest. A cell keeps its index for ever: growing moves the storage, not the
/// world. Offsets are for hot loops; they change when the grid grows. Safe to read from many threads at once.
template <class Value, int Dim>
class Grid {
  static_assert(!std::is_same_v<Value, bool>, "use std::uint8_t: cells are addressed one by one");

 public:
  static constexpr int dimension = Dim;
  /// No grid holds more cells than this: a wild coordinate must not ask for all of the memory.
  static constexpr std::int64_t cell_count_max = std::numeric_limits<int>::max();

  /// Cells of `box`, each `fill`. Throws std::length_error above cell_count_max.
  explicit Grid(const Lattice<Dim>& lattice, const IndexBox<Dim>& box = {}, Value fill = Value{})
      : lattice_(lattice), fill_(fill) {
    clear_to(box);
  }

  [[nodiscard]] const Lattice<Dim>& lattice() const { return lattice_; }
  [[nodiscard]] double resolution_m() const { return lattice_.resolution_m(); }
  [[nodiscard]] const IndexBox<Dim>& box() const { return box_; }
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  /// How far apart in storage two neighbours along `axis` are.
  [[nodiscard]] Offset stride(int axis) const { return stride_[static_cast<std::size_t>(axis)]; }

  [[nodiscard]] bool contains(const Index<Dim>& index) const { return box_.contains(index); }

  /// The storage place of a cell of the box; the index is not checked.
  [[nodiscard]] Offset offset_of(const Index<Dim>& index) const {
    Offset offset = index[0] - box_.lower[0];
    for (int axis = 1; axis < Dim; ++axis) offset += (index[axis] - box_.lower[axis]) * stride(axis);
    return offset;
  }

  [[nodiscard]] Index<Dim> index_at(Offset offset) const {
    Index<Dim> index;
    for (int axis = Dim - 1; axis > 0; --axis) {
      index[axis] = static_cast<int>(offset / stride(axis)) + box_.lower[axis];
      offset %= stride(axis);
    }
    index[0] = static_cast<int>(offset) + box_.lower[0];
    return index;
  }

  [[nodiscard]] Value& operator[](Offset offset) { return values_[static_cast<std::size_t>(offset)]; }
  [[nodiscard]] const Value& operator[](Offset offset) const { return values_[static_cast<std::size_t>(offset)]; }

  /// The value of a cell, the fill value outside of the box.
  [[nodiscard]] const Value& value(const Index<Dim>& index) const {
    return contains(index) ? (*this)[offset_of(index)] : fill_;
  }

  /// Sets a cell of the box; throws std::out_of_range outside of it.
  void set(const Index<Dim>& index, const Value& value) {
    if (!contains(index)) throw std::out_of_range("Grid::set: the index lies outside of the grid's box");
    (*this)[offset_of(index)] = value;
  }

  [[nodiscard]] const std::vector<Value>& values() const { return values_; }
  [[nodiscard]] std::vector<Value>& values() { return values_; }

  /// Makes the grid one of `box`, each cell the fill value, in the storage that it has if that is enough. Throws
  /// std::length_error above cell_count_max.
  void clear_to(const IndexBox<Dim>& box) {
    const auto count = static_cast<std::size_t>(checked_count(box));
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
    if (const IndexBox<Dim> roomy = with_margins(grown, parts); cell_count(roomy) <= cell_count_max) grown = roomy;
    move_to(grown);
    return true;
  }

  /// For archives of states, see docs/mission_file.md.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive_box(archive);
    archive.each(values_);
  }

  /// The same of a grid whose values can be found again: when loading, each is the fill value.
  template <class Archive>
  void archive_box(Archive& archive) {
    IndexBox<Dim> box = box_;
    archive(box);
    if constexpr (Archive::is_loading) {
      archive.require(is_within(box, archive_reach), "a grid reaches too far");
      archive.claim(static_cast<std::uint64_t>(cell_count(box)), sizeof(Value));
      clear_to(box);
    }
  }

 private:
  /// So far from index 0 nobody's arithmetic overflows.
  static constexpr int archive_reach = 1 << 30;

  [[nodiscard]] static bool is_within(const IndexBox<Dim>& box, int reach) {
    for (int axis = 0; axis < Dim; ++axis) {
      if (box.lower[axis] < -reach || box.upper[axis] > reach || box.lower[axis] > box.upper[axis]) return false;
    }
    return true;
  }

  /// The cells of a box, or cell_count_max + 1 when there are more.
  [[nodiscard]] static std::int64_t cell_count(const IndexBox<Dim>& box) {
    if (box.empty()) return 0;
    std::int64_t count = 1;
    for (int axis = 0; axis < Dim; ++axis) {
      const std::int64_t extent = std::int64_t{box.upper[axis]} - std::int64_t{box.lower[axis]};
      if (extent > cell_count_max / count) return cell_count_max + 1;
      count *= extent;
    }
    return count;
  }

  [[nodiscard]] static std::int64_t checked_count(const IndexBox<Dim>& box) {
    const std::int64_t count = cell_count(box);
    if (count > cell_count_max) {
      throw std::length_error("Grid: a box of more than " + std::to_string(cell_count_max) + " cells");
    }
    return count;
  }

  /// `grown`, which holds the grid's box, with each side that moves moved by at least one of `parts` of the grid's
  /// extent, as far as indices go.
  [[nodiscard]] IndexBox<Dim> with_margins(IndexBox<Dim> grown, int parts) const {
    using Limits = std::numeric_limits<int>;
    for (int axis = 0; axis < Dim && !box_.empty(); ++axis) {
      const std::int64_t lower = box_.lower[axis];
      const std::int64_t upper = box_.upper[axis];
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

  /// The same cells in a box that holds the present one.
  void move_to(const IndexBox<Dim>& box) {
    Grid larger(lattice_, box, fill_);
    if (!box_.empty()) copy_rows_to(larger);
    *this = std::move(larger);
  }

  void resize(const IndexBox<Dim>& box) {
    static_cast<void>(checked_count(box));
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
