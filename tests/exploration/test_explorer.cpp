#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "small_office.hpp"

namespace incognita {
namespace {

using Measure = std::function<double(double)>;
using OfficeExplorer = Explorer<Map<TBayes>, Measure, DvlEkf>;
using BlindExplorer = Explorer<Map<TBayes>, Measure, DeadReckoning>;

DeadReckoning noisy_reckoning(double position_m_per_sqrt_s) {
  DeadReckoning::Params params;
  params.noise = {position_m_per_sqrt_s, 0.05};
  return DeadReckoning(params);
}

double explored_fraction(const OfficeExplorer& explorer, const Simulator& simulator) {
  const Coverage coverage(visible_floor(simulator.world(), test::left_start().position(), 0.2, 10.0),
                          simulator.T_start_world(), explorer.map().lattice());
  return coverage.explored_fraction([&](const Index<2>& cell) {
    return explorer.params().thresholds.classify(explorer.map().log_odds(cell)) != Occupancy::unknown;
  });
}

bool same(const std::vector<Pose2>& a, const std::vector<Pose2>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Pose2& p, const Pose2& q) {
    return p.x_m == q.x_m && p.y_m == q.y_m && p.yaw_rad == q.yaw_rad;
  });
}

}  // namespace

TEST_CASE("two rooms are explored through their door, without a collision") {
  const auto seed = GENERATE(1U, 2U);
  Simulator simulator = test::office_simulator(0.9, seed);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 120.0);
  REQUIRE(explorer.stopped());
  const bool is_done = *explorer.stopped() == StopReason::complete || *explorer.stopped() == StopReason::nothing_informative;
  CAPTURE(seed, to_string(*explorer.stopped()), simulator.time_s());
  CHECK(is_done);
  CHECK(explored_fraction(explorer, simulator) > 0.95);
  CHECK(simulator.collisions() == 0);
  CHECK((explorer.belief().pose.position() - simulator.T_start_robot().position()).norm() < 0.1);

  // The end is the end.
  CHECK_FALSE(explorer.goal());
  CHECK_FALSE(explorer.decide());
  const Twist2 command = explorer.command(simulator.scan());
  CHECK(command.speed_m_per_s == 0.0);
  CHECK(command.turn_rate_rad_per_s == 0.0);
}

TEST_CASE("every strategy, measure of information and cost of navigation explores two rooms") {
  struct Choice {
    Strategy strategy;
    FrontierInformation information;
    NavigationCost navigation;
  };
  const Choice choice = GENERATE(Choice{Strategy::persistent, FrontierInformation::big, NavigationCost::geodesic},
                                 Choice{Strategy::online, FrontierInformation::big, NavigationCost::geodesic},
                                 Choice{Strategy::last_mile, FrontierInformation::log_big, NavigationCost::geodesic},
                                 Choice{Strategy::last_mile, FrontierInformation::uniform, NavigationCost::geodesic},
                                 Choice{Strategy::last_mile, FrontierInformation::size, NavigationCost::euclidean},
                                 Choice{Strategy::persistent, FrontierInformation::entropy, NavigationCost::uniform},
                                 Choice{Strategy::online, FrontierInformation::size, NavigationCost::euclidean});
  Simulator simulator = test::office_simulator(0.9, 5);
  ExplorerParams params = test::quick_params();
  params.strategy = choice.strategy;
  params.information = choice.information;
  params.navigation = choice.navigation;
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 200.0);
  REQUIRE(explorer.stopped());
  CAPTURE(static_cast<int>(choice.strategy), static_cast<int>(choice.information), to_string(*explorer.stopped()));
  CHECK(*explorer.stopped() != StopReason::lost);
  CHECK(explored_fraction(explorer, simulator) > 0.95);
  CHECK(simulator.collisions() == 0);
}

