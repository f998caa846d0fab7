/// One scan written into cells: the walk that maps and their overlays share.
#pragma once

#include <algorithm>
#include <cstddef>

#include "incognita/geometry/pose.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// What became of the beams of a scan.
struct ScanReport {
  std::size_t beams_used = 0;
  std::size_t beams_ignored = 0;  ///< NaN, infinite, negative or out of range
};

/// Cells that a scan can be written to: `cells.seen(index)` is a state to look at, `cells.state(index)` one to change.
/// Updates each cell that the scan's valid beams hit or pass, first all hits, then all passes (so the order of the
/// beams does not decide which wins). A hit lies `push_m` behind the measured end point: walls are measured at the face
/// of a cell while h is the distance to its centre (reading of Seo et al., (6)). O(cells passed), no allocation.
template <CellPolicy Cell, int Dim, class Cells>
ScanReport integrate_scan(const Cell& policy, const Lattice<Dim>& lattice, Cells& cells, const Scan<Dim>& scan,
                          const Pose<Dim>& T_map_sensor,
                          const Eigen::Matrix<double, Dim, Dim>& position_covariance_m2, double push_m,
                          ScanStamp stamp) {
  const Point<Dim> origin = T_map_sensor.position();
  const Eigen::Matrix<double, Dim, Dim> rotation = T_map_sensor.rotation();
  const auto variance_along = [&](const Point<Dim>& direction) {
    return std::max(0.0, direction.dot(position_covariance_m2 * direction));
  };
  const auto residual_m = [&](const Index<Dim>& index, double range_m) {
    return static_cast<float>(range_m - (lattice.center_m(index) - origin).norm());
  };

  ScanReport report;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const Reading reading = scan.reading(beam);
    if (reading == Reading::invalid) {
      ++report.beams_ignored;
      continue;
    }
    ++report.beams_used;
    if (reading != Reading::hit) continue;
    const Point<Dim> direction = rotation * scan.direction(beam);
    const double range_m = scan.range_m(beam) + push_m;
    const Index<Dim> index = lattice.index_of(origin + direction * range_m);
    policy.hit(cells.state(index), policy.beam(variance_along(direction)), residual_m(index, range_m), stamp);
  }
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const Reading reading = scan.reading(beam);
    if (reading == Reading::invalid) continue;
    const Point<Dim> direction = rotation * scan.direction(beam);
    const double range_m = scan.range_m(beam);
    const bool is_hit = reading == Reading::hit;
    const Point<Dim> end = origin + direction * (is_hit ? range_m + push_m : range_m);
    const Index<Dim> hit_index = lattice.index_of(end);
    const typename Cell::Beam constants = policy.beam(variance_along(direction));
    traverse<Dim>(lattice, origin, end, [&](const Index<Dim>& index) {
      if (is_hit && index == hit_index) return;
      if (policy.ignores_passes(cells.seen(index))) return;
      policy.pass(cells.state(index), constants, residual_m(index, range_m), stamp);
    });
  }
  return report;
}

/// A box that holds every cell integrate_scan may touch, with a cell to spare on each side: an end point on the face of a
/// cell may be rounded to either side of it.
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
