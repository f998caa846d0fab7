/// Floor plans of the KTH campus data set: from XML to a raster.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/core/error.hpp"
#include "incognita/grid/floor_plan.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/kth_doors.hpp"
#include "incognita/io/kth_floor.hpp"
#include "incognita/io/number.hpp"
#include "incognita/io/read_file.hpp"

namespace incognita {

namespace detail {

/// Sets the cells whose centre lies inside of a polygon, by the even-odd rule. O(corners x rows + cells).
inline void fill_polygon(FloorPlan& plan, const Polygon& corners, FloorCell value) {
  const Lattice<2>& lattice = plan.lattice();
  double y_min = std::numeric_limits<double>::infinity();
  double y_max = -y_min;
  for (const Point<2>& corner : corners) {
    y_min = std::min(y_min, lattice.to_cells(corner).y());
    y_max = std::max(y_max, lattice.to_cells(corner).y());
  }
  const int row_first = std::max(static_cast<int>(std::ceil(y_min - 0.5)), plan.box().lower.y());
  const int row_last = std::min(static_cast<int>(std::floor(y_max - 0.5)), plan.box().upper.y() - 1);
  std::vector<double> crossings;
  for (int row = row_first; row <= row_last; ++row) {
    const double y = row + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point<2> a = lattice.to_cells(corners[i]);
      const Point<2> b = lattice.to_cells(corners[(i + 1) % corners.size()]);
      if ((a.y() <= y) != (b.y() <= y))
        crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const int first = std::max(static_cast<int>(std::ceil(crossings[i] - 0.5)), plan.box().lower.x());
      const int last =
          std::min(static_cast<int>(std::ceil(crossings[i + 1] - 0.5)), plan.box().upper.x()) - 1;
      for (int column = first; column <= last; ++column) plan.set({column, row}, value);
    }
  }
}

/// A passage made longer by `margin_m` at both ends, so that it also cuts the lines that the walls are drawn
/// with, and a hair narrower, so that it spares the pixels that its two sides run through.
[[nodiscard]] inline Polygon clearing(const Polygon& passage, double margin_m) {
  const auto cut = [margin_m](const Point<2>& from, const Point<2>& to, double side) {
    const Point<2> along = (to - from).normalized() * margin_m;
    const Point<2> outwards(side * along.y(), -side * along.x());
    return Polygon{from + 0.01 * along + outwards, to - 0.01 * along + outwards};
  };
  const Point<2> backwards = passage[0] + passage[1] - passage[2] - passage[3];
  const Point<2> along = passage[1] - passage[0];
  const double side = along.y() * backwards.x() - along.x() * backwards.y() < 0.0 ? -1.0 : 1.0;
  Polygon cleared = cut(passage[0], passage[1], side);
  for (const Point<2>& corner : cut(passage[2], passage[3], side)) cleared.push_back(corner);
  return cleared;
}

/// An empty plan with room for all of a floor.
[[nodiscard]] inline FloorPlan empty_plan(const KthFloor& floor, double pixel_size_m,
                                          const std::string& source) {
  constexpr double side_max_m = 1000.0;
  constexpr double area_max_px = 1 << 26;
  constexpr double painted_max_px = 1 << 28;
  constexpr int margin_px = 2;
  Point<2> lower = Point<2>::Constant(std::numeric_limits<double>::infinity());
  Point<2> upper = -lower;
  double painted_px = 0.0;
  for (const KthSpace& space : floor.spaces) {
    for (const KthContour& contour : space.contours) {
      Point<2> contour_lower = contour.front().from_m;
      Point<2> contour_upper = contour_lower;
      for (const Point<2>& corner : polygon_of(contour)) {
        contour_lower = contour_lower.cwiseMin(corner);
        contour_upper = contour_upper.cwiseMax(corner);
      }
      painted_px += ((contour_upper - contour_lower) / pixel_size_m).prod();
      lower = lower.cwiseMin(contour_lower);
      upper = upper.cwiseMax(contour_upper);
    }
  }
  const Point<2> extent_m = upper - lower;
  const std::string measures = format_number(extent_m.x()) + " x " + format_number(extent_m.y()) + " m";
  if (!(extent_m.maxCoeff() <= side_max_m)) {
    throw InputError(source, "the floor measures " + measures + ", but must have at most " +
                                 format_number(side_max_m) + " m a side");
  }
  if (!((extent_m / pixel_size_m).prod() <= area_max_px)) {
    throw InputError(source, "the floor measures " + measures + ", which is more than " +
                                 format_number(area_max_px) + " pixels of " + format_number(pixel_size_m) +
                                 " m");
  }
  if (!(painted_px <= painted_max_px)) {
    throw InputError(source, "the spaces lie on each other: together they cover more than " +
                                 format_number(painted_max_px) + " pixels");
  }
  // Multiples of the pixel size are pixel centres: walls of plans that are drawn on such a lattice are then
  // as thick on the left as on the right.
  const Point<2> origin_m = ((lower / pixel_size_m).array().floor() - (margin_px + 0.5)) * pixel_size_m;
  const Lattice<2> lattice(pixel_size_m, origin_m);
  const Index<2> size = lattice.index_of(upper).array() + 1 + margin_px;
  return FloorPlan(lattice, {Index<2>::Zero(), size}, FloorCell::solid);
}

/// Makes the solid cells that touch the floor walls, so that all floor is enclosed by walls: the sides of
/// passages, gaps in contours and portals that lead nowhere become walls too.
inline void enclose_floor(FloorPlan& plan) {
  const Index<2> last = plan.box().upper.array() - 1;
  for (int row = 1; row < last.y(); ++row) {
    for (int column = 1; column < last.x(); ++column) {
      const Offset here = plan.offset_of({column, row});
      if (plan[here] != FloorCell::solid) continue;
      const Offset up = plan.stride(1);
      if (plan[here - 1] == FloorCell::floor || plan[here + 1] == FloorCell::floor ||
          plan[here - up] == FloorCell::floor || plan[here + up] == FloorCell::floor) {
        plan[here] = FloorCell::wall;
      }
    }
  }
}

}  // namespace detail

