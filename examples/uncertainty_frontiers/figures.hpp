/// Pictures and charts in the manner of Figs. 2, 3, 4, 6, 8 and 9 of Sansoni et al.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "incognita/entropy/signed_relative_entropy.hpp"
#include "incognita/map/dispersion_probability.hpp"
#include "incognita/map/uncertainty_map.hpp"
#include "incognita/sensor/measured_point.hpp"
#include "support/box_plot.hpp"
#include "support/chart.hpp"
#include "support/drawing.hpp"
#include "uncertainty_frontiers/experiments.hpp"

namespace uncertainty_frontiers {

namespace detail {

inline constexpr examples::Color ink{0.15, 0.15, 0.15};
inline constexpr examples::Color path_color{0.0, 0.0, 0.0, 0.7};
inline constexpr examples::Color uncertain_color{0.85, 0.0, 0.75};
inline constexpr examples::Color classical_color{1.0, 0.55, 0.0};
inline constexpr examples::Color landmark_color{0.85, 0.1, 0.1};

/// From dark blue at 0 by green to yellow at 1: lighter throughout, so that it reads without colours too.
[[nodiscard]] inline examples::Color scale_color(double share) {
  constexpr std::array<std::array<double, 3>, 5> stops{
      {{0.20, 0.13, 0.55}, {0.16, 0.37, 0.66}, {0.13, 0.57, 0.55}, {0.48, 0.78, 0.35}, {0.99, 0.90, 0.30}}};
  const double place = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double rest = place - static_cast<double>(first);
  const auto mix = [&](std::size_t channel) { return stops[first][channel] + rest * (stops[first + 1][channel] - stops[first][channel]); };
  return {mix(0), mix(1), mix(2)};
}

/// The uncertainty map, walls in ink, what was never seen in white.
inline void draw_belief(examples::Drawing& drawing, const Belief& map, const Eigen::Vector2d& shift_m) {
  incognita::Grid<float, 2> uncertainty_m = incognita::uncertainty_map(map);
  const auto limit_m = static_cast<float>(incognita::UncertaintyOfDispersion(map.cell()).tolerated_m());
  for (incognita::Offset offset = 0; offset < static_cast<incognita::Offset>(uncertainty_m.size()); ++offset) {
    const incognita::Dispersion::State& state = map.grid()[offset];
    if (!state.is_explored) uncertainty_m[offset] = -1.0F;
    if (map.log_odds(offset) > 1.0F) uncertainty_m[offset] = std::numeric_limits<float>::infinity();
  }
  drawing.raster(uncertainty_m, {shift_m.x(), shift_m.y(), 0.0}, [&](float at_m) {
    if (at_m < 0.0F) return examples::transparent;
    return std::isinf(at_m) ? ink : scale_color(static_cast<double>(at_m / limit_m));
  });
}

inline void draw_cells(examples::Drawing& drawing, const std::vector<incognita::Frontier<2>>& frontiers,
                       const incognita::Lattice<2>& lattice, const examples::Color& color, double radius_m) {
  for (const auto& frontier : frontiers) {
    for (const incognita::Index<2>& cell : frontier.cells) drawing.disc(lattice.center_m(cell), radius_m, color);
  }
}

/// Points along a way, as far apart as the dots of a dotted line.
inline void draw_path(examples::Drawing& drawing, const std::vector<Eigen::Vector2d>& path_m, const Eigen::Vector2d& shift_m) {
  for (std::size_t i = 0; i < path_m.size(); ++i) drawing.disc(path_m[i] + shift_m, 0.05, path_color);
}

}  // namespace detail

/// As Fig. 6: the uncertainty map of the corridors with both kinds of frontier.
inline void draw_corridors(const std::filesystem::path& path, const Snapshot& shot) {
  using examples::Swatch;
  examples::Drawing drawing({{-0.8, -0.8}, {20.4, 14.0}}, 1400);
  detail::draw_belief(drawing, shot.map, {0.0, 0.0});
  detail::draw_path(drawing, shot.path_m, {0.0, 0.0});
  detail::draw_cells(drawing, shot.classical, shot.map.lattice(), detail::classical_color, 0.12);
  detail::draw_cells(drawing, shot.uncertain, shot.map.lattice(), detail::uncertain_color, 0.07);
  for (const Eigen::Vector2d& landmark_m : corridors().landmarks_m) drawing.marker(landmark_m, detail::landmark_color, 6.0);
  drawing.marker(shot.path_m.front(), {0.1, 0.6, 0.1}, 8.0);
  drawing.legend({{"U = 0", detail::scale_color(0.0), Swatch::area},
                  {"U = 0.5 m", detail::scale_color(0.5), Swatch::area},
                  {"U = 1 m", detail::scale_color(1.0), Swatch::area},
                  {"classical frontier", detail::classical_color, Swatch::dot},
                  {"uncertainty frontier", detail::uncertain_color, Swatch::dot},
                  {"landmark", detail::landmark_color, Swatch::dot},
                  {"way", detail::path_color, Swatch::line}});
  drawing.write_png(path);
}

/// As Fig. 9: one trial of each setting.
inline void draw_trials(const std::filesystem::path& path, const std::vector<Series>& all) {
  using examples::Swatch;
  const Eigen::Vector2d step_m(hall_width_m + 3.0, hall_height_m + 4.0);
  constexpr std::size_t columns = planning_systems.size();
  const std::size_t rows = all.size() / columns;
  examples::Drawing drawing({{-1.0, -1.0}, {static_cast<double>(columns) * step_m.x(), static_cast<double>(rows) * step_m.y()}}, 2000);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector2d shift_m(static_cast<double>(i % columns) * step_m.x(), static_cast<double>(rows - 1 - i / columns) * step_m.y());
    const Trial& trial = all[i].trials.front();
    if (trial.map) detail::draw_belief(drawing, *trial.map, shift_m);
    detail::draw_path(drawing, trial.path_m, shift_m);
    for (const Eigen::Vector2d& landmark_m : trial.landmarks_m) drawing.marker(landmark_m + shift_m, detail::landmark_color, 3.0);
    drawing.text(shift_m + Eigen::Vector2d(0.0, hall_height_m), std::string(all[i].setting.system.name) + ", " + all[i].layout(), detail::ink,
                 13.0, {2.0, 14.0});
  }
  drawing.legend({{"U = 0", detail::scale_color(0.0), Swatch::area},
                  {"half of what is tolerated", detail::scale_color(0.5), Swatch::area},
                  {"U = 0.6 m (PPS3) or 1 m", detail::scale_color(1.0), Swatch::area},
                  {"landmark", detail::landmark_color, Swatch::dot},
                  {"way", detail::path_color, Swatch::line}});
  drawing.write_png(path);
}