TEST_CASE("candidates are ranked by what they tell for what they cost") {
  Simulator simulator = test::office_simulator(0.9, 6);
  ExplorerParams params = test::quick_params();
  params.information = FrontierInformation::size;
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 4.0);
  const std::vector<Candidate>& candidates = explorer.decision().candidates;
  REQUIRE_FALSE(candidates.empty());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    CHECK(candidate.information == Approx(0.01 * static_cast<double>(candidate.frontier.size())));
    CHECK(candidate.utility == Approx(candidate.information / (candidate.navigation_cost + params.travel_offset_m)));
    CHECK((candidate.goal_m() - explorer.map().lattice().center_m(candidate.viewpoint)).norm() < 1e-9);
    if (i > 0) CHECK(candidate.utility <= candidates[i - 1].utility);
  }
}

TEST_CASE("the order of magnitude of a gain counts from the least that is worth going for") {
  Simulator simulator = test::office_simulator(0.9, 6);
  ExplorerParams params = test::quick_params();
  params.information = FrontierInformation::log_big;
  params.gain_min_cells = GENERATE(0.0, 7.0);
  OfficeExplorer explorer(params, Map<TBayes>{}, Shannon{});
  test::run_mission(explorer, simulator, 4.0);
  REQUIRE_FALSE(explorer.decision().candidates.empty());
  for (const Candidate& candidate : explorer.decision().candidates) {
    const double unit_nats = std::max(1.0, params.gain_min_cells) * std::log(2.0);
    CHECK(candidate.information == Approx(std::log(1.0 + candidate.gain_nats / unit_nats)).epsilon(1e-6));
  }
}

TEST_CASE("what lies behind a door too narrow for the robot is looked at through it, and not gone to") {
  Simulator simulator = test::office_simulator(0.3, 3);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 200.0);
  REQUIRE(explorer.stopped());
  CHECK(to_string(*explorer.stopped()) == "nothing_informative");
  CHECK(simulator.collisions() == 0);
  CHECK((test::left_start() * explorer.belief().pose).x_m < 4.0);
}

TEST_CASE("doors that the belief may have drawn too narrow are tried, and shut when the robot does not get through") {
  // Two doors of 0.45 m into the other room, for a body of 0.42 m that is kept 2 cm from everything.
  FloorPlan plan = test::room(160, 120, 0.05);
  for (int y = 0; y < 120; ++y) {
    if ((y >= 30 && y < 39) || (y >= 80 && y < 89)) continue;
    plan.set({79, y}, FloorCell::wall);
    plan.set({80, y}, FloorCell::wall);
  }
  SimulatorParams simulation;
  simulation.robot.radius_m = 0.21;
  simulation.odometry = {0.0, 0.0};
  ExplorerParams params = test::quick_params();
  params.travel.robot_radius_m = 0.21;
  params.guard.robot_radius_m = 0.21;
  const std::uint64_t seed = GENERATE(1U, 2U, 3U, 4U);
  const double yaw_rad = 0.4 * static_cast<double>(seed);
  Simulator simulator(World(plan), {1.83, 2.21, yaw_rad}, simulation, seed);
  Explorer<Map<TBayes>, Behavioral, DeadReckoning> explorer(params, Map<TBayes>{}, Behavioral{},
                                                            DeadReckoning({MotionNoise{}, PoseBelief{}}));
  test::run_mission(explorer, simulator, 1000.0);
  CAPTURE(seed, simulator.time_s(), simulator.distance_m());
  REQUIRE(explorer.stopped());
  CHECK(simulator.time_s() < 140.0);  // not as often as there is something to see behind them
  CHECK(simulator.collisions() == 0);
}

TEST_CASE("a robot that starts in a corner, nearer to the walls than it plans to be, gets away from there") {
  const Strategy strategy = GENERATE(Strategy::persistent, Strategy::last_mile, Strategy::online);
  const double yaw_rad = GENERATE(0.3, 0.7, 2.0, 2.6, -1.1, -2.5);
  SimulatorParams simulation;
  simulation.odometry = {0.0, 0.0};
  simulation.sensor.beams = circular_beams(360, 1.5);
  Simulator simulator(World(test::two_rooms(0.9)), {0.255, 0.255, yaw_rad}, simulation, 1);
  ExplorerParams params = test::quick_params();
  params.strategy = strategy;
  params.information = FrontierInformation::size;
  params.gain.range_max_m = 1.5;
  params.visibility_tolerance_m = 0.1;
  Explorer<Map<LogOdds>, Behavioral, DeadReckoning> explorer(params, Map<LogOdds>{}, Behavioral{},
                                                             DeadReckoning({MotionNoise{}, PoseBelief{}}));
  test::run_mission(explorer, simulator, 30.0);
  CAPTURE(static_cast<int>(strategy), yaw_rad, simulator.time_s());
  CHECK_FALSE(explorer.stopped());
  CHECK(simulator.distance_m() > 5.0);
  CHECK(simulator.collisions() == 0);
}

