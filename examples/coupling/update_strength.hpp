/// Fig. 5 of Seo et al.: how an uncertain pose weakens what a scan tells of the cells it hits and passes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene.hpp"
#include "incognita/sensor/scan.hpp"
#include "support/chart.hpp"
#include "support/csv.hpp"

namespace coupling {

/// How far before the measured surface the cells lie that the figure follows.
constexpr std::array<double, 4> kResiduals_m = {0.5, 1.5, 2.5, 4.5};
constexpr int kScans = 3;  // N_max: as many hits as the tempering of (14) tells apart

/// One beam into an unknown map, from a pose of this sigma.
struct UpdateStrength {
  double sigma_m;
  std::array<double, kScans> hit_log_odds;                  ///< after each scan
  std::array<double, kResiduals_m.size()> passed_log_odds;  ///< after the first scan
};

/// The same sigma on both axes; the heading does not enter (13).
[[nodiscard]] inline Eigen::Matrix3d position_covariance(double sigma_m) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, 0.0).asDiagonal();
}

[[nodiscard]] inline UpdateStrength measure_update_strength(double sigma_m) {
  // From the centre of a cell onto the face of another whose centre is 6 m away: the hit's residual is 0.
  const incognita::Pose2 pose{0.5 * kCell_m, 0.5 * kCell_m, 0.0};
  const double range_m = 6.0 - 0.5 * kCell_m;
  const incognita::Scan<2> scan(incognita::planar_beams(1, 0.0, 0.0, 10.0), {range_m});
  Map map(incognita::MapParams{.resolution_m = kCell_m});
  const auto log_odds_at = [&](double distance_m) {
    return static_cast<double>(map.log_odds(map.lattice().index_of(pose * Eigen::Vector2d(distance_m, 0.0))));
  };
  UpdateStrength strength{sigma_m, {}, {}};
  for (std::size_t scans = 0; scans < kScans; ++scans) {
    map.update(scan, pose, position_covariance(sigma_m));
    strength.hit_log_odds[scans] = log_odds_at(6.0);
    if (scans > 0) continue;
    for (std::size_t i = 0; i < kResiduals_m.size(); ++i) {
      strength.passed_log_odds[i] = log_odds_at(range_m - kResiduals_m[i]);
    }
  }
  return strength;
}

/// For sigma from 0 to 3 m.
[[nodiscard]] inline std::vector<UpdateStrength> measure_update_strengths() {
  std::vector<UpdateStrength> strengths;
  for (int step = 0; step <= 300; ++step) strengths.push_back(measure_update_strength(0.01 * step));
  return strengths;
}

/// The first sigma from which a first hit lowers the cell.
[[nodiscard]] inline std::optional<double> sigma_of_sign_change_m(
    const std::vector<UpdateStrength>& strengths) {
  for (const UpdateStrength& strength : strengths) {
    if (strength.hit_log_odds[0] < 0.0) return strength.sigma_m;
  }
  return std::nullopt;
}

inline void write_update_strengths(const std::filesystem::path& path,
                                   const std::vector<UpdateStrength>& strengths) {
  std::ostringstream header;
  header << "sigma_m";
  for (int scans = 1; scans <= kScans; ++scans) header << ",hit_log_odds_scan_" << scans;
  for (int scans = 1; scans <= kScans; ++scans) header << ",hit_probability_scan_" << scans;
  for (const double residual_m : kResiduals_m) header << ",passed_log_odds_residual_" << residual_m << "_m";
  for (const double residual_m : kResiduals_m)
    header << ",passed_probability_residual_" << residual_m << "_m";
  examples::write_csv(path, header.str(), [&](std::ostream& out) {
    for (const UpdateStrength& strength : strengths) {
      out << strength.sigma_m;
      for (const double l : strength.hit_log_odds) out << ',' << l;
      for (const double l : strength.hit_log_odds) out << ',' << incognita::probability_of_log_odds(l);
      for (const double l : strength.passed_log_odds) out << ',' << l;
      for (const double l : strength.passed_log_odds) out << ',' << incognita::probability_of_log_odds(l);
      out << '\n';
    }
  });
}

inline void draw_update_strengths(const std::filesystem::path& path,
                                  const std::vector<UpdateStrength>& strengths) {
  const double sigma_max_m = strengths.back().sigma_m;
  const auto unknown_line = [&](std::string name) {
    return examples::Series{.name = std::move(name),
                            .x = {0.0, sigma_max_m},
                            .y = {0.0, 0.0},
                            .color = "#808080",
                            .stroke = examples::Stroke::dashed};
  };
  const auto chart = [&](std::string title) {
    return examples::Chart{.title = std::move(title),
                           .x_label = "pose sigma along the beam (m)",
                           .y_label = "log-odds of the cell (0: unknown)",
                           .x_range = {{0.0, sigma_max_m}}};
  };
  const auto add = [&](examples::Chart& to, std::string name, std::string color, auto value) {
    examples::Series series{.name = std::move(name), .color = std::move(color), .width = 2.5};
    for (const UpdateStrength& strength : strengths) {
      series.x.push_back(strength.sigma_m);
      series.y.push_back(value(strength));
    }
    to.series.push_back(std::move(series));
  };

  examples::Chart hit = chart("(a) the cell that a beam hits");
  hit.y_range = {{-1.0, 5.0}};
  const std::array<const char*, kScans> warm = {"#99000d", "#e6550d", "#fdae61"};
  for (std::size_t i = 0; i < kScans; ++i) {
    add(hit, "after " + std::to_string(i + 1) + (i == 0 ? " scan" : " scans"), warm[i],
        [i](const UpdateStrength& strength) { return strength.hit_log_odds[i]; });
  }
  hit.series.push_back(unknown_line(""));

  examples::Chart passed = chart("(b) cells that it passes, after 1 scan (floor: -20)");
  passed.y_range = {{-21.0, 1.0}};
  const std::array<const char*, kResiduals_m.size()> cold = {"#a6bddb", "#4eb3d3", "#2b8cbe", "#08306b"};
  for (std::size_t i = 0; i < kResiduals_m.size(); ++i) {
    std::ostringstream name;
    name << kResiduals_m[i] << " m before the hit";
    add(passed, name.str(), cold[i],
        [i](const UpdateStrength& strength) { return strength.passed_log_odds[i]; });
  }
  passed.series.push_back(unknown_line(""));
  examples::write_chart_png(path, {hit, passed});
}

}  // namespace coupling
