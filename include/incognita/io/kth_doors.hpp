/// What lies behind the doors of a KTH floor.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/grid/lattice.hpp"
#include "incognita/io/kth_floor.hpp"

namespace incognita::detail {

using Polygon = std::vector<Point<2>>;

/// The corners of a contour, gaps between its segments closed by straight lines.
[[nodiscard]] inline Polygon polygon_of(const KthContour& contour) {
  Polygon corners;
  for (const KthSegment& segment : contour) {
    if (corners.empty() || corners.back() != segment.from_m) corners.push_back(segment.from_m);
    corners.push_back(segment.to_m);
  }
  return corners;
}

/// Whether a point lies inside of a space, by the even-odd rule.
[[nodiscard]] inline bool contains(const KthSpace& space, const Point<2>& point) {
  bool inside = false;
  for (const KthContour& contour : space.contours) {
    const Polygon corners = polygon_of(contour);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point<2>& a = corners[i];
      const Point<2>& b = corners[(i + 1) % corners.size()];
      if ((a.y() <= point.y()) == (b.y() <= point.y())) continue;
      if (a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > point.x()) inside = !inside;
    }
  }
  return inside;
}

/// Where a ray first meets a segment of a space, as a distance in metres.
[[nodiscard]] inline std::optional<double> distance_to(const KthSpace& space, const Point<2>& from_m,
                                                       const Point<2>& direction) {
  std::optional<double> nearest_m;
  for (const KthContour& contour : space.contours) {
    for (const KthSegment& segment : contour) {
      const Point<2> along = segment.to_m - segment.from_m;
      const Point<2> offset = segment.from_m - from_m;
      const double cross = direction.x() * along.y() - direction.y() * along.x();
      const double distance_m = (offset.x() * along.y() - offset.y() * along.x()) / cross;
      const double share = (offset.x() * direction.y() - offset.y() * direction.x()) / cross;
      if (distance_m >= 0.0 && share >= 0.0 && share <= 1.0 && (!nearest_m || distance_m < *nearest_m)) {
        nearest_m = distance_m;
      }
    }
  }
  return nearest_m;
}

/// Finds what lies behind each portal of a floor.
class KthDoors {
 public:
  /// No wall is thicker than this: portals farther apart do not belong together.
  static constexpr double wall_thickness_max_m = 2.0;

  explicit KthDoors(const KthFloor& floor) {
    for (const KthSpace& space : floor.spaces) {
      spaces_.emplace(space.name, &space);
      for (const KthContour& contour : space.contours) {
        for (const KthSegment& segment : contour) {
          if (segment.type == KthSegmentType::portal)
            portals_[{space.name, segment.target}].push_back(&segment);
        }
      }
    }
  }

  /// The passage from a portal of `space` through the wall: a quadrilateral from it to the nearest portal
  /// that leads back or, when there is none, straight to the contour of the room behind it, if it is not in
  /// the midst of that room. Nothing when that room is not on this floor or too far away.
  [[nodiscard]] std::optional<Polygon> passage(const KthSpace& space, const KthSegment& portal) const {
    const Point<2> middle = 0.5 * (portal.from_m + portal.to_m);
    double nearest_m = wall_thickness_max_m;
    const KthSegment* partner = nullptr;
    if (const auto back = portals_.find({portal.target, space.name}); back != portals_.end()) {
      for (const KthSegment* other : back->second) {
        const double distance_m = (0.5 * (other->from_m + other->to_m) - middle).norm();
        if (other != &portal && distance_m <= nearest_m) {
          nearest_m = distance_m;
          partner = other;
        }
      }
    }
    if (partner != nullptr) {
      // The other room sees the door from behind: as a rule its segment runs the other way.
      const bool same_way = (portal.to_m - portal.from_m).dot(partner->to_m - partner->from_m) > 0.0;
      return Polygon{portal.from_m, portal.to_m, same_way ? partner->to_m : partner->from_m,
                     same_way ? partner->from_m : partner->to_m};
    }
    const auto target = spaces_.find(portal.target);
    const Point<2> along = portal.to_m - portal.from_m;
    if (target == spaces_.end() || target->second == &space || along.norm() == 0.0) return std::nullopt;
    if (contains(*target->second, middle))
      return Polygon{portal.from_m, portal.to_m, portal.to_m, portal.from_m};
    const Point<2> normal = Point<2>(along.y(), -along.x()) / along.norm();
    std::optional<Point<2>> through;
    for (const double side : {1.0, -1.0}) {
      const std::optional<double> distance_m = distance_to(*target->second, middle, side * normal);
      if (distance_m && *distance_m <= nearest_m) {
        nearest_m = *distance_m;
        through = side * *distance_m * normal;
      }
    }
    if (!through) return std::nullopt;
    return Polygon{portal.from_m, portal.to_m, portal.to_m + *through, portal.from_m + *through};
  }

 private:
  std::map<std::string, const KthSpace*> spaces_;
  std::map<std::pair<std::string, std::string>, std::vector<const KthSegment*>> portals_;
};

}  // namespace incognita::detail