TEST_CASE("a robot whose pose is too uncertain is lost") {
  Simulator simulator = test::office_simulator(0.9, 4);
  ExplorerParams params = test::quick_params();
  params.position_sigma_max_m = 0.3;
  BlindExplorer explorer(params, Map<TBayes>{}, Behavioral{}, noisy_reckoning(0.3));
  test::run_mission(explorer, simulator, 30.0);
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::lost);
  // sigma^2 = 0.3^2 t and what the heading adds while driving.
  CHECK(simulator.time_s() <= Approx(1.1));
  CHECK(position_sigma_m(explorer.belief().covariance) > 0.3);
}

TEST_CASE("odometry that is no motion is refused, and changes nothing") {
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  explorer.move({0.1, 0.0, 0.0}, 0.1);
  const PoseBelief before = explorer.belief();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(explorer.move({nan, 0.0, 0.0}, 0.1), Catch::Contains("increment"));
  CHECK_THROWS_WITH(explorer.move({0.1, 0.0, 0.0}, -0.5), Catch::Contains("duration_s") && Catch::Contains("-0.5"));
  CHECK_THROWS_AS(explorer.move({0.1, 0.0, 0.0}, nan), std::invalid_argument);
  CHECK(explorer.time_s() == 0.1);
  CHECK(explorer.belief().pose.x_m == before.pose.x_m);
  CHECK(explorer.belief().covariance == before.covariance);
}

TEST_CASE("candidates that tell too little do not hide a better one further away") {
  ExplorerParams params = test::quick_params();
  params.candidates_max = GENERATE(1, 2, 40);
  params.gain_min_cells = 2000.0;  // only the way into the other room promises as much
  Simulator simulator = test::office_simulator(0.9, 1);
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  while (!explorer.decide()) {
    explorer.move({}, 0.1);
    explorer.observe(simulator.scan());
  }
  CAPTURE(params.candidates_max);
  REQUIRE(explorer.decision().chosen() != nullptr);
  CHECK(explorer.decision().chosen()->gain_nats >= 2000.0 * std::log(2.0));
}

TEST_CASE("the bar for a candidate scales with the entropy") {
  // Half of Tsallis' entropy with q = 1000 is a thousandth of Shannon's.
  Simulator simulator = test::office_simulator(0.9, 1);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Tsallis{1000.0});
  test::run_mission(explorer, simulator, 120.0);
  CHECK(explored_fraction(explorer, simulator) > 0.9);
}

TEST_CASE("an exploration ends when its time is over") {
  Simulator simulator = test::office_simulator(0.9, 5);
  ExplorerParams params = test::quick_params();
  params.duration_max_s = 3.05;
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 30.0);
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::out_of_time);
  CHECK(explorer.decision().time_s == Approx(3.1));  // the first scan after
}

TEST_CASE("nothing is decided before the first scan") {
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  CHECK_FALSE(explorer.decide());
  explorer.move(Pose2{0.1, 0.0, 0.0}, 0.1);
  CHECK_FALSE(explorer.decide());
  CHECK_FALSE(explorer.goal());
  CHECK_FALSE(explorer.stopped());
  CHECK(explorer.command(test::blind_scan()).speed_m_per_s == 0.0);
}

