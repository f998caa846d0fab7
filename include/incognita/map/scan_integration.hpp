/// One scan written into cells: the walk that maps and their overlays share.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "incognita/geometry/pose.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/grid/segment_walk.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/cell_layers.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// What became of the beams of a scan.
struct ScanReport {
  std::size_t beams_used = 0;     ///< hits, and beams that met nothing
  std::size_t beams_ignored = 0;  ///< NaN, infinite, negative or out of range

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(beams_used, beams_ignored);
  }
};

namespace detail {

/// What makes a cell policy's constants of the beams of one scan: called with a direction in the map's axes and the range read.
template <int Dim, CellPolicy Cell>
[[nodiscard]] auto beam_constants(const Cell& policy, const typename Pose<Dim>::Covariance& covariance, double range_max_m) {
  if constexpr (PoseAwarePolicy<Cell>) {
    static_assert(Dim == 2, "a PoseAwarePolicy is for maps of the plane");
    return [view = policy.view(covariance, range_max_m)](const Point<2>& direction, double range_m) {
      return view.beam(direction, range_m);
    };
  } else {
    return [&policy, &covariance](const Point<Dim>& direction, double /*range_m*/) {
      const auto position = covariance.template topLeftCorner<Dim, Dim>();
      return policy.beam(std::max(0.0, direction.dot(position * direction)));
    };
  }
}

}  // namespace detail