/// How finely a floor is drawn.
struct KthRasterParams {
  double pixel_size_m = 0.05;  ///< >= 0.001
};

/// Draws a KTH floor as a raster in the file's frame. Each contour is filled with floor, its walls and
/// windows are drawn as lines one pixel wide that no diagonal step slips through, and then the portals are
/// opened, each together with its counterpart in the room behind and the wall between the two. What lies
/// within a wall or outside of all rooms is solid. A portal that leads to no room of this floor is a closed
/// door, and a contour with a gap is closed by a wall. `source` is named in errors. Throws InputError when
/// there is no floor, or when it is too large (1000 m a side, 2^26 pixels), and std::invalid_argument for a
/// bad pixel size. O(pixels + segments x rows).
[[nodiscard]] inline FloorPlan floor_plan_of(const KthFloor& floor, const std::string& source,
                                             const KthRasterParams& params = {}) {
  const double pixel_size_m = params.pixel_size_m;
  require(std::isfinite(pixel_size_m) && pixel_size_m >= 0.001, "KthRasterParams", "pixel_size_m",
          pixel_size_m, "finite and >= 0.001");
  FloorPlan plan = detail::empty_plan(floor, pixel_size_m, source);
  for (const KthSpace& space : floor.spaces) {
    for (const KthContour& contour : space.contours) {
      detail::fill_polygon(plan, detail::polygon_of(contour), FloorCell::floor);
    }
  }

  const auto draw_wall = [&plan](const Point<2>& from_m, const Point<2>& to_m) {
    traverse(plan.lattice(), from_m, to_m,
             [&plan](const Index<2>& index) { plan.set(index, FloorCell::wall); });
  };
  std::vector<detail::Polygon> passages;
  const detail::KthDoors doors(floor);
  for (const KthSpace& space : floor.spaces) {
    for (const KthContour& contour : space.contours) {
      Point<2> end_m = contour.back().to_m;
      for (const KthSegment& segment : contour) {
        if (segment.from_m != end_m) draw_wall(end_m, segment.from_m);
        end_m = segment.to_m;
        std::optional<detail::Polygon> passage;
        if (segment.type == KthSegmentType::portal) passage = doors.passage(space, segment);
        if (passage) {
          passages.push_back(detail::clearing(*passage, pixel_size_m));
        } else {
          draw_wall(segment.from_m, segment.to_m);
        }
      }
    }
  }
  for (const detail::Polygon& passage : passages) detail::fill_polygon(plan, passage, FloorCell::floor);
  detail::enclose_floor(plan);
  if (std::find(plan.values().begin(), plan.values().end(), FloorCell::floor) == plan.values().end()) {
    throw InputError(source, "there is no floor: no space is wider than its walls at pixels of " +
                                 format_number(pixel_size_m) + " m");
  }
  return plan;
}

/// The floor plan that the text of a KTH XML file describes; `source` is named in errors. Throws InputError.
[[nodiscard]] inline FloorPlan read_kth_xml_text(std::string_view xml, const std::string& source,
                                                 const KthRasterParams& params = {}) {
  return floor_plan_of(parse_kth_floor(xml, source), source, params);
}

/// Reads a KTH XML file of at most 8 MiB; see parse_kth_floor and floor_plan_of. Throws InputError.
[[nodiscard]] inline FloorPlan read_kth_xml(const std::filesystem::path& file,
                                            const KthRasterParams& params = {}) {
  return read_kth_xml_text(read_file(file, std::size_t{1} << 23), file.string(), params);
}

}  // namespace incognita