TEST_CASE("a map from before may be larger than what the scans have reached") {
  Map<TBayes> known;
  const Scan<2> open(circular_beams(360, 10.0));
  for (const double x_m : {0.0, 8.0, 16.0}) known.update(open, {x_m, 0.0, 0.0}, Eigen::Matrix3d::Identity() * 1e-4);
  ExplorerParams params = test::quick_params();
  params.gain.range_max_m = 20.0;
  params.gain.beams = 8;
  params.gain.pose_spacing_m = 5.0;
  params.candidates_max = 1000;
  OfficeExplorer explorer(params, known, Behavioral{});
  Scan<2> near(circular_beams(360, 10.0));
  for (std::size_t beam = 0; beam < near.size(); ++beam) near.set_range_m(beam, std::numeric_limits<double>::quiet_NaN());
  for (int scan = 0; scan < 20; ++scan) explorer.observe(near);
  CHECK(explorer.decide());
  CHECK_FALSE(explorer.decision().candidates.empty());
  // All that a candidate may predict lies in the map.
  for (const Candidate& candidate : explorer.decision().candidates) {
    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(explorer.params().gain.range_max_m);
    const Lattice<2>& lattice = explorer.map().lattice();
    CHECK(explorer.map().grid().contains(lattice.index_of(candidate.goal_m() + reach)));
    CHECK(explorer.map().grid().contains(lattice.index_of(candidate.goal_m() - reach)));
  }
}

TEST_CASE("while the map stays the same no goal is taken up twice") {
  ExplorerParams params = test::quick_params();
  params.position_sigma_max_m = 100.0;  // the robot stands and learns nothing for minutes
  Simulator simulator = test::office_simulator(0.9, 6);
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 1.9);
  REQUIRE(explorer.goal());
  const double decided_s = explorer.decision().time_s;
  REQUIRE(decided_s == explorer.time_s());

  std::vector<Eigen::Vector2d> frontiers_m{explorer.decision().chosen()->frontier_m};
  const Scan<2> nothing = test::blind_scan();
  double kept_until_s = 0.0;
  while (!explorer.stopped() && explorer.time_s() < 400.0) {
    explorer.move(Pose2{}, 0.1);
    explorer.observe(nothing);
    explorer.decide();
    (void)explorer.command(nothing);
    if (explorer.stopped()) break;
    const Eigen::Vector2d frontier_m = explorer.decision().chosen()->frontier_m;
    if (frontier_m == frontiers_m.back()) continue;
    if (kept_until_s == 0.0) kept_until_s = explorer.time_s();
    CHECK(std::find(frontiers_m.begin(), frontiers_m.end(), frontier_m) == frontiers_m.end());
    frontiers_m.push_back(frontier_m);
  }
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::nothing_informative);
  CHECK(frontiers_m.size() > 1);
  CHECK(kept_until_s > decided_s + 20.0);  // only because the goal was not reached in time
}

TEST_CASE("a robot that drives and learns nothing keeps its goal until it is there, also when it plans online by straight lines") {
  ExplorerParams params = test::quick_params();
  params.strategy = Strategy::online;
  params.information = FrontierInformation::size;
  params.navigation = GENERATE(NavigationCost::uniform, NavigationCost::euclidean, NavigationCost::geodesic);
  params.position_sigma_max_m = 100.0;
  Simulator simulator = test::office_simulator(0.9, 9);
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 1.9);
  REQUIRE(explorer.goal());
  const Scan<2> nothing = test::blind_scan();
  std::vector<Eigen::Vector2d> frontiers_m;
  std::size_t arrivals = 0;
  Twist2 command;
  while (!explorer.stopped() && explorer.time_s() < 600.0) {
    explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(nothing);
    if (explorer.decide() && explorer.goal()) {
      const Eigen::Vector2d frontier_m = explorer.decision().chosen()->frontier_m;
      CHECK(std::find(frontiers_m.begin(), frontiers_m.end(), frontier_m) == frontiers_m.end());
      frontiers_m.push_back(frontier_m);
      ++arrivals;
    }
    command = explorer.command(nothing);
  }
  CAPTURE(explorer.time_s());
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::nothing_informative);
  CHECK(arrivals > 1);
}

