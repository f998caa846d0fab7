/// Scans that are kept with the poses they were taken at, so that a map can be drawn again when poses turn out otherwise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/estimation/map_drift.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// Scans in the order of their time, each tied to a piece of the map (see MapDrift). Memory is bounded: when scans_max are
/// held, every second one is let go, and of those that follow only as many are kept; a map drawn from them then rests on half
/// of the evidence. 4 bytes a beam and 160 a scan, and 24 a beam for each pattern of beams that was ever used.
class KeptScans {
 public:
  /// Throws std::invalid_argument unless scans_max >= 2.
  explicit KeptScans(int scans_max) : scans_max_(static_cast<std::size_t>(scans_max)) {
    require(scans_max >= 2, "KeptScans", "scans_max", scans_max, ">= 2");
  }

  [[nodiscard]] std::size_t size() const { return kept_.size(); }  ///< how many are kept

  /// Keeps a scan taken at `belief`, while its piece was moved by `twist`; or not, when there have been too many.
  void add(const Scan<2>& scan, const PoseBelief& belief, int piece, const Eigen::Vector3d& twist) {
    if (kept_.size() == scans_max_) thin_out();
    if (seen_++ % stride_ != 0) return;
    Kept kept{belief, twist, piece, pattern_of(scan), std::vector<float>(scan.size())};
    for (std::size_t beam = 0; beam < scan.size(); ++beam) kept.ranges_m[beam] = static_cast<float>(scan.range_m(beam));
    kept_.push_back(std::move(kept));
  }

  /// Calls visit(scan, belief) for each scan, in the order of their time, with the pose that it is now known to have been
  /// taken at and the covariance of then. Ranges are those taken, to the precision of a float. O(scans * beams).
  template <class Visit>
  void for_each(const MapDrift& drift, Visit&& visit) const {
    if (kept_.empty()) return;
    Scan<2> scan = patterns_.front();
    std::size_t pattern = 0;
    for (const Kept& kept : kept_) {
      if (kept.pattern != pattern) scan = patterns_[pattern = kept.pattern];
      const double range_max_m = scan.range_max_m();
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        // Exactly the sensor's range means that nothing was met.
        const float range_m = kept.ranges_m[beam];
        scan.set_range_m(beam, range_m == static_cast<float>(range_max_m) ? range_max_m : static_cast<double>(range_m));
      }
      visit(std::as_const(scan), PoseBelief{pose_now(kept, drift), kept.belief.covariance});
    }
  }

  /// The same for the poses alone: visit(pose). O(scans).
  template <class Visit>
  void for_each_pose(const MapDrift& drift, Visit&& visit) const {
    for (const Kept& kept : kept_) visit(pose_now(kept, drift));
  }

  /// How far the piece that was moved farthest since MapDrift::settle has moved a place where a scan was taken. O(scans).
  [[nodiscard]] double unsettled_max_m(const MapDrift& drift) const {
    double farthest_m = 0.0;
    for (const Kept& kept : kept_) {
      farthest_m = std::max(farthest_m, norm(drift.shift_m(kept.piece, kept.belief.pose.position())));
    }
    return farthest_m;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws. Scans must be tied to one of `pieces` pieces of the map.
  template <class Archive>
  void archive_state(Archive& archive, std::size_t pieces) {
    std::size_t patterns = patterns_.size();
    archive(stride_, seen_, patterns);
    if constexpr (Archive::is_loading) {
      archive.claim(patterns, sizeof(Scan<2>));
      patterns_.assign(patterns, Scan<2>(BeamPattern<2>{}));
    }
    for (Scan<2>& pattern : patterns_) archive(pattern);
    archive(kept_);
    archive.require(stride_ >= 1 && kept_.size() <= scans_max_, "more scans are kept than may be");
    for (const Kept& kept : kept_) {
      archive.require(kept.pattern < patterns_.size() && kept.ranges_m.size() == patterns_[kept.pattern].size(),
                      "a scan that was kept has not one range a beam");
      archive.require(kept.piece >= 0 && static_cast<std::size_t>(kept.piece) < pieces, "a scan that was kept is of no piece of the map");
    }
  }

 private:
  struct Kept {
    PoseBelief belief;
    Eigen::Vector3d twist;  // of its piece, when it was taken
    int piece;
    std::size_t pattern;
    std::vector<float> ranges_m;

    template <class Archive>
    void archive_state(Archive& archive) {
      archive(belief, twist, piece, pattern, ranges_m);
    }
  };

  [[nodiscard]] std::size_t pattern_of(const Scan<2>& scan) {
    std::size_t pattern = patterns_.size();
    while (pattern > 0 && !patterns_[pattern - 1].has_beams_of(scan)) --pattern;
    if (pattern > 0) return pattern - 1;
    patterns_.push_back(scan);
    return patterns_.size() - 1;
  }

  [[nodiscard]] static Pose2 pose_now(const Kept& kept, const MapDrift& drift) {
    return moved_pose(kept.belief.pose, difference(drift.twist(kept.piece), kept.twist));
  }

  void thin_out() {
    for (std::size_t i = 0; 2 * i < kept_.size(); ++i) {
      if (i > 0) kept_[i] = std::move(kept_[2 * i]);
    }
    kept_.resize((kept_.size() + 1) / 2);
    stride_ *= 2;
  }

  std::size_t scans_max_;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
  std::vector<Scan<2>> patterns_;  // each kept scan has the beams of one of them
  std::vector<Kept> kept_;
};

}  // namespace incognita
