/// Beam patterns and range scans, in two and three dimensions.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/lattice.hpp"

namespace incognita {

/// The beams of a range sensor. A reading of exactly range_max_m means that nothing was met within the range.
template <int Dim>
struct BeamPattern {
  std::vector<Point<Dim>> directions;  ///< unit vectors in the sensor's frame, one a beam
  double range_min_m = 0.0;            ///< shorter readings are ignored
  double range_max_m = 10.0;           ///< a reading of this much met nothing

  /// Throws std::invalid_argument unless 0 <= range_min_m < range_max_m, finite, and each direction has length 1
  /// within 1e-6.
  void validate() const {
    require_non_negative("BeamPattern", "range_min_m", range_min_m);
    require(std::isfinite(range_max_m) && range_max_m > range_min_m, "BeamPattern", "range_max_m", range_max_m,
            "finite and > range_min_m");
    for (const Point<Dim>& direction : directions) {
      const double length = norm(direction);
      require(std::abs(length - 1.0) <= 1e-6, "BeamPattern", "length of a direction", length, "1 within 1e-6");
    }
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(directions, range_min_m, range_max_m);
  }
};

/// Beams in the plane, the first at first_rad from the sensor's x axis, counter-clockwise for increment_rad > 0. Throws
/// std::invalid_argument for a range that is not finite and > 0 and for angles that are not finite.
[[nodiscard]] inline BeamPattern<2> planar_beams(std::size_t count, double first_rad, double increment_rad,
                                                 double range_max_m) {
  BeamPattern<2> beams;
  beams.range_max_m = range_max_m;
  beams.directions.reserve(count);
  for (std::size_t beam = 0; beam < count; ++beam) {
    const double angle_rad = first_rad + increment_rad * static_cast<double>(beam);
    beams.directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad));
  }
  beams.validate();
  return beams;
}

/// `count` beams evenly around the sensor, the first along its x axis.
[[nodiscard]] inline BeamPattern<2> circular_beams(std::size_t count, double range_max_m) {
  return planar_beams(count, 0.0, 2.0 * std::numbers::pi / static_cast<double>(count), range_max_m);
}

/// What a reading says.
enum class Reading {
  hit,     ///< a surface at that range
  clear,   ///< range_max_m exactly: nothing within the range
  invalid  ///< NaN, infinite, negative, zero, below range_min_m or above range_max_m: to be ignored
};

/// One reading a beam, taken at one instant.
template <int Dim>
class Scan {
 public:
  /// Every beam reads range_max_m until told otherwise. Throws std::invalid_argument for a bad pattern.
  explicit Scan(BeamPattern<Dim> beams) : beams_(std::move(beams)) {
    beams_.validate();
    ranges_m_.assign(beams_.directions.size(), beams_.range_max_m);
  }

  /// Throws std::invalid_argument for a bad pattern or another number of ranges than beams.
  Scan(BeamPattern<Dim> beams, std::vector<double> ranges_m) : Scan(std::move(beams)) {
    if (ranges_m.size() != size()) {
      throw std::invalid_argument("Scan: " + std::to_string(ranges_m.size()) + " ranges for " +
                                  std::to_string(size()) + " beams, but must be as many");
    }
    ranges_m_ = std::move(ranges_m);
  }

  [[nodiscard]] std::size_t size() const { return ranges_m_.size(); }  ///< the number of beams
  [[nodiscard]] double range_max_m() const { return beams_.range_max_m; }  ///< what a beam reads that met nothing
  /// Of length 1, in the sensor's frame.
  [[nodiscard]] const Point<Dim>& direction(std::size_t beam) const { return beams_.directions[beam]; }
  [[nodiscard]] double range_m(std::size_t beam) const { return ranges_m_[beam]; }  ///< as read, whatever it is
  void set_range_m(std::size_t beam, double range_m) { ranges_m_[beam] = range_m; }  ///< takes any number

  /// Whether the other scan comes from beams with the same directions and ranges. O(beams).
  [[nodiscard]] bool has_beams_of(const Scan& other) const {
    if (size() != other.size() || beams_.range_min_m != other.beams_.range_min_m ||
        beams_.range_max_m != other.beams_.range_max_m) {
      return false;
    }
    for (std::size_t beam = 0; beam < size(); ++beam) {
      if (!equal(direction(beam), other.direction(beam))) return false;
    }
    return true;
  }

  /// What a beam's range means.
  [[nodiscard]] Reading reading(std::size_t beam) const {
    const double range_m = ranges_m_[beam];
    if (!(range_m > 0.0) || range_m < beams_.range_min_m || range_m > beams_.range_max_m) return Reading::invalid;
    return range_m < beams_.range_max_m ? Reading::hit : Reading::clear;
  }

  /// Where a beam ends in the sensor's frame, its range lengthened by extra_m.
  [[nodiscard]] Point<Dim> end_point_m(std::size_t beam, double extra_m = 0.0) const {
    return scaled(direction(beam), range_m(beam) + extra_m);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(beams_, ranges_m_);
    if constexpr (Archive::is_loading) beams_.validate();
    archive.require(ranges_m_.size() == beams_.directions.size(), "a scan has not one range a beam");
  }

 private:
  BeamPattern<Dim> beams_;
  std::vector<double> ranges_m_;
};

}  // namespace incognita
