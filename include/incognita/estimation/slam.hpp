/// A filter and the map that it is coupled with, one scan after the other.
#pragma once

#include <concepts>
#include <utility>

#include "incognita/estimation/estimator.hpp"
#include "incognita/map/map.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// An estimator that keeps its scans and may find out later that they were taken elsewhere, as LoopClosure does.
template <class Filter>
concept RedrawsMaps = requires(Filter& filter) {
  { filter.loops().is_redraw_due() } -> std::same_as<bool>;
};

/// What a scan has done.
struct SlamReport {
  CorrectionReport correction;  ///< of the filter
  ScanReport scan;              ///< of the map; all beams ignored when the correction was not trusted
  bool is_redrawn = false;      ///< the map was drawn again from all scans, after a loop was closed

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(correction, scan, is_redrawn);
  }
};

/// Localisation and mapping, coupled as in Algorithm 1 of Seo et al.: the filter reads the map, then the map takes the scan at
/// the corrected pose, then the filter learns it; a scan that the filter does not trust is ignored. When the filter closes
/// a loop that moves scans noticeably, the map is drawn again from the scans kept, upon what was given at the start.
/// Not thread safe.
template <class MapType, Estimator<MapType> Filter>
class Slam {
 public:
  /// Takes a filter, and a map to start from in the filter's frame.
  explicit Slam(Filter filter, MapType map = MapType{})
      : filter_(std::move(filter)), given_(map), map_(std::move(map)) {}

  [[nodiscard]] const Filter& filter() const { return filter_; }  ///< that locates the robot
  [[nodiscard]] const PoseBelief& belief() const { return filter_.belief(); }  ///< T_map_robot and its covariance
  [[nodiscard]] const MapType& map() const { return map_; }  ///< as the scans that were trusted have it

  /// The robot has moved by `increment`, in its own frame, within duration_s. Throws std::invalid_argument unless the
  /// increment is finite and the duration finite and >= 0; nothing has then changed.
  void move(const Pose2& increment, double duration_s) { filter_.predict(increment, duration_s); }

  /// A scan was taken. See Map::update for bad scans; when it throws (a pose beyond the lattice's reach), the pose has been
  /// corrected and the map is as it was.
  SlamReport observe(const Scan<2>& scan) {
    SlamReport report{filter_.correct(scan, map_), {0, scan.size()}};
    if (!report.correction.trusted) return report;
    report.scan = map_.update(scan, belief().pose, belief().covariance);
    filter_.learn(scan);
    if constexpr (RedrawsMaps<Filter>) {
      report.is_redrawn = filter_.loops().is_redraw_due();
      if (report.is_redrawn) redraw();
    }
    return report;
  }

  /// See Map::reserve.
  void reserve(const Box<Point<2>>& box_m) { map_.reserve(box_m); }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(filter_, given_, map_);
  }

 private:
  /// O(scans kept): about 0.1 ms each.
  void redraw() {
    MapType fresh = given_;
    const IndexBox<2>& box = map_.grid().box();
    if (!box.empty()) {
      const IndexBox<2> last{box.lower, {box.upper[0] - 1, box.upper[1] - 1}};
      fresh.reserve({map_.lattice().center_m(last.lower), map_.lattice().center_m(last.upper)});
    }
    filter_.loops().kept().for_each(filter_.drift(), [&](const Scan<2>& scan, const PoseBelief& belief) {
      (void)fresh.update(scan, belief.pose, belief.covariance);
    });
    map_ = std::move(fresh);
    filter_.loops().redrawn();
  }

  Filter filter_;
  MapType given_;  // what was known before the first scan
  MapType map_;
};

}  // namespace incognita
