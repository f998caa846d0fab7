/// An allowed area on a lattice.
#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

#include "incognita/grid/cell_bits.hpp"
#include "incognita/planning/allowed_area.hpp"

namespace incognita {

/// Which cells an AllowedArea closes to a robot, and how far the others are from what is not allowed. A cell is open when the disc
/// around its square is allowed: whoever stays in open cells stays in the area. Safe to read from many threads.
template <int Dim>
class ClosedCells {
  static_assert(Dim == 2);

 public:
  /// Of no cells yet. Throws std::invalid_argument for polygons that are none.
  ClosedCells(const Lattice<Dim>& lattice, AllowedArea area)
      : area_(std::move(area)), clearance_m_(lattice, {}, not_asked), bits_(lattice, false) {
    area_.validate();
  }

  /// Makes room for some cells and the tiles around them. O(corners * new cells + cells); nothing without bounds and polygons.
  void grow_to_include(const IndexBox<Dim>& cells) {
    if (area_.is_everywhere() || cells.empty()) return;
    if (clearance_m_.grow_to_include(cells.padded(CellBits::tile_side))) find_new();
  }

  /// Whether every cell is open.
  [[nodiscard]] bool none() const { return area_.is_everywhere(); }

  /// A bit for each cell that is closed, of those that there is room for.
  [[nodiscard]] const CellBits& bits() const { return bits_; }

  /// From an open cell's centre to what is not allowed; 0 for one that is closed. There must be room for the cell.
  [[nodiscard]] float clearance_m(const Index<Dim>& cell) const { return clearance_m_[clearance_m_.offset_of(cell)]; }

  /// For archives of states, see docs/mission_file.md: of cells closed by the same area.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive_box(archive, clearance_m_);
    if constexpr (Archive::is_loading) {
      bits_ = CellBits(clearance_m_.lattice(), false);
      find_new();
    }
  }

 private:
  static constexpr float not_asked = -1.0F;

  void find_new() {
    bits_.grow_to_include(clearance_m_.box());
    const double half_diagonal_m = std::sqrt(0.5) * clearance_m_.resolution_m();
    for (Offset cell = 0; cell < static_cast<Offset>(clearance_m_.size()); ++cell) {
      if (clearance_m_[cell] != not_asked) continue;
      const Index<Dim> index = clearance_m_.index_at(cell);
      const double clearance_m = area_.clearance_m(clearance_m_.lattice().center_m(index));
      const bool is_open = clearance_m >= half_diagonal_m;
      clearance_m_[cell] = is_open ? static_cast<float>(clearance_m) : 0.0F;
      bits_.set(index, !is_open);
    }
  }

  AllowedArea area_;
  Grid<float, Dim> clearance_m_;
  CellBits bits_;
};

}  // namespace incognita
