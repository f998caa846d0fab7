/// The curves of Figs. 6 and 7 of Isleyen et al., and the ways that the robots drove.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "office_exploration/averages.hpp"
#include "support/chart.hpp"
#include "support/drawing.hpp"
#include "support/exploration_names.hpp"

namespace office_exploration {

/// What an experiment compares in one world: as many choices in a row of a picture as belong together.
struct Figure {
  std::string name;
  std::size_t columns = 0;
  std::span<const Series> series;
};

/// One for each world of each experiment, in their order.
[[nodiscard]] inline std::vector<Figure> figures_of(const std::vector<Series>& all) {
  std::vector<Figure> figures;
  for (std::size_t first = 0; first < all.size();) {
    const std::string& experiment = all[first].experiment;
    std::size_t end = first;
    while (end < all.size() && all[end].experiment == experiment && all[end].arena == all[first].arena) ++end;
    const std::size_t columns = experiment == "utility" ? 4 : experiment == "strategy" ? 3 : 5;
    figures.push_back({experiment + '_' + all[first].arena->name, columns, std::span(all).subspan(first, end - first)});
    first = end;
  }
  return figures;
}

namespace detail {

/// The panel that a choice's curve is drawn in.
[[nodiscard]] inline std::string panel_title(const Series& series) {
  if (series.experiment == "utility") return "navigation cost: " + examples::name_of(series.choice.navigation);
  return "information: " + examples::name_of(series.choice.information);
}

[[nodiscard]] inline std::string curve_name(const Series& series) {
  if (series.experiment == "utility") return examples::name_of(series.choice.information);
  return examples::name_of(series.choice.strategy) + ", " + examples::name_of(series.choice.navigation);
}

[[nodiscard]] inline std::string curve_color(const Series& series) {
  constexpr std::array<const char*, 4> colors{"#c0392b", "#2471a3", "#229954", "#7d3c98"};
  const auto number = series.experiment == "utility" ? static_cast<std::size_t>(series.choice.information)
                                                     : static_cast<std::size_t>(series.choice.strategy);
  return colors[number];
}

[[nodiscard]] inline examples::Stroke curve_stroke(const Series& series) {
  using incognita::NavigationCost;
  using examples::Stroke;
  const NavigationCost navigation = series.choice.navigation;
  if (series.experiment == "utility" || navigation == NavigationCost::geodesic) return Stroke::solid;
  return navigation == NavigationCost::euclidean ? Stroke::dashed : Stroke::points;
}

/// Each start's way in a colour of its own.
[[nodiscard]] inline examples::Color way_color(std::size_t start) {
  constexpr std::array<examples::Color, 8> colors{{{0.12, 0.47, 0.71, 0.8},
                                                   {0.84, 0.15, 0.16, 0.8},
                                                   {0.17, 0.63, 0.17, 0.8},
                                                   {0.58, 0.40, 0.74, 0.8},
                                                   {1.00, 0.50, 0.05, 0.8},
                                                   {0.55, 0.34, 0.29, 0.8},
                                                   {0.09, 0.75, 0.81, 0.8},
                                                   {0.89, 0.47, 0.76, 0.8}}};
  return colors[start % colors.size()];
}

}  // namespace detail

/// The mean mapped percentage over the distance, a curve for each choice.
inline void draw_curves(const std::filesystem::path& path, const Figure& figure) {
  double end_m = 0.0;
  for (const Series& series : figure.series) end_m = std::max(end_m, settled_m(series));
  std::vector<examples::Chart> panels;
  for (const Series& series : figure.series) {
    const std::string title = detail::panel_title(series);
    if (panels.empty() || panels.back().title != title) {
      panels.push_back({.title = title,
                        .x_label = "distance (m)",
                        .y_label = "mapped, mean of all starts (%)",
                        .x_range = {{0.0, end_m}},
                        .y_range = {{0.0, 100.0}},
                        .legend = "bottom right"});
    }
    examples::Series curve{.name = detail::curve_name(series),
                           .color = detail::curve_color(series),
                           .stroke = detail::curve_stroke(series)};
    for (const Progress& mean : mean_progress(series, end_m)) {
      curve.x.push_back(mean.distance_m);
      curve.y.push_back(100.0 * mean.mapped_fraction);
    }
    panels.back().series.push_back(std::move(curve));
  }
  examples::write_chart_png(path, panels);
}

/// The ways from all starts, a copy of the world for each choice.
inline void draw_ways(const std::filesystem::path& path, const Figure& figure) {
  using incognita::FloorCell;
  constexpr examples::Color ink{0.15, 0.15, 0.15};
  constexpr double gap_m = 0.6;
  constexpr double title_px = 14.0;
  const Arena& arena = *figure.series.front().arena;
  const incognita::FloorPlan& plan = arena.world.plan();
  const Eigen::Vector2d size_m = plan.box().extent().cast<double>() * plan.resolution_m();
  const double title_m = 0.1 * size_m.y();
  const std::size_t rows = (figure.series.size() + figure.columns - 1) / figure.columns;
  const Eigen::Array2d step_m(size_m.x() + gap_m, size_m.y() + title_m);
  const Eigen::Array2d copies(static_cast<double>(figure.columns), static_cast<double>(rows));
  examples::Drawing drawing({{0.0, 0.0}, (copies * step_m).matrix()});
  for (std::size_t i = 0; i < figure.series.size(); ++i) {
    const Series& series = figure.series[i];
    const Eigen::Vector2d shift_m(static_cast<double>(i % figure.columns) * step_m.x() + 0.5 * gap_m,
                                  static_cast<double>(rows - 1 - i / figure.columns) * step_m.y());
    drawing.raster(plan, {shift_m.x(), shift_m.y(), 0.0},
                   [&](FloorCell cell) { return cell == FloorCell::floor ? examples::Color{1.0, 1.0, 1.0} : ink; });
    for (std::size_t start = 0; start < series.trials.size(); ++start) {
      std::vector<Eigen::Vector2d> way_m;
      for (const Eigen::Vector2d& point_m : series.trials[start].path_m) way_m.push_back(point_m + shift_m);
      drawing.polyline(way_m, detail::way_color(start), 1.0);
      drawing.marker(way_m.front(), detail::way_color(start), 4.0);
    }
    const Choice& choice = series.choice;
    const std::string title = examples::name_of(choice.strategy) + ", " + examples::name_of(choice.information) + ", " +
                              examples::name_of(choice.navigation);
    drawing.text(shift_m + Eigen::Vector2d(0.0, size_m.y()), title, ink, title_px, {2.0, 7.0});
  }
  drawing.legend({{"walls and furniture", ink, examples::Swatch::area},
                  {"a robot's way", detail::way_color(0), examples::Swatch::line},
                  {"its start", detail::way_color(0), examples::Swatch::dot}});
  drawing.write_png(path);
}

}  // namespace office_exploration
