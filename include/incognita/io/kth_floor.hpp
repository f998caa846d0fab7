/// A floor of a building as the KTH campus data set describes it in XML: rooms as contours of line segments.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/grid/lattice.hpp"
#include "incognita/io/input_error.hpp"
#include "incognita/io/number.hpp"

namespace incognita {

/// What a piece of a room's contour is.
enum class KthSegmentType {
  wall,    ///< solid
  window,  ///< solid too
  portal   ///< a door, or an opening into another room
};

/// A piece of a room's contour, in metres.
struct KthSegment {
  Point<2> from_m;                             ///< in the file's frame
  Point<2> to_m;                               ///< likewise
  KthSegmentType type = KthSegmentType::wall;  ///< what stands there
  std::string target;                          ///< of a portal: the name of the room behind it
};

/// A closed line around (a part of) a room. Where the file leaves a gap between two segments, the contour
/// goes straight across.
using KthContour = std::vector<KthSegment>;

/// A room, a corridor, a staircase.
struct KthSpace {
  std::string name;                  ///< as the file has it; portals name it
  std::vector<KthContour> contours;  ///< outlines; more than one where it has several parts
};

/// A storey.
struct KthFloor {
  std::vector<KthSpace> spaces;  ///< in the order of the file
};

namespace detail {

/// Walks through the XML of a KTH floor, with errors that name the place.
class KthParser {
 public:
  explicit KthParser(const std::string& source) : source_(source) {}

  [[nodiscard]] KthFloor parse(std::string_view xml) {
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_buffer(xml.data(), xml.size());
    if (!result) {
      fail(std::string("not valid XML: ") + result.description() + " at byte " +
           std::to_string(result.offset));
    }
    const pugi::xml_node root = document.child("floor");
    if (!root) fail("is not a KTH floor plan: the outermost element must be floor");
    const pugi::xml_node scale = root.child("Scale");
    if (!scale) fail("Scale is missing");
    meters_per_unit_ = positive(scale, "RealDistance") / positive(scale, "PixelDistance");

    KthFloor floor;
    for (const pugi::xml_node space : root.children("space")) floor.spaces.push_back(parse_space(space));
    if (floor.spaces.empty()) fail("there are no spaces");
    return floor;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { throw InputError(source_, problem); }

  [[nodiscard]] double positive(const pugi::xml_node& node, const char* name) const {
    const std::string_view text = node.attribute(name).value();
    const std::optional<double> value = parse_number(text);
    if (!value || !std::isfinite(*value) || *value <= 0.0) {
      fail(std::string("Scale's ") + name + " is " + shown(text) + ", but must be a number > 0");
    }
    return *value;
  }

  [[nodiscard]] KthSpace parse_space(const pugi::xml_node& node) {
    KthSpace space;
    space.name = node.attribute("name").value();
    for (const pugi::xml_node contour : node.children("contour")) {
      space.contours.push_back(parse_contour(contour, space.name));
    }
    if (space.contours.empty()) fail("space " + shown(space.name) + " has no contour");
    return space;
  }

  [[nodiscard]] KthContour parse_contour(const pugi::xml_node& node, const std::string& space) {
    KthContour contour;
    for (const pugi::xml_node segment : node.children("linesegment")) {
      if (++segments_ > segments_max)
        fail("has more than " + std::to_string(segments_max) + " line segments");
      contour.push_back({{coordinate_m(segment, "x1", space), coordinate_m(segment, "y1", space)},
                         {coordinate_m(segment, "x2", space), coordinate_m(segment, "y2", space)},
                         type_of(segment, space),
                         segment.attribute("target").value()});
    }
    const std::size_t points = count_points(contour);
    if (points < 3) {
      fail("space " + shown(space) + " has a contour of " + std::to_string(points) +
           (points == 1 ? " point" : " points") + ", but must have at least 3");
    }
    return contour;
  }

  /// How many different points a contour has, 3 standing for more.
  [[nodiscard]] static std::size_t count_points(const KthContour& contour) {
    std::vector<Point<2>> points;
    for (const KthSegment& segment : contour) {
      for (const Point<2>& end : {segment.from_m, segment.to_m}) {
        bool known = false;
        for (const Point<2>& point : points) known = known || point == end;
        if (!known) points.push_back(end);
        if (points.size() == 3) return 3;
      }
    }
    return points.size();
  }

  [[nodiscard]] double coordinate_m(const pugi::xml_node& node, const char* name,
                                    const std::string& space) const {
    const std::string_view text = node.attribute(name).value();
    const std::optional<double> value = parse_number(text);
    if (!value || !std::isfinite(*value)) {
      fail("space " + shown(space) + ": " + name + " is " + shown(text) + ", but must be a finite number");
    }
    const double meters = *value * meters_per_unit_;
    if (!(std::abs(meters) <= far_m)) {
      fail("space " + shown(space) + ": " + name + " lies " + format_number(meters) +
           " m away, but must be within " + format_number(far_m) + " m");
    }
    return meters;
  }

  [[nodiscard]] KthSegmentType type_of(const pugi::xml_node& node, const std::string& space) const {
    const std::string_view type = node.attribute("type").value();
    if (type == "Wall") return KthSegmentType::wall;
    if (type == "Window") return KthSegmentType::window;
    if (type == "Portal") return KthSegmentType::portal;
    fail("space " + shown(space) + ": a type is " + shown(type) + ", but must be Wall, Window or Portal");
  }

  static constexpr double far_m = 1e6;
  static constexpr std::size_t segments_max = 20000;

  const std::string& source_;
  double meters_per_unit_ = 1.0;
  std::size_t segments_ = 0;
};

}  // namespace detail

/// Reads the XML text of a KTH floor; `source` is named in errors. Metres are file coordinates times
/// RealDistance / PixelDistance, in the file's frame and y up: the files do not say which way y points, but
/// seen so their contours run counter-clockwise. Throws InputError when the text is malformed, a coordinate
/// is no number, or a space has no contour or one of fewer than three points.
[[nodiscard]] inline KthFloor parse_kth_floor(std::string_view xml, const std::string& source) {
  return detail::KthParser(source).parse(xml);
}

}  // namespace incognita