TEST_CASE("a pause stands still and decides nothing, and start goes on") {
  Simulator simulator = test::office_simulator(0.9, 10);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  explorer.pause();
  CHECK(explorer.is_paused());
  test::run_mission(explorer, simulator, 5.0);
  CHECK_FALSE(explorer.goal());
  CHECK(simulator.distance_m() == 0.0);
  CHECK(explorer.map().update_count() > 0);
  CHECK_FALSE(explorer.frontiers().empty());

  explorer.start();
  CHECK_FALSE(explorer.is_paused());
  test::run_mission(explorer, simulator, 7.5);
  REQUIRE(explorer.goal());
  const double driven_m = simulator.distance_m();
  CHECK(driven_m > 0.3);
  const Eigen::Vector2d goal_m = *explorer.goal();

  explorer.pause();
  explorer.pause();
  test::run_mission(explorer, simulator, 200.0);  // longer than any patience
  CHECK(simulator.distance_m() == driven_m);
  CHECK(explorer.goal() == goal_m);
  CHECK_FALSE(explorer.stopped());
  explorer.start();
  test::run_mission(explorer, simulator, 400.0);
  REQUIRE(explorer.stopped());
  CHECK(explored_fraction(explorer, simulator) > 0.95);
  CHECK(simulator.collisions() == 0);
}

TEST_CASE("an exploration is stopped, and started again where it was") {
  Simulator simulator = test::office_simulator(0.9, 11);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 4.0);
  REQUIRE(explorer.goal());
  explorer.pause();
  explorer.stop();
  CHECK(explorer.stopped() == StopReason::stopped);
  CHECK_FALSE(explorer.is_paused());
  CHECK_FALSE(explorer.goal());
  CHECK_FALSE(explorer.decide());
  CHECK(explorer.command(simulator.scan()).speed_m_per_s == 0.0);
  explorer.stop();
  explorer.start();
  CHECK_FALSE(explorer.stopped());
  test::run_mission(explorer, simulator, 200.0);
  REQUIRE(explorer.stopped());
  const StopReason reason = *explorer.stopped();
  CHECK(reason != StopReason::stopped);
  CHECK(explored_fraction(explorer, simulator) > 0.95);
  explorer.stop();
  CHECK(explorer.stopped() == reason);
}

TEST_CASE("a robot returns to its start on request, from the way or from the end") {
  const bool from_the_end = GENERATE(false, true);
  Simulator simulator = test::office_simulator(0.9, 12);
  ExplorerParams params = test::quick_params();
  if (!from_the_end) params.duration_max_s = 12.0;  // does not count on the way back
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 200.0);
  REQUIRE(explorer.stopped());
  const double away_m = simulator.T_start_robot().position().norm();
  CAPTURE(from_the_end, away_m);
  REQUIRE(away_m > 1.0);
  explorer.return_to_start();
  CHECK(explorer.is_returning());
  CHECK_FALSE(explorer.stopped());
  const double begun_m = simulator.distance_m();
  test::run_mission(explorer, simulator, 400.0);
  CHECK(explorer.stopped() == StopReason::returned);
  CHECK(simulator.T_start_robot().position().norm() < 0.3);
  CHECK(simulator.distance_m() - begun_m < 2.0 * away_m + 2.0);
  CHECK(simulator.collisions() == 0);

  // It is there already.
  explorer.return_to_start();
  test::run_mission(explorer, simulator, simulator.time_s() + 10.0);
  CHECK(explorer.stopped() == StopReason::returned);
}

TEST_CASE("a robot that is driven by other means arrives all the same") {
  Simulator simulator = test::office_simulator(0.9, 12);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 6.0);
  explorer.return_to_start();
  while (!explorer.stopped() && simulator.time_s() < 60.0) {
    Twist2 drive;
    if (explorer.goal()) {
      const Eigen::Vector2d ahead_m = explorer.belief().pose.inverse() * *explorer.goal();
      const double aside_rad = std::atan2(ahead_m.y(), ahead_m.x());
      drive = {std::abs(aside_rad) < 0.3 ? 0.3 : 0.0, aside_rad};
    }
    explorer.move(simulator.step(drive), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    explorer.decide();
  }
  CHECK(explorer.stopped() == StopReason::returned);
  CHECK(simulator.time_s() < 30.0);
}

