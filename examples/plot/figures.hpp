/// The charts.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "plot/comparison.hpp"
#include "support/box_plot.hpp"
#include "support/chart.hpp"

namespace plot {

/// Colours that are told apart by the colour-blind, too (Okabe and Ito 2008), and a stroke for who sees none: no two of groups_max groups
/// have both.
[[nodiscard]] inline std::pair<const char*, examples::Stroke> look_of(std::size_t group) {
  using examples::Stroke;
  constexpr std::array colors{"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"};
  constexpr std::array strokes{Stroke::solid, Stroke::dashed, Stroke::dash_dotted, Stroke::dotted};
  return {colors[group % colors.size()], strokes[group % strokes.size()]};
}

/// A curve within its band.
[[nodiscard]] inline examples::Series series_of(const Band& band, const std::string& name, std::size_t group, double factor = 1.0) {
  const auto scaled = [&](std::vector<double> values) {
    for (double& value : values) value *= factor;
    return values;
  };
  const auto [color, stroke] = look_of(group);
  return {.name = name,
          .x = band.at,
          .y = scaled(band.median),
          .color = color,
          .stroke = stroke,
          .width = 2.5,
          .low = scaled(band.low),
          .high = scaled(band.high)};
}

/// Where a legend stands, in a font in which the longest of its names fits into so many letters of the usual size.
[[nodiscard]] inline std::string legend_of(const std::string& place, std::size_t longest, std::size_t letters) {
  constexpr std::size_t usual = 14;
  const std::size_t size = longest <= letters ? usual : std::max<std::size_t>(usual * letters / longest, 6);
  return size == usual ? place : place + " font '," + std::to_string(size) + "'";
}

/// A panel with a legend below that has room for these names.
[[nodiscard]] inline examples::Chart panel(const std::string& title, const std::string& x_label, const std::string& y_label,
                                           const std::vector<std::string>& legend) {
  constexpr std::size_t letters = 84;  // that fit beside each other, with their strokes
  std::size_t longest = 1;
  for (const std::string& name : legend) longest = std::max(longest, name.size() + 6);
  const std::size_t columns = std::clamp<std::size_t>(letters / longest, 1, 3);
  const std::size_t rows = (legend.size() + columns - 1) / columns;
  return {.title = title,
          .x_label = x_label,
          .y_label = y_label,
          .legend = legend_of("below center horizontal maxcols " + std::to_string(columns), longest, letters),
          .lines_below = examples::lines_below_legend(rows)};
}

[[nodiscard]] inline std::vector<std::string> titles_of(const Comparison& comparison) {
  std::vector<std::string> titles;
  for (const Group& group : comparison.groups) titles.push_back(group.title());
  return titles;
}

/// What a band is, for the title of a chart.
[[nodiscard]] inline std::string spread_name(const Comparison& comparison) {
  bool quartiles = false;
  bool range = false;
  for (const Group& group : comparison.groups) {
    quartiles |= group.runs.size() >= examples::quartile_values_min;
    range |= group.runs.size() > 1 && group.runs.size() < examples::quartile_values_min;
  }
  if (quartiles) return range ? "median and quartiles (range where < 4 runs)" : "median and quartiles";
  return range ? "median and range" : "";
}

[[nodiscard]] inline std::string with_spread(const std::string& what, const Comparison& comparison) {
  const std::string spread = spread_name(comparison);
  return spread.empty() ? what : what + ": " + spread;
}

/// The explored floor over time and over distance.
inline void draw_explored(const std::filesystem::path& path, const Comparison& comparison) {
  const std::vector<std::string> titles = titles_of(comparison);
  std::vector<examples::Chart> panels{panel(with_spread("Explored floor", comparison), "simulated time (s)", "explored floor (%)", titles),
                                      panel(with_spread("Explored floor", comparison), "distance driven (m)", "explored floor (%)", titles)};
  for (std::size_t i = 0; i < titles.size(); ++i) {
    panels[0].series.push_back(series_of(comparison.bands[i].explored_over_time, titles[i], i, 100.0));
    panels[1].series.push_back(series_of(comparison.bands[i].explored_over_distance, titles[i], i, 100.0));
  }
  for (examples::Chart& chart : panels) chart.y_range = {{0.0, 100.0}};
  examples::write_chart_png(path, panels);
}

/// The entropy of the map over time.
inline void draw_entropy(const std::filesystem::path& path, const Comparison& comparison) {
  const std::vector<std::string> titles = titles_of(comparison);
  examples::Chart chart = panel(with_spread("Entropy of the map", comparison), "simulated time (s)", "Shannon entropy (1000 bits)", titles);
  for (std::size_t i = 0; i < titles.size(); ++i) chart.series.push_back(series_of(comparison.bands[i].entropy, titles[i], i, 1e-3));
  examples::write_chart_png(path, {chart});
}

/// The error of the position under three standard deviations, a panel a group. All have the same scale but those that it would flatten, and
/// rounding errors are never shown large.
inline void draw_error(const std::filesystem::path& path, const Comparison& comparison) {
  constexpr double scale_min_m = 0.001;
  constexpr double share_min = 0.2;  // of the scale that a group must fill
  std::vector<examples::Chart> panels;
  std::vector<double> greatest_m;
  for (std::size_t i = 0; i < comparison.groups.size(); ++i) {
    const Group& group = comparison.groups[i];
    const std::string error_name = "error of the position";
    const std::string sigma_name = group.runs.size() > 1 ? "3 sigma, median" : "3 sigma";
    examples::Chart chart = panel(group.title(), "simulated time (s)", "translation error (m)", {error_name, sigma_name});
    const Band& error = comparison.bands[i].error;
    const Band& sigma = comparison.bands[i].three_sigma;
    chart.series = {series_of(error, error_name, i),
                    {.name = sigma_name,
                     .x = sigma.at,
                     .y = sigma.median,
                     .color = "#777777",
                     .stroke = examples::Stroke::dashed,
                     .width = 1.5,
                     .low = std::vector<double>(sigma.at.size(), 0.0),
                     .high = sigma.median}};
    chart.series.front().stroke = examples::Stroke::solid;
    greatest_m.push_back(0.0);
    for (const std::vector<double>* values : {&sigma.median, &error.high}) {
      for (const double value : *values) greatest_m.back() = std::max(greatest_m.back(), value);
    }
    panels.push_back(std::move(chart));
  }
  const double scale_m = std::max(*std::max_element(greatest_m.begin(), greatest_m.end()), scale_min_m);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const bool has_own = greatest_m[i] < share_min * scale_m && greatest_m[i] >= scale_min_m;
    if (has_own) panels[i].title += ", in its own scale";
    panels[i].y_range = {{0.0, 1.05 * (has_own ? greatest_m[i] : scale_m)}};
  }
  examples::write_chart_png(path, panels, {.columns = 3});
}

