/// What a map would be after scans that were not taken: changes kept beside the map, which stays as it is.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "incognita/geometry/box.hpp"
#include "incognita/map/map.hpp"

namespace incognita {

/// A tile of a plane's cells is copied from the map when a predicted scan first changes one of them. Starting over costs as much as what
/// was changed. Memory: 6 bits a cell of the map's box, and a tile of 64 states for each tile changed at once, kept for
/// the next use. One overlay a thread; the map must not change between look_at and the last use.
template <CellPolicy Cell>
class Overlay {
 public:
  using State = typename Cell::State;  ///< of one cell

  /// Forgets all changes and looks at `map`, as it is now, from now on. The map must outlive the use. O(tiles of the map).
  void look_at(const Map<Cell, 2>& map) {
    map_ = nullptr;  // until all is done
    layers_ = map.layers();
    layers_->forget_changes();
    slots_.assign(layers_->changed.tiles().size(), no_slot);
    cleared_.assign(layers_->changed.tiles().size(), 0);
    cleared_count_ = 0;
    used_ = 0;
    stamp_ = map.stamp();
    map_ = &map;
  }

  /// Forgets all changes. O(tiles changed). Throws std::logic_error before look_at, and when the map has grown since.
  void forget() {
    if (map_ == nullptr || map_->layers().changed.tiles().box() != layers_->changed.tiles().box()) {
      throw std::logic_error("Overlay::forget: the overlay has looked at no map, or the map has grown since; see look_at");
    }
    const CellLayers<2>& seen = map_->layers();
    const Grid<CellBits::Word, 2>& tiles = layers_->changed.tiles();
    for (const Index<2>& tile : layers_->changed_tiles) {
      const Offset place = tiles.offset_of(tile);
      layers_->heeding.tiles()[place] = seen.heeding.tiles()[place];
      layers_->blocked.tiles()[place] = seen.blocked.tiles()[place];
      layers_->written.tiles()[place] = seen.written.tiles()[place];
      slots_[static_cast<std::size_t>(place)] = no_slot;
      cleared_[static_cast<std::size_t>(place)] = 0;
    }
    cleared_count_ = 0;
    layers_->forget_changes();
    used_ = 0;
    stamp_ = map_->stamp();
  }

  /// What it looks at; not to be asked before look_at.
  [[nodiscard]] const Map<Cell, 2>& map() const { return *map_; }

  /// The cells' layers as the predicted scans leave them; `changed` are the cells that differ from the map, or may.
  [[nodiscard]] const CellLayers<2>& layers() const { return *layers_; }

  /// The predicted log-odds of a cell; 0 outside of the map's box.
  [[nodiscard]] float log_odds(const Index<2>& index) const {
    if (!map_->grid().contains(index)) return 0.0F;
    if (!layers_->changed.get(index)) return map_->log_odds(index);
    const auto place = static_cast<std::size_t>(layers_->changed.tiles().offset_of(CellBits::tile_of(index)));
    const CellBits::Word cell = CellBits::mask_of(index);
    if constexpr (ClearingPolicy<Cell>) {
      if ((cleared_[place] & cell) != 0) return Cell::log_odds(map_->cell().cleared());
    }
    return Cell::log_odds(states_[slots_[place] + static_cast<std::size_t>(std::countr_zero(cell))]);
  }

  /// How many of the changed cells were never written and are now beyond doubt free, policy.cleared(). That is all there is to
  /// know of them.
  [[nodiscard]] std::size_t cleared_count() const { return cleared_count_; }

  /// Calls visit(index, before, after) for each other changed cell with its states in the map and here, tile by tile.
  template <class Visit>
  void for_each_changed_but_cleared(Visit&& visit) const {
    for_each_changed([&](const Index<2>& tile, CellBits::Word changed, CellBits::Word cleared, const State* after) {
      const auto before = map_->states_of(tile);
      for (CellBits::Word left = changed & ~cleared; left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        visit(CellBits::cell_of(tile, bit), before(bit), after[bit]);
      }
    });
  }

  /// Calls visit(index) for each changed cell, tile by tile.
  template <class Visit>
  void for_each_changed_cell(Visit&& visit) const {
    for_each_changed([&](const Index<2>& tile, CellBits::Word changed, CellBits::Word, const State*) {
      for (CellBits::Word left = changed; left != 0; left &= left - 1U) {
        visit(CellBits::cell_of(tile, std::countr_zero(left)));
      }
    });
  }

  /// Writes a predicted scan, as Map::update would. Throws std::length_error when it reaches out of the map's box
  /// (Map::reserve makes room), and after more predicted scans than stamps are left for (5,535).
  void update(const Scan<2>& scan, const Pose2& T_map_sensor, const Pose2::Covariance& covariance) {
    require_stamp();
    map_->require_reach(T_map_sensor.position(), scan.range_max_m() + map_->hit_push_m());
    beams_.take(map_->cell(), map_->lattice(), scan, T_map_sensor, covariance, map_->hit_push_m());
    if (!map_->grid().box().contains(beams_.reach())) {
      throw std::length_error("Overlay::update: a predicted scan reaches the cells " + box_text(beams_.reach()) +
                              ", but must stay within those of the map, " + box_text(map_->grid().box()) + "; see Map::reserve");
    }
    ++stamp_;
    beams_.write(map_->cell(), *layers_, map_->blocked_above(), stamp_, Access{*this});
  }

