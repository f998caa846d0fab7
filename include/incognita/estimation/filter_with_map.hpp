/// A filter that reads a map of its own, so that decisions are made by another.
#pragma once

#include <cstddef>
#include <span>
#include <utility>

#include "incognita/estimation/slam.hpp"

namespace incognita {

/// An estimator that couples `Filter` with a map of type `MapType` that it keeps to itself. The map that it is handed by a Slam or an
/// Explorer is then that of decisions alone, and may have other cells: B1 and B2 of Seo et al., section VI-B3, where frontiers and gains
/// are those of a map that knows nothing of the pose's uncertainty. It costs a second map update a scan.
/// Filters that draw maps again would have to do so with both, so they are refused. Not thread safe.
template <class MapType, Estimator<MapType> Filter>
  requires(!RedrawsMaps<Filter>)
class FilterWithMap {
 public:
  /// Takes a filter, and a map to start from in the filter's frame.
  explicit FilterWithMap(Filter filter = Filter{}, MapType map = MapType{}) : slam_(std::move(filter), std::move(map)) {}

  [[nodiscard]] const MapType& map() const { return slam_.map(); }       ///< that it localises in
  [[nodiscard]] const Filter& filter() const { return slam_.filter(); }  ///< that localises
  [[nodiscard]] const PoseBelief& belief() const { return slam_.belief(); }  ///< in the frame of both maps
  [[nodiscard]] bool is_ready() const { return slam_.filter().is_ready(); }  ///< as the filter is

  /// Throws std::invalid_argument unless the increment is finite and the duration finite and >= 0.
  void predict(const Pose2& increment, double duration_s) { slam_.move(increment, duration_s); }

  /// Corrects the belief by the scan and its own map, which then takes it, as Slam::observe. The map handed over is not read.
  template <class OtherMap>
  CorrectionReport correct(const Scan<2>& scan, const OtherMap& /*map*/) {
    return slam_.observe(scan).correction;
  }

  /// Does nothing: correct() has learned.
  void learn(const Scan<2>& /*scan*/) {}

  /// As the filter.
  [[nodiscard]] PoseBelief imagine_motion(const PoseBelief& belief, const Pose2& increment, double duration_s) const {
    return slam_.filter().imagine_motion(belief, increment, duration_s);
  }

  /// As the filter.
  [[nodiscard]] PoseBelief imagine_scan(const PoseBelief& belief, std::span<const RayObservation> hits, std::size_t beam_count,
                                        double scan_count) const {
    return slam_.filter().imagine_scan(belief, hits, beam_count, scan_count);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(slam_);
  }

 private:
  Slam<MapType, Filter> slam_;
};

}  // namespace incognita
