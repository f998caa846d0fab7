/// How much of the floor that a robot could see is known.
#pragma once

#include <cstdint>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/metrics/belief_box.hpp"

namespace incognita {

/// The share of a floor that a belief knows. Made once for a floor and a belief's lattice, then asked as
/// often as the belief changes. Immutable: safe from many threads.
class Coverage {
 public:
  /// `visible` is not 0 where there is floor to be seen (visible_floor), in the world's frame. Throws
  /// std::invalid_argument when there is none, or for a pose that is not finite. O(cells).
  template <class Value>
  Coverage(const Grid<Value, 2>& visible, const Pose2& T_belief_world, const Lattice<2>& belief_lattice) {
    require_finite_pose("Coverage", "T_belief_world", T_belief_world);
    Grid<std::uint32_t, 2> counts(belief_lattice, belief_box(visible, T_belief_world, belief_lattice));
    std::uint64_t total = 0;
    for (Offset cell = 0; cell < static_cast<Offset>(visible.size()); ++cell) {
      if (visible[cell] == 0) continue;
      const Point<2> center_m = T_belief_world * visible.lattice().center_m(visible.index_at(cell));
      ++counts[counts.offset_of(belief_lattice.index_of(center_m))];
      ++total;
    }
    require(total > 0, "Coverage", "the number of pixels of floor to be seen", static_cast<double>(total), ">= 1");
    for (Offset cell = 0; cell < static_cast<Offset>(counts.size()); ++cell) {
      if (counts[cell] != 0) shares_.push_back({counts.index_at(cell), counts[cell]});
    }
    total_ = total;
    floor_area_m2_ = static_cast<double>(total) * visible.resolution_m() * visible.resolution_m();
  }

  /// All of the floor that there is to be seen.
  [[nodiscard]] double floor_area_m2() const { return floor_area_m2_; }

  /// The share in [0, 1] of the floor's pixels whose centre lies in a belief cell for which is_known(index)
  /// holds. O(belief cells on the floor).
  template <class IsKnown>
  [[nodiscard]] double explored_fraction(IsKnown&& is_known) const {
    std::uint64_t known = 0;
    for (const Share& share : shares_) {
      if (is_known(share.cell)) known += share.count;
    }
    return static_cast<double>(known) / static_cast<double>(total_);
  }

 private:
  /// How many floor pixels have their centre in a belief cell.
  struct Share {
    Index<2> cell;
    std::uint32_t count;
  };

  std::vector<Share> shares_;
  std::uint64_t total_ = 0;
  double floor_area_m2_ = 0.0;
};

}  // namespace incognita
