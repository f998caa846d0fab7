/// Fig. 6 of Seo et al.: how the covariance of the pose grows on a drive out of known surroundings.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/exploration/information_gain.hpp"
#include "support/chart.hpp"
#include "support/csv.hpp"

namespace coupling {

/// The robot comes through a corridor that it knows and crosses x = 0, where its map ends unless told
/// otherwise.
constexpr double kDriveFrom_m = -20.0;
constexpr double kInitial_m = -kRange_m;  ///< Sigma_init is taken here, before anything unknown is seen
constexpr double kDriveTo_m = 14.0;

/// A corridor 4 m wide with pillars on alternating sides, up to x = end_m.
[[nodiscard]] inline Scene corridor(double end_m) {
  std::vector<Area> walls_m = {
      {{-26.0, 2.0}, {end_m, 2.2}}, {{-26.0, -2.2}, {end_m, -2.0}}, {{-26.2, -2.2}, {-26.0, 2.2}}};
  bool is_left = true;
  for (double x_m = -23.0; x_m < end_m; x_m += 4.0, is_left = !is_left) {
    const double y_m = is_left ? 1.6 : -2.0;
    walls_m.push_back({{x_m, y_m}, {x_m + 0.4, y_m + 0.4}});
  }
  return Scene({{-32.0, -8.0}, {25.0, 8.0}}, std::move(walls_m));
}

enum class Surroundings { known, unknown_walls, unknown_empty };

[[nodiscard]] inline std::string name_of(Surroundings surroundings) {
  if (surroundings == Surroundings::known) return "known, with walls";
  return surroundings == Surroundings::unknown_walls ? "unknown, with walls" : "unknown, empty";
}

/// What the robot believes of its pose and of the map after each step of 0.1 m.
struct Drive {
  Surroundings surroundings;
  int scans_per_m;
  Scene scene;
  Map map;  ///< at the end
  std::vector<incognita::PoseBelief> beliefs;

  /// In m^2, of the position: (x, y) of the covariance.
  [[nodiscard]] static double trace_m2(const incognita::PoseBelief& belief) {
    return belief.covariance.topLeftCorner<2, 2>().trace();
  }

  [[nodiscard]] double initial_trace_m2() const {
    const auto is_there = [](const incognita::PoseBelief& belief) {
      return belief.pose.x_m > kInitial_m - 1e-6;
    };
    return trace_m2(*std::find_if(beliefs.begin(), beliefs.end(), is_there));
  }

  [[nodiscard]] double growth() const { return trace_m2(beliefs.back()) / initial_trace_m2(); }

