#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/simulation/simulator.hpp"
#include "plans.hpp"

namespace {

using namespace incognita;

const Pose2 start_in_room{3.0, 2.0, 0.8};

Simulator simulator_in_room(std::uint64_t seed, const SimulatorParams& params = {}) {
  return Simulator(World(test::room(120, 80, 0.05)), start_in_room, params, seed);
}

std::vector<double> ranges_of(const Scan<2>& scan) {
  std::vector<double> ranges_m;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) ranges_m.push_back(scan.range_m(beam));
  return ranges_m;
}

/// Everything that one run says, for a sequence of commands.
std::vector<double> record(std::uint64_t seed, std::uint64_t command_seed, int steps) {
  Simulator simulator = simulator_in_room(seed);
  Random commands(command_seed);
  std::vector<double> numbers = ranges_of(simulator.scan());
  for (int i = 0; i < steps; ++i) {
    const Pose2 odometry = simulator.step({commands.uniform(-0.2, 1.0), commands.uniform(-1.0, 1.0)});
    numbers.insert(numbers.end(), {odometry.x_m, odometry.y_m, odometry.yaw_rad});
    const Pose2 pose = simulator.T_start_robot();
    numbers.insert(numbers.end(), {pose.x_m, pose.y_m, pose.yaw_rad});
    if (simulator.scan_is_new()) {
      for (const double range_m : ranges_of(simulator.scan())) numbers.push_back(range_m);
    }
  }
  return numbers;
}

}  // namespace

TEST_CASE("Time and scans follow from the number of steps", "[simulation]") {
  Simulator simulator = simulator_in_room(1);
  CHECK(simulator.time_s() == 0.0);
  CHECK(simulator.scan_is_new());
  int scans = 1;
  std::vector<double> last = ranges_of(simulator.scan());
  for (int i = 1; i <= 500; ++i) {
    simulator.step({0.1, 0.5});
    REQUIRE(simulator.steps() == static_cast<std::size_t>(i));
    REQUIRE(simulator.time_s() == i / 50.0);
    REQUIRE(simulator.scan_is_new() == (i % 5 == 0));
    REQUIRE((ranges_of(simulator.scan()) != last) == simulator.scan_is_new());
    last = ranges_of(simulator.scan());
    scans += simulator.scan_is_new() ? 1 : 0;
  }
  CHECK(scans == 101);
  CHECK(simulator.distance_m() == Approx(1.0));
}

TEST_CASE("The true pose starts at identity in the start frame and agrees with the world's", "[simulation]") {
  Simulator simulator = simulator_in_room(2);
  CHECK(simulator.T_start_robot().position().norm() < 1e-14);
  CHECK(simulator.T_start_robot().yaw_rad == 0.0);
  Pose2 expected;
  for (int i = 0; i < 100; ++i) {
    simulator.step({0.4, -0.6});
    expected = expected * unicycle_motion({0.4, -0.6}, 0.02);
  }
  const Pose2 pose = simulator.T_start_robot();
  CHECK(pose.x_m == Approx(expected.x_m));
  CHECK(pose.y_m == Approx(expected.y_m));
  CHECK(pose.yaw_rad == Approx(expected.yaw_rad));
  const Pose2 world_pose = simulator.T_start_world().inverse() * pose;
  CHECK(world_pose.x_m == Approx(simulator.T_world_robot().x_m));
  CHECK(world_pose.y_m == Approx(simulator.T_world_robot().y_m));
}

TEST_CASE("The same seed and commands give the same numbers, another seed others", "[simulation]") {
  const std::vector<double> one = record(3, 1, 200);
  CHECK(one == record(3, 1, 200));
  CHECK(one != record(4, 1, 200));
  CHECK(one != record(3, 2, 200));
}

