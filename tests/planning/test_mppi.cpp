#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "../allocations.hpp"
#include "drawn_plan.hpp"
#include "incognita/core/random.hpp"
#include "incognita/geometry/unicycle.hpp"
#include "incognita/io/state_archive.hpp"
#include "incognita/planning/clearance_window.hpp"
#include "incognita/planning/collision_guard.hpp"
#include "incognita/planning/mppi.hpp"
#include "incognita/planning/path.hpp"
#include "incognita/planning/room_aside.hpp"
#include "incognita/sensor/ray_cast.hpp"

using namespace incognita;

namespace {

bool is_wall(Occupancy cell) { return cell == Occupancy::occupied; }

/// Of nothing: everything is clear.
const Grid<float, 2> open_floor{Lattice<2>(0.1)};

struct SteeredDrive {
  double time_s = 0.0;
  double deviation_max_m = 0.0;
  bool finished = false;
  Pose2 pose;
};

/// Follows until finished or for time_max_s; checks the limits.
SteeredDrive drive(MppiController& controller, PathFollower course, const Pose2& start, const Grid<float, 2>& clearance_m, double time_max_s) {
  SteeredDrive result{0.0, 0.0, false, start};
  const MppiParams& params = controller.params();
  for (; result.time_s < time_max_s; result.time_s += params.step_s) {
    course.advance(result.pose);
    const Twist2 twist = controller.command(result.pose, course, clearance_m);
    result.finished = course.is_finished();
    if (result.finished) break;
    REQUIRE(twist.speed_m_per_s >= 0.0);
    REQUIRE(twist.speed_m_per_s <= params.speed_max_m_per_s);
    REQUIRE(std::abs(twist.turn_rate_rad_per_s) <= params.turn_rate_max_rad_per_s);
    result.pose = result.pose * unicycle_motion(twist, params.step_s);
    const Polyline& path = course.path();
    const Eigen::Vector2d nearest_m = path.point_at(path.nearest_along_m(result.pose.position(), 0.0, path.length_m()));
    result.deviation_max_m = std::max(result.deviation_max_m, (nearest_m - result.pose.position()).norm());
  }
  return result;
}

void scan_around(const OccupancyGrid<2>& world, const Pose2& pose, Scan<2>& scan) {
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    scan.set_range_m(beam, cast_ray_m(world, pose.position(), Eigen::Vector2d(pose.rotation() * scan.direction(beam)), scan.range_max_m(), is_wall));
  }
}

struct GuardedDrive {
  bool finished = false;
  double closest_m = 1.0;
  double time_s = 0.0;
};

/// Steered at 10 Hz by what a scan and the world's cells show, guarded, and driven in steps of 0.02 s.
GuardedDrive drive_guarded(const OccupancyGrid<2>& world, const std::vector<Eigen::Vector2d>& path_m, Pose2 pose, double time_max_s,
                           std::uint64_t seed) {
  const CollisionGuardParams guard;
  MppiParams params;
  params.robot_radius_m = guard.robot_radius_m + guard.creep_margin_m;
  params.samples = 256;
  params.seed = seed;
  MppiController controller(params);
  PathFollower course(path_m);
  ClearanceWindow window(world.lattice());
  Scan<2> scan(circular_beams(180, 10.0));
  const double keep_m = params.robot_radius_m + params.margin_m;
  GuardedDrive result;
  for (; result.time_s < time_max_s; result.time_s += 0.1) {
    course.advance(pose);
    if (course.is_finished()) break;
    scan_around(world, pose, scan);
    window.measure(pose.position(), params.reach_m() + keep_m, [&](const Index<2>& cell) { return is_wall(world.value(cell)); });
    const Grid<float, 2>& clearance_m = window.lower_to(near_hits_m(pose, scan, params.reach_m() + keep_m), keep_m);
    const Twist2 twist = guard_command(controller.command(pose, course, clearance_m), scan, guard);
    for (int step = 0; step < 5; ++step) {
      pose = pose * unicycle_motion(twist, 0.02);
      result.closest_m = std::min(result.closest_m, distance_to_squares_m(world, pose.position()));
    }
  }
  result.finished = course.is_finished();
  return result;
}

std::vector<double> numbers(const std::vector<Twist2>& plan) {
  std::vector<double> all;
  for (const Twist2& twist : plan) all.insert(all.end(), {twist.speed_m_per_s, twist.turn_rate_rad_per_s});
  return all;
}

