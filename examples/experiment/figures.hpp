/// The pictures of a study: curves over time, the spread of metrics, and the ways that robots drove.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "experiment/analysis.hpp"
#include "experiment/arena.hpp"
#include "support/box_plot.hpp"
#include "support/chart.hpp"
#include "support/drawing.hpp"

namespace experiment {

namespace detail {

/// Told apart without colour vision too, by Okabe and Ito; after eight they come again, dashed.
[[nodiscard]] inline std::string color_of(std::size_t n) {
  constexpr std::array<const char*, 8> colors{"#000000", "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7", "#8a7a00"};
  return colors[n % colors.size()];
}

/// The values of all rows at one step, each row's last one where it has ended before.
[[nodiscard]] inline std::vector<double> values_at(const std::vector<Results::Done>& rows, const std::string& metric, std::size_t step) {
  std::vector<double> values;
  for (const Results::Done& done : rows) {
    const auto& curve = done.row->json.at("curves").at(metric);
    if (curve.empty()) continue;
    const auto& value = curve.at(std::min(step, curve.size() - 1));
    if (value.is_number()) values.push_back(value.get<double>());
  }
  return values;
}

/// Whether a linear axis that reaches up to `greatest` would press some of the medians, which are above 0, flat.
[[nodiscard]] inline bool needs_logarithm(const std::vector<double>& medians, double greatest) {
  constexpr double times = 20.0;
  return !medians.empty() && greatest > times * *std::min_element(medians.begin(), medians.end());
}

}  // namespace detail

/// Medians over time with a band from quartile to quartile, a panel a metric, of the first group of trials; where medians end far below
/// others' quartiles, on a logarithmic axis.
inline void draw_curves(const std::filesystem::path& file, const Study& study, const Results& results, std::size_t map) {
  constexpr std::size_t columns_of_legend = 3;
  const std::size_t rows_of_legend = (study.methods.size() + columns_of_legend - 1) / columns_of_legend;
  std::vector<examples::Chart> panels;
  for (const std::string& metric : study.curves) {
    examples::Chart panel{.title = study.maps[map].name, .x_label = "time (s)", .y_label = metric,
                          .lines_below = examples::lines_below_legend(rows_of_legend)};
    std::vector<double> last;
    double greatest = 0.0;
    bool is_positive = true;
    for (std::size_t method = 0; method < study.methods.size(); ++method) {
      const std::vector<Results::Done> rows = results.of(map, method, &study.trials.front());
      if (rows.empty()) continue;
      const double step_s = rows.front().row->json.at("curves").at("step_s").get<double>();
      examples::Series curve{.name = study.methods[method].name, .color = detail::color_of(method),
                             .stroke = method < 8 ? examples::Stroke::solid : examples::Stroke::dashed};
      const double duration_s = study.settings_of({map, method, 1, 1}).duration_s;
      for (std::size_t step = 0; static_cast<double>(step + 1) * step_s <= duration_s + 1e-9; ++step) {
        const std::vector<double> values = detail::values_at(rows, metric, step);
        if (values.empty()) continue;
        const examples::Spread spread = examples::spread_of(values);
        curve.x.push_back(static_cast<double>(step + 1) * step_s);
        curve.y.push_back(spread.median);
        curve.low.push_back(spread.lower_quartile);
        curve.high.push_back(spread.upper_quartile);
        is_positive = is_positive && spread.lower_quartile > 0.0;
        greatest = std::max(greatest, spread.upper_quartile);
      }
      if (!curve.y.empty()) last.push_back(curve.y.back());
      panel.series.push_back(std::move(curve));
    }
    panel.y_logarithmic = is_positive && detail::needs_logarithm(last, greatest);
    panels.push_back(std::move(panel));
  }
  examples::write_chart_png(file, panels, {.columns = 2, .panel_width_px = 720, .panel_height_px = 540});
}

/// A box for each method, a panel a metric, of the first group of trials; where medians are far below the greatest value, on a
/// logarithmic axis.
inline void draw_boxes(const std::filesystem::path& file, const Study& study, const Results& results, std::size_t map) {
  std::vector<examples::Chart> panels;
  for (const std::string& metric : study.tables) {
    examples::Chart panel{.title = study.maps[map].name, .y_label = metric,
                          .x_range = {{0.5, static_cast<double>(study.methods.size()) + 0.5}}, .legend = "off", .lines_below = 3.5};
    std::vector<double> medians;
    double greatest = 0.0;
    bool is_positive = true;
    for (std::size_t method = 0; method < study.methods.size(); ++method) {
      panel.names.push_back(study.methods[method].name);
      const std::vector<double> values = results.values(map, method, metric, &study.trials.front());
      if (values.empty()) continue;
      medians.push_back(examples::median(values));
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      is_positive = is_positive && *least > 0.0;
      greatest = std::max(greatest, *most);
      examples::add_box(panel, static_cast<double>(method + 1), values, detail::color_of(method), "#999999");
    }
    panel.y_logarithmic = is_positive && detail::needs_logarithm(medians, greatest);
    if (!panel.series.empty()) panels.push_back(std::move(panel));
  }
  examples::write_chart_png(file, panels, {.columns = 2, .panel_width_px = 600, .panel_height_px = 400});
}

namespace detail {

/// Each method's row of the first trial that all have; where there is none, each one's first. Null where a method has no row.
[[nodiscard]] inline std::vector<const Row*> rows_of_one_trial(const Study& study, const Results& results, std::size_t map) {
  std::vector<std::vector<Results::Done>> all;
  for (std::size_t method = 0; method < study.methods.size(); ++method) all.push_back(results.of(map, method));
  std::vector<const Row*> rows;
  for (const Results::Done& tried : all.front()) {
    rows.clear();
    for (const auto& of_method : all) {
      const auto same = std::find_if(of_method.begin(), of_method.end(), [&tried](const Results::Done& done) {
        return done.unit.start == tried.unit.start && done.unit.seed == tried.unit.seed;
      });
      if (same == of_method.end()) break;
      rows.push_back(same->row);
    }
    if (rows.size() == all.size()) return rows;
  }
  rows.clear();
  for (const auto& of_method : all) rows.push_back(of_method.empty() ? nullptr : of_method.front().row);
  return rows;
}

}  // namespace detail

/// The floor with corridors shaded, once for each method, with the way of the first trial that all have.
inline void draw_ways(const std::filesystem::path& file, const Study& study, const Results& results, const Arena& arena, std::size_t map) {
  using incognita::FloorCell;
  constexpr examples::Color ink{0.15, 0.15, 0.15};
  constexpr examples::Color corridor{0.93, 0.95, 1.0};
  constexpr examples::Color way_color{0.84, 0.15, 0.16, 0.9};
  const incognita::FloorPlan& plan = arena.world.plan();
  const Eigen::Vector2d low_m = plan.lattice().origin_m() + plan.box().lower.cast<double>() * plan.resolution_m();
  const Eigen::Vector2d size_m = plan.box().extent().cast<double>() * plan.resolution_m();
  const Eigen::Vector2d step_m(1.03 * size_m.x(), size_m.y() + 0.06 * std::max(size_m.x(), size_m.y()));
  const std::size_t columns = std::min<std::size_t>(study.methods.size(), size_m.x() > 1.6 * size_m.y() ? 2 : 3);
  const std::size_t rows = (study.methods.size() + columns - 1) / columns;
  examples::Drawing drawing({{0.0, 0.0}, {static_cast<double>(columns) * step_m.x(), static_cast<double>(rows) * step_m.y()}}, 1200, 1200.0);
  const std::vector<const Row*> trial = detail::rows_of_one_trial(study, results, map);
  for (std::size_t method = 0; method < study.methods.size(); ++method) {
    const Eigen::Vector2d corner_m(static_cast<double>(method % columns) * step_m.x(), static_cast<double>(rows - 1 - method / columns) * step_m.y());
    const Eigen::Vector2d shift_m = corner_m - low_m;
    const incognita::Pose2 shift{shift_m.x(), shift_m.y(), 0.0};
    drawing.raster(arena.uses, shift, [&](FloorUse use) { return use == FloorUse::corridor ? corridor : examples::transparent; });
    drawing.raster(plan, shift, [&](FloorCell cell) { return cell == FloorCell::wall ? ink : examples::transparent; });
    if (trial[method] != nullptr) {
      std::vector<Eigen::Vector2d> way_m;
      for (const auto& place : trial[method]->json.at("way_m")) way_m.emplace_back(shift_m + Eigen::Vector2d(place[0].get<double>(), place[1].get<double>()));
      drawing.polyline(way_m, way_color, 1.5);
      if (!way_m.empty()) drawing.marker(way_m.front(), way_color, 5.0);
    }
    drawing.text(corner_m + Eigen::Vector2d(0.0, size_m.y()), study.methods[method].name, ink, 16.0, {2.0, 5.0});
  }
  std::vector<examples::LegendEntry> legend{{"walls", ink, examples::Swatch::area}, {"a robot's way", way_color, examples::Swatch::line},
                                            {"its start", way_color, examples::Swatch::dot}};
  if (!arena.uses.box().empty()) legend.push_back({"corridors", corridor, examples::Swatch::area});
  drawing.legend(legend);
  drawing.write_png(file);
}

}  // namespace experiment