  /// Predicts the scan that `beams`, in the axes of the map, would read at `position_m`: each ends in the first cell that is
  /// blocked (see MapParams), or at its range. measure_m(direction, cell) tells the range that a hit of that cell is read as; a
  /// beam for which it is not positive is left out. Nothing is written before write_cast. Throws std::length_error unless all
  /// within the range lies in the map's box (Map::reserve), and after more predicted scans than stamps are left for (5,535).
  template <class Measure>
  void cast(const BeamPattern<2>& beams, const Point<2>& position_m, Measure&& measure_m) {
    require_stamp();
    map_->require_reach(position_m, beams.range_max_m);
    const Box<Point<2>> reach_m = Box<Point<2>>{position_m, position_m}.padded(beams.range_max_m);
    if (!map_->grid().box().contains(map_->lattice().cells_of(reach_m).padded(1))) {
      throw std::length_error("Overlay::cast: a beam may reach the cells " + box_text(map_->lattice().cells_of(reach_m).padded(1)) +
                              ", but must stay within those of the map, " + box_text(map_->grid().box()) + "; see Map::reserve");
    }
    beams_.cast(map_->lattice(), *layers_, beams, position_m, map_->hit_push_m(), measure_m);
  }

  /// Writes the scan that cast has predicted last, once, before anything else is done with the overlay.
  void write_cast(const Pose2::Covariance& covariance) {
    ++stamp_;
    beams_.write_cast(map_->cell(), *layers_, map_->blocked_above(), stamp_, covariance, Access{*this});
  }

 private:
  static constexpr std::uint32_t no_slot = static_cast<std::uint32_t>(-1);

  void require_stamp() const {
    if (stamp_ == static_cast<ScanStamp>(-1)) {
      throw std::length_error("Overlay: too many predicted scans: no stamp is left of the 5535 after look_at");
    }
  }

  /// What MapBeams::write asks for.
  struct Access {
    Overlay& overlay;

    [[nodiscard]] auto open(Offset place, const Index<2>& tile, CellBits::Word cells) {
      return overlay.open(static_cast<std::size_t>(place), tile, cells);
    }
    void clear(Offset place, const Index<2>& /*tile*/, CellBits::Word cells) {
      overlay.cleared_[static_cast<std::size_t>(place)] |= cells;
      overlay.cleared_count_ += static_cast<std::size_t>(std::popcount(cells));
    }
  };

  /// Access to the states of a tile, by bit, of which `cells` are about to be written.
  [[nodiscard]] auto open(std::size_t place, const Index<2>& tile, CellBits::Word cells) {
    std::uint32_t& slot = slots_[place];
    if (slot == no_slot) slot = open_slot(tile);
    if constexpr (ClearingPolicy<Cell>) {
      const CellBits::Word cleared = cleared_[place] & cells;
      if (cleared != 0) {
        for (CellBits::Word left = cleared; left != 0; left &= left - 1U) {
          states_[slot + static_cast<std::size_t>(std::countr_zero(left))] = map_->cell().cleared();
        }
        cleared_[place] &= ~cleared;
        cleared_count_ -= static_cast<std::size_t>(std::popcount(cleared));
      }
    }
    return [states = states_.data() + slot](int bit) -> State& { return states[bit]; };
  }

  /// visit(tile, changed cells, those of them that are cleared, the states of the others by bit)
  template <class Visit>
  void for_each_changed(Visit&& visit) const {
    const Grid<CellBits::Word, 2>& changed = layers_->changed.tiles();
    for (const Index<2>& tile : layers_->changed_tiles) {
      const Offset place = changed.offset_of(tile);
      const std::uint32_t slot = slots_[static_cast<std::size_t>(place)];
      visit(tile, changed[place], cleared_[static_cast<std::size_t>(place)], states_.data() + (slot == no_slot ? 0 : slot));
    }
  }

  /// Room for the states of a tile, with those that the map has.
  [[nodiscard]] std::uint32_t open_slot(const Index<2>& tile) {
    const std::size_t slot = used_;
    used_ += 64;
    if (used_ > states_.size()) states_.resize(2 * used_);
    const Grid<State, 2>& grid = map_->grid();
    const Index<2> first = CellBits::cell_of(tile, 0);
    const Index<2> end = CellBits::cell_of({tile[0] + 1, tile[1] + 1}, 0);
    if (grid.box().contains(IndexBox<2>{first, end})) {
      const State* row = grid.values().data() + grid.offset_of(first);
      for (std::size_t to = slot; to < used_; to += CellBits::tile_side, row += grid.stride(1)) {
        std::copy_n(row, CellBits::tile_side, states_.begin() + static_cast<std::ptrdiff_t>(to));
      }
    } else {
      const auto seen = map_->states_of(tile);
      for (CellBits::Word left = cells_of_tile(tile, grid.box()); left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        states_[slot + static_cast<std::size_t>(bit)] = seen(bit);
      }
    }
    return static_cast<std::uint32_t>(slot);
  }

  const Map<Cell, 2>* map_ = nullptr;
  MapBeams<Cell, 2> beams_;            // scratch
  std::optional<CellLayers<2>> layers_;
  std::vector<std::uint32_t> slots_;     // where the states of a changed tile begin, by the tile's place
  std::vector<CellBits::Word> cleared_;  // cells that have no state of their own, likewise
  std::size_t cleared_count_ = 0;
  std::vector<State> states_;
  std::size_t used_ = 0;  // of states_
  ScanStamp stamp_ = 0;
};

}  // namespace incognita
