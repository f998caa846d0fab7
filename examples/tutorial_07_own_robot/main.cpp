/// Tutorial 7, docs/tutorials/07_own_robot.md: a robot of one's own, its wheels, its laser and its controller.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/robot.hpp"
#include "support/belief_output.hpp"
#include "support/tutorial.hpp"

namespace {

// What is known of the robot. Its frame lies between the wheels, x ahead.
constexpr double kRadius_m = 0.2;
constexpr double kTrack_m = 0.32;               // from wheel to wheel
constexpr double kTick_m = 0.2 / 1024.0;        // of way: 1024 ticks for a turn of a wheel of 0.2 m circumference
const incognita::Pose2 T_robot_laser{0.12, 0.06, 0.05};

/// 541 beams over 270 degrees, from right to left.
incognita::BeamPattern<2> laser_beams() {
  constexpr double degree_rad = std::numbers::pi / 180.0;
  incognita::BeamPattern<2> beams = incognita::planar_beams(541, -135.0 * degree_rad, 0.5 * degree_rad, 10.0);
  beams.range_min_m = 0.05;
  return beams;
}

/// T_before_after of the robot, from what its wheels have turned since.
incognita::Pose2 motion(long left_ticks, long right_ticks) {
  const double left_m = kTick_m * static_cast<double>(left_ticks);
  const double right_m = kTick_m * static_cast<double>(right_ticks);
  return incognita::unicycle_motion({0.5 * (left_m + right_m), (right_m - left_m) / kTrack_m}, 1.0);
}

/// The same motion, of the laser: what the explorer is told, because to it the robot is where the laser is.
incognita::Pose2 laser_motion(const incognita::Pose2& T_before_after) {
  return T_robot_laser.inverse() * T_before_after * T_robot_laser;
}

/// Own controller: leads the laser along a path. A point ahead of the axle can be moved in any direction, by driving and turning.
incognita::Twist2 lead(const incognita::Polyline& path, const incognita::Pose2& T_map_laser) {
  const double along_m = path.nearest_along_m(T_map_laser.position(), 0.0, path.length_m());
  const Eigen::Vector2d to_target = (T_map_laser * T_robot_laser.inverse()).inverse() * path.point_at(along_m + 0.3) - T_robot_laser.position();
  const double speed_m_per_s = std::min(0.6, std::max(0.1, 1.5 * (path.length_m() - along_m)));
  const Eigen::Vector2d wanted = to_target.normalized() * speed_m_per_s;
  incognita::Twist2 twist;
  twist.turn_rate_rad_per_s = wanted.y() / T_robot_laser.x_m;
  twist.speed_m_per_s = wanted.x() + twist.turn_rate_rad_per_s * T_robot_laser.y_m;
  // No faster than the wheels can, on the same curve; never backwards, where the laser is blind.
  const double too_fast = std::max(1.0, std::abs(twist.turn_rate_rad_per_s));
  return {std::max(0.0, twist.speed_m_per_s / too_fast), twist.turn_rate_rad_per_s / too_fast};
}

/// The simulated robot: it counts ticks of wheels that slip by a twentieth and are half a percent larger than thought.
class Wheels {
 public:
  void turn(const incognita::Twist2& twist, double duration_s) {
    const double turn_m = 0.5 * kTrack_m * twist.turn_rate_rad_per_s;
    left_ += random_.normal(1.0, 0.05) * (twist.speed_m_per_s - turn_m) * duration_s / (1.005 * kTick_m);
    right_ += random_.normal(1.0, 0.05) * (twist.speed_m_per_s + turn_m) * duration_s / (1.005 * kTick_m);
  }
  [[nodiscard]] long left() const { return std::lround(left_); }
  [[nodiscard]] long right() const { return std::lround(right_); }

