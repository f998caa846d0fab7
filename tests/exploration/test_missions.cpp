#include <catch2/catch.hpp>

#include <filesystem>
#include <utility>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/simulator.hpp"

using namespace incognita;

TEST_CASE("Every strategy explores a real floor to an end, however it weighs what there is to see", "[exploration][.long]") {
  const std::filesystem::path file = std::filesystem::path(INCOGNITA_DATA_DIR) / "kth" / "50052749.yaml";
  if (!std::filesystem::exists(file)) {
    WARN("skipped: " << file << " is not there");
    return;
  }
  ExplorerParams params;
  struct Choice {
    Strategy strategy;
    FrontierInformation information;
    NavigationCost navigation;
  };
  const Choice choice = GENERATE(Choice{Strategy::persistent, FrontierInformation::big, NavigationCost::geodesic},
                                 Choice{Strategy::last_mile, FrontierInformation::size, NavigationCost::euclidean},
                                 Choice{Strategy::last_mile, FrontierInformation::entropy, NavigationCost::uniform},
                                 Choice{Strategy::online, FrontierInformation::uniform, NavigationCost::geodesic},
                                 Choice{Strategy::online, FrontierInformation::big, NavigationCost::euclidean});
  params.strategy = choice.strategy;
  params.information = choice.information;
  params.navigation = choice.navigation;
  params.duration_max_s = 7200.0;
  World world(read_floor_plan(file));
  SimulatorParams simulated;
  simulated.odometry = {0.0, 0.0};
  Random random(1);
  const Pose2 T_world_start = random_start(world, simulated.robot.radius_m, random);
  Simulator simulator(std::move(world), T_world_start, simulated, 1);
  DeadReckoning::Params known_pose;
  known_pose.noise = {0.0, 0.0};
  Explorer<Map<>, Behavioral, DeadReckoning> explorer(params, Map<>{}, Behavioral{}, DeadReckoning(known_pose));
  Twist2 command;
  while (!explorer.stopped()) {
    explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    explorer.decide();
    command = explorer.command(simulator.scan());
  }
  const Coverage coverage(visible_floor(simulator.world(), T_world_start.position(), simulated.robot.radius_m, 10.0),
                          simulator.T_start_world(), explorer.map().lattice());
  const double explored = coverage.explored_fraction(
      [&](const Index<2>& cell) { return explorer.occupancy().grid().value(cell) != Occupancy::unknown; });
  CAPTURE(static_cast<int>(params.strategy), static_cast<int>(params.information), static_cast<int>(params.navigation));
  CAPTURE(simulator.distance_m(), simulator.time_s());
  CHECK(*explorer.stopped() != StopReason::out_of_time);
  CHECK(*explorer.stopped() != StopReason::lost);
  CHECK(explored > 0.95);
  CHECK(simulator.collisions() == 0);
}
