/// Whether a scan can have been taken where the robot believes to be.
#pragma once

#include <algorithm>
#include <cstddef>

#include "incognita/core/error.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Parameters of scan_consistency.
struct ConsistencyParams {
  std::size_t beams_max = 60;    ///< so many, evenly chosen, are looked at; >= 1
  double tolerance_m = 0.15;     ///< a surface this near to where a beam ends explains it; see tolerance_cells
  double tolerance_cells = 1.5;  ///< no less than so many cells, whatever tolerance_m: a map knows no surface better, >= 0
  float occupied_above = 2.0F;   ///< log-odds of a cell that is certainly a surface ...
  float free_below = -2.0F;      ///< ... and log-odds of one that is certainly not
  std::size_t beams_min = 12;    ///< fewer that the map can judge say nothing
  double share_min = 0.6;        ///< of the judged beams that must agree with the map, in [0, 1]

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require(beams_max >= 1, "ConsistencyParams", "beams_max", static_cast<int>(beams_max), ">= 1");
    require_positive("ConsistencyParams", "tolerance_m", tolerance_m);
    require_non_negative("ConsistencyParams", "tolerance_cells", tolerance_cells);
    require(occupied_above > 0.0F, "ConsistencyParams", "occupied_above", static_cast<double>(occupied_above), "> 0");
    require(free_below < 0.0F, "ConsistencyParams", "free_below", static_cast<double>(free_below), "< 0");
    require(share_min >= 0.0 && share_min <= 1.0, "ConsistencyParams", "share_min", share_min, "in [0, 1]");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "beams_max, tolerance_m, tolerance_cells, occupied_above, free_below, beams_min, share_min",
        beams_max, tolerance_m, tolerance_cells, occupied_above, free_below, beams_min, share_min);
  }
};

/// How the beams of a scan agree with a map.
struct ScanConsistency {
  std::size_t agreeing = 0;       ///< end where the map has a surface
  std::size_t contradicting = 0;  ///< pass through a surface, or end where there is certainly none

  /// How many beams the map can judge.
  [[nodiscard]] std::size_t judged() const { return agreeing + contradicting; }

  /// Of the beams that the map can judge; 1 when it can judge none.
  [[nodiscard]] double share() const {
    return judged() == 0 ? 1.0 : static_cast<double>(agreeing) / static_cast<double>(judged());
  }

  /// False when enough beams were judged and too few agree: the pose is wrong, or the building has changed, or the
  /// scanner is blinded. Beams into unmapped space are not judged, so new rooms do not matter.
  [[nodiscard]] bool holds(const ConsistencyParams& params) const {
    return judged() < params.beams_min || share() >= params.share_min;
  }
};

/// Compares a scan taken at T_map_sensor with a map that has not taken it. A beam agrees when it ends within the tolerance
/// of the first surface on its way; it contradicts when it passes one, or when all is certainly free where it ends. What it
/// finds in unknown space is not judged. O(beams_max * cells a beam); safe to call from many threads.
template <class MapType>
[[nodiscard]] ScanConsistency scan_consistency(const MapType& map, const Scan<2>& scan, const Pose2& T_map_sensor,
                                               const ConsistencyParams& params = {}) {
  ScanConsistency result;
  const Eigen::Vector2d origin = T_map_sensor.position();
  const Eigen::Matrix2d rotation = T_map_sensor.rotation();
  const double tolerance_m = std::max(params.tolerance_m, params.tolerance_cells * map.lattice().resolution_m());
  const std::size_t stride = std::max<std::size_t>(1, (scan.size() + params.beams_max - 1) / params.beams_max);
  for (std::size_t beam = 0; beam < scan.size(); beam += stride) {
    const Reading reading = scan.reading(beam);
    if (reading == Reading::invalid) continue;
    const double range_m = scan.range_m(beam);
    const Eigen::Vector2d direction = product(rotation, scan.direction(beam));
    bool meets_surface = false;
    bool ends_in_free = true;
    double along_m = 0.0;
    traverse<2>(map.lattice(), origin, sum(origin, scaled(direction, range_m + tolerance_m)),
                [&](const Index<2>& index) {
                  const float log_odds = map.log_odds(index);
                  meets_surface = log_odds > params.occupied_above;
                  if (log_odds < params.free_below) return true;
                  along_m = dot(direction, difference(map.lattice().center_m(index), origin));
                  if (along_m > range_m - tolerance_m) ends_in_free = false;
                  return !meets_surface;
                });
    if (meets_surface && along_m < range_m - tolerance_m) {
      ++result.contradicting;
    } else if (reading == Reading::hit && meets_surface) {
      ++result.agreeing;
    } else if (reading == Reading::hit && ends_in_free) {
      ++result.contradicting;
    }
  }
  return result;
}

}  // namespace incognita
