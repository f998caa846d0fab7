/// What a map would be after scans that were not taken: changes kept beside the map, which stays as it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "incognita/map/map.hpp"

namespace incognita {

/// Cells are copied from the map when a predicted scan first touches them. Starting over costs O(1): a cell belongs to
/// the overlay only while its epoch is the current one. Memory: sizeof(State) + 4 bytes for each cell of the map's
/// box, kept for the next use. One overlay a thread; the map must not change between reset and the last use.
template <CellPolicy Cell, int Dim = 2>
class Overlay {
 public:
  using State = typename Cell::State;

  /// Forgets all changes and looks at `map` from now on. The map must outlive the use.
  void reset(const Map<Cell, Dim>& map) {
    map_ = &map;
    stamp_ = map.stamp();
    touched_.clear();
    std::size_t tiles = 0;
    if constexpr (Dim == 2) tiles = map.heeding().tiles().size();
    if (epochs_.size() != map.grid().size() || tile_epochs_.size() != tiles) {
      states_.resize(map.grid().size());
      epochs_.assign(map.grid().size(), 0);
      words_.resize(tiles);
      tile_epochs_.assign(tiles, 0);
      epoch_ = 0;
    }
    if (++epoch_ == 0) {
      std::fill(epochs_.begin(), epochs_.end(), 0);
      std::fill(tile_epochs_.begin(), tile_epochs_.end(), 0);
      epoch_ = 1;
    }
  }

  [[nodiscard]] const Map<Cell, Dim>& map() const { return *map_; }

  /// The predicted log-odds of a cell; 0 outside of the map's box.
  [[nodiscard]] float log_odds(const Index<Dim>& index) const {
    if (!map_->grid().contains(index)) return 0.0F;
    return Cell::log_odds(seen(map_->grid().offset_of(index)));
  }

  /// Writes a predicted scan, as Map::update would. Throws std::length_error when it reaches out of the map's box
  /// (Map::reserve makes room), and after more predicted scans than stamps are left for (5,535).
  void update(const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
              const Eigen::Matrix<double, Dim, Dim>& position_covariance_m2) {
    if (stamp_ == static_cast<ScanStamp>(-1)) throw std::length_error("Overlay::update: too many predicted scans");
    beams_.take(map_->cell(), scan, T_map_sensor, position_covariance_m2, map_->hit_push_m());
    if (!map_->grid().box().contains(beams_.reach(map_->lattice()))) {
      throw std::length_error("Overlay::update: a predicted scan reaches out of the map's box; see Map::reserve");
    }
    ++stamp_;
    Writer writer{*this};
    beams_.write(map_->cell(), map_->lattice(), writer, stamp_);
  }

  /// The cells touched since the last reset, in the order of their first touch.
  [[nodiscard]] const std::vector<Offset>& touched() const { return touched_; }

  /// The predicted log-odds of a touched cell.
  [[nodiscard]] float touched_log_odds(Offset offset) const {
    return Cell::log_odds(states_[static_cast<std::size_t>(offset)]);
  }

 private:
  struct Writer {
    Overlay& overlay;

    State& state(const Index<Dim>& index) { return overlay.state(index); }
    [[nodiscard]] const State& seen(const Index<Dim>& index) const {
      return overlay.seen(overlay.map_->grid().offset_of(index));
    }
    void heed(const Index<Dim>& index) {
      if constexpr (Dim == 2) overlay.own_word(CellBits::tile_of(index)) |= CellBits::mask_of(index);
    }
    [[nodiscard]] CellBits::Word word(const Index<2>& tile) const { return overlay.word(tile); }
    void clear(const Index<2>& tile, CellBits::Word mask) { overlay.own_word(tile) &= ~mask; }
  };

  /// The state to change.
  [[nodiscard]] State& state(const Index<Dim>& index) {
    const Offset offset = map_->grid().offset_of(index);
    State& state = states_[static_cast<std::size_t>(offset)];
    if (!is_changed(offset)) {
      state = map_->grid()[offset];
      epochs_[static_cast<std::size_t>(offset)] = epoch_;
      touched_.push_back(offset);
    }
    return state;
  }

  [[nodiscard]] const State& seen(Offset offset) const {
    return is_changed(offset) ? states_[static_cast<std::size_t>(offset)] : map_->grid()[offset];
  }

  [[nodiscard]] CellBits::Word word(const Index<2>& tile) const {
    const auto place = static_cast<std::size_t>(map_->heeding().tiles().offset_of(tile));
    return tile_epochs_[place] == epoch_ ? words_[place] : map_->heeding().tiles().values()[place];
  }

  [[nodiscard]] CellBits::Word& own_word(const Index<2>& tile) {
    const auto place = static_cast<std::size_t>(map_->heeding().tiles().offset_of(tile));
    words_[place] = word(tile);
    tile_epochs_[place] = epoch_;
    return words_[place];
  }

  [[nodiscard]] bool is_changed(Offset offset) const { return epochs_[static_cast<std::size_t>(offset)] == epoch_; }

  const Map<Cell, Dim>* map_ = nullptr;
  MapBeams<Cell, Dim> beams_;  // scratch
  std::vector<State> states_;
  std::vector<std::uint32_t> epochs_;
  std::vector<CellBits::Word> words_;  // of the map's heeding(), for tiles that have changed
  std::vector<std::uint32_t> tile_epochs_;
  std::uint32_t epoch_ = 0;
  ScanStamp stamp_ = 0;
  std::vector<Offset> touched_;
};

}  // namespace incognita