/// A course with a corner, and a wall beside it.
struct Scene {
  OccupancyGrid<2> world = draw({"....................",  //
                                 "....................",  //
                                 "....................",  //
                                 ".........####.......",  //
                                 ".........####.......",  //
                                 "....................",  //
                                 "....................",  //
                                 "...................."},
                                0.1, 2);
  Grid<float, 2> clearance_m = clearance_of(world);
  PathFollower course{std::vector<Eigen::Vector2d>{{0.3, 0.4}, {2.0, 0.5}, {2.6, 1.3}}};
  Pose2 pose{0.35, 0.5, 0.4};
};

}  // namespace

TEST_CASE("A free straight path is driven along to its end", "[planning]") {
  MppiController controller;
  const SteeredDrive straight = drive(controller, PathFollower({{0.0, 0.0}, {8.0, 0.0}}), {}, open_floor, 20.0);
  CHECK(straight.finished);
  CHECK(straight.deviation_max_m < 0.1);
  CHECK(straight.time_s < 9.5);
  CHECK(controller.plan().empty());
}

TEST_CASE("From any heading, and aside of the path, the robot gets to the path and to its end", "[planning]") {
  Random random(1);
  for (int trial = 0; trial < 8; ++trial) {
    MppiParams params;
    params.samples = 256;
    params.seed = static_cast<std::uint64_t>(trial);
    MppiController controller(params);
    const Pose2 start{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-3.1, 3.1)};
    const Eigen::Vector2d end_m(random.uniform(2.0, 4.0), random.uniform(-2.0, 2.0));
    const SteeredDrive there = drive(controller, PathFollower({{0.0, 0.0}, {1.5, 0.5}, end_m}), start, open_floor, 30.0);
    CAPTURE(trial, there.pose.x_m, there.pose.y_m);
    CHECK(there.finished);
    CHECK((there.pose.position() - end_m).norm() <= 0.1);
    CHECK(there.time_s < 14.0);
    CHECK(there.deviation_max_m < 0.6);
  }
}

TEST_CASE("Paths of one place or none are driven", "[planning]") {
  MppiController controller;
  CHECK(drive(controller, PathFollower(std::vector<Eigen::Vector2d>{{0.5, 0.3}}), {}, open_floor, 10.0).finished);
  CHECK(drive(controller, PathFollower({{0.5, 0.3}, {0.5, 0.3}}), {}, open_floor, 10.0).finished);
  CHECK(controller.command({}, PathFollower(), open_floor).speed_m_per_s == 0.0);
}

TEST_CASE("A robot that the guard watches passes blocks without touching them", "[planning]") {
  Random random(2);
  int driven = 0;
  int finished = 0;
  double closest_m = 1.0;
  for (int draw = 0; driven < 6; ++draw) {
    OccupancyGrid<2> world = random_belief(random, 60, 50, 0.1);
    const IndexBox<2> box = world.box();
    for (int y = box.lower.y(); y < box.upper.y(); ++y) {
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        const bool is_rim = x == box.lower.x() || y == box.lower.y() || x + 1 == box.upper.x() || y + 1 == box.upper.y();
        if (is_rim) world.set({x, y}, Occupancy::occupied);
        if (world.value({x, y}) == Occupancy::unknown) world.set({x, y}, Occupancy::free);
      }
    }
    const Grid<float, 2> clearance_m = clearance_of(world);
    const auto somewhere = [&] { return world.index_at(static_cast<Offset>(random.index(world.size()))); };
    const Index<2> start = somewhere();
    const Index<2> goal = somewhere();
    if (clearance_m.value(start) < 0.35F || clearance_m.value(goal) < 0.35F) continue;
    const Eigen::Vector2d start_m = world.lattice().center_m(start);
    const TravelCostField field(world, clearance_m, start_m);
    const auto path_m = shorten_path(field, find_path(field, goal));
    if (path_m.size() < 2 || Polyline(path_m).length_m() < 2.0) continue;
    ++driven;
    const GuardedDrive result = drive_guarded(world, path_m, {start_m.x(), start_m.y(), random.uniform(-3.0, 3.0)},
                                              20.0 + 3.0 * Polyline(path_m).length_m(), static_cast<std::uint64_t>(draw));
    CAPTURE(draw, result.time_s, Polyline(path_m).length_m());
    CHECK(result.closest_m > 0.2);
    closest_m = std::min(closest_m, result.closest_m);
    finished += static_cast<int>(result.finished);
  }
  CHECK(finished >= 5);
  CHECK(closest_m < 0.4);  // some ways were narrow
}

