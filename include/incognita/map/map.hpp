/// A belief over the occupancy of the world, one cell policy's state a cell.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/map/cell_layers.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/occupancy.hpp"
#include "incognita/map/scan_integration.hpp"

namespace incognita {

/// The probability that belongs to natural log-odds.
[[nodiscard]] inline double probability_of_log_odds(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

/// How a map is laid out, whatever its cells.
struct MapParams {
  double resolution_m = 0.1;  ///< > 0
  /// How far behind the measured end point a hit lies, in cells, >= 0. 0 is the paper's literal form; without a push
  /// walls become two cells thick (reading of Seo et al., (6)).
  double hit_push_cells = 0.5;
  /// A predicted ray ends in the first cell with log-odds above this; all other cells, unknown ones too, are transparent.
  float blocked_above = 0.4F;

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("resolution_m, hit_push_cells, blocked_above", resolution_m, hit_push_cells, blocked_above);
  }
};

/// The map's frame is that of the poses it is given; its lattice starts at the origin. The map grows as scans ask.
/// Reading is safe from many threads; updating is not.
template <CellPolicy Cell = TBayes, int Dim = 2>
class Map {
 public:
  using CellType = Cell;                 ///< the policy
  using State = typename Cell::State;    ///< of one cell
  static constexpr int dimension = Dim;  ///< 2 or 3

  /// Throws std::invalid_argument for bad parameters.
  explicit Map(const MapParams& params = {}, Cell cell = Cell{})
      : cell_(std::move(cell)), params_(params), grid_(Lattice<Dim>(params.resolution_m)) {
    require_non_negative("Map", "hit_push_cells", params.hit_push_cells);
    require(params.blocked_above >= 0.0F && std::isfinite(params.blocked_above), "Map", "blocked_above",
            static_cast<double>(params.blocked_above), "finite and >= 0");
  }

  /// Starts from log-odds that are known already (see map/prior.hpp, which makes them); cells of 0 and NaN are unknown. Counts as one
  /// update. Throws std::invalid_argument for bad parameters and for a grid on another lattice than the map's, which has its origin
  /// at 0. O(cells).
  explicit Map(const Grid<float, Dim>& log_odds, const MapParams& params = {}, Cell cell = Cell{})
    requires PriorPolicy<Cell>
      : Map(params, std::move(cell)) {
    require(log_odds.resolution_m() == params.resolution_m, "Map", "resolution_m of the given log-odds", log_odds.resolution_m(),
            "the map's");
    if (!equal(log_odds.lattice().origin_m(), lattice().origin_m())) {
      throw std::invalid_argument("Map: the lattice of the given log-odds must have its origin at 0");
    }
    if (log_odds.box().empty()) return;
    grow_to_include(log_odds.box());
    ++update_count_;
    for (Offset offset = 0; offset < static_cast<Offset>(log_odds.size()); ++offset) {
      const float given = log_odds[offset];
      if (given != 0.0F && !std::isnan(given)) start_with(log_odds.index_at(offset), cell_.state_of_log_odds(given));
    }
  }

  [[nodiscard]] const Cell& cell() const { return cell_; }  ///< the policy, with its parameters
  [[nodiscard]] const Grid<State, Dim>& grid() const { return grid_; }  ///< the states of all cells
  [[nodiscard]] const Lattice<Dim>& lattice() const { return grid_.lattice(); }  ///< in the map's frame
  [[nodiscard]] double resolution_m() const { return params_.resolution_m; }  ///< the side of a cell
  [[nodiscard]] float blocked_above() const { return params_.blocked_above; }  ///< in log-odds, see MapParams
  [[nodiscard]] double hit_push_m() const { return params_.hit_push_cells * params_.resolution_m; }  ///< see MapParams

  /// How many scans were written, and 1 for a prior; what follows a map knows by it whether it has missed one.
  [[nodiscard]] std::uint64_t update_count() const { return update_count_; }

  /// The stamp of the last scan; 0 before the first.
  [[nodiscard]] ScanStamp stamp() const { return stamp_; }

