/// Polygons in the plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// Corners in order, either way around; the last joins the first. One that crosses itself holds what an odd number of its sides
/// must be crossed to leave.
using Polygon = std::vector<Eigen::Vector2d>;

/// Throws std::invalid_argument unless a polygon has three corners or more, none further than 1e9 from 0 along an axis.
template <class PolygonType>
void require_polygon(std::string_view where, std::string_view field, const PolygonType& polygon) {
  require(polygon.size() >= 3, where, field, static_cast<double>(polygon.size()), "three corners or more");
  for (const auto& corner : polygon) {
    for (int axis = 0; axis < 2; ++axis) {
      require(std::abs(corner[axis]) <= 1e9, where, field, corner[axis], "finite, within 1e9 of 0");
    }
  }
}

/// Whether a place lies in a polygon; on its outline, either. O(corners).
template <class PolygonType>
[[nodiscard]] bool contains(const PolygonType& polygon, const typename PolygonType::value_type& place) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& a = polygon[i];
    const auto& b = polygon[(i + 1) % polygon.size()];
    if ((a[1] > place[1]) == (b[1] > place[1])) continue;
    if (place[0] < a[0] + (b[0] - a[0]) * (place[1] - a[1]) / (b[1] - a[1])) inside = !inside;
  }
  return inside;
}

/// How far a place is from the outline of a polygon, in the unit of both; infinity from that of none. O(corners).
template <class PolygonType>
[[nodiscard]] double distance_to_outline(const PolygonType& polygon, const typename PolygonType::value_type& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto side = difference(polygon[(i + 1) % polygon.size()], polygon[i]);
    const auto way = difference(place, polygon[i]);
    const double length2 = dot(side, side);
    const double share = length2 > 0.0 ? std::clamp(dot(way, side) / length2, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, norm(difference(way, scaled(side, share))));
  }
  return nearest;
}

}  // namespace incognita
