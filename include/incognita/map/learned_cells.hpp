/// How much of a map was ever known.
#pragma once

#include <bit>
#include <cstddef>

#include "incognita/map/occupancy_layer.hpp"

namespace incognita {

/// The cells of the plane that were free or occupied at any time. Noise makes cells at the edge of what is known come and go; their
/// number here only grows, so that what waits for it to grow waits a finite number of times in a finite building (the consistent
/// mapper that Isleyen et al. assume, (2) to (4)).
template <int Dim>
class LearnedCells {
 public:
  /// On the lattice of the map, with nothing learned yet.
  explicit LearnedCells(const Lattice<Dim>& lattice) : known_(lattice, false) {}

  /// Takes over what the last follow or rebuild of the layer changed. O(tiles changed).
  void follow(const OccupancyLayer<Dim>& occupancy) {
    known_.grow_to_include(occupancy.grid().box());
    for (const Index<Dim>& tile : occupancy.changed_tiles()) {
      CellBits::Word& known = known_.tiles()[known_.tiles().offset_of(tile)];
      const CellBits::Word learned = (occupancy.free().tiles().value(tile) | occupancy.occupied().tiles().value(tile)) & ~known;
      known |= learned;
      count_ += static_cast<std::size_t>(std::popcount(learned));
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }  ///< how many; never falls

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(known_);
    if constexpr (Archive::is_loading) {
      count_ = 0;
      for (const CellBits::Word known : known_.tiles().values()) count_ += static_cast<std::size_t>(std::popcount(known));
    }
  }

 private:
  CellBits known_;
  std::size_t count_ = 0;
};

}  // namespace incognita