/// The normalised squared error of the position (two degrees of freedom) with what a consistent filter has.
inline void draw_nees(const std::filesystem::path& path, const Comparison& comparison) {
  std::vector<std::string> legend = titles_of(comparison);
  legend.insert(legend.end(), {"mean of a consistent filter (2)", "its 95 % bound (5.99)"});
  examples::Chart chart = panel(with_spread("NEES of the position", comparison), "simulated time (s)", "NEES", legend);
  double end_s = 0.0;
  double greatest = 6.5;
  for (std::size_t i = 0; i < comparison.groups.size(); ++i) {
    const Band& band = comparison.bands[i].nees;
    chart.series.push_back(series_of(band, legend[i], i));
    for (const double high : band.high) greatest = std::max(greatest, 1.05 * high);
    if (!band.at.empty()) end_s = std::max(end_s, band.at.back());
  }
  if (end_s > 0.0) {
    const auto level = [&](double value, const std::string& name, examples::Stroke stroke) {
      chart.series.push_back(
          {.name = name, .x = {0.0, end_s}, .y = {value, value}, .color = "#777777", .stroke = stroke, .width = 1.5});
    };
    level(2.0, legend[legend.size() - 2], examples::Stroke::solid);
    level(5.991, legend.back(), examples::Stroke::dashed);
  }
  chart.y_range = {{0.0, greatest}};
  examples::write_chart_png(path, {chart});
}

/// What the runs ended with: a box of each group's runs, a panel a quantity, the legend in the last.
inline void draw_summary(const std::filesystem::path& path, const Comparison& comparison) {
  struct Quantity {
    const char* key;
    const char* title;
    double factor;
  };
  constexpr std::array quantities{Quantity{"explored_fraction", "explored floor (%)", 100.0},
                                  Quantity{"duration_s", "simulated time (s)", 1.0},
                                  Quantity{"distance_m", "distance driven (m)", 1.0},
                                  Quantity{"time_to_90_percent_s", "time to 90 % explored (s)", 1.0},
                                  Quantity{"distance_to_90_percent_m", "distance to 90 % explored (m)", 1.0},
                                  Quantity{"map_error", "error of the map", 1.0},
                                  Quantity{"translation_rmse_m", "translation RMSE (m)", 1.0},
                                  Quantity{"heading_rmse_rad", "heading RMSE (rad)", 1.0},
                                  Quantity{"nees_mean", "mean NEES of the position", 1.0},
                                  Quantity{"collisions", "collisions", 1.0},
                                  Quantity{"decision_time_s", "time of a decision, median (ms)", 1000.0}};
  std::vector<examples::Chart> panels;
  for (const Quantity& quantity : quantities) {
    examples::Chart chart{.title = quantity.title, .x_range = {{0.4, static_cast<double>(comparison.groups.size()) + 0.6}}, .legend = "off"};
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (std::size_t i = 0; i < comparison.groups.size(); ++i) {
      std::vector<double> values = end_values(comparison.groups[i], quantity.key);
      for (double& value : values) value *= quantity.factor;
      examples::add_box(chart, static_cast<double>(i + 1), values, look_of(i).first, look_of(i).first);
      chart.names.push_back(std::string(1, static_cast<char>('A' + i)));
      for (const double value : values) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
      }
    }
    if (least == greatest) chart.y_range = {{0.0, greatest > 0.0 ? 1.2 * greatest : 1.0}};
    panels.push_back(std::move(chart));
  }
  std::size_t longest = 0;
  for (const Group& group : comparison.groups) longest = std::max(longest, group.title().size());
  examples::Chart legend{.legend = legend_of("center center vertical", longest, 44), .only_legend = true};
  for (std::size_t i = 0; i < comparison.groups.size(); ++i) {
    legend.series.push_back(
        {.name = std::string(1, static_cast<char>('A' + i)) + ": " + comparison.groups[i].title(), .color = look_of(i).first, .width = 6.0});
  }
  panels.push_back(std::move(legend));
  examples::write_chart_png(path, panels, {.columns = 4, .panel_width_px = 520, .panel_height_px = 400});
}

}  // namespace plot
