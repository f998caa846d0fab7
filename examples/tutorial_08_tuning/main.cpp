/// Tutorial 8, docs/tutorials/08_tuning.md: what gamma, R_o, R_u, N_max and alpha do.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/io/carmen_log.hpp"
#include "incognita/metrics/map_error.hpp"
#include "incognita/metrics/truth.hpp"
#include "support/belief_output.hpp"
#include "support/chart.hpp"
#include "support/tutorial.hpp"
#include "support/tutorial_recording.hpp"
#include "tutorial_02_localise/localise.hpp"
#include "tutorial_03_where_to_go/ways.hpp"

namespace {

using incognita::TBayes;

constexpr std::array kColors{"#2b8cbe", "#000000", "#e6550d", "#31a354"};

std::string named(const std::string& name, double value, const std::string& unit = "") {
  char text[80];
  std::snprintf(text, sizeof text, "%s = %g%s", name.c_str(), value, unit.c_str());
  return text;
}

/// A map of the log's scans at their poses.
incognita::Map<> map_of(const incognita::RobotLog& log, const TBayes::Params& cell) {
  incognita::Map<> map(incognita::MapParams{}, TBayes(cell));
  for (const incognita::LogScan& entry : log.scans) {
    map.update(incognita::Scan<2>(log.beams, entry.ranges_m), entry.T_odom_robot, incognita::diagonal_covariance(1e-4, 1e-4, 1e-4));
  }
  return map;
}

void report(const std::string& name, const incognita::Map<>& map, const incognita::World& world) {
  const auto truth = incognita::truly_occupied_cells(world.plan(), incognita::Pose2{}, map.lattice());
  const incognita::OccupancyThresholds thresholds;
  std::array<std::size_t, 3> walls{};
  std::array<std::size_t, 3> floor{};
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(map.grid().size()); ++cell) {
    if (map.log_odds(cell) == 0.0F) continue;
    auto& counts = truth.value(map.grid().index_at(cell)) != 0 ? walls : floor;
    ++counts[static_cast<std::size_t>(thresholds.classify(map.log_odds(cell)))];
  }
  std::printf("%-18s map_error %.3f  of walls: %4zu occupied %3zu unknown %3zu free  of floor: %4zu occupied %3zu unknown %5zu free\n",
              name.c_str(), incognita::map_error(map, truth).value(), walls[2], walls[0], walls[1], floor[2], floor[0], floor[1]);
}

/// The same part of three maps, side by side.
void draw_three(const std::filesystem::path& file, const std::array<incognita::Map<>, 3>& maps, const std::array<std::string, 3>& titles) {
  const examples::Area view{{10.2, -0.1}, {16.2, 4.1}};
  examples::Drawing drawing({{-0.1, -0.1}, {19.3, 4.8}}, 1000, 1048.0);
  for (std::size_t i = 0; i < 3; ++i) {
    examples::draw_part(drawing, maps[i], view, Eigen::Vector2d(6.5 * static_cast<double>(i), 0.0) - view.lower, titles[i]);
  }
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area},
                  {"undecided", {0.5, 0.5, 0.5}, Swatch::area},
                  {"free", {1.0, 1.0, 1.0}, Swatch::area},
                  {"never measured", examples::never_seen, Swatch::area}});
  drawing.write_png(file);
}

void tune_likelihoods(const incognita::RobotLog& log, const incognita::World& world, examples::OutputFolder& output) {
  const auto with = [&](double occupied_m, double unoccupied_m) {
    TBayes::Params cell;
    cell.dvl.occupied_m2 = occupied_m * occupied_m;        // R_o
    cell.dvl.unoccupied_m2 = unoccupied_m * unoccupied_m;  // R_u
    return map_of(log, cell);
  };
  const std::array r_o{with(0.1, 3.0), with(0.39, 3.0), with(1.0, 3.0)};
  const std::array<std::string, 3> r_o_names{"sqrt(R_o) = 0.1 m", "sqrt(R_o) = 0.39 m", "sqrt(R_o) = 1 m"};
  const std::array r_u{with(0.39, 0.5), with(0.39, 3.0), with(0.39, 20.0)};
  const std::array<std::string, 3> r_u_names{"sqrt(R_u) = 0.5 m", "sqrt(R_u) = 3 m", "sqrt(R_u) = 20 m"};
  for (std::size_t i = 0; i < 3; ++i) report(r_o_names[i], r_o[i], world);
  for (std::size_t i = 0; i < 3; ++i) report(r_u_names[i], r_u[i], world);
  draw_three(output.staged("r_o.png"), r_o, r_o_names);
  draw_three(output.staged("r_u.png"), r_u, r_u_names);
}

