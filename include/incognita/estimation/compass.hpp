/// A heading from the walls: in most buildings they stand at right angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include "incognita/core/angles.hpp"
#include "incognita/core/error.hpp"
#include "incognita/sensor/line_segments.hpp"
#include "incognita/sensor/scan.hpp"

namespace incognita {

/// A turn brought into [-pi/4, pi/4]: two perpendicular directions are one.
[[nodiscard]] inline double wrap_quarter_turn_rad(double angle_rad) {
  return std::remainder(angle_rad, 0.5 * std::numbers::pi);
}

/// The dominant direction of the walls in a scan.
struct WallDirection {
  double angle_rad;             ///< in the sensor's frame, a quarter turn's multiple apart from its equals
  double noise_variance_rad2;   ///< of that angle, from the noise of the ranges
  double walls_variance_rad2;   ///< of that angle, from walls that are off the right angle
  double wall_scatter_rad2;     ///< how far one wall is off, squared, as this scan has it; may be negative
  std::size_t walls;            ///< the pieces that stand parallel or perpendicular to it ...
  double share;                 ///< ... and their share of the straight pieces' length
};

/// Parameters of wall_direction and Compass.
struct CompassParams {
  LineSegmentParams segments;       ///< which walls are looked at
  double wall_sigma_rad = 0.01;     ///< how far walls are off the right angle, before the building has shown it ...
  double wall_sigma_walls = 50;     ///< ... by more walls than so many, a weight in walls, >= 1
  double inlier_max_rad = 0.05;     ///< a wall this near to the dominant direction belongs to it
  double length_min_m = 3.0;        ///< of all straight pieces together: less says nothing
  double share_min = 0.6;           ///< below, a scan, or the building, has no dominant direction
  /// Scans of the same walls repeat their errors: how many scans count as one, >= 1. 100 are 10 s before the same walls.
  double scans_a_view = 100;

  /// Throws std::invalid_argument for values outside of their bounds.
  void validate() const {
    segments.validate();
    require_positive("CompassParams", "wall_sigma_rad", wall_sigma_rad);
    require_positive("CompassParams", "inlier_max_rad", inlier_max_rad);
    require_positive("CompassParams", "length_min_m", length_min_m);
    require(share_min > 0.0 && share_min <= 1.0, "CompassParams", "share_min", share_min, "in (0, 1]");
    require(wall_sigma_walls >= 1.0, "CompassParams", "wall_sigma_walls", wall_sigma_walls, ">= 1");
    require(scans_a_view >= 1.0, "CompassParams", "scans_a_view", scans_a_view, ">= 1");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields(
        "segments, wall_sigma_rad, wall_sigma_walls, inlier_max_rad, length_min_m, share_min, scans_a_view",
        segments, wall_sigma_rad, wall_sigma_walls, inlier_max_rad, length_min_m, share_min, scans_a_view);
  }
};

/// The direction that most of the straight pieces' length is parallel or perpendicular to, refined over those that are.
/// wall_variance_rad2 is how far a wall of this building is off, squared. None when the pieces are too short together.
/// O(pieces^2), of which there are some tens.
[[nodiscard]] inline std::optional<WallDirection> wall_direction(const std::vector<LineSegment>& segments,
                                                                 double wall_variance_rad2,
                                                                 const CompassParams& params) {
  // The first guess is the piece that most length agrees with.
  WallDirection found{};
  double length_m = 0.0;
  double most_m = 0.0;
  for (const LineSegment& guess : segments) {
    length_m += guess.length_m;
    double agreeing_m = 0.0;
    for (const LineSegment& segment : segments) {
      const double off_rad = wrap_quarter_turn_rad(segment.angle_rad - guess.angle_rad);
      if (std::abs(off_rad) <= params.inlier_max_rad) agreeing_m += segment.length_m;
    }
    if (agreeing_m <= most_m) continue;
    most_m = agreeing_m;
    found.angle_rad = guess.angle_rad;
  }
  if (length_m < params.length_min_m) return std::nullopt;
  for (int pass = 0; pass < 2; ++pass) {
    found = {found.angle_rad, 0.0, 0.0, 0.0, 0, 0.0};
    double turn = 0.0;
    double information = 0.0;
    for (const LineSegment& segment : segments) {
      const double off_rad = wrap_quarter_turn_rad(segment.angle_rad - found.angle_rad);
      if (std::abs(off_rad) > params.inlier_max_rad) continue;
      const double weight = 1.0 / (segment.variance_rad2 + wall_variance_rad2);
      turn += weight * off_rad;
      information += weight;
      found.noise_variance_rad2 += weight * weight * segment.variance_rad2;
      found.walls_variance_rad2 += weight * weight * wall_variance_rad2;
      found.wall_scatter_rad2 += off_rad * off_rad - segment.variance_rad2;
      found.share += segment.length_m / length_m;
      ++found.walls;
    }
    if (found.walls == 0) return std::nullopt;
    found.noise_variance_rad2 /= information * information;
    found.walls_variance_rad2 /= information * information;
    found.wall_scatter_rad2 /= static_cast<double>(found.walls);
    found.angle_rad = wrap_quarter_turn_rad(found.angle_rad + turn / information);
  }
  return found;
}

/// Keeps the direction of a building's walls in the map's frame and measures headings by it. The first scan that has a
/// direction gives it, and the mean over all that agree within inlier_max_rad, because the first may have seen walls that are
/// a little off. A robot that starts in the lesser of two wings gets no headings in the greater. Silent for
/// scans without a dominant direction, and while the building has none: two wings at an angle have one each, and it has
/// none. Not thread safe.
class Compass {
 public:
  /// A heading and its variance.
  struct Heading {
    double yaw_rad;        ///< of the robot in the map's frame, in (-pi, pi]
    double variance_rad2;  ///< of the ranges' noise and of walls off the right angle