TEST_CASE("A block that stands on the path is driven around", "[planning]") {
  OccupancyGrid<2> world(Lattice<2>(0.1), {{-10, -30}, {60, 30}}, Occupancy::free);
  for (int x = 20; x < 24; ++x) {
    for (int y = -1; y < 3; ++y) world.set({x, y}, Occupancy::occupied);
  }
  const GuardedDrive around = drive_guarded(world, {{0.0, 0.0}, {4.5, 0.0}}, {}, 30.0, 1);
  CHECK(around.finished);
  CHECK(around.closest_m > 0.2);
  CHECK(around.time_s < 12.0);
}

TEST_CASE("A door of 0.65 m is passed, at any angle of the way to it", "[planning]") {
  OccupancyGrid<2> world(Lattice<2>(0.05), {{-60, -60}, {60, 60}}, Occupancy::free);
  for (int x = 0; x < 3; ++x) {
    for (int y = -60; y < 60; ++y) world.set({x, y}, y >= -6 && y < 7 ? Occupancy::free : Occupancy::occupied);
  }
  for (const double from_y_m : {-1.5, 0.0, 1.2}) {
    const GuardedDrive through = drive_guarded(world, {{-1.5, from_y_m}, {-0.4, 0.0}, {1.5, 0.3}}, {-1.5, from_y_m, 0.0}, 40.0, 3);
    CAPTURE(from_y_m, through.time_s);
    CHECK(through.finished);
    CHECK(through.closest_m > 0.2);
  }
}

TEST_CASE("Weights are those of a long double sum, whatever the costs", "[planning]") {
  Random random(3);
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<double> costs(1 + random.index(300));
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    for (double& cost : costs) cost = 1e3 * random.uniform(-1.0, 1.0) * (draw % 2) + scale * random.uniform();
    const double temperature = std::pow(10.0, random.uniform(-3.0, 3.0));
    std::vector<double> weights;
    path_integral_weights(costs, temperature, weights);
    const long double least = *std::min_element(costs.begin(), costs.end());
    long double sum = 0.0L;
    for (const double cost : costs) sum += std::exp(-(static_cast<long double>(cost) - least) / static_cast<long double>(temperature));
    double total = 0.0;
    REQUIRE(weights.size() == costs.size());
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const long double expected = std::exp(-(static_cast<long double>(costs[i]) - least) / static_cast<long double>(temperature)) / sum;
      REQUIRE(weights[i] == Approx(static_cast<double>(expected)).epsilon(1e-9).margin(1e-300));
      total += weights[i];
    }
    REQUIRE(total == Approx(1.0));
  }
}

