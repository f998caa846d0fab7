/// Outlines as lines: around the walls of a floor plan, and with no more corners than are seen.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "incognita/geometry/vector.hpp"
#include "incognita/grid/floor_plan.hpp"

namespace examples {

using Points = std::vector<incognita::Point<2>>;

/// The points of a line that are needed to stay within `tolerance_m` of all of them; the first and the last always are. Douglas and Peucker
/// 1973. O(n log n) as a rule, O(n^2) at worst.
[[nodiscard]] inline Points simplified(const Points& points_m, double tolerance_m) {
  if (points_m.size() < 3) return points_m;
  std::vector<char> is_kept(points_m.size(), 0);
  is_kept.front() = is_kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points_m.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const incognita::Point<2> along = incognita::difference(points_m[last], points_m[first]);
    const double length2_m2 = along[0] * along[0] + along[1] * along[1];
    double worst_m = tolerance_m;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const incognita::Point<2> offset = incognita::difference(points_m[i], points_m[first]);
      const double part = length2_m2 > 0.0 ? std::clamp((offset[0] * along[0] + offset[1] * along[1]) / length2_m2, 0.0, 1.0) : 0.0;
      const double apart_m = std::hypot(offset[0] - part * along[0], offset[1] - part * along[1]);
      if (apart_m > worst_m) {
        worst_m = apart_m;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    is_kept[farthest] = 1;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  Points kept;
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    if (is_kept[i] != 0) kept.push_back(points_m[i]);
  }
  return kept;
}

/// Closed lines around the walls of a plan, in the plan's frame, walls on their left; the last point of each is the first. With a tolerance of
/// 0 they follow the sides of the pixels, else they leave them by up to as much. O(cells).
[[nodiscard]] inline std::vector<Points> wall_outlines(const incognita::FloorPlan& plan, double tolerance_m) {
  using incognita::FloorCell;
  using incognita::Index;
  constexpr std::array<std::array<int, 2>, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  if (plan.box().empty()) return {};
  const auto is_wall = [&](int x, int y) {
    const Index<2> cell(x, y);
    return plan.contains(cell) && plan.value(cell) == FloorCell::wall;
  };
  // For each corner of pixels, the directions of the sides that start there.
  incognita::IndexBox<2> corners = plan.box();
  for (int axis = 0; axis < 2; ++axis) ++corners.upper[axis];
  incognita::Grid<std::uint8_t, 2> sides(plan.lattice(), corners);
  const auto add = [&](int x, int y, unsigned direction) {
    std::uint8_t& bits = sides[sides.offset_of(Index<2>(x, y))];
    bits = static_cast<std::uint8_t>(bits | (1U << direction));
  };
  for (int y = plan.box().lower[1]; y < plan.box().upper[1]; ++y) {
    for (int x = plan.box().lower[0]; x < plan.box().upper[0]; ++x) {
      if (!is_wall(x, y)) continue;
      if (!is_wall(x, y - 1)) add(x, y, 0);
      if (!is_wall(x + 1, y)) add(x + 1, y, 1);
      if (!is_wall(x, y + 1)) add(x + 1, y + 1, 2);
      if (!is_wall(x - 1, y)) add(x, y + 1, 3);
    }
  }

  std::vector<Points> outlines;
  const auto point_m = [&](const Index<2>& corner) {
    const auto& origin_m = plan.lattice().origin_m();
    return incognita::Point<2>{origin_m[0] + corner[0] * plan.resolution_m(), origin_m[1] + corner[1] * plan.resolution_m()};
  };
  for (int y = corners.lower[1]; y < corners.upper[1]; ++y) {
    for (int x = corners.lower[0]; x < corners.upper[0]; ++x) {
      while (sides.value(Index<2>(x, y)) != 0) {
        // As many sides end at a corner as start there, so that one can only come to an end where one started.
        Points outline;
        Index<2> corner(x, y);
        unsigned direction = 4;
        while (std::uint8_t& bits = sides[sides.offset_of(corner)]) {
          // To the right first: walls that touch at a corner are one.
          unsigned next = 0;
          if (direction == 4) {
            while ((bits >> next & 1U) == 0) ++next;
          } else {
            for (const unsigned turn : {3U, 0U, 1U, 2U}) {
              next = (direction + turn) % 4;
              if ((bits >> next & 1U) != 0) break;
            }
          }
          if (next != direction) outline.push_back(point_m(corner));
          bits = static_cast<std::uint8_t>(bits & ~(1U << next));
          direction = next;
          corner[0] += steps[next][0];
          corner[1] += steps[next][1];
        }
        outline.push_back(outline.front());
        if (tolerance_m > 0.0) {
          // A ring has no ends to hold on to, so it is cut in two at the point that is farthest from its first.
          const auto from_first = [&](const incognita::Point<2>& point) { return incognita::distance(point, outline.front()); };
          const auto middle = std::max_element(outline.begin(), outline.end(),
                                               [&](const auto& a, const auto& b) { return from_first(a) < from_first(b); });
          Points halves = simplified(Points(outline.begin(), middle + 1), tolerance_m);
          const Points second = simplified(Points(middle, outline.end()), tolerance_m);
          halves.insert(halves.end(), second.begin() + 1, second.end());
          outline = std::move(halves);
        }
        outlines.push_back(std::move(outline));
      }
    }
  }
  return outlines;
}

}  // namespace examples