/// A box stands in a room for 100 scans and is then carried away.
void tune_hits(examples::OutputFolder& output) {
  const examples::Area box{{3.4, 1.4}, {4.2, 2.2}};
  incognita::FloorPlan cluttered = examples::tutorial_building();
  examples::draw_blocks(cluttered, {box});
  const incognita::World before(cluttered);
  const incognita::World after(examples::tutorial_building());
  const std::vector<incognita::Pose2> poses = examples::poses_along({{2.5, 3.4}, {2.5, 2.0}, {2.5, 3.4}, {2.5, 2.0}});

  examples::Chart decided{.title = "A wall's cell and how often it was hit", .x_label = "hits", .y_label = "log-odds"};
  examples::Chart removed{.title = "A box that was carried away", .x_label = "scans since", .y_label = "its cells that are still occupied"};
  std::size_t color = 0;
  for (const int hits_max : {1, 3, 10, 100}) {
    TBayes::Params cell;
    cell.hits_max = hits_max;  // N_max
    const TBayes policy(cell);
    examples::Series evidence{.name = named("N_max", hits_max), .color = kColors[color]};
    TBayes::State state;
    for (int hits = 0; hits <= 20; ++hits) {
      evidence.x.push_back(hits);
      evidence.y.push_back(static_cast<double>(state.log_odds));
      policy.hit(state, policy.beam(1e-4), 0.0F, static_cast<incognita::ScanStamp>(hits + 1));
    }
    decided.series.push_back(evidence);

    incognita::Map<> map(incognita::MapParams{}, policy);
    incognita::RangeSensor sensor({incognita::circular_beams(360, 10.0), 0.01}, 1);
    const auto scan_from = [&](const incognita::World& world, std::size_t scan) {
      const incognita::Pose2& pose = poses[scan % poses.size()];
      map.update(sensor.measure(world, pose), pose, incognita::diagonal_covariance(1e-4, 1e-4, 1e-4));
    };
    const auto occupied = [&] {
      const incognita::IndexBox<2> cells = map.lattice().cells_of(box);
      int count = 0;
      for (int y = cells.lower[1]; y < cells.upper[1]; ++y) {
        for (int x = cells.lower[0]; x < cells.upper[0]; ++x) count += map.log_odds(incognita::Index<2>(x, y)) > 1.0F ? 1 : 0;
      }
      return count;
    };
    for (std::size_t scan = 0; scan < 100; ++scan) scan_from(before, scan);
    examples::Series left{.name = named("N_max", hits_max), .color = kColors[color++]};
    std::size_t gone_after = 0;
    for (std::size_t scan = 0; scan <= 40; ++scan) {
      left.x.push_back(static_cast<double>(scan));
      left.y.push_back(occupied());
      if (occupied() > 0) gone_after = scan + 1;
      scan_from(after, scan);
    }
    std::printf("N_max %3d log-odds after 1, 3, 20 hits: %.2f %.2f %.2f  box: %.0f cells, gone after %zu scans\n", hits_max, evidence.y[1], evidence.y[3],
                evidence.y[20], left.y.front(), gone_after);
    removed.series.push_back(left);
  }
  examples::write_chart_png(output.staged("n_max.png"), {decided, removed});
}

