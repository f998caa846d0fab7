/// Tutorial 3, docs/tutorials/03_where_to_go.md: frontiers, views of them and what each way there would tell, without an Explorer.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"
#include "tutorial_03_where_to_go/ways.hpp"

namespace {

using namespace tutorial_ways;

/// The entropy that is gone when the way was really driven, a scan every 0.1 m.
double driven_nats(incognita::Map<> map, const incognita::EntropyTable& entropy, const incognita::World& world, const Way& way) {
  using namespace incognita;
  const auto total_nats = [&] { return map_entropy_nats(map, entropy); };
  // Room first, so that cells that nothing was measured of count before and after.
  for (const Eigen::Vector2d& corner_m : way.path.points_m()) {
    map.reserve(Box<Eigen::Vector2d>{corner_m, corner_m}.padded(range_max_m + 2.0));
  }
  const double before_nats = total_nats();
  RangeSensor sensor({circular_beams(360, range_max_m), 0.01}, 2);
  for (const Eigen::Vector2d& at_m : resample_path(way.path, 0.1)) {
    const Pose2 pose{at_m.x(), at_m.y(), 0.0};
    map.update(sensor.measure(world, pose), pose, diagonal_covariance(1e-4, 1e-4, 1e-4));
  }
  return before_nats - total_nats();
}

/// From yellow to dark red.
examples::Color color_of(double share) { return {1.0 - 0.45 * share, 0.8 * (1.0 - share), 0.0}; }

void draw(const std::filesystem::path& file, const incognita::Map<>& map, const Eigen::Vector2d& robot_m, const std::vector<Way>& ways) {
  examples::Drawing drawing = examples::building_drawing();
  examples::draw_belief(drawing, map, incognita::Pose2{});
  const double most_nats = ways.front().gain_nats;
  for (const Way& way : ways) {
    const examples::Color color = color_of(way.gain_nats / most_nats);
    for (const incognita::Index<2>& cell : way.frontier.cells) drawing.disc(map.lattice().center_m(cell), 0.07, color);
    drawing.polyline(way.path.points_m(), color, 3.0);
  }
  for (const Way& way : ways) {
    const examples::Color color = color_of(way.gain_nats / most_nats);
    drawing.marker(way.path.points_m().back(), color);
    drawing.text(way.path.points_m().back(), std::to_string(std::lround(way.gain_nats)), {0.1, 0.1, 0.1}, 15.0);
  }
  constexpr examples::Color robot{0.1, 0.3, 0.85};
  drawing.marker(robot_m, robot, 9.0);
  using examples::Swatch;
  drawing.legend({{"robot", robot, Swatch::dot},
                  {"frontier, way and viewpoint: little gain", color_of(0.0), Swatch::line},
                  {"much", color_of(1.0), Swatch::line},
                  {"never measured", examples::never_seen, Swatch::area}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  using namespace incognita;
  const World world(examples::tutorial_building());
  Map<> map;
  const PoseBelief robot = map_half(world, map);

  const EntropyTable entropy{Behavioral(1.0)};  // what a cell's uncertainty is, by its log-odds
  std::vector<Way> ways = ways_to_look(map, robot.pose.position());
  predict_gains(map, robot, entropy, ways);
  for (Way& way : ways) way.truth_nats = driven_nats(map, entropy, world, way);
  std::printf("   gain    true  way to  (nats, nats, m)\n");
  for (const Way& way : ways) {
    const Eigen::Vector2d& goal_m = way.path.points_m().back();
    std::printf("way %6.0f  %6.0f  %4.1f, %3.1f  %4.1f m\n", way.gain_nats, way.truth_nats, goal_m.x(), goal_m.y(), way.path.length_m());
  }
  draw(output.staged("where_to_go.png"), map, robot.pose.position(), ways);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Ranks the ways to the frontiers of a half finished map by what they are predicted to tell.");
  return examples::run_tutorial("tutorial_03_where_to_go", app, argc, argv, run);
}