TEST_CASE("Costs and plans are those that the definition gives, written out for one sample after the other", "[planning]") {
  using Real = long double;
  Scene scene;
  MppiParams params;
  params.samples = 60;
  MppiController controller(params);
  Twist2 last;
  for (std::uint64_t call = 0; call < 3; ++call) {
    scene.course.advance(scene.pose);
    const std::vector<Twist2> begin = controller.warm_started(scene.pose, scene.course);
    const Twist2 commanded = controller.command(scene.pose, scene.course, scene.clearance_m);

    // The path ahead, as places a tenth of a metre apart.
    const Polyline& path = scene.course.path();
    const double from_m = scene.course.progress_m();
    const double end_m = std::min(path.length_m(), from_m + params.reach_m() + params.aim_m);
    std::vector<Eigen::Vector2d> places_m;
    std::vector<Real> left_m;
    for (int i = 0; from_m + 0.1 * i < end_m; ++i) {
      places_m.push_back(path.point_at(from_m + 0.1 * i));
      left_m.push_back(static_cast<Real>(end_m - from_m - 0.1 * i));
    }
    places_m.push_back(path.point_at(end_m));
    left_m.push_back(0.0L);
    const auto clearance_at = [&](const Eigen::Vector2d& at_m) -> Real {
      const Eigen::Vector2d cells = scene.clearance_m.lattice().to_cells(at_m) - Eigen::Vector2d(0.5, 0.5);
      Real sum = 0.0L;
      for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
          const Index<2> cell(static_cast<int>(std::floor(cells.x())) + dx, static_cast<int>(std::floor(cells.y())) + dy);
          const float there_m = scene.clearance_m.value(cell);
          const Real share = (1.0L - std::abs(static_cast<Real>(cells.x()) - cell.x())) * (1.0L - std::abs(static_cast<Real>(cells.y()) - cell.y()));
          sum += share * static_cast<Real>(std::min(static_cast<float>(params.robot_radius_m + params.margin_m), there_m));
        }
      }
      return sum;
    };

    std::vector<Real> costs;
    std::vector<std::vector<Twist2>> noises;
    for (std::size_t sample = 0; sample < 60; ++sample) {
      std::vector<Twist2>& noise = noises.emplace_back();
      controller.for_each_noise(call, sample, [&](std::size_t step, const Twist2& added) {
        REQUIRE(step == noise.size());
        noise.push_back(added);
      });
      Real x_m = scene.pose.x_m;
      Real y_m = scene.pose.y_m;
      Real yaw_rad = scene.pose.yaw_rad;
      Real cost = 0.0L;
      Real speed_before = last.speed_m_per_s;
      Real turn_before = last.turn_rate_rad_per_s;
      std::size_t nearest = 0;
      const Real step_s = params.step_s;
      for (std::size_t step = 0; step < begin.size(); ++step) {
        const Real speed = std::clamp(begin[step].speed_m_per_s + noise[step].speed_m_per_s, 0.0, 1.0);
        const Real turn = std::clamp(begin[step].turn_rate_rad_per_s + noise[step].turn_rate_rad_per_s, -1.0, 1.0);
        // A circle's arc.
        if (std::abs(turn) > 1e-9L) {
          x_m += speed / turn * (std::sin(yaw_rad + turn * step_s) - std::sin(yaw_rad));
          y_m -= speed / turn * (std::cos(yaw_rad + turn * step_s) - std::cos(yaw_rad));
        } else {
          x_m += speed * step_s * std::cos(yaw_rad);
          y_m += speed * step_s * std::sin(yaw_rad);
        }
        yaw_rad += turn * step_s;
        const auto away_m = [&](std::size_t place) { return std::hypot(x_m - places_m[place].x(), y_m - places_m[place].y()); };
        while (nearest + 1 < places_m.size() && away_m(nearest + 1) <= away_m(nearest)) ++nearest;
        const Eigen::Vector2d along = places_m[std::min(nearest + 1, places_m.size() - 1)] - places_m[nearest == 0 ? 0 : nearest - 1];
        Real along_m = ((x_m - places_m[nearest].x()) * along.x() + (y_m - places_m[nearest].y()) * along.y()) / along.norm();
        if (nearest + 1 == places_m.size()) along_m = std::min(along_m, 0.0L);
        const Real aside_m = std::sqrt(std::max(0.0L, away_m(nearest) * away_m(nearest) - along_m * along_m));
        const Real way_left_m = left_m[nearest] - along_m + aside_m;
        const std::size_t aim = std::min(nearest + 4, places_m.size() - 1);
        const Real off_rad = std::atan2(places_m[aim].y() - y_m, places_m[aim].x() - x_m) - yaw_rad;
        Real wanted = 1.0L;
        if (end_m == path.length_m()) wanted = std::min(wanted, std::sqrt(2.0L * static_cast<Real>(params.deceleration_m_per_s2) * way_left_m));
        const Real slower = wanted * std::max(0.0L, std::cos(off_rad)) - speed;
        Real a_second = params.way_left_weight * way_left_m + params.deviation_weight * aside_m * aside_m +
                        params.heading_weight * (1.0L - std::cos(off_rad)) * std::min(1.0L, away_m(aim) / static_cast<Real>(params.aim_m)) +
                        params.speed_weight * slower * slower;
        const Real clearance_m = clearance_at({static_cast<double>(x_m), static_cast<double>(y_m)});
        const Real keep_m = std::min(static_cast<Real>(params.robot_radius_m), clearance_at(places_m[nearest]));
        const Real share = (params.robot_radius_m + params.margin_m - clearance_m) / params.margin_m;
        if (share > 0.0L) a_second += params.obstacle_weight * std::min(1.0L, share) * std::min(1.0L, share);
        if (clearance_m < keep_m) a_second += params.collision_weight * (1.0L + (keep_m - clearance_m) / params.robot_radius_m);
        cost += step_s * a_second + params.smoothness_weight * ((speed - speed_before) * (speed - speed_before) + (turn - turn_before) * (turn - turn_before));
        speed_before = speed;
        turn_before = turn;
      }
      costs.push_back(cost);
      CAPTURE(call, sample);
      REQUIRE(controller.costs()[sample] == Approx(static_cast<double>(cost)).epsilon(1e-9));
    }
    // By the controller's own costs: what differs in them by rounding is not the matter here.
    const double least = *std::min_element(controller.costs().begin(), controller.costs().end());
    Real sum = 0.0L;
    for (const double cost : controller.costs()) sum += std::exp((static_cast<Real>(least) - cost) / static_cast<Real>(params.temperature));
    for (std::size_t step = 0; step < begin.size(); ++step) {
      Real speed = begin[step].speed_m_per_s;
      Real turn = begin[step].turn_rate_rad_per_s;
      for (std::size_t sample = 0; sample < noises.size(); ++sample) {
        const Real weight = std::exp((static_cast<Real>(least) - controller.costs()[sample]) / static_cast<Real>(params.temperature)) / sum;
        speed += weight * noises[sample][step].speed_m_per_s;
        turn += weight * noises[sample][step].turn_rate_rad_per_s;
      }
      REQUIRE(controller.plan()[step].speed_m_per_s == Approx(static_cast<double>(std::clamp(speed, 0.0L, 1.0L))).margin(1e-12));
      REQUIRE(controller.plan()[step].turn_rate_rad_per_s == Approx(static_cast<double>(std::clamp(turn, -1.0L, 1.0L))).margin(1e-12));
    }
    REQUIRE(commanded.speed_m_per_s == controller.plan().front().speed_m_per_s);
    last = commanded;
    scene.pose = scene.pose * unicycle_motion(commanded, params.step_s);
  }
}