/// As Fig. 8: SiREn of the trials of each setting, a panel for each layout.
inline void draw_box_plots(const std::filesystem::path& path, const std::vector<Series>& all, std::size_t judge) {
  std::vector<examples::Chart> panels;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % planning_systems.size() == 0) {
      panels.push_back({.title = all[i].layout(),
                        .x_label = "planning system",
                        .y_label = "SiREn (nats m^2)",
                        .x_range = {{0.5, static_cast<double>(planning_systems.size()) + 0.5}},
                        .legend = "off"});
    }
    std::vector<double> values;
    for (const Trial& trial : all[i].trials) values.push_back(trial.siren_nats_m2[judge]);
    examples::add_box(panels.back(), 1.0 + static_cast<double>(i % planning_systems.size()), values, "#1f77b4", "#d62728");
  }
  // One scale for all.
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0.0;
  for (const Series& setting : all) {
    for (const Trial& trial : setting.trials) {
      least = std::min(least, trial.siren_nats_m2[judge]);
      greatest = std::max(greatest, trial.siren_nats_m2[judge]);
    }
  }
  const double margin = 0.05 * (greatest - least) + 1.0;
  for (examples::Chart& panel : panels) panel.y_range = {{least - margin, greatest + margin}};
  examples::write_chart_png(path, panels);
}