TEST_CASE("a robot returns to a start that the belief has hardly room for, with cells of any size") {
  const double resolution_m = GENERATE(0.1, 0.25, 0.5);
  SimulatorParams simulation;
  simulation.odometry = {0.0, 0.0};
  Simulator simulator(World(test::two_rooms(2.5)), {0.31, 0.33, 0.7}, simulation, 1);
  MapParams cells;
  cells.resolution_m = resolution_m;
  Explorer<Map<TBayes>, Behavioral, DeadReckoning> explorer(test::quick_params(), Map<TBayes>(cells), Behavioral{},
                                                            DeadReckoning({MotionNoise{}, PoseBelief{}}));
  test::run_mission(explorer, simulator, 15.0);
  CAPTURE(resolution_m);
  REQUIRE(simulator.T_start_robot().position().norm() > 1.0);
  explorer.return_to_start();
  test::run_mission(explorer, simulator, 80.0);
  CHECK(explorer.stopped() == StopReason::returned);
  CHECK(simulator.T_start_robot().position().norm() < 0.6 + 0.1);
}

TEST_CASE("a robot carried away in a pause has time to find out where it is") {
  Simulator simulator = test::office_simulator(0.9, 10);
  OfficeExplorer explorer(test::quick_params(), Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 4.0);
  explorer.pause();
  explorer.move(Pose2{}, 60.0);  // without scans
  explorer.start();
  explorer.move(Pose2{}, 0.1);
  explorer.decide();
  CHECK_FALSE(explorer.stopped());
}

TEST_CASE("a robot outside of its area does not say that it is explored") {
  Simulator simulator = test::office_simulator(0.9, 14);
  ExplorerParams params = test::quick_params();
  params.area.bounds = {{20.0, 20.0}, {30.0, 20.0}, {30.0, 30.0}};
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 20.0);
  CHECK(explorer.stopped() == StopReason::nothing_reachable);
}

TEST_CASE("a robot that cannot get back says so, and may explore again") {
  Simulator simulator = test::office_simulator(0.9, 13);
  ExplorerParams params = test::quick_params();
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  test::run_mission(explorer, simulator, 30.0);
  explorer.return_to_start();
  const Scan<2> nothing = test::blind_scan();
  double began_s = explorer.time_s();
  while (!explorer.stopped() && explorer.time_s() < began_s + 100.0) {
    explorer.move(Pose2{}, 0.1);  // its wheels are blocked
    explorer.observe(simulator.scan());
    explorer.decide();
    (void)explorer.command(nothing);
  }
  CHECK(explorer.stopped() == StopReason::nothing_reachable);
  CHECK_FALSE(explorer.is_returning());
  explorer.pause();
  CHECK_FALSE(explorer.is_paused());
  explorer.start();
  CHECK_FALSE(explorer.is_returning());
  CHECK_FALSE(explorer.stopped());
}

TEST_CASE("no path, no goal and no frontier leaves the allowed area, and the exploration of it is complete") {
  // The left room alone; the whole with a bar across the left room but for a gap; a polygon in front of the door.
  const Polygon left_room{{0.0, 0.0}, {3.6, 0.0}, {3.6, 6.0}, {0.0, 6.0}};
  const Polygon bar{{0.0, 3.2}, {2.6, 3.0}, {2.6, 3.4}, {0.0, 3.5}};
  const Polygon before_the_door{{3.5, 2.6}, {4.4, 2.6}, {4.4, 4.4}, {3.5, 4.4}};
  const int which = GENERATE(0, 1, 2);
  AllowedArea area;
  if (which == 0) area.bounds = left_room;
  if (which == 1) area.no_go = {bar};
  if (which == 2) area.no_go = {before_the_door};
  Simulator simulator = test::office_simulator(0.9, 14);
  ExplorerParams params = test::quick_params();
  params.area = area.transformed(simulator.T_start_world());
  OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{});
  Twist2 command;
  double clearance_min_m = 1.0;
  while (!explorer.stopped() && simulator.time_s() < 200.0) {
    explorer.move(simulator.step(command), 0.02);
    clearance_min_m = std::min(clearance_min_m, area.clearance_m(simulator.T_world_robot().position()));
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    if (explorer.decide() && explorer.goal()) {
      for (const Candidate& candidate : explorer.decision().candidates) {
        for (double s_m = 0.0; s_m < candidate.path.length_m(); s_m += 0.02) {
          REQUIRE(params.area.clearance_m(candidate.path.point_at(s_m)) > 0.14);  // 0.22 m but for half a diagonal
        }
      }
      for (const Frontier<2>& frontier : explorer.frontiers()) {
        for (const Index<2>& cell : frontier.cells) {
          REQUIRE(params.area.clearance_m(explorer.map().lattice().center_m(cell)) >= 0.07);
        }
      }
    }
    command = explorer.command(simulator.scan());
  }
  REQUIRE(explorer.stopped());
  CAPTURE(which, to_string(*explorer.stopped()), simulator.distance_m());
  // Of the right room the robot sees through the door what it cannot go to.
  CHECK(*explorer.stopped() == (which == 2 ? StopReason::nothing_informative : StopReason::complete));
  CHECK(clearance_min_m > 0.15);
  CHECK(simulator.collisions() == 0);
  if (which == 1) CHECK(explored_fraction(explorer, simulator) > 0.95);
}

