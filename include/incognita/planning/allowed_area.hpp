/// Where a robot is allowed to be: bounds and no-go polygons.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "incognita/geometry/polygon.hpp"
#include "incognita/geometry/pose2.hpp"

namespace incognita {

/// What lies in the bounds and in no no-go polygon, in metres in a frame of the user's choice. A plain value; by default, everywhere.
struct AllowedArea {
  Polygon bounds;              ///< no corners: no bounds
  std::vector<Polygon> no_go;  ///< closed polygons, in the frame of `bounds`

  /// Whether nothing is forbidden.
  [[nodiscard]] bool is_everywhere() const { return bounds.empty() && no_go.empty(); }

  /// Throws std::invalid_argument as require_polygon does.
  void validate() const {
    if (!bounds.empty()) require_polygon("AllowedArea", "bounds", bounds);
    for (const Polygon& polygon : no_go) require_polygon("AllowedArea", "no_go", polygon);
  }

  /// How far a place is from the nearest that is not allowed: 0 where it is not itself, infinity without bounds and polygons.
  /// O(corners).
  [[nodiscard]] double clearance_m(const Eigen::Vector2d& place_m) const {
    double nearest_m = std::numeric_limits<double>::infinity();
    if (!bounds.empty()) {
      if (!contains(bounds, place_m)) return 0.0;
      nearest_m = distance_to_outline(bounds, place_m);
    }
    for (const Polygon& polygon : no_go) {
      if (contains(polygon, place_m)) return 0.0;
      nearest_m = std::min(nearest_m, distance_to_outline(polygon, place_m));
    }
    return nearest_m;
  }

  /// The same area in frame a, when this one is in frame b.
  [[nodiscard]] AllowedArea transformed(const Pose2& T_a_b) const {
    AllowedArea area = *this;
    const auto transform = [&](Polygon& polygon) {
      for (Eigen::Vector2d& corner_m : polygon) corner_m = T_a_b * corner_m;
    };
    transform(area.bounds);
    for (Polygon& polygon : area.no_go) transform(polygon);
    return area;
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("bounds, no_go", bounds, no_go);
  }
};

}  // namespace incognita