TEST_CASE("Commands do not shift the noise of the sensors", "[simulation]") {
  // One robot stands, one turns: the errors of odometry and of ranges are the same.
  Simulator standing = simulator_in_room(5);
  Simulator turning = simulator_in_room(5);
  SimulatorParams exact_params;
  exact_params.sensor.range_sigma_m = 0.0;
  Simulator exact_standing = simulator_in_room(5, exact_params);
  Simulator exact_turning = simulator_in_room(5, exact_params);
  for (int i = 0; i < 50; ++i) {
    const Pose2 a = standing.step({0.0, 0.0});
    const Pose2 b = turning.step({0.0, 0.9});
    exact_standing.step({0.0, 0.0});
    exact_turning.step({0.0, 0.9});
    CHECK(b.yaw_rad - 0.018 == Approx(a.yaw_rad).margin(1e-15));
    CHECK(b.position().norm() == Approx(a.position().norm()).epsilon(1e-4));
    for (std::size_t beam = 0; beam < standing.scan().size(); beam += 31) {
      const double noise_m = standing.scan().range_m(beam) - exact_standing.scan().range_m(beam);
      CHECK(turning.scan().range_m(beam) - exact_turning.scan().range_m(beam) ==
            Approx(noise_m).margin(1e-12));
    }
  }
}

TEST_CASE("Odometry and ranges have noise of their own", "[simulation]") {
  SimulatorParams exact_params;
  exact_params.sensor.range_sigma_m = 0.0;
  double products = 0.0;
  const int runs = 400;
  for (int run = 0; run < runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run);
    SimulatorParams params;
    params.sensor.beams = exact_params.sensor.beams = circular_beams(1, 10.0);
    Simulator simulator = simulator_in_room(seed, params);
    const double range_noise =
        (simulator.scan().range_m(0) - simulator_in_room(seed, exact_params).scan().range_m(0)) / 0.01;
    products += range_noise * simulator.step({0.0, 0.0}).x_m / (0.05 * 0.02);
  }
  CHECK(products / runs == Approx(0.0).margin(0.2));  // of one stream it would be 1
}

TEST_CASE("Odometry drifts as a random walk does", "[simulation]") {
  // Heading after n steps: sigma 0.02 rad/s x 0.02 s x sqrt(n), along the way 0.05 m/s x 0.02 s x sqrt(n).
  const int steps = 400;
  const int runs = 60;
  double yaw_squares = 0.0;
  double x_squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    SimulatorParams params;
    params.steps_per_scan = 100000;
    Simulator simulator = simulator_in_room(100 + static_cast<std::uint64_t>(run), params);
    Pose2 dead_reckoned;
    for (int i = 0; i < steps; ++i) dead_reckoned = dead_reckoned * simulator.step({0.0, 0.0});
    yaw_squares += dead_reckoned.yaw_rad * dead_reckoned.yaw_rad;
    x_squares += dead_reckoned.x_m * dead_reckoned.x_m;
  }
  CHECK(std::sqrt(yaw_squares / runs) == Approx(0.02 * 0.02 * 20.0).epsilon(0.3));
  CHECK(std::sqrt(x_squares / runs) == Approx(0.05 * 0.02 * 20.0).epsilon(0.3));
}

TEST_CASE("Odometry knows that a wall has stopped the robot", "[simulation]") {
  SimulatorParams params;
  params.odometry = {0.0, 0.0};
  Simulator simulator = simulator_in_room(6, params);
  Pose2 dead_reckoned;
  for (int i = 0; i < 500; ++i) dead_reckoned = dead_reckoned * simulator.step({1.0, 0.0});
  CHECK(simulator.collisions() == 1);
  CHECK(simulator.distance_m() < 4.0);
  CHECK(dead_reckoned.x_m == Approx(simulator.T_start_robot().x_m).epsilon(1e-9));
}

TEST_CASE("A simulator refuses bad parameters, starts and commands", "[simulation]") {
  CHECK_THROWS_AS(Simulator(World(test::room(20, 20, 0.05)), Pose2{0.1, 0.1, 0.0}, {}, 1),
                  std::invalid_argument);
  SimulatorParams params;
  params.steps_per_s = 0;
  CHECK_THROWS_AS(simulator_in_room(1, params), std::invalid_argument);
  params = {};
  params.steps_per_scan = 0;
  CHECK_THROWS_AS(simulator_in_room(1, params), std::invalid_argument);
  params = {};
  params.odometry.speed_sigma_m_per_s = -1.0;
  CHECK_THROWS_AS(simulator_in_room(1, params), std::invalid_argument);
  Simulator simulator = simulator_in_room(1);
  CHECK_THROWS_AS(simulator.step({std::numeric_limits<double>::quiet_NaN(), 0.0}), std::invalid_argument);
  CHECK(simulator.steps() == 0);
}