TEST_CASE("The noise has the deviations and the correlation that are asked for", "[planning]") {
  MppiParams params;
  params.noise_lasts_s = GENERATE(0.0, 0.5);
  params.samples = 4000;
  const MppiController controller(params);
  std::vector<double> speed2(25, 0.0);
  std::vector<double> turn2(25, 0.0);
  std::vector<double> next(25, 0.0);
  for (std::size_t sample = 1; sample < 4000; ++sample) {
    Twist2 before;
    controller.for_each_noise(0, sample, [&](std::size_t step, const Twist2& noise) {
      speed2[step] += noise.speed_m_per_s * noise.speed_m_per_s / 3999.0;
      turn2[step] += noise.turn_rate_rad_per_s * noise.turn_rate_rad_per_s / 3999.0;
      next[step] += noise.speed_m_per_s * before.speed_m_per_s / 3999.0;
      before = noise;
    });
  }
  const double lasting = params.noise_lasts_s > 0.0 ? std::exp(-0.1 / params.noise_lasts_s) : 0.0;
  for (std::size_t step = 0; step < 25; ++step) {
    CHECK(speed2[step] == Approx(0.3 * 0.3).epsilon(0.1));
    CHECK(turn2[step] == Approx(0.4 * 0.4).epsilon(0.1));
    if (step > 0) CHECK(next[step] == Approx(0.3 * 0.3 * lasting).margin(0.008));
  }
}

TEST_CASE("Without noise the plan is the warm start: pure pursuit first, then the plan before, a step later", "[planning]") {
  Scene scene;
  MppiParams params;
  params.speed_sigma_m_per_s = params.turn_rate_sigma_rad_per_s = 0.0;
  MppiController controller(params);
  PathFollower guide = scene.course;
  Pose2 pose = scene.pose;
  std::vector<Twist2> expected;
  for (int step = 0; step < params.horizon_steps; ++step) {
    expected.push_back(guide.command(pose));
    pose = pose * unicycle_motion(expected.back(), params.step_s);
  }
  (void)controller.command(scene.pose, scene.course, scene.clearance_m);
  REQUIRE(numbers(controller.plan()) == numbers(expected));
  (void)controller.command(scene.pose, scene.course, scene.clearance_m);
  expected.erase(expected.begin());
  expected.push_back(expected.back());
  REQUIRE(numbers(controller.plan()) == numbers(expected));

  // Another path begins anew, and so does the same one after forget().
  const PathFollower other({{0.3, 0.4}, {0.3, 1.2}});
  const std::vector<double> anew = numbers(MppiController(params).warm_started(scene.pose, other));
  REQUIRE(numbers(controller.warm_started(scene.pose, other)) == anew);
  REQUIRE(numbers(controller.warm_started(scene.pose, scene.course)) != numbers(MppiController(params).warm_started(scene.pose, scene.course)));
  controller.forget();
  REQUIRE(numbers(controller.warm_started(scene.pose, scene.course)) == numbers(MppiController(params).warm_started(scene.pose, scene.course)));
}