void tune_gamma(const incognita::RobotLog& log, const incognita::World& world, examples::OutputFolder& output) {
  using namespace tutorial_localise;
  std::vector<examples::Chart> charts;
  for (const double gamma : {4.8, 48.0, 480.0, 4800.0, 48000.0}) {
    incognita::DvlEkf::Params params;
    params.registration.gamma = gamma;
    const Slam slam = learn(log, params);
    const incognita::Pose2 T_map_world = map_from_world(log);
    Score mean;
    constexpr int seeds = 3;
    for (int seed = 1; seed <= seeds; ++seed) {
      incognita::Simulator robot = robot_after(log, world, static_cast<std::uint64_t>(seed));
      const std::vector<Instant> instants = localise(slam, examples::moved(todays_route_m(), T_map_world), T_map_world, robot);
      const Score score = score_of(instants);
      mean.rmse_m += score.rmse_m / seeds;
      mean.sigma_m += score.sigma_m / seeds;
      mean.nees += score.nees / seeds;
      mean.within_3_sigma += score.within_3_sigma / seeds;
      if (seed > 1 || gamma == 48.0 || gamma == 4800.0) continue;
      examples::Series error{.name = "true error", .color = "#1a4dd9"};
      examples::Series bound{.name = "3 sigma", .color = "#1a4dd9", .stroke = examples::Stroke::dashed};
      for (std::size_t i = 0; i < instants.size(); i += 4) {
        const Instant& now = instants[i];
        error.x.push_back(now.time_s);
        bound.x.push_back(now.time_s);
        error.y.push_back(100.0 * distance_m(now.belief.pose, now.truth));
        bound.y.push_back(300.0 * incognita::position_sigma_m(now.belief.covariance));
      }
      charts.push_back({.title = named("gamma", gamma), .x_label = "time (s)", .y_label = "position (cm)", .series = {error, bound}, .y_range = {{0.0, 16.0}}});
    }
    std::printf("gamma %7g rmse %.4f m  sigma %.4f m  nees %5.2f  within 3 sigma %.3f\n", gamma, mean.rmse_m, mean.sigma_m, mean.nees, mean.within_3_sigma);
  }
  examples::write_chart_png(output.staged("gamma.png"), charts);
}

void tune_alpha(const incognita::World& world, examples::OutputFolder& output) {
  using namespace tutorial_ways;
  incognita::Map<> map;
  const incognita::PoseBelief robot = map_half(world, map);
  examples::Chart curves{.title = "Uncertainty of a cell", .x_label = "probability that it is occupied", .y_label = "nats", .x_range = {{0.0, 1.0}}};
  examples::Chart gains{.title = "The ways of tutorial 3", .x_label = "way, by its gain for alpha = 1", .y_label = "gain, of the greatest", .x_range = {{0.5, 8.5}}, .y_range = {{0.0, 1.05}}};
  std::vector<Way> ways = ways_to_look(map, robot.pose.position());
  predict_gains(map, robot, incognita::EntropyTable{incognita::Behavioral(1.0)}, ways);
  const std::vector<Way> in_order = ways;
  std::size_t color = 0;
  for (const double alpha : {0.3, 1.0, 3.0}) {
    const incognita::Behavioral entropy(alpha);
    examples::Series curve{.name = named("alpha", alpha), .color = kColors[color]};
    for (int i = 0; i <= 400; ++i) {
      curve.x.push_back(i / 400.0);
      curve.y.push_back(entropy(i / 400.0));
    }
    curves.series.push_back(curve);
    predict_gains(map, robot, incognita::EntropyTable{entropy}, ways);
    examples::Series gain{.name = named("alpha", alpha), .color = kColors[color++], .stroke = examples::Stroke::points, .width = 4.0};
    std::printf("alpha %g gains of the greatest:", alpha);
    for (std::size_t i = 0; i < in_order.size(); ++i) {
      for (const Way& way : ways) {
        if (way.path.points_m().back() != in_order[i].path.points_m().back()) continue;
        gain.x.push_back(static_cast<double>(i + 1));
        gain.y.push_back(way.gain_nats / ways.front().gain_nats);
        std::printf(" %.2f", gain.y.back());
      }
    }
    std::printf("  (%.0f nats)\n", ways.front().gain_nats);
    gains.series.push_back(gain);
  }
  examples::write_chart_png(output.staged("alpha.png"), {curves, gains});
}

void run(examples::OutputFolder& output) {
  examples::require_gnuplot();
  const incognita::World world(examples::tutorial_building());
  examples::write_recording(output.staged("scans.log"), world);
  const incognita::RobotLog log = incognita::read_carmen_log(output.staged("scans.log"));
  tune_likelihoods(log, world, output);
  tune_hits(output);
  tune_gamma(log, world, output);
  tune_alpha(world, output);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Shows what gamma, R_o, R_u, N_max and alpha do.");
  return examples::run_tutorial("tutorial_08_tuning", app, argc, argv, run);
}