TEST_CASE("behavioral entropy with alpha 1 decides as Shannon's") {
  const auto run = [](const Measure& measure) {
    Simulator simulator = test::office_simulator(0.9, 7);
    ExplorerParams params = test::quick_params();
    params.strategy = Strategy::online;  // decides often
    OfficeExplorer explorer(params, Map<TBayes>{}, measure);
    return test::run_mission(explorer, simulator, 15.0);
  };
  const test::Mission behavioral = run(Behavioral{1.0});
  const test::Mission shannon = run(Shannon{});
  CHECK(behavioral.goals_m.size() > 1);
  CHECK(same(behavioral.estimated, shannon.estimated));
  CHECK(behavioral.goals_m == shannon.goals_m);
  REQUIRE(behavioral.gains_nats.size() == shannon.gains_nats.size());
  for (std::size_t i = 0; i < shannon.gains_nats.size(); ++i) {
    CHECK(behavioral.gains_nats[i] == Approx(shannon.gains_nats[i]).epsilon(1e-12));
  }
}

TEST_CASE("the trajectory is the same to the bit for any number of threads") {
  const auto run = [](int threads) {
    Simulator simulator = test::office_simulator(0.9, 8);
    ExplorerParams params = test::quick_params();
    params.threads = threads;
    params.strategy = Strategy::online;  // decides often
    OfficeExplorer explorer(params, Map<TBayes>{}, Behavioral{0.5});
    return test::run_mission(explorer, simulator, 15.0);
  };
  const test::Mission one = run(1);
  CHECK(one.goals_m.size() > 1);
  for (const int threads : {2, 4}) {
    const test::Mission more = run(threads);
    CHECK(same(one.estimated, more.estimated));
    CHECK(one.goals_m == more.goals_m);
    CHECK(one.gains_nats == more.gains_nats);
  }
}

