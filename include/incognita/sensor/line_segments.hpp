/// The straight pieces of a planar scan.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/vector.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// A line through consecutive end points.
struct LineSegment {
  double angle_rad;      ///< of the line in the sensor's frame, in [-pi/2, pi/2]
  double variance_rad2;  ///< of that angle, from the noise of the ranges
  double length_m;       ///< from its first end point to its last
};

/// What counts as straight.
struct LineSegmentParams {
  double gap_max_m = 0.5;         ///< between neighbouring end points of a piece
  double deviation_max_m = 0.04;  ///< of an end point from the chord: four times the noise of a usual range
  double length_min_m = 0.6;      ///< shorter pieces are left out
  int points_min = 6;             ///< >= 5
  double noise_m = 0.01;          ///< of an end point, at least

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    require_positive("LineSegmentParams", "gap_max_m", gap_max_m);
    require_positive("LineSegmentParams", "deviation_max_m", deviation_max_m);
    require_positive("LineSegmentParams", "length_min_m", length_min_m);
    require(points_min >= 5, "LineSegmentParams", "points_min", points_min, ">= 5");
    require_positive("LineSegmentParams", "noise_m", noise_m);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("gap_max_m, deviation_max_m, length_min_m, points_min, noise_m", gap_max_m, deviation_max_m, length_min_m, points_min, noise_m);
  }
};

/// Fits a line to the end points [first, last] by total least squares; the variance is that of the slope of a regression,
/// sigma^2 / sum t^2, with the residuals' own sigma where it is larger than noise_m.
[[nodiscard]] inline LineSegment fit_line_segment(const Scan<2>& scan, std::size_t first, std::size_t last,
                                                  double noise_m) {
  const double count = static_cast<double>(last - first + 1);
  Point<2> mean{0.0, 0.0};
  for (std::size_t beam = first; beam <= last; ++beam) mean = sum(mean, scaled(scan.end_point_m(beam), 1.0 / count));
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t beam = first; beam <= last; ++beam) {
    const Point<2> offset = difference(scan.end_point_m(beam), mean);
    xx += offset[0] * offset[0];
    xy += offset[0] * offset[1];
    yy += offset[1] * offset[1];
  }
  const double half_difference = std::hypot(0.5 * (xx - yy), xy);
  const double along_m2 = 0.5 * (xx + yy) + half_difference;
  const double across_m2 = std::max(0.0, 0.5 * (xx + yy) - half_difference) / (count - 2.0);
  return {0.5 * std::atan2(2.0 * xy, xx - yy), std::max(across_m2, noise_m * noise_m) / along_m2,
          distance(scan.end_point_m(first), scan.end_point_m(last))};
}

namespace detail {

/// Splits [first, last] at the end point farthest from the chord until the pieces are straight.
inline void split_into_segments(const Scan<2>& scan, std::size_t first, std::size_t last,
                                const LineSegmentParams& params, std::vector<LineSegment>& segments) {
  if (last - first + 1 < static_cast<std::size_t>(params.points_min)) return;
  const Point<2> from = scan.end_point_m(first);
  const Point<2> chord = difference(scan.end_point_m(last), from);
  const double length_m = norm(chord);
  double farthest_m = params.deviation_max_m;
  std::size_t split = first;
  for (std::size_t beam = first + 1; beam < last; ++beam) {
    const Point<2> offset = difference(scan.end_point_m(beam), from);
    const double across_m =
        length_m > 0.0 ? std::abs(chord[0] * offset[1] - chord[1] * offset[0]) / length_m : norm(offset);
    if (across_m <= farthest_m) continue;
    farthest_m = across_m;
    split = beam;
  }
  if (split != first) {
    split_into_segments(scan, first, split, params, segments);
    split_into_segments(scan, split, last, params, segments);
  } else if (length_m >= params.length_min_m) {
    // The ends belong to corners: the deviation that is allowed hides some of the next wall there.
    const std::size_t margin = 1 + (last - first) / 12;
    segments.push_back(fit_line_segment(scan, first + margin, last - margin, params.noise_m));
    segments.back().length_m = length_m;
  }
}

}  // namespace detail

/// The straight pieces of a scan whose beams are in order of their angle, into `segments` (cleared first; scratch that
/// keeps its memory), by splitting runs of neighbouring hits (Douglas and Peucker 1973). O(n log n) as a rule, O(n^2) at
/// worst.
inline void find_line_segments(const Scan<2>& scan, const LineSegmentParams& params, std::vector<LineSegment>& segments) {
  segments.clear();
  std::size_t first = 0;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) != Reading::hit) {
      first = beam + 1;
      continue;
    }
    const bool last = beam + 1 == scan.size() || scan.reading(beam + 1) != Reading::hit ||
                      distance(scan.end_point_m(beam), scan.end_point_m(beam + 1)) > params.gap_max_m;
    if (!last) continue;
    detail::split_into_segments(scan, first, beam, params, segments);
    first = beam + 1;
  }
}

}  // namespace incognita