 private:
  double left_ = 0.0;
  double right_ = 0.0;
  incognita::Random random_{1};
};

void draw(const std::filesystem::path& file, const incognita::Explorer<>& explorer, const incognita::FloorPlan& plan,
          const incognita::Pose2& T_world_map, const std::vector<Eigen::Vector2d>& axle_m, const incognita::Pose2& T_world_robot) {
  examples::Drawing drawing = examples::building_drawing();
  examples::draw_belief(drawing, explorer.map(), T_world_map);
  examples::draw_true_walls(drawing, plan);
  constexpr examples::Color path{0.1, 0.3, 0.85};
  constexpr examples::Color body{0.1, 0.55, 0.2};
  constexpr examples::Color laser{0.75, 0.1, 0.6};
  drawing.polyline(axle_m, path, 1.5);
  drawing.disc(T_world_robot.position(), kRadius_m, body);
  drawing.marker((T_world_robot * T_robot_laser).position(), laser, 4.0);
  using examples::Swatch;
  drawing.legend({{"occupied", {0.0, 0.0, 0.0}, Swatch::area},
                  {"true wall", examples::true_wall, Swatch::area},
                  {"never seen", examples::never_seen, Swatch::area},
                  {"way of the axle", path, Swatch::line},
                  {"body", body, Swatch::dot},
                  {"laser", laser, Swatch::dot}});
  drawing.write_png(file);
}

void run(examples::OutputFolder& output) {
  using namespace incognita;
  // A disc around the laser that holds all of the robot, wherever it is turned.
  const double reach_m = kRadius_m + T_robot_laser.position().norm();
  ExplorerParams params;
  params.travel.robot_radius_m = reach_m;
  params.guard.robot_radius_m = reach_m;
  params.follow.speed_max_m_per_s = 0.6;  // by which it knows when a drive takes too long
  params.gain.speed_m_per_s = 0.6;
  params.duration_max_s = 900.0;
  Explorer explorer(params);

  const World world(examples::tutorial_building());
  Robot robot(world, Pose2{1.5, 4.7, 0.4});
  const Pose2 T_world_map = robot.T_world_robot() * T_robot_laser;  // the map's frame is where the laser was at the start
  RangeSensor laser({laser_beams(), 0.01}, 1);
  Wheels wheels;
  long left_then = 0;
  long right_then = 0;
  Twist2 command;
  std::vector<Eigen::Vector2d> axle_m;
  double worst_error_m = 0.0;
  while (!explorer.stopped()) {
    for (int step = 0; step < 5; ++step) wheels.turn(robot.move(world, command, 0.02), 0.02);
    const Scan<2>& scan = laser.measure(world, robot.T_world_robot() * T_robot_laser);

    explorer.move(laser_motion(motion(wheels.left() - left_then, wheels.right() - right_then)), 0.1);
    left_then = wheels.left();
    right_then = wheels.right();
    explorer.observe(scan);
    explorer.decide();
    command = {};
    if (const Candidate* to = explorer.decision().chosen()) {  // its path ends at explorer.goal()
      command = guard_command(lead(to->path, explorer.belief().pose), scan, params.guard);
    }

    axle_m.push_back(robot.T_world_robot().position());
    const Pose2 T_world_believed = T_world_map * explorer.belief().pose * T_robot_laser.inverse();
    worst_error_m = std::max(worst_error_m, (T_world_believed.position() - axle_m.back()).norm());
  }

  const Pose2 T_map_world = T_world_map.inverse();
  const Coverage coverage(visible_floor(world, axle_m.front(), kRadius_m, 10.0), T_map_world, explorer.map().lattice());
  const double known = coverage.explored_fraction(
      [&](const Index<2>& cell) { return explorer.occupancy().grid().value(cell) != Occupancy::unknown; });
  std::printf("stopped %s after %.0f s and %.1f m\n", to_string(*explorer.stopped()).data(), explorer.time_s(), robot.distance_m());
  std::printf("explored_fraction %.3f\ncollisions %zu\nworst_error_m %.3f\n", known, robot.collisions(), worst_error_m);
  draw(output.staged("own_robot.png"), explorer, world.plan(), T_world_map, axle_m, robot.T_world_robot());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Explores with a differential drive that counts ticks and a 270 degree laser beside its centre.");
  return examples::run_tutorial("tutorial_07_own_robot", app, argc, argv, run);
}