TEST_CASE("Plans do not depend on the number of threads, nor on what a grid holds beyond reach", "[planning]") {
  std::vector<double> of_one;
  for (const int threads : {1, 2, 4}) {
    Scene scene;
    if (threads == 4) scene.clearance_m.grow_to_include({{-200, -200}, {200, 200}});
    MppiParams params;
    params.samples = 100;  // chunks that are not full
    params.threads = threads;
    MppiController controller(params);
    std::vector<double> all;
    for (int call = 0; call < 6; ++call) {
      scene.course.advance(scene.pose);
      scene.pose = scene.pose * unicycle_motion(controller.command(scene.pose, scene.course, scene.clearance_m), params.step_s);
      const std::vector<double> plan = numbers(controller.plan());
      all.insert(all.end(), plan.begin(), plan.end());
      all.insert(all.end(), controller.costs().begin(), controller.costs().end());
    }
    if (threads == 1) of_one = all;
    REQUIRE(all == of_one);
  }
}

TEST_CASE("Seeds differ, and so do calls", "[planning]") {
  Scene scene;
  MppiParams params;
  MppiController one(params);
  params.seed = 2;
  MppiController two(params);
  (void)one.command(scene.pose, scene.course, scene.clearance_m);
  (void)two.command(scene.pose, scene.course, scene.clearance_m);
  CHECK(one.costs()[0] == two.costs()[0]);
  CHECK(one.costs()[1] != two.costs()[1]);
  const std::vector<double> before = one.costs();
  one.forget();
  (void)one.command(scene.pose, scene.course, scene.clearance_m);
  CHECK(one.costs()[0] == before[0]);
  CHECK(one.costs()[1] != before[1]);
}

TEST_CASE("A controller goes on from its state to the bit", "[planning]") {
  Scene scene;
  MppiController whole;
  const auto drive_on = [&](MppiController& controller) {
    scene.course.advance(scene.pose);
    scene.pose = scene.pose * unicycle_motion(controller.command(scene.pose, scene.course, scene.clearance_m), 0.1);
  };
  for (int call = 0; call < 3; ++call) drive_on(whole);
  StateWriter writer;
  writer(whole);
  MppiController resumed;
  StateReader reader(writer.bytes(), writer.parameters(), "state");
  reader(resumed);
  reader.require_end();
  const Scene then = scene;
  for (int call = 0; call < 3; ++call) drive_on(whole);
  const Pose2 expected = scene.pose;
  scene = then;
  for (int call = 0; call < 3; ++call) drive_on(resumed);
  CHECK(scene.pose.x_m == expected.x_m);
  CHECK(scene.pose.yaw_rad == expected.yaw_rad);
  CHECK(numbers(resumed.plan()) == numbers(whole.plan()));
  CHECK(resumed.costs() == whole.costs());

  MppiParams other;
  other.temperature = 0.5;
  MppiController another(other);
  StateReader refused(writer.bytes(), writer.parameters(), "state");
  REQUIRE_THROWS_WITH(refused(another), Catch::Contains("mppi.temperature = 0.3"));
  std::string broken = writer.bytes();
  const double not_a_number = std::nan("");
  const std::size_t first_command = 8 + 3 * 16 + 8;
  std::copy_n(reinterpret_cast<const char*>(&not_a_number), sizeof not_a_number, broken.begin() + first_command);
  StateReader damaged(broken, writer.parameters(), "state");
  REQUIRE_THROWS_WITH(damaged(resumed), Catch::Contains("a plan has not one finite command for each step of the horizon"));
}