/// As Figs. 2 to 4: how a robot's uncertainty goes over to what it measures while it drives without landmarks; the terms of (9); and
/// the divergence over sigma.
inline void draw_figures(const std::filesystem::path& path) {
  using namespace incognita;
  const Eigen::Vector2d sides = Eigen::Vector2d::Constant(0.1);
  const RangeBearingNoise noise;
  Eigen::Matrix3d covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-6).asDiagonal();
  examples::Chart clouds{.title = "A robot and the wall it measures, drawn at random",
                         .x_label = "x (m)",
                         .y_label = "y (m)",
                         .legend = "below center horizontal maxcols 2",
                         .equal_axes = true};
  examples::Series robot{.name = "robot", .color = "#d62728", .stroke = examples::Stroke::points, .width = 0.6};
  examples::Series wall{.name = "measured", .color = "#2ca02c", .stroke = examples::Stroke::points, .width = 0.6};
  examples::Chart terms{.title = "The terms of (9)", .x_label = "distance driven (m)", .y_label = "log10 of metres", .legend = "bottom right"};
  examples::Series sigma{.name = "mean sigma", .color = "#1f77b4"};
  examples::Series bound{.name = "U, as printed", .color = "#ff7f0e", .stroke = examples::Stroke::dashed};
  Random random(1);
  Pose2 pose{0.0, 0.0, 0.0};
  for (int pace = 0; pace <= 12; ++pace) {
    const Eigen::Vector2d to_wall(0.0, 1.0);
    const MeasuredPoint point = measured_point(pose.position(), covariance, to_wall, 3.0, noise);
    sigma.x.push_back(pose.x_m);
    sigma.y.push_back(std::log10(mean_sigma(point.covariance_m2)));
    bound.x.push_back(pose.x_m);
    bound.y.push_back(std::log10(
        uncertainty_of_probability(dispersion_probability<2>(point.covariance_m2, sides), gauss_scale(sides), 2)));
    if (pace % 3 == 0) {
      const Eigen::LLT<Eigen::Matrix3d> root(covariance);
      for (int sample = 0; sample < 200; ++sample) {
        const Eigen::Vector3d error = root.matrixL() * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
        const double angle_rad = 0.5 * std::numbers::pi + error.z() + noise.bearing_rad * random.normal();
        const double range_m = 3.0 + noise.range_m * random.normal();
        robot.x.push_back(pose.x_m + error.x());
        robot.y.push_back(error.y());
        wall.x.push_back(robot.x.back() + range_m * std::cos(angle_rad));
        wall.y.push_back(robot.y.back() + range_m * std::sin(angle_rad));
      }
    }
    // Dead reckoning over a metre: the yaw's error turns what is driven.
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
    jacobian(1, 2) = 1.0;
    covariance = (jacobian * covariance * jacobian.transpose()).eval();
    covariance.diagonal() += Eigen::Vector3d(4e-4, 4e-4, 4e-4);
    pose.x_m += 1.0;
  }
  clouds.series = {robot, wall};
  terms.series = {sigma, bound};
  examples::Chart divergence{.title = "(20): one dimension, sigma_max = 1", .x_label = "sigma", .y_label = "signed divergence (nats)", .legend = "top right"};
  examples::Series curve{.name = "SiREn of a cell", .color = "#1f77b4"};
  for (double ratio = 0.02; ratio < 2.5; ratio += 0.01) {
    curve.x.push_back(ratio);
    curve.y.push_back(signed_relative_entropy_nats_of_ratio(ratio, 1));
  }
  divergence.series = {curve};
  examples::write_chart_png(path, {clouds, terms, divergence});
}

}  // namespace uncertainty_frontiers
