/// The convex hull of a point and of a disc.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "incognita/core/floor.hpp"
#include "incognita/geometry/box.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// The convex hull of a point and of a disc: what must be free for the point to be seen from all of the disc, and where a robot
/// that turns towards a goal may come by on its way.
class DiscHull {
 public:
  using Point = Eigen::Vector2d;  ///< in the plane, in any unit

  /// The radius, in the unit of the points, must be >= 0.
  DiscHull(const Point& apex, const Point& center, double radius)
      : apex_(apex), center_(center), radius_(radius) {
    const Point way = difference(center, apex);
    const double distance2 = dot(way, way);
    has_tangents_ = distance2 > radius * radius;
    if (!has_tangents_) return;
    // The points where the lines from the apex touch the disc.
    const double along = (distance2 - radius * radius) / distance2;
    const double aside = radius * std::sqrt(distance2 - radius * radius) / distance2;
    touching_[0] = {apex[0] + along * way[0] - aside * way[1], apex[1] + along * way[1] + aside * way[0]};
    touching_[1] = {apex[0] + along * way[0] + aside * way[1], apex[1] + along * way[1] - aside * way[0]};
  }

  [[nodiscard]] const Point& apex() const { return apex_; }  ///< the point beside the disc
  [[nodiscard]] const Point& center() const { return center_; }  ///< of the disc
  [[nodiscard]] double radius() const { return radius_; }  ///< of the disc, in the unit of its points

  /// The smallest box around it, with sides along the axes.
  [[nodiscard]] Box<Point> box() const {
    Box<Point> box{{center_[0] - radius_, center_[1] - radius_}, {center_[0] + radius_, center_[1] + radius_}};
    box.stretch_to(apex_);
    return box;
  }

  /// How far it is from a box, in the unit of the points; 0 where they overlap.
  [[nodiscard]] double distance_to(const Box<Point>& box) const {
    double least = std::max(0.0, distance_between(center_, box) - radius_);
    if (!has_tangents_ || least == 0.0) return least;
    // Beyond the disc there is the triangle of the apex and of the points where its tangents touch the disc.
    for (const Point& touching : touching_) least = std::min(least, distance_between(apex_, touching, box));
    const Point middle(0.5 * (box.lower[0] + box.upper[0]), 0.5 * (box.lower[1] + box.upper[1]));
    return triangle_holds(middle) ? 0.0 : least;
  }

  /// In lattice coordinates: calls visit(y, first, last) for each row of cells with the first and the last of its cells of which
  /// the hull overlaps more than a sliver (1e-9 of a cell), until visit returns false; returns whether it never did. O(rows).
  template <class Visit>
  bool for_each_row(Visit&& visit) const {
    constexpr double sliver = 1e-9;
    const double low = std::min(apex_[1], center_[1] - radius_);
    const double high = std::max(apex_[1], center_[1] + radius_);
    const int last_row = floor_to_int(std::max(high - sliver, low));
    // x is a concave function of y on the right side, so it is largest in a row where the row is nearest to its peak.
    const double right_peak = apex_[0] >= center_[0] + radius_ ? apex_[1] : center_[1];
    const double left_peak = apex_[0] <= center_[0] - radius_ ? apex_[1] : center_[1];
    for (int row = floor_to_int(std::min(low + sliver, high)); row <= last_row; ++row) {
      const double from = std::max(low, static_cast<double>(row));
      const double to = std::min(high, row + 1.0);
      const double left = side(std::clamp(left_peak, from, to), -1.0);
      const double right = side(std::clamp(right_peak, from, to), 1.0);
      const int first = floor_to_int(std::min(left + sliver, right));
      const int last = floor_to_int(std::max(right - sliver, left));
      if (!visit(row, first, last)) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] static double distance_between(const Point& point, const Box<Point>& box) {
    double squared = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double off = std::max({box.lower[axis] - point[axis], point[axis] - box.upper[axis], 0.0});
      squared += off * off;
    }
    return std::sqrt(squared);
  }

  [[nodiscard]] static double distance_between(const Point& point, const Point& from, const Point& to) {
    const Point way = difference(to, from);
    const double length2 = dot(way, way);
    const double share = length2 > 0.0 ? std::clamp(dot(difference(point, from), way) / length2, 0.0, 1.0) : 0.0;
    return distance(point, sum(from, scaled(way, share)));
  }

  /// Of a segment from a box.
  [[nodiscard]] static double distance_between(const Point& from, const Point& to, const Box<Point>& box) {
    if (crosses(from, to, box)) return 0.0;
    double least = std::min(distance_between(from, box), distance_between(to, box));
    for (const double x : {box.lower[0], box.upper[0]}) {
      for (const double y : {box.lower[1], box.upper[1]}) least = std::min(least, distance_between(Point(x, y), from, to));
    }
    return least;
  }

  [[nodiscard]] static bool crosses(const Point& from, const Point& to, const Box<Point>& box) {
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double way = to[axis] - from[axis];
      if (way == 0.0) {
        if (from[axis] < box.lower[axis] || from[axis] > box.upper[axis]) return false;
        continue;
      }
      const double a = (box.lower[axis] - from[axis]) / way;
      const double b = (box.upper[axis] - from[axis]) / way;
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
  }

  [[nodiscard]] bool triangle_holds(const Point& point) const {
    const auto turn = [](const Point& a, const Point& b, const Point& c) {
      return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    };
    const double first = turn(apex_, touching_[0], point);
    const double second = turn(touching_[0], touching_[1], point);
    const double third = turn(touching_[1], apex_, point);
    // Strictly: of a triangle without width nothing is inside, but all points of its line would not be outside.
    return (first > 0.0 && second > 0.0 && third > 0.0) || (first < 0.0 && second < 0.0 && third < 0.0);
  }

  /// The x of the hull's right (left) side, sign 1 (-1), at a height.
  [[nodiscard]] double side(double y, double sign) const {
    double best = -1e300;
    const double above = y - center_[1];
    if (std::abs(above) <= radius_) best = sign * center_[0] + std::sqrt(radius_ * radius_ - above * above);
    if (has_tangents_) {
      for (const Point& touching : touching_) best = std::max(best, tangent_side(y, sign, touching));
    }
    return sign * std::max(best, y == apex_[1] ? sign * apex_[0] : -1e300);
  }

  [[nodiscard]] double tangent_side(double y, double sign, const Point& touching) const {
    const double low = std::min(apex_[1], touching[1]);
    const double high = std::max(apex_[1], touching[1]);
    if (y < low || y > high) return -1e300;
    if (high - low < 1e-12) return std::max(sign * apex_[0], sign * touching[0]);
    return sign * (apex_[0] + (touching[0] - apex_[0]) * ((y - apex_[1]) / (touching[1] - apex_[1])));
  }

  Point apex_;
  Point center_;
  double radius_;
  bool has_tangents_;
  std::array<Point, 2> touching_;
};

}  // namespace incognita
