/// The pictures of Fig. 5 of Seo et al.: a wall ahead, seen from poses that are known more and less well.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <vector>

#include "coupling/panel.hpp"
#include "coupling/scene.hpp"
#include "coupling/update_strength.hpp"
#include "incognita/sensor/scan.hpp"
#include "support/drawing.hpp"

namespace coupling {

inline void draw_update_maps(const std::filesystem::path& path) {
  const Scene scene({{-3.0, -5.0}, {9.0, 5.0}}, {{{6.0, -3.4}, {6.2, 3.4}}});
  const incognita::Pose2 pose{0.1, 0.1, 0.0};
  // One beam to each cell of the wall, so that a scan hits each of them once.
  incognita::BeamPattern<2> beams;
  for (double y_m = -3.3; y_m < 3.4; y_m += kCell_m) {
    beams.directions.push_back((Eigen::Vector2d(6.1, y_m) - pose.position()).normalized());
  }
  const incognita::Scan<2> scan = scene.scan(pose.position(), beams);

  const Area view_m{{-2.2, -3.6}, {7.0, 3.6}};
  const Eigen::Vector2d pitch_m = view_m.extent() + Eigen::Vector2d(0.6, 1.4);
  constexpr std::array<double, 4> kSigmas_m = {0.1, 0.5, 1.0, 2.0};
  const Eigen::Vector2d last_m(pitch_m.x() * (kSigmas_m.size() - 1), 0.0);
  examples::Drawing drawing(
      {view_m.lower - Eigen::Vector2d(0.0, pitch_m.y()), view_m.upper + last_m + Eigen::Vector2d(0.0, 1.0)},
      1800);
  for (std::size_t column = 0; column < kSigmas_m.size(); ++column) {
    Map map = empty_map(scene);
    for (int scans = 1; scans <= kScans; ++scans) {
      map.update(scan, pose, position_covariance(kSigmas_m[column]));
      if (scans != 1 && scans != kScans) continue;
      const Panel panel{
          drawing, view_m, {pitch_m.x() * static_cast<double>(column), scans == 1 ? 0.0 : -pitch_m.y()}};
      panel.map(map, strength_color);
      panel.ellipse({pose, position_covariance(kSigmas_m[column])}, kInk);
      panel.robot(pose.position());
      std::ostringstream title;
      title << "pose sigma " << kSigmas_m[column] << " m, " << scans << (scans == 1 ? " scan" : " scans");
      panel.title(title.str());
    }
  }
  std::vector<examples::LegendEntry> legend = strength_legend();
  legend.push_back({"robot", kInk, examples::Swatch::dot});
  legend.push_back({"1 sigma of its position", kInk});
  drawing.legend(legend);
  drawing.write_png(path);
}

}  // namespace coupling
