/// Paths as chains of straight segments, measured along their length.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// A path in the plane: its corners in metres, the first where it starts. The places on it are known by their
/// distance from the start along the path.
class Polyline {
 public:
  Polyline() = default;  ///< without a point

  /// Through these points, in any frame; O(points).
  explicit Polyline(std::vector<Eigen::Vector2d> points_m) : points_m_(std::move(points_m)) {
    arc_m_.reserve(points_m_.size());
    for (std::size_t i = 0; i < points_m_.size(); ++i) {
      arc_m_.push_back(i == 0 ? 0.0 : arc_m_.back() + distance(points_m_[i], points_m_[i - 1]));
    }
  }

  [[nodiscard]] bool empty() const { return points_m_.empty(); }  ///< whether it has no point
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points_m() const { return points_m_; }  ///< as given
  [[nodiscard]] double length_m() const { return arc_m_.empty() ? 0.0 : arc_m_.back(); }  ///< 0 with one point or none

  /// How far along the path its corner i lies.
  [[nodiscard]] double arc_m(std::size_t i) const { return arc_m_[i]; }

  /// The first corner further along than `along_m`, or the last one. The path must not be empty.
  [[nodiscard]] std::size_t corner_after(double along_m) const {
    const auto after = std::upper_bound(arc_m_.begin(), arc_m_.end(), along_m);
    return std::min(points_m_.size() - 1, static_cast<std::size_t>(after - arc_m_.begin()));
  }

  /// The place `along_m` along the path, or the nearer end. The path must not be empty. O(log corners).
  [[nodiscard]] Eigen::Vector2d point_at(double along_m) const {
    const std::size_t end = corner_after(along_m);
    if (end == 0 || along_m >= arc_m_[end]) return points_m_[end];
    const double share = std::max(0.0, along_m - arc_m_[end - 1]) / (arc_m_[end] - arc_m_[end - 1]);
    return sum(points_m_[end - 1], scaled(difference(points_m_[end], points_m_[end - 1]), share));
  }

  /// How far along the path the place nearest to `point_m` lies, between `from_m` and `to_m` along it; the
  /// first of equals. The path must not be empty. O(corners between).
  [[nodiscard]] double nearest_along_m(const Eigen::Vector2d& point_m, double from_m, double to_m) const {
    double best_along_m = std::clamp(from_m, 0.0, length_m());
    const auto distance2_at = [&](double along_m) {
      const Eigen::Vector2d offset = difference(point_at(along_m), point_m);
      return dot(offset, offset);
    };
    double best_distance2 = distance2_at(best_along_m);
    for (std::size_t end = corner_after(best_along_m); end > 0 && end < points_m_.size(); ++end) {
      if (arc_m_[end - 1] > to_m) break;
      const Eigen::Vector2d segment = difference(points_m_[end], points_m_[end - 1]);
      const double length_m = arc_m_[end] - arc_m_[end - 1];
      if (!(length_m > 0.0)) continue;
      const double ahead_m = dot(difference(point_m, points_m_[end - 1]), segment) / length_m;
      const double low_m = std::max(arc_m_[end - 1], from_m);
      const double high_m = std::max(low_m, std::min(arc_m_[end], to_m));
      const double along_m = std::clamp(arc_m_[end - 1] + ahead_m, low_m, high_m);
      const double distance2 = distance2_at(along_m);
      if (distance2 < best_distance2) {
        best_distance2 = distance2;
        best_along_m = along_m;
      }
    }
    return best_along_m;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(points_m_);
    if constexpr (Archive::is_loading) *this = Polyline(std::move(points_m_));
  }

 private:
  std::vector<Eigen::Vector2d> points_m_;
  std::vector<double> arc_m_;
};

/// Calls visit(place) for places along a path at even distances of at most `spacing_m`, both ends included; for those of the path
/// itself when it has fewer than two corners. Throws std::invalid_argument unless spacing_m is finite and > 0. No allocation.
template <class Visit>
void for_each_place(const Polyline& path, double spacing_m, Visit&& visit) {
  require_positive("for_each_place", "spacing_m", spacing_m);
  if (path.points_m().size() < 2) {
    for (const Eigen::Vector2d& point_m : path.points_m()) visit(point_m);
    return;
  }
  const double steps = std::max(1.0, std::ceil(path.length_m() / spacing_m - 1e-9));
  for (double step = 0.0; step <= steps; step += 1.0) visit(path.point_at(path.length_m() * step / steps));
}

/// The places of for_each_place.
[[nodiscard]] inline std::vector<Eigen::Vector2d> resample_path(const Polyline& path, double spacing_m) {
  std::vector<Eigen::Vector2d> points_m;
  for_each_place(path, spacing_m, [&](const Eigen::Vector2d& point_m) { points_m.push_back(point_m); });
  return points_m;
}

}  // namespace incognita
