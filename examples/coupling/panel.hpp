/// Parts of a scene side by side in one picture: the belief, and what is drawn on it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "coupling/scene.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/grid/grid.hpp"
#include "support/drawing.hpp"

namespace coupling {

constexpr examples::Color kInk{0.1, 0.1, 0.1};

/// How strongly a cell is believed to be free (blue) or occupied (red); unknown is grey.
[[nodiscard]] inline examples::Color strength_color(float log_odds) {
  constexpr examples::Color unknown{0.88, 0.88, 0.88};
  constexpr examples::Color free{0.13, 0.40, 0.67};
  constexpr examples::Color occupied{0.70, 0.09, 0.17};
  const examples::Color& end = log_odds < 0.0F ? free : occupied;
  const double share =
      1.0 - std::exp(-std::abs(static_cast<double>(log_odds)) / (log_odds < 0.0F ? 4.0 : 1.5));
  const auto blend = [share](double from, double to) { return from + share * (to - from); };
  return {blend(unknown.red, end.red), blend(unknown.green, end.green), blend(unknown.blue, end.blue)};
}

/// The legend of strength_color.
[[nodiscard]] inline std::vector<examples::LegendEntry> strength_legend() {
  using examples::Swatch;
  return {{"surely free", strength_color(-15.0F), Swatch::area},
          {"perhaps free", strength_color(-2.0F), Swatch::area},
          {"unknown", strength_color(0.0F), Swatch::area},
          {"perhaps occupied", strength_color(0.69F), Swatch::area},
          {"surely occupied", strength_color(5.0F), Swatch::area}};
}

/// Black is occupied, white is free, grey is unknown.
[[nodiscard]] inline examples::Color probability_color(float log_odds) {
  const double light = 1.0 - incognita::probability_of_log_odds(static_cast<double>(log_odds));
  const double grey = 0.15 + 0.85 * light;
  return {grey, grey, grey};
}

/// The part `view_m` of a scene, moved by `shift_m` in the picture.
struct Panel {
  examples::Drawing& drawing;
  Area view_m;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d place(const Eigen::Vector2d& point_m) const { return point_m + shift_m; }

  template <class ColorOf>
  void map(const Map& map, ColorOf&& color_of) const {
    incognita::Grid<float, 2> log_odds(map.lattice(), map.lattice().cells_of(inset(view_m)));
    for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(log_odds.size()); ++cell) {
      log_odds[cell] = map.log_odds(log_odds.index_at(cell));
    }
    drawing.raster(log_odds, {shift_m.x(), shift_m.y(), 0.0}, color_of);
    frame(view_m, kInk, 1.0);
  }

  void frame(const Area& box_m, const examples::Color& color, double width_px) const {
    const Eigen::Vector2d& low = box_m.lower;
    const Eigen::Vector2d& high = box_m.upper;
    line({low, {high.x(), low.y()}, high, {low.x(), high.y()}, low}, color, width_px);
  }

  void line(std::vector<Eigen::Vector2d> points_m, const examples::Color& color, double width_px) const {
    for (Eigen::Vector2d& point_m : points_m) point_m = place(point_m);
    drawing.polyline(points_m, color, width_px);
  }

  void robot(const Eigen::Vector2d& position_m) const { drawing.marker(place(position_m), kInk); }

  /// One standard deviation of the position.
  void ellipse(const incognita::PoseBelief& belief, const examples::Color& color,
               double width_px = 2.0) const {
    drawing.ellipse(place(belief.pose.position()), belief.covariance.topLeftCorner<2, 2>(), 1.0, color,
                    width_px);
  }

  /// Above the upper left corner.
  void title(const std::string& text) const {
    drawing.text(place({view_m.lower.x(), view_m.upper.y()}), text, kInk, 20.0, {2.0, 10.0});
  }

 private:
  /// Keeps faces that coincide with the view's from adding cells outside of it.
  [[nodiscard]] static Area inset(const Area& area_m) {
    const Eigen::Vector2d hair = Eigen::Vector2d::Constant(1e-6);
    return {area_m.lower + hair, area_m.upper - hair};
  }
};

}  // namespace coupling
