/// A filter that is told its heading at each scan: the orientation aid of Seo et al., section VI-B1.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "incognita/estimation/dvl_ekf.hpp"

namespace experiment {

/// DvlEkf with a measured heading before each correction; without a compass it is DvlEkf.
class HeadingAidedEkf {
 public:
  /// `compass` returns the heading in the map's frame, in rad, with this standard deviation; it may be empty.
  explicit HeadingAidedEkf(incognita::DvlEkf filter = incognita::DvlEkf(), std::function<double()> compass = {}, double sigma_rad = 0.0)
      : filter_(std::move(filter)), compass_(std::move(compass)), sigma_rad_(sigma_rad) {}

  [[nodiscard]] const incognita::PoseBelief& belief() const { return filter_.belief(); }
  [[nodiscard]] bool is_ready() const { return filter_.is_ready(); }
  void predict(const incognita::Pose2& increment, double duration_s) { filter_.predict(increment, duration_s); }

  template <class MapType>
  incognita::CorrectionReport correct(const incognita::Scan<2>& scan, const MapType& map) {
    if (compass_ && is_ready()) filter_.correct_heading(compass_(), sigma_rad_);
    return filter_.correct(scan, map);
  }

  void learn(const incognita::Scan<2>& scan) { filter_.learn(scan); }

  [[nodiscard]] incognita::PoseBelief imagine_motion(const incognita::PoseBelief& belief, const incognita::Pose2& increment,
                                                     double duration_s) const {
    return filter_.imagine_motion(belief, increment, duration_s);
  }

  [[nodiscard]] incognita::PoseBelief imagine_scan(const incognita::PoseBelief& belief, std::span<const incognita::RayObservation> hits,
                                                   std::size_t beam_count, double scan_count) const {
    return filter_.imagine_scan(belief, hits, beam_count, scan_count);
  }

 private:
  incognita::DvlEkf filter_;
  std::function<double()> compass_;
  double sigma_rad_;
};

}  // namespace experiment