/// The valid beams of a scan in a map's frame, each with what is constant along it. Keeps its storage from one scan to the
/// next.
template <CellPolicy Cell, int Dim>
class MapBeams {
 public:
  /// Takes a scan's beams, seen from T_map_sensor. A hit lies `push_m` behind the measured end point: walls are measured at
  /// the face of a cell while h is the distance to its centre (reading of Seo et al., (6)). Of the pose's covariance only the
  /// position's counts, unless the policy is a PoseAwarePolicy: h does not depend on the heading.
  void take(const Cell& policy, const Lattice<Dim>& lattice, const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
            const typename Pose<Dim>::Covariance& covariance, double push_m) {
    const auto constants = detail::beam_constants<Dim>(policy, covariance, scan.range_max_m());
    const Point<Dim> origin_m = T_map_sensor.position();
    const Eigen::Matrix<double, Dim, Dim> rotation = T_map_sensor.rotation();
    origin_ = lattice.to_cells(origin_m);
    resolution_m_ = static_cast<float>(lattice.resolution_m());
    push_m_ = push_m;
    beams_.clear();
    beams_.reserve(scan.size());
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const Reading reading = scan.reading(beam);
      if (reading == Reading::invalid) continue;
      const Point<Dim> direction = rotation * scan.direction(beam);
      const bool is_hit = reading == Reading::hit;
      const double range_m = scan.range_m(beam);
      const double length_m = is_hit ? range_m + push_m : range_m;
      const Point<Dim> end = lattice.to_cells(origin_m + direction * length_m);
      beams_.push_back({end, range_m, is_hit, constants(direction, range_m), Walk(origin_, end, !is_hit)});
    }
    report_ = {beams_.size(), scan.size() - beams_.size()};
  }

  [[nodiscard]] const ScanReport& report() const { return report_; }  ///< of the scan last taken

  /// A box that holds every cell that the beams meet, with a cell to spare on each side: an end point on the face of a cell
  /// may be rounded to either side of it.
  [[nodiscard]] IndexBox<Dim> reach() const {
    Box<Point<Dim>> reach{origin_, origin_};
    for (const Beam& beam : beams_) reach.stretch_to(beam.end);
    IndexBox<Dim> cells{cell_holding<Dim>(reach.lower), cell_holding<Dim>(reach.upper)};
    for (int axis = 0; axis < Dim; ++axis) ++cells.upper[axis];
    return cells.padded(1);
  }

  /// Updates each cell that a beam hits or passes, first all hits, then all passes (so the order of the beams does not decide
  /// which wins). `states` must hold the cells of reach(). O(cells passed), no allocation.
  void write(const Cell& policy, Grid<typename Cell::State, Dim>& states, ScanStamp stamp) const
    requires(Dim != 2)
  {
    for (const Beam& beam : beams_) {
      if (!beam.is_hit) continue;
      const Index<Dim> index = cell_holding<Dim>(beam.end);
      policy.hit(states[states.offset_of(index)], beam.constants, residual_m(index, beam.range_m + push_m_), stamp);
    }
    for (const Beam& beam : beams_) {
      const Index<Dim> end = cell_holding<Dim>(beam.end);
      traverse_cells<Dim>(origin_, beam.end, [&](const Index<Dim>& index) {
        typename Cell::State& state = states[states.offset_of(index)];
        if ((beam.is_hit && equal(index, end)) || policy.ignores_passes(state)) return;
        policy.pass(state, beam.constants, residual_m(index, beam.range_m), stamp);
      });
    }
  }

  /// The same in the plane, where cells with log-odds over blocked_above end predicted rays, by way of the cells' layers, which are
  /// kept up to date: of cells that ignore passes nothing is looked at but a bit. `states` gives access: states.open(place, tile, cells)
  /// to a tile's states by bit, of which `cells` are about to be written; states.clear(place, tile, cells) makes them
  /// policy.cleared(). O(cells passed that do not ignore passes, and tiles passed).
  template <class States>
  void write(const Cell& policy, CellLayers<Dim>& layers, float blocked_above, ScanStamp stamp, States&& states)
    requires(Dim == 2)
  {
    write_hits(policy, layers, blocked_above, stamp, states);
    find_heeding(layers.heeding);
    write_passes(policy, layers, blocked_above, stamp, states);
    heed_again(layers);
  }

  /// Takes the beams that a sensor at `origin_m`, in the axes of the map, would read if each ended in the first cell that is
  /// blocked, or at its range. measure_m(direction, cell) tells the range of a hit of that cell; a beam for which it is not
  /// positive is left out. For write_cast, with the layers as they are now.
  template <class Measure>
  void cast(const Lattice<2>& lattice, const CellLayers<2>& layers, const BeamPattern<2>& pattern, const Point<2>& origin_m,
            double push_m, Measure&& measure_m)
    requires(Dim == 2)
  {
    origin_ = lattice.to_cells(origin_m);
    resolution_m_ = static_cast<float>(lattice.resolution_m());
    push_m_ = push_m;
    range_max_m_ = pattern.range_max_m;
    beams_.clear();
    beams_.reserve(pattern.directions.size());
    directions_.clear();
    met_.clear();
    for (const Point<2>& direction : pattern.directions) {
      const Point<2> end = lattice.to_cells(sum(origin_m, scaled(direction, pattern.range_max_m)));
      const auto index = static_cast<std::uint32_t>(beams_.size());
      const std::size_t met_before = met_.size();
      beams_.push_back({end, pattern.range_max_m, false, {}, SegmentWalk(origin_, end, true)});
      Beam& beam = beams_.back();
      const auto meet = [&](SegmentWalk::TileCells tile) {
        SegmentWalk::TileCells blocked = tile;
        blocked.cells &= layers.blocked.tiles()[tile.place];
        if (blocked.cells != 0) {
          const Index<2> hit = beam.walk.first_of(blocked);
          tile.cells = beam.walk.cells_before(tile, hit);
          beam.is_hit = true;
          beam.range_m = measure_m(direction, hit);
          beam.end = {hit[0] + 0.5, hit[1] + 0.5};
        }
        if (tile.cells != 0) met_.push_back({tile, index});
        return !beam.is_hit;
      };
      visit_set(layers.heeding, beam.walk, origin_, end, meet);
      if (beam.range_m > 0.0) {
        directions_.push_back(direction);
      } else {
        beams_.pop_back();
        met_.resize(met_before);
      }
    }
    report_ = {beams_.size(), pattern.directions.size() - beams_.size()};
  }

  /// Writes what cast took, as `write` would write such a scan with that covariance of its pose; blocked_above is in log-odds.
  template <class States>
  void write_cast(const Cell& policy, CellLayers<Dim>& layers, float blocked_above, ScanStamp stamp,
                  const Pose2::Covariance& covariance, States&& states)
    requires(Dim == 2)
  {
    const auto constants = detail::beam_constants<2>(policy, covariance, range_max_m_);
    for (std::size_t beam = 0; beam < beams_.size(); ++beam) {
      beams_[beam].constants = constants(directions_[beam], beams_[beam].range_m);
    }
    write_hits(policy, layers, blocked_above, stamp, states);
    write_passes(policy, layers, blocked_above, stamp, states);
    heed_again(layers);
  }

 private:
  struct NoWalk {
    NoWalk(const Point<Dim>&, const Point<Dim>&, bool) {}
  };
  using Walk = std::conditional_t<Dim == 2, SegmentWalk, NoWalk>;

  struct Beam {
    Point<Dim> end;  // in lattice coordinates
    double range_m;  // as measured
    bool is_hit;
    typename Cell::Beam constants;
    Walk walk;
  };

  /// Whether a cell that was just updated ignores the passes to come: of this scan, or for ever.
  [[nodiscard]] static bool is_settled(const Cell& policy, const typename Cell::State& state) {
    if constexpr (OncePolicy<Cell>) return true;
    return policy.ignores_passes(state);
  }

  /// What one scan has settled heeds the next, where settled is for this scan only.
  static void heed_again(CellLayers<2>& layers) {
    if constexpr (OncePolicy<Cell>) {
      for (const Index<2>& tile : layers.changed_tiles) layers.heeding.tiles()[layers.heeding.tiles().offset_of(tile)] = ~CellBits::Word{0};
    }
  }

  template <class States>
  void write_hits(const Cell& policy, CellLayers<2>& layers, float blocked_above, ScanStamp stamp, States& states) const {
    for (const Beam& beam : beams_) {
      if (!beam.is_hit) continue;
      const Index<2> end = cell_holding<Dim>(beam.end);
      const Index<2> tile = CellBits::tile_of(end);
      const Offset place = layers.heeding.tiles().offset_of(tile);
      const CellBits::Word cell = CellBits::mask_of(end);
      layers.mark_changed(place, tile, cell);
      typename Cell::State& state = states.open(place, tile, cell)(std::countr_zero(cell));
      policy.hit(state, beam.constants, residual_m(end, beam.range_m + push_m_), stamp);
      const bool is_blocked = Cell::log_odds(state) > blocked_above;
      layers.assign(place, cell, is_blocked ? cell : 0, is_settled(policy, state) ? cell : 0);
    }
  }

  /// Finds the cells that the beams pass and that heed them, in two rounds over all beams, each without a branch that depends
  /// on what is met: which tiles may matter, and which cells of them do.
  void find_heeding(const CellBits& heeding) {
    std::size_t count = 0;
    for (std::size_t b = 0; b < beams_.size(); ++b) {
      const Beam& beam = beams_[b];
      const std::size_t needed = count + static_cast<std::size_t>(beam.walk.tile_columns());
      if (possible_.size() < needed) possible_.resize(2 * needed);
      beam.walk.survey(heeding, [&](int column, bool may_meet) {
        possible_[count] = {static_cast<std::uint32_t>(b), column};
        count += static_cast<std::size_t>(may_meet);
        return true;
      });
    }
    std::size_t met_count = 0;
    met_.resize(std::max(met_.size(), 2 * count + 4));
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t b = possible_[i].beam;
      const int column = possible_[i].column;
      std::array<SegmentWalk::TileCells, 2> found;
      if (beams_[b].walk.find_set(heeding, column, found)) {
        for (const SegmentWalk::TileCells& tile : found) {
          met_[met_count] = {tile, b};
          met_count += static_cast<std::size_t>(tile.cells != 0);
        }
      } else {
        beams_[b].walk.visit_exactly(heeding, column, origin_, beams_[b].end, [&](const SegmentWalk::TileCells& tile) {
          met_[met_count++] = {tile, b};
          return true;
        });
        met_.resize(std::max(met_.size(), met_count + 2 * (count - i) + 4));
      }
    }
    met_.resize(met_count);
  }

  /// What a pass settles may be passed again in the same round, which changes nothing.
  template <class States>
  void write_passes(const Cell& policy, CellLayers<2>& layers, float blocked_above, ScanStamp stamp, States& states) const {
    using Word = CellBits::Word;
    const Grid<Word, 2>& heeding = layers.heeding.tiles();
    for (const Met& met : met_) {
      const auto& [place, tile, found] = met.cells;
      const Beam& beam = beams_[met.beam];
      Word cells = found & heeding[place];  // some may have been settled since
      if constexpr (ClearingPolicy<Cell>) {
        const Word unwritten = cells & ~layers.written.tiles()[place];
        if (unwritten != 0 && is_cleared_by(policy, beam, tile)) {
          layers.mark_changed(place, tile, unwritten);
          states.clear(place, tile, unwritten);
          layers.assign(place, unwritten, 0, unwritten);
          cells &= ~unwritten;
        }
      }
      if (cells == 0) continue;
      layers.mark_changed(place, tile, cells);
      const auto state_of = states.open(place, tile, cells);
      Word ignoring = 0;
      Word blocking = 0;
      for (Word left = cells; left != 0; left &= left - 1U) {
        const int bit = std::countr_zero(left);
        typename Cell::State& state = state_of(bit);
        policy.pass(state, beam.constants, residual_m(CellBits::cell_of(tile, bit), beam.range_m), stamp);
        ignoring |= static_cast<Word>(is_settled(policy, state)) << bit;
        blocking |= static_cast<Word>(Cell::log_odds(state) > blocked_above) << bit;
      }
      layers.assign(place, cells, blocking, ignoring);
    }
  }

  /// Whether a beam clears every cell of a tile that was never written.
  [[nodiscard]] bool is_cleared_by(const Cell& policy, const Beam& beam, const Index<2>& tile) const {
    float farthest2 = 0.0F;  // of the cells' centres from the sensor, in cells, squared
    for (int axis = 0; axis < 2; ++axis) {
      const auto first = static_cast<float>(tile[axis] * CellBits::tile_side + 0.5 - origin_[axis]);
      const float farther = std::max(-first, first + static_cast<float>(CellBits::tile_side - 1));
      farthest2 += farther * farther;
    }
    const float reach = (static_cast<float>(beam.range_m) - policy.clearing_residual_m(beam.constants)) / resolution_m_;
    return reach > 0.0F && farthest2 <= reach * reach;
  }

  /// A range less the distance to the centre of a cell.
  [[nodiscard]] float residual_m(const Index<Dim>& index, double range_m) const {
    float squared = 0.0F;
    for (int axis = 0; axis < Dim; ++axis) {
      const auto way = static_cast<float>(index[axis] + 0.5 - origin_[axis]);
      squared += way * way;
    }
    return static_cast<float>(range_m) - resolution_m_ * std::sqrt(squared);
  }

  Point<Dim> origin_ = zero<Point<Dim>>();  // in lattice coordinates
  float resolution_m_ = 0.0F;
  double push_m_ = 0.0;
  std::vector<Beam> beams_;
  // Scratch of a plane's write.
  struct Possible {
    std::uint32_t beam;
    int column;
  };
  std::vector<Possible> possible_;
  struct Met {
    SegmentWalk::TileCells cells;
    std::uint32_t beam;
  };
  std::vector<Met> met_;
  std::vector<Point<Dim>> directions_;  // of beams that were cast
  double range_max_m_ = 0.0;            // theirs
  ScanReport report_;
};

/// A box that holds every cell that a scan meets, as MapBeams::reach.
template <int Dim>
[[nodiscard]] IndexBox<Dim> cells_in_reach(const Lattice<Dim>& lattice, const Scan<Dim>& scan,
                                           const Pose<Dim>& T_map_sensor, double push_m) {
  const Point<Dim> origin = T_map_sensor.position();
  const Eigen::Matrix<double, Dim, Dim> rotation = T_map_sensor.rotation();
  Box<Point<Dim>> reach{origin, origin};
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) == Reading::invalid) continue;
    const Point<Dim> end = origin + rotation * scan.end_point_m(beam, push_m);
    reach.stretch_to(end);
  }
  return lattice.cells_of(reach).padded(1);
}

}  // namespace incognita
