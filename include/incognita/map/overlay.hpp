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
    if (epochs_.size() != map.grid().size()) {
      states_.resize(map.grid().size());
      epochs_.assign(map.grid().size(), 0);
      epoch_ = 0;
    }
    if (++epoch_ == 0) {
      std::fill(epochs_.begin(), epochs_.end(), 0);
      epoch_ = 1;
    }
  }

  [[nodiscard]] const Map<Cell, Dim>& map() const { return *map_; }

  /// The predicted log-odds of a cell; 0 outside of the map's box.
  [[nodiscard]] float log_odds(const Index<Dim>& index) const {
    if (!map_->grid().contains(index)) return 0.0F;
    return Cell::log_odds(seen(index));
  }

  /// The predicted state of a cell, to look at. The index must lie in the map's box.
  [[nodiscard]] const State& seen(const Index<Dim>& index) const {
    const Offset offset = map_->grid().offset_of(index);
    return is_changed(offset) ? states_[static_cast<std::size_t>(offset)] : map_->grid()[offset];
  }

  /// The state to change, as integrate_scan asks for it. The index must lie in the map's box.
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

  /// Writes a predicted scan, as Map::update would. Throws std::length_error when it reaches out of the map's box
  /// (Map::reserve makes room), and after more predicted scans than stamps are left for (5,535).
  void update(const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
              const Eigen::Matrix<double, Dim, Dim>& position_covariance_m2) {
    if (stamp_ == static_cast<ScanStamp>(-1)) throw std::length_error("Overlay::update: too many predicted scans");
    const IndexBox<Dim> reach = cells_in_reach(map_->lattice(), scan, T_map_sensor, map_->hit_push_m());
    if (!map_->grid().box().contains(reach)) {
      throw std::length_error("Overlay::update: a predicted scan reaches out of the map's box; see Map::reserve");
    }
    ++stamp_;
    integrate_scan<Cell, Dim>(map_->cell(), map_->lattice(), *this, scan, T_map_sensor, position_covariance_m2,
                              map_->hit_push_m(), stamp_);
  }

  /// The cells touched since the last reset, in the order of their first touch.
  [[nodiscard]] const std::vector<Offset>& touched() const { return touched_; }

  /// The predicted log-odds of a touched cell.
  [[nodiscard]] float touched_log_odds(Offset offset) const {
    return Cell::log_odds(states_[static_cast<std::size_t>(offset)]);
  }

 private:
  [[nodiscard]] bool is_changed(Offset offset) const { return epochs_[static_cast<std::size_t>(offset)] == epoch_; }

  const Map<Cell, Dim>* map_ = nullptr;
  std::vector<State> states_;
  std::vector<std::uint32_t> epochs_;
  std::uint32_t epoch_ = 0;
  ScanStamp stamp_ = 0;
  std::vector<Offset> touched_;
};

}  // namespace incognita
