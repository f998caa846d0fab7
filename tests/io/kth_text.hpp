/// KTH floors as text, for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "incognita/io/number.hpp"

namespace io_test {

/// A corner of a contour and what leads from it to the next one: "Wall", "Window", "" for a gap, or a portal
/// to the room that is named.
struct Corner {
  double x_m;
  double y_m;
  std::string to_next = "Wall";
};

/// Turns and shifts what it writes; files are in centimetres.
class KthText {
 public:
  explicit KthText(double yaw_rad = 0.0, double x_m = 0.0, double y_m = 0.0)
      : yaw_rad_(yaw_rad), x_m_(x_m), y_m_(y_m) {}

  KthText& space(const std::string& name, const std::vector<Corner>& corners) {
    spaces_ += "<space name=\"" + name + "\"><contour><centroid x=\"0\" y=\"0\"/>\n";
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner& from = corners[i];
      const Corner& to = corners[(i + 1) % corners.size()];
      if (from.to_next.empty()) continue;
      const bool is_portal = from.to_next != "Wall" && from.to_next != "Window";
      spaces_ += "<linesegment" + point("1", from) + point("2", to) + " type=\"" +
                 (is_portal ? "Portal" : from.to_next) + "\" target=\"" + (is_portal ? from.to_next : "") +
                 "\"/>\n";
    }
    spaces_ += "</contour></space>\n";
    return *this;
  }

  [[nodiscard]] std::string text() const {
    return "<?xml version=\"1.0\"?>\n<floor>\n<Scale PixelDistance=\"1000\" RealDistance=\"10\"/>\n" +
           spaces_ + "</floor>\n";
  }

 private:
  [[nodiscard]] std::string point(const std::string& suffix, const Corner& corner) const {
    const double c = std::cos(yaw_rad_);
    const double s = std::sin(yaw_rad_);
    return " x" + suffix + "=\"" +
           incognita::format_number(100.0 * (c * corner.x_m - s * corner.y_m + x_m_)) + "\" y" + suffix +
           "=\"" + incognita::format_number(100.0 * (s * corner.x_m + c * corner.y_m + y_m_)) + "\"";
  }

  double yaw_rad_;
  double x_m_;
  double y_m_;
  std::string spaces_;
};

/// Two rooms of 4 x 3 m, left and right of a wall of `wall_m` with a door of 0.8 m in its middle.
/// `left_target` and `right_target` are what stands at the door.
inline KthText two_rooms(KthText text, double wall_m, const std::string& left_target = "right",
                         const std::string& right_target = "left") {
  text.space("left", {{0, 0}, {4, 0}, {4, 1.1, left_target}, {4, 1.9}, {4, 3}, {0, 3, "Window"}});
  const double x = 4 + wall_m;
  return text.space("right", {{x, 0}, {x + 4, 0}, {x + 4, 3}, {x, 3}, {x, 1.9, right_target}, {x, 1.1}});
}

}  // namespace io_test
