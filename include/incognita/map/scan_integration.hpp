/// One scan written into cells: the walk that maps and their overlays share.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "incognita/geometry/pose.hpp"
#include "incognita/grid/cell_bits.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// What became of the beams of a scan.
struct ScanReport {
  std::size_t beams_used = 0;
  std::size_t beams_ignored = 0;  ///< NaN, infinite, negative or out of range
};

/// The valid beams of a scan in a map's frame, each with what is constant along it. Keeps its storage from one scan to the
/// next.
template <CellPolicy Cell, int Dim>
class MapBeams {
 public:
  /// Takes a scan's beams, seen from T_map_sensor. A hit lies `push_m` behind the measured end point: walls are measured at
  /// the face of a cell while h is the distance to its centre (reading of Seo et al., (6)). Only the position's covariance
  /// counts: h does not depend on the heading.
  void take(const Cell& policy, const Scan<Dim>& scan, const Pose<Dim>& T_map_sensor,
            const Eigen::Matrix<double, Dim, Dim>& position_covariance_m2, double push_m) {
    origin_m_ = T_map_sensor.position();
    push_m_ = push_m;
    const Eigen::Matrix<double, Dim, Dim> rotation = T_map_sensor.rotation();
    beams_.clear();
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const Reading reading = scan.reading(beam);
      if (reading == Reading::invalid) continue;
      const Point<Dim> direction = rotation * scan.direction(beam);
      const bool is_hit = reading == Reading::hit;
      const double range_m = scan.range_m(beam);
      const double variance_m2 = std::max(0.0, direction.dot(position_covariance_m2 * direction));
      beams_.push_back({origin_m_ + direction * (is_hit ? range_m + push_m : range_m), range_m, is_hit,
                        policy.beam(variance_m2)});
    }
    report_ = {beams_.size(), scan.size() - beams_.size()};
  }

  [[nodiscard]] const ScanReport& report() const { return report_; }

  /// A box that holds every cell that the beams meet, with a cell to spare on each side: an end point on the face of a cell
  /// may be rounded to either side of it.
  [[nodiscard]] IndexBox<Dim> reach(const Lattice<Dim>& lattice) const {
    Box<Point<Dim>> reach_m{origin_m_, origin_m_};
    for (const Beam& beam : beams_) reach_m.stretch_to(beam.end_m);
    return lattice.cells_of(reach_m).padded(1);
  }

  /// Updates each of `cells` that a beam hits or passes, first all hits, then all passes (so the order of the beams does not
  /// decide which wins). O(cells passed), no allocation. cells.state(index) is a state to change. Most cells of most scans
  /// ignore passes; cells.heed(index) is told of those that no longer do. In the plane `cells` knows which do, as words of
  /// CellBits; in space each is asked, cells.seen(index).
  template <class Cells>
  void write(const Cell& policy, const Lattice<Dim>& lattice, Cells& cells, ScanStamp stamp) const {
    const Point<Dim> origin = lattice.to_cells(origin_m_);
    const auto resolution_m = static_cast<float>(lattice.resolution_m());
    const auto residual_m = [&](const Index<Dim>& index, double range_m) {
      float squared = 0.0F;
      for (int axis = 0; axis < Dim; ++axis) {
        const auto way = static_cast<float>(index[axis] + 0.5 - origin[axis]);
        squared += way * way;
      }
      return static_cast<float>(range_m) - resolution_m * std::sqrt(squared);
    };
    for (const Beam& beam : beams_) {
      if (!beam.is_hit) continue;
      const Index<Dim> index = lattice.index_of(beam.end_m);
      typename Cell::State& state = cells.state(index);
      policy.hit(state, beam.constants, residual_m(index, beam.range_m + push_m_), stamp);
      if (!policy.ignores_passes(state)) cells.heed(index);
    }
    for (const Beam& beam : beams_) {
      const Index<Dim> end = lattice.index_of(beam.end_m);
      const auto pass = [&](const Index<Dim>& index) {
        if (beam.is_hit && index == end) return true;
        typename Cell::State& state = cells.state(index);
        policy.pass(state, beam.constants, residual_m(index, beam.range_m), stamp);
        return !policy.ignores_passes(state);
      };
      if constexpr (Dim == 2) {
        traverse_set(lattice, origin_m_, beam.end_m, cells, pass);
      } else {
        traverse<Dim>(lattice, origin_m_, beam.end_m, [&](const Index<Dim>& index) {
          if (!policy.ignores_passes(cells.seen(index))) static_cast<void>(pass(index));
        });
      }
    }
  }

 private:
  struct Beam {
    Point<Dim> end_m;
    double range_m;  // as measured
    bool is_hit;
    typename Cell::Beam constants;
  };

  Point<Dim> origin_m_ = Point<Dim>::Zero();
  double push_m_ = 0.0;
  std::vector<Beam> beams_;
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
