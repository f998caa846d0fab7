/// The pictures of Fig. 6 of Seo et al.: what the robot believes after its drives.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "coupling/drive.hpp"
#include "coupling/panel.hpp"
#include "support/drawing.hpp"

namespace coupling {

/// The drives with one scan a metre, one below the other.
inline void draw_drive_maps(const std::filesystem::path& path, const std::vector<Drive>& drives) {
  constexpr examples::Color kEdge{0.95, 0.55, 0.0};
  constexpr double kLeft_m = -8.0;
  constexpr double kRight_m = 20.0;
  constexpr double kTitle_m = 1.2;
  const auto half_height_m = [](const Drive& drive) {
    return drive.surroundings == Surroundings::unknown_empty ? 5.4 : 2.6;
  };
  double height_m = 0.0;
  for (const Drive& drive : drives) {
    if (drive.scans_per_m == 1) height_m += 2.0 * half_height_m(drive) + kTitle_m;
  }
  examples::Drawing drawing({{kLeft_m, -height_m}, {kRight_m, 0.0}}, 1600);
  double top_m = 0.0;
  for (const Drive& drive : drives) {
    if (drive.scans_per_m != 1) continue;
    const Area view_m{{kLeft_m, -half_height_m(drive)}, {kRight_m, half_height_m(drive)}};
    const Panel panel{drawing, view_m, {0.0, top_m - kTitle_m - half_height_m(drive)}};
    top_m -= view_m.extent().y() + kTitle_m;
    panel.map(drive.map, strength_color);
    panel.line({{0.0, view_m.lower.y()}, {0.0, view_m.upper.y()}}, kEdge, 2.5);
    panel.line({{kLeft_m, 0.0}, drive.beliefs.back().pose.position()}, kInk, 1.0);
    for (std::size_t step = 0; step < drive.beliefs.size(); ++step) {
      const incognita::PoseBelief& belief = drive.beliefs[step];
      const double x_m = belief.pose.x_m;
      if (x_m < kLeft_m + 1.0 || std::abs(x_m - 2.0 * std::round(0.5 * x_m)) > 1e-6) continue;
      panel.ellipse(belief, kInk, 2.5);
    }
    panel.robot(drive.beliefs.back().pose.position());
    std::ostringstream title;
    title.precision(3);
    title << "Surroundings " << name_of(drive.surroundings) << ": tr Σ × " << drive.growth();
    panel.title(title.str());
  }
  std::vector<examples::LegendEntry> legend = strength_legend();
  legend.push_back({"1 sigma of the position", kInk});
  legend.push_back({"edge of what was known", kEdge});
  drawing.legend(legend);
  drawing.write_png(path);
}

}  // namespace coupling