  /// How far behind x = 0 the trace has grown by a factor for the first time, if it does.
  [[nodiscard]] std::optional<double> distance_of_growth_m(double factor) const {
    for (const incognita::PoseBelief& belief : beliefs) {
      if (belief.pose.x_m > 0.0 && trace_m2(belief) >= factor * initial_trace_m2()) return belief.pose.x_m;
    }
    return std::nullopt;
  }
};

/// Drives at 1 m/s. At each scan, as in Algorithm 1: the covariance is corrected by the hits that the map
/// predicts, then the map takes what the sensor reads, at that covariance. The pose itself is the true one
/// throughout, so that nothing but the coupling of the uncertainties is seen.
[[nodiscard]] inline Drive drive(Surroundings surroundings, int scans_per_m) {
  const Scene scene = corridor(surroundings == Surroundings::unknown_empty ? 0.0 : 24.0);
  Map map = empty_map(scene);
  const double known_to_m = surroundings == Surroundings::known ? 20.0 : -kRange_m;
  survey(scene, {-25.0, 0.0}, {known_to_m, 0.0}, map);

  const incognita::DvlEkf filter;
  const incognita::GainParams prediction{.beams = static_cast<int>(kBeams), .range_max_m = kRange_m};
  incognita::GainWorkspace<incognita::TBayes> workspace;
  workspace.prepare(prediction);
  const incognita::BeamPattern<2> beams = incognita::circular_beams(kBeams, kRange_m);
  constexpr int kStepsPerMetre = 10;
  incognita::PoseBelief belief{{kDriveFrom_m, 0.0, 0.0}, filter.params().start.covariance};
  std::vector<incognita::PoseBelief> beliefs;
  const int steps = static_cast<int>(std::lround((kDriveTo_m - kDriveFrom_m) * kStepsPerMetre));
  for (int step = 1; step <= steps; ++step) {
    belief = filter.imagine_motion(belief, {1.0 / kStepsPerMetre, 0.0, 0.0}, 1.0 / kStepsPerMetre);
    if (step % (kStepsPerMetre / scans_per_m) == 0) {
      workspace.overlay.look_at(map);
      incognita::predict_scan(belief.pose.position(), workspace);
      belief = filter.imagine_scan(belief, workspace.hits, workspace.beams.directions.size(), 1.0);
      map.update(scene.scan(belief.pose.position(), beams), belief.pose, belief.covariance);
    }
    beliefs.push_back(belief);
  }
  return {surroundings, scans_per_m, scene, std::move(map), std::move(beliefs)};
}

/// All surroundings, first with the scans of a 10 Hz sensor at 1 m/s, then with one a metre.
[[nodiscard]] inline std::vector<Drive> all_drives() {
  std::vector<Drive> drives;
  for (const int scans_per_m : {10, 1}) {
    for (const Surroundings surroundings :
         {Surroundings::known, Surroundings::unknown_walls, Surroundings::unknown_empty}) {
      drives.push_back(drive(surroundings, scans_per_m));
    }
  }
  return drives;
}

inline void write_drives(const std::filesystem::path& path, const std::vector<Drive>& drives) {
  examples::write_csv(path, "surroundings,scans_per_m,x_m,trace_m2,trace_over_initial,yaw_variance_rad2",
                      [&](std::ostream& out) {
                        for (const Drive& drive : drives) {
                          for (const incognita::PoseBelief& belief : drive.beliefs) {
                            out << '"' << name_of(drive.surroundings) << "\"," << drive.scans_per_m << ','
                                << belief.pose.x_m << ',' << Drive::trace_m2(belief) << ','
                                << Drive::trace_m2(belief) / drive.initial_trace_m2() << ',' << belief.covariance(2, 2)
                                << '\n';
                          }
                        }
                      });
}

/// The root of the trace, so that growth by 1.1 and by 100 are seen in one chart; the factors are in the
/// legend.
inline void draw_drives(const std::filesystem::path& path, const std::vector<Drive>& drives) {
  std::vector<examples::Chart> charts;
  for (const int scans_per_m : {10, 1}) {
    examples::Chart chart{.title = scans_per_m == 1 ? "(b) 1 scan a metre"
                                                    : "(a) " + std::to_string(scans_per_m) + " scans a metre",
                          .x_label = "distance driven past the edge of the known map (m)",
                          .y_label = "pose sigma √(tr Σ) (m)",
                          .x_range = {{-5.0, kDriveTo_m}},
                          .y_range = {{0.0, 3.0}},
                          .legend = "top left"};
    for (const Drive& drive : drives) {
      if (drive.scans_per_m != scans_per_m) continue;
      std::ostringstream name;
      name.precision(3);
      name << name_of(drive.surroundings) << ": tr Σ × " << drive.growth();
      examples::Series series{.name = name.str(), .width = 2.5};
      if (drive.surroundings == Surroundings::known) series.color = "#000000";
      if (drive.surroundings == Surroundings::unknown_walls) series.color = "#2b8cbe";
      if (drive.surroundings == Surroundings::unknown_empty) series.color = "#e6550d";
      if (drive.surroundings == Surroundings::unknown_walls) series.stroke = examples::Stroke::dashed;
      for (const incognita::PoseBelief& belief : drive.beliefs) {
        series.x.push_back(belief.pose.x_m);
        series.y.push_back(std::sqrt(Drive::trace_m2(belief)));
      }
      chart.series.push_back(std::move(series));
    }
    charts.push_back(std::move(chart));
  }
  examples::write_chart_png(path, charts);
}

}  // namespace coupling