    /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
    template <class Archive>
    void archive_state(Archive& archive) {
      archive(yaw_rad, variance_rad2);
    }
  };

  Compass() = default;  ///< with the default parameters

  /// Throws std::invalid_argument for parameters outside of their bounds.
  explicit Compass(const CompassParams& params) : params_(params) { params_.validate(); }

  /// The heading that the walls in `scan` give to a robot that believes in yaw_rad; none when they give none. Learns from the
  /// scan.
  [[nodiscard]] std::optional<Heading> measure(const Scan<2>& scan, double yaw_rad) {
    find_line_segments(scan, params_.segments, segments_);
    const std::optional<WallDirection> seen = wall_direction(segments_, wall_variance_rad2(), params_);
    if (!seen) return std::nullopt;
    const auto walls = static_cast<double>(seen->walls);
    walls_ += walls;
    wall_scatter_rad2_ += (seen->wall_scatter_rad2 - wall_scatter_rad2_) * walls / walls_;
    const double in_map_rad = yaw_rad + seen->angle_rad;
    const bool is_first = measurements_ == 0.0;
    const double turn_rad = is_first ? 0.0 : wrap_quarter_turn_rad(direction_rad_ - in_map_rad);
    const bool is_along = std::abs(turn_rad) <= params_.inlier_max_rad;
    scans_ += 1.0;
    share_ += ((is_along ? seen->share : 0.0) - share_) / scans_;
    if (!is_along || seen->share < params_.share_min || share_ < params_.share_min) return std::nullopt;

    measurements_ += 1.0;
    if (is_first) {
      direction_rad_ = in_map_rad;
      return std::nullopt;
    }
    const double variance_rad2 = params_.scans_a_view * (seen->noise_variance_rad2 + seen->walls_variance_rad2);
    const Heading heading{wrap_angle_rad(yaw_rad + turn_rad), variance_rad2 * measurements_ / (measurements_ - 1.0)};
    direction_rad_ -= turn_rad / measurements_;
    return heading;
  }

  /// The share of straight walls that stand parallel or perpendicular to the building's dominant direction, a mean over all
  /// scans with enough of them; 0 before the first. Scans with another dominant direction count as 0; before the building has
  /// one, scans count with their own.
  [[nodiscard]] double share() const { return share_; }

  /// How far a wall of this building is off the right angle, squared: from what was seen, and from wall_sigma_rad as if it
  /// had been seen at wall_sigma_walls of them.
  [[nodiscard]] double wall_variance_rad2() const {
    const double assumed_rad2 = params_.wall_sigma_rad * params_.wall_sigma_rad;
    const double sum_rad2 = params_.wall_sigma_walls * assumed_rad2 + walls_ * std::max(0.0, wall_scatter_rad2_);
    return sum_rad2 / (params_.wall_sigma_walls + walls_);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive.check("compass", params_);
    archive(scans_, share_, walls_, wall_scatter_rad2_, measurements_, direction_rad_);
  }

 private:
  CompassParams params_;
  std::vector<LineSegment> segments_;  // scratch
  double scans_ = 0.0;
  double share_ = 0.0;
  double walls_ = 0.0;  // seen so far, each as often as it was seen
  double wall_scatter_rad2_ = 0.0;
  double measurements_ = 0.0;
  double direction_rad_ = 0.0;  // in the map's frame, the mean over the measurements
};

}  // namespace incognita