  /// What is known of the cells of a plane in one bit each; its changes are those of the last update.
  [[nodiscard]] const CellLayers<Dim>& layers() const
    requires(Dim == 2)
  {
    return layers_;
  }

  /// Access to the states of a tile of the plane, by bit; only for cells of the map's box.
  [[nodiscard]] auto states_of(const Index<2>& tile) const
    requires(Dim == 2)
  {
    return tile_states(grid_.values().data(), tile);
  }

  /// Natural log-odds of a cell; 0 where nothing was ever measured.
  [[nodiscard]] float log_odds(const Index<Dim>& index) const { return Cell::log_odds(grid_.value(index)); }
  /// Of a cell by its offset, which is not checked.
  [[nodiscard]] float log_odds(Offset offset) const { return Cell::log_odds(grid_[offset]); }
  /// That a cell is occupied; 1/2 beyond the map's box.
  [[nodiscard]] double probability(const Index<Dim>& index) const {
    return probability_of_log_odds(static_cast<double>(log_odds(index)));
  }

  /// Writes a scan, taken at T_map_sensor with the covariance of that pose (only the position's block is used, as h does
  /// not depend on the heading, unless the cells are a PoseAwarePolicy), into the cells that its beams meet. Invalid beams are ignored and counted.
  /// Throws std::invalid_argument for a pose or covariance that is not finite or not positive semi-definite, and
  /// std::length_error for a pose out of the lattice's reach; the map is then unchanged. O(cells passed), amortised.
  ScanReport update(const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
                    const typename Pose<Dim>::Covariance& covariance) {
    require_finite_pose("Map::update", "the pose", T_map_sensor);
    require_covariance("Map::update", "the covariance", covariance);
    require_reach(T_map_sensor.position(), scan.range_max_m() + hit_push_m());
    beams_.take(cell_, lattice(), scan, T_map_sensor, covariance, hit_push_m());
    grow_to_include(beams_.reach());
    advance_stamp();
    ++update_count_;
    if constexpr (Dim == 2) {
      layers_.forget_changes();
      beams_.write(cell_, layers_, params_.blocked_above, stamp_, Access{*this});
    } else {
      beams_.write(cell_, grid_, stamp_);
    }
    return beams_.report();
  }

  /// Throws std::length_error for a point that is not finite or, with a margin around it, beyond the lattice's reach.
  void require_reach(const Point<Dim>& point_m, double margin_m) const {
    const double reach_m = resolution_m() * static_cast<double>(std::numeric_limits<int>::max() / 2);
    if (!(point_m.array().abs() + margin_m < reach_m).all()) {
      throw std::length_error("Map: the point " + tuple_text(point_m) + " and " + std::to_string(margin_m) + " m around it lie beyond " +
                              std::to_string(reach_m) + " m from the map's origin");
    }
  }

  /// Makes room for a box of points, in metres, so that prediction there needs no growth. Throws std::length_error for
  /// points out of the lattice's reach.
  void reserve(const Box<Point<Dim>>& box_m) {
    require_reach(box_m.lower, 0.0);
    require_reach(box_m.upper, 0.0);
    grow_to_include(lattice().cells_of(box_m));
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("map", params_);
    archive.check("cells", cell_);
    archive(grid_, stamp_, update_count_);
    if constexpr (Archive::is_loading) {
      archive.require(stamp_ <= stamp_last, "the stamp of a map is too large");
      for (const State& state : grid_.values()) archive.require(std::isfinite(Cell::log_odds(state)), "a cell's log-odds are not finite");
    }
    if constexpr (Dim == 2) {
      layers_.archive_state(archive, grid_.box());
      if constexpr (Archive::is_loading) find_layers();
    }
  }

 private:
  struct NoLayers {
    explicit NoLayers(const Lattice<Dim>&) {}
  };
  template <int OfDim>
  struct LayersOf {
    using type = NoLayers;
  };
  template <int OfDim>
    requires(OfDim == 2)
  struct LayersOf<OfDim> {
    using type = CellLayers<OfDim>;
  };

  /// What MapBeams::write asks for.
  struct Access {
    Map& map;