TEST_CASE("Nothing is allocated after the first call for a path", "[planning]") {
  Scene scene;
  MppiController controller;
  (void)controller.command(scene.pose, scene.course, scene.clearance_m);
  const std::size_t before = test::allocation_count();
  for (int call = 0; call < 5; ++call) {
    scene.course.advance(scene.pose);
    scene.pose = scene.pose * unicycle_motion(controller.command(scene.pose, scene.course, scene.clearance_m), 0.1);
  }
  CHECK(test::allocation_count() == before);
}

TEST_CASE("Poses, grids and parameters that are none are refused, and nothing changes", "[planning]") {
  Scene scene;
  MppiController controller;
  MppiController same;
  const double infinite = std::numeric_limits<double>::infinity();
  (void)controller.command(scene.pose, scene.course, scene.clearance_m);
  (void)same.command(scene.pose, scene.course, scene.clearance_m);
  REQUIRE_THROWS_WITH(controller.command({std::nan(""), 0.0, 0.0}, scene.course, scene.clearance_m),
                      "MppiController::command: the pose is (nan, 0, 0), but must be finite");
  REQUIRE_THROWS_WITH(controller.command({0.0, 0.0, infinite}, PathFollower(), scene.clearance_m), Catch::Contains("the pose is"));
  REQUIRE_THROWS_WITH(controller.command({1e12, 0.0, 0.0}, scene.course, scene.clearance_m), Catch::Contains("within 2^30 of the origin"));
  REQUIRE_THROWS_WITH(controller.command(scene.pose, scene.course, Grid<float, 2>(Lattice<2>(1e-4))),
                      "MppiController::command: the plans' reach in cells is 25000, but must be <= 5000");
  (void)controller.command(scene.pose, scene.course, scene.clearance_m);
  (void)same.command(scene.pose, scene.course, scene.clearance_m);
  CHECK(numbers(controller.plan()) == numbers(same.plan()));

  const auto refused = [](auto change, const char* message) {
    MppiParams params;
    change(params);
    REQUIRE_THROWS_WITH(MppiController(params), Catch::Contains(message));
  };
  refused([](MppiParams& params) { params.horizon_steps = 0; }, "MppiParams: horizon_steps is 0, but must be in 1..1000");
  refused([](MppiParams& params) { params.step_s = -0.1; }, "step_s is -0.1");
  refused([](MppiParams& params) { params.samples = 1; }, "samples is 1");
  refused([](MppiParams& params) { params.samples = 100001; }, "samples");
  refused([](MppiParams& params) { params.speed_sigma_m_per_s = -1.0; }, "speed_sigma_m_per_s");
  refused([](MppiParams& params) { params.turn_rate_sigma_rad_per_s = std::nan(""); }, "turn_rate_sigma_rad_per_s is nan");
  refused([](MppiParams& params) { params.noise_lasts_s = -1.0; }, "noise_lasts_s");
  refused([](MppiParams& params) { params.temperature = 0.0; }, "temperature is 0");
  refused([](MppiParams& params) { params.speed_max_m_per_s = 0.0; }, "speed_max_m_per_s");
  refused([](MppiParams& params) { params.turn_rate_max_rad_per_s = 0.0; }, "turn_rate_max_rad_per_s");
  refused([](MppiParams& params) { params.deceleration_m_per_s2 = 0.0; }, "deceleration_m_per_s2");
  refused([](MppiParams& params) { params.robot_radius_m = 0.0; }, "robot_radius_m");
  refused([](MppiParams& params) { params.margin_m = 0.0; }, "margin_m");
  refused([](MppiParams& params) { params.aim_m = 0.0; }, "aim_m");
  refused([](MppiParams& params) { params.way_left_weight = -1.0; }, "way_left_weight");
  refused([](MppiParams& params) { params.deviation_weight = -1.0; }, "deviation_weight");
  refused([](MppiParams& params) { params.heading_weight = -1.0; }, "heading_weight");
  refused([](MppiParams& params) { params.speed_weight = -1.0; }, "speed_weight");
  refused([](MppiParams& params) { params.smoothness_weight = -1.0; }, "smoothness_weight");
  refused([](MppiParams& params) { params.obstacle_weight = -1.0; }, "obstacle_weight");
  refused([](MppiParams& params) { params.collision_weight = std::numeric_limits<double>::infinity(); }, "collision_weight is inf");
  refused([](MppiParams& params) { params.threads = -1; }, "threads");
  refused([](MppiParams& params) { params.step_s = 1e300; }, "horizon_steps * step_s * speed_max_m_per_s");
}