TEST_CASE("explorer parameters out of bounds are refused by name and value") {
  const auto refused = [](auto change, const char* where, const char* field, const char* value) {
    ExplorerParams params;
    change(params);
    CHECK_THROWS_WITH(OfficeExplorer(params, Map<TBayes>{}, Behavioral{}),
                      Catch::Contains(where) && Catch::Contains(field) && Catch::Contains(value));
    CHECK_THROWS_AS(OfficeExplorer(params, Map<TBayes>{}, Behavioral{}), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const char* const own = "ExplorerParams";
  refused([](auto& p) { p.travel_offset_m = -0.25; }, own, "travel_offset_m", "-0.25");
  refused([](auto& p) { p.candidates_max = 0; }, own, "candidates_max", "0");
  refused([](auto& p) { p.visibility_tolerance_m = -3.0; }, own, "visibility_tolerance_m", "-3");
  refused([](auto& p) { p.information_min_m2 = -0.75; }, own, "information_min_m2", "-0.75");
  refused([](auto& p) { p.gain.range_max_m = 0.2; }, own, "gain.range_max_m", "0.15");
  refused([](auto& p) { p.gain_min_cells = -0.5; }, own, "gain_min_cells", "-0.5");
  refused([](auto& p) { p.decision_interval_s = -1.5; }, own, "decision_interval_s", "-1.5");
  refused([](auto& p) { p.blocked_max_s = 0.0; }, own, "blocked_max_s", "0");
  refused([](auto& p) { p.retreat.distance_m = -2.5; }, "RetreatParams", "distance_m", "-2.5");
  refused([&](auto& p) { p.position_sigma_max_m = nan; }, own, "position_sigma_max_m", "nan");
  refused([&](auto& p) { p.duration_max_s = nan; }, own, "duration_max_s", "nan");
  refused([](auto& p) { p.threads = -2; }, own, "threads", "-2");
  refused([](auto& p) { p.gain.beams = -7; }, "GainParams", "beams", "-7");
  refused([](auto& p) { p.set_aside.radius_m = -0.5; }, "SetAsideParams", "radius_m", "-0.5");
  refused([](auto& p) { p.area.bounds = {{0.0, 0.0}, {1.0, 1.0}}; }, "AllowedArea", "bounds", "2");
  refused([](auto& p) { p.thresholds.free_below = 0.5F; }, "OccupancyThresholds", "free_below", "0.5");
  refused([](auto& p) { p.frontier.length_max_m = -4.0; }, "FrontierParams", "length_max_m", "-4");
  refused([](auto& p) { p.travel.robot_radius_m = -0.2; }, "TravelParams", "robot_radius_m", "-0.2");
}

TEST_CASE("Uncertainty frontiers are gone to as well, each once, and the exploration ends") {
  std::size_t goals[2] = {0, 0};
  for (const bool by_uncertainty : {false, true}) {
    Simulator simulator = test::office_simulator(0.9, 21, 360);
    ExplorerParams params;
    params.threads = 1;
    params.information = FrontierInformation::size;
    if (by_uncertainty) params.uncertainty.emplace();
    // A filter that becomes unsure while it drives, and is never corrected: leaps stay.
    params.position_sigma_max_m = 10.0;
    const DeadReckoning filter({MotionNoise{0.5, 0.0}, PoseBelief{}});
    Explorer<Map<Dispersion>, Behavioral, DeadReckoning> explorer(params, Map<Dispersion>{}, Behavioral{}, filter);
    const test::Mission mission = test::run_mission(explorer, simulator, 90.0);
    goals[by_uncertainty ? 1 : 0] = mission.goals_m.size();
    REQUIRE(explorer.stopped());
    CHECK(*explorer.stopped() != StopReason::lost);
    CHECK(simulator.collisions() == 0);
  }
  CHECK(goals[1] > goals[0]);
}

TEST_CASE("Uncertainty frontiers need cells that know of it, and information that sees it") {
  ExplorerParams params;
  params.uncertainty.emplace();
  CHECK_THROWS_WITH((Explorer<Map<Dispersion>>(params)), Catch::Matchers::Contains("information other than big"));
  params.information = FrontierInformation::size;
  CHECK_NOTHROW(Explorer<Map<Dispersion>>(params));
  CHECK_THROWS_WITH((Explorer<>(params)), Catch::Matchers::Contains("cells know their dispersion"));
  params.uncertainty->gradient_min_m = -1.0;
  CHECK_THROWS_WITH((Explorer<Map<Dispersion>>(params)), Catch::Matchers::Contains("gradient_min_m is -1"));
}

TEST_CASE("A map without floor is not complete, unless it stays without") {
  const auto explore = [](double pass, double duration_s) {
    Dispersion::Params cells;
    cells.pass = pass;
    Simulator simulator = test::office_simulator(0.9, 21, 360);
    ExplorerParams params;
    params.threads = 1;
    Explorer<Map<Dispersion>, Behavioral, DeadReckoning> explorer(params, Map<Dispersion>({}, Dispersion(cells)));
    test::run_mission(explorer, simulator, duration_s);
    return std::pair(explorer.stopped(), simulator.distance_m());
  };
  CHECK(explore(-0.4, 2.0).second > 0.2);               // floor is known after three scans
  CHECK_FALSE(explore(-1.0 / 512.0, 2.0).first);        // not yet
  CHECK(explore(-1.0 / 512.0, 15.0).first.has_value());  // it stands, and waits no longer
}

}  // namespace incognita