    [[nodiscard]] auto open(Offset /*place*/, const Index<2>& tile, CellBits::Word /*cells*/) {
      return map.tile_states(map.grid_.values().data(), tile);
    }
    void clear(Offset /*place*/, const Index<2>& tile, CellBits::Word cells) {
      const auto states = map.tile_states(map.grid_.values().data(), tile);
      for (CellBits::Word left = cells; left != 0; left &= left - 1U) states(std::countr_zero(left)) = map.cell_.cleared();
    }
  };

  template <class States>
  [[nodiscard]] auto tile_states(States* states, const Index<2>& tile) const {
    return [states, first = grid_.offset_of(CellBits::cell_of(tile, 0)), stride = grid_.stride(1)](int bit) -> States& {
      constexpr int in_tile = CellBits::tile_side - 1;
      return states[first + (bit & in_tile) + (bit >> CellBits::tile_shift) * stride];
    };
  }

  void start_with(const Index<Dim>& index, const State& state) {
    grid_[grid_.offset_of(index)] = state;
    if constexpr (Dim == 2) {
      const Index<2> tile = CellBits::tile_of(index);
      const Offset place = layers_.heeding.tiles().offset_of(tile);
      const CellBits::Word cell = CellBits::mask_of(index);
      layers_.mark_changed(place, tile, cell);
      layers_.assign(place, cell, Cell::log_odds(state) > params_.blocked_above ? cell : 0, cell_.ignores_passes(state) ? cell : 0);
    }
  }

  void grow_to_include(const IndexBox<Dim>& cells) {
    grid_.grow_to_include(cells);
    if constexpr (Dim == 2) layers_.grow_to_include(grid_.box());
  }

  /// What is blocked and what ignores passes, of what was written.
  void find_layers() {
    for_each_tile_of(grid_.box(), [&](const Index<2>& tile) {
      const Offset place = layers_.written.tiles().offset_of(tile);
      const CellBits::Word written = layers_.written.tiles()[place];
      if (written == 0) return;
      const auto states = states_of(tile);
      CellBits::Word blocking = 0;
      CellBits::Word ignoring = 0;
      for (CellBits::Word left = written; left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        blocking |= static_cast<CellBits::Word>(Cell::log_odds(states(bit)) > params_.blocked_above) << bit;
        ignoring |= static_cast<CellBits::Word>(cell_.ignores_passes(states(bit))) << bit;
      }
      layers_.assign(place, written, blocking, OncePolicy<Cell> ? 0 : ignoring);  // what settles for a scan heeds the next
    });
  }

  /// Stamps stay clear of the upper end of their type by as many scans as a prediction may add (Overlay). When they
  /// run out, every cell forgets its stamp: once in hours of scans.
  void advance_stamp() {
    if (stamp_ >= stamp_last) {
      for (State& state : grid_.values()) cell_.forget_stamp(state);
      stamp_ = 0;
    }
    ++stamp_;
  }

 public:
  static constexpr ScanStamp stamp_last = 60000;  ///< after so many scans all stamps are forgotten

 private:
  Cell cell_;
  MapParams params_;
  Grid<State, Dim> grid_;
  typename LayersOf<Dim>::type layers_{lattice()};
  MapBeams<Cell, Dim> beams_;  // scratch
  ScanStamp stamp_ = 0;
  std::uint64_t update_count_ = 0;
};

/// Every cell of the map's box in one word. Throws std::invalid_argument for bad thresholds. O(cells).
template <CellPolicy Cell, int Dim>
[[nodiscard]] OccupancyGrid<Dim> classify(const Map<Cell, Dim>& map, const OccupancyThresholds& thresholds = {}) {
  thresholds.validate();
  OccupancyGrid<Dim> occupancy(map.lattice(), map.grid().box(), Occupancy::unknown);
  for (Offset offset = 0; offset < static_cast<Offset>(occupancy.size()); ++offset) {
    occupancy[offset] = thresholds.classify(map.log_odds(offset));
  }
  return occupancy;
}

}  // namespace incognita
