/// The information gain of driving along a path: map and pose covariance predicted together (Seo et al., Algorithm 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/estimation/estimator.hpp"
#include "incognita/map/overlay.hpp"
#include "incognita/planning/polyline.hpp"

namespace incognita {

/// How finely scans are predicted along a path. Poses 1 m apart with 60 beams rank candidates as 0.1 m and 360 beams do
/// at 1/26 of the cost (reading of Seo et al.: Spearman 0.98; 2 m cost 7 % regret).
struct GainParams {
  double pose_spacing_m = 1.0;  ///< between predicted scans, > 0
  int beams = 60;               ///< of a predicted scan, >= 1
  double range_max_m = 10.0;    ///< of the robot's sensor
  double speed_m_per_s = 1.0;   ///< of the robot along the path: how much time Q of (7) has
  double scan_rate_hz = 10.0;   ///< of the robot's sensor: how many scans a predicted one stands for

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("GainParams", "pose_spacing_m", pose_spacing_m);
    require(beams >= 1, "GainParams", "beams", beams, ">= 1");
    require_positive("GainParams", "range_max_m", range_max_m);
    require_positive("GainParams", "speed_m_per_s", speed_m_per_s);
    require_positive("GainParams", "scan_rate_hz", scan_rate_hz);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("pose_spacing_m, beams, range_max_m, speed_m_per_s, scan_rate_hz", pose_spacing_m, beams, range_max_m, speed_m_per_s, scan_rate_hz);
  }
};

/// Scratch of one thread, kept from one evaluation to the next.
template <CellPolicy Cell>
struct GainWorkspace {
  Overlay<Cell> overlay;             ///< the predicted map
  BeamPattern<2> beams;              ///< see prepare()
  std::vector<RayObservation> hits;  ///< of the scan predicted last

  /// Makes `beams` those that `params` ask for.
  void prepare(const GainParams& params) {
    const auto count = static_cast<std::size_t>(params.beams);
    if (beams.directions.size() == count && beams.range_max_m == params.range_max_m) return;
    beams = circular_beams(count, params.range_max_m);
  }
};

/// Where a ray enters and leaves a cell that it meets, in metres along its unit direction.
struct RayInterval {
  double enter_m;  ///< 0 where the ray starts inside
  double leave_m;  ///< where it is outside again
};

/// A ray in metres in the lattice's frame, its direction of length 1. O(1).
[[nodiscard]] inline RayInterval ray_through_cell(const Lattice<2>& lattice, const Index<2>& index,
                                                  const Eigen::Vector2d& origin, const Eigen::Vector2d& direction) {
  RayInterval interval{0.0, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double low_m = lattice.origin_m()[axis] + index[axis] * lattice.resolution_m();
    const double per_m = 1.0 / direction[axis];
    const double a = (low_m - origin[axis]) * per_m;
    const double b = a + lattice.resolution_m() * per_m;
    interval.enter_m = std::max(interval.enter_m, std::min(a, b));
    interval.leave_m = std::min(interval.leave_m, std::max(a, b));
  }
  return interval;
}

/// Predicts the scan that `workspace.beams` would read at `position`, in the axes of the map (Overlay::cast). A hit is read in
/// the middle of the beam's way through the blocked cell; a beam whose cell is too near or too far to be measured so is left
/// out. The cells that beams hit go into `workspace.hits`. Throws as Overlay::cast.
template <CellPolicy Cell>
void predict_scan(const Eigen::Vector2d& position, GainWorkspace<Cell>& workspace) {
  Overlay<Cell>& overlay = workspace.overlay;
  const Lattice<2>& lattice = overlay.map().lattice();
  const double push_m = overlay.map().hit_push_m();
  workspace.hits.clear();
  overlay.cast(workspace.beams, position, [&](const Eigen::Vector2d& direction, const Index<2>& index) {
    const RayInterval interval = ray_through_cell(lattice, index, position, direction);
    const double range_m = 0.5 * (interval.enter_m + interval.leave_m) - push_m;
    const Eigen::Vector2d to_cell = difference(lattice.center_m(index), position);
    const double distance_m = norm(to_cell);
    if (!(range_m > 0.0 && range_m < workspace.beams.range_max_m && distance_m > 0.0)) return 0.0;
    workspace.hits.push_back({{to_cell[0] / distance_m, to_cell[1] / distance_m}, range_m + push_m - distance_m,
                              probability_of_log_odds(static_cast<double>(overlay.log_odds(index)))});
    return range_m;
  });
}

/// H(map) - H(map after the scans predicted along `path`), in nats: (16), or (18), BIG, with the entropy table of
/// `Behavioral`. Summed over the cells that the predicted scans touch; the others cancel. At each pose, in this order:
/// motion (7), predicted scan, covariance (11a) given the map so far, cells (15) given that covariance. The path starts
/// at the robot; its first point brings nothing. All within the sensor's range of the path must lie in the map's box
/// (Map::reserve); std::length_error otherwise. The map is the one that workspace.overlay looks at (Overlay::look_at); what
/// the overlay held is forgotten.
/// O(poses * beams * cells a beam).
template <CellPolicy Cell, class Filter>
[[nodiscard]] double information_gain(const EntropyTable& entropy, const Filter& filter, const Polyline& path,
                                      const GainParams& params, GainWorkspace<Cell>& workspace) {
  workspace.prepare(params);
  workspace.overlay.forget();
  PoseBelief belief = filter.belief();
  const auto drive_and_scan = [&](const Eigen::Vector2d& to) {
    const Eigen::Vector2d step = difference(to, belief.pose.position());
    const double duration_s = norm(step) / params.speed_m_per_s;
    const Pose2 next{to[0], to[1], duration_s > 0.0 ? std::atan2(step[1], step[0]) : belief.pose.yaw_rad};
    belief = filter.imagine_motion(belief, belief.pose.inverse() * next, duration_s);
    predict_scan(to, workspace);
    const double scan_count = std::max(1.0, duration_s * params.scan_rate_hz);
    belief = filter.imagine_scan(belief, workspace.hits, workspace.beams.directions.size(), scan_count);
    workspace.overlay.write_cast(belief.covariance);
  };

  bool is_start = true;
  for_each_place(path, params.pose_spacing_m, [&](const Eigen::Vector2d& place_m) {
    if (!std::exchange(is_start, false)) drive_and_scan(place_m);
  });

  const Overlay<Cell>& overlay = workspace.overlay;
  double gain_nats = 0.0;
  if constexpr (ClearingPolicy<Cell>) {
    const double cleared_nats = entropy(Cell::log_odds(typename Cell::State{})) - entropy(Cell::log_odds(overlay.map().cell().cleared()));
    gain_nats += static_cast<double>(overlay.cleared_count()) * cleared_nats;
  }
  overlay.for_each_changed_but_cleared([&](const Index<2>&, const auto& before, const auto& after) {
    gain_nats += entropy(Cell::log_odds(before)) - entropy(Cell::log_odds(after));
  });
  return gain_nats;
}

/// The same, in nats, of a map that the workspace has not looked at yet. O(tiles of the map) more.
template <CellPolicy Cell, class Filter>
[[nodiscard]] double information_gain(const Map<Cell, 2>& map, const EntropyTable& entropy, const Filter& filter,
                                      const Polyline& path, const GainParams& params, GainWorkspace<Cell>& workspace) {
  workspace.overlay.look_at(map);
  return information_gain(entropy, filter, path, params, workspace);
}

}  // namespace incognita
