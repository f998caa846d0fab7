#include <catch2/catch.hpp>

#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/exploration/decision_reason.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "small_office.hpp"

namespace incognita {
namespace {

using Reasons = std::map<DecisionReason, int>;

/// Drives as test::run_mission does and counts why it was decided. drives: whether the wheels turn, sees: whether the scanner sees.
template <class ExplorerType>
Reasons reasons_of(ExplorerType& explorer, Simulator& simulator, double duration_s, bool drives = true, bool sees = true) {
  Reasons reasons;
  Twist2 command;
  const double end_s = explorer.time_s() + duration_s;
  while (!explorer.stopped() && explorer.time_s() < end_s) {
    if (drives) {
      explorer.move(simulator.step(command), 0.02);
      if (!simulator.scan_is_new()) continue;
    } else {
      explorer.move({}, 0.1);
    }
    const Scan<2>& scan = sees ? simulator.scan() : test::blind_scan();
    explorer.observe(scan);
    if (explorer.decide()) ++reasons[explorer.decision().reason];
    command = explorer.command(scan);
  }
  return reasons;
}

}  // namespace

TEST_CASE("the first decision has no goal before it, and the last has ended") {
  Simulator simulator = test::office_simulator(0.9, 5);
  ExplorerParams params = test::quick_params();
  params.duration_max_s = 3.05;
  Explorer<> explorer(params);
  const Reasons reasons = reasons_of(explorer, simulator, 10.0);
  CHECK(reasons.at(DecisionReason::no_goal) == 1);
  CHECK(reasons.at(DecisionReason::ended) == 1);
  CHECK(explorer.decision().reason == DecisionReason::ended);
  explorer.start();
  CHECK(explorer.decision().reason == DecisionReason::no_goal);
}

TEST_CASE("a persistent robot decides where it has arrived, others before that when there is reason to") {
  const Strategy strategy = GENERATE(Strategy::persistent, Strategy::last_mile, Strategy::online);
  SimulatorParams simulated;
  simulated.sensor.beams = circular_beams(180, 3.0);
  simulated.odometry = {0.0, 0.0};
  Simulator simulator(World(test::two_rooms(0.9)), test::left_start(), simulated, 1);
  ExplorerParams params = test::quick_params();
  params.gain.range_max_m = 3.0;
  params.information = FrontierInformation::size;
  params.strategy = strategy;
  Explorer<Map<LogOdds>, Behavioral, DeadReckoning> explorer(params, Map<LogOdds>{}, Behavioral{}, DeadReckoning({MotionNoise{}, PoseBelief{}}));
  const Reasons reasons = reasons_of(explorer, simulator, 60.0);
  CAPTURE(static_cast<int>(strategy));
  if (strategy == Strategy::persistent) CHECK(reasons.contains(DecisionReason::arrived));
  CHECK(reasons.contains(DecisionReason::seen_enough) == (strategy == Strategy::last_mile));
  CHECK(reasons.contains(DecisionReason::learned) == (strategy == Strategy::online));
}

TEST_CASE("a goal that is not reached in time is overdue, one that tells nothing was gone to in vain") {
  ExplorerParams params = test::quick_params();
  params.position_sigma_max_m = 100.0;  // it learns nothing for minutes
  Simulator simulator = test::office_simulator(0.9, 9);
  Explorer<> explorer(params);
  reasons_of(explorer, simulator, 2.5);
  REQUIRE(explorer.goal());
  Explorer<> standing = explorer;
  Simulator still = simulator;
  CHECK(reasons_of(standing, still, 60.0, false, false).contains(DecisionReason::overdue));
  CHECK(reasons_of(explorer, simulator, 60.0, true, false).contains(DecisionReason::in_vain));
}

TEST_CASE("a pause puts the way in doubt, and a wall that appears closes it") {
  ExplorerParams params = test::quick_params();
  params.strategy = Strategy::persistent;
  Simulator simulator = test::office_simulator(0.9, 10);
  Explorer<> explorer(params);
  reasons_of(explorer, simulator, 2.5);
  REQUIRE(explorer.goal());
  explorer.pause();
  explorer.start();
  explorer.move({}, 0.1);
  explorer.observe(simulator.scan());
  REQUIRE(explorer.decide());
  CHECK(explorer.decision().reason == DecisionReason::way_in_doubt);

  // Someone stands on the way, half a metre ahead of the robot, or of its way where that turns.
  REQUIRE(explorer.goal());
  const Pose2 pose = explorer.belief().pose;
  const Eigen::Vector2d ahead_m = pose.inverse() * explorer.decision().chosen()->path.point_at(0.6);
  Scan<2> scan = simulator.scan();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.direction(beam).dot(ahead_m.normalized()) > 0.97) scan.set_range_m(beam, ahead_m.norm());
  }
  bool is_decided = false;
  for (int i = 0; i < 20 && !is_decided; ++i) {
    explorer.move({}, 0.1);
    explorer.observe(scan);
    is_decided = explorer.decide();
  }
  REQUIRE(is_decided);
  CHECK(explorer.decision().reason == DecisionReason::path_closed);
}

TEST_CASE("the way back is decided on for want of a goal, and again when it is in doubt") {
  Simulator simulator = test::office_simulator(0.9, 12);
  Explorer<> explorer(test::quick_params());
  reasons_of(explorer, simulator, 12.0);
  explorer.return_to_start();
  explorer.observe(simulator.scan());
  REQUIRE(explorer.decide());
  CHECK(explorer.decision().reason == DecisionReason::no_goal);
  explorer.pause();
  explorer.start();
  explorer.observe(simulator.scan());
  REQUIRE(explorer.decide());
  CHECK(explorer.decision().reason == DecisionReason::way_in_doubt);
  CHECK_FALSE(explorer.decide());
}

TEST_CASE("each reason has a name of its own") {
  std::set<std::string_view> names;
  for (int reason = 0; reason <= static_cast<int>(DecisionReason::ended); ++reason) names.insert(to_string(static_cast<DecisionReason>(reason)));
  CHECK(names.size() == 9);
  CHECK_FALSE(names.contains("unknown"));
  CHECK(to_string(static_cast<DecisionReason>(9)) == "unknown");
}

}  // namespace incognita
