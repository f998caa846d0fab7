#include <catch2/catch.hpp>

#include <filesystem>
#include <string>
#include <utility>

#include "incognita/entropy/behavioral.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/io/floor_plan.hpp"
#include "incognita/metrics/coverage.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/metrics/visible_floor.hpp"
#include "incognita/simulation/simulator.hpp"

using namespace incognita;

namespace {

/// Says so, when a floor plan of the shared data is not there.
bool is_missing(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) return false;
  WARN("skipped: " << file << " is not there");
  return true;
}

std::filesystem::path kth_floor(const std::string& name) { return std::filesystem::path(INCOGNITA_DATA_DIR) / "kth" / name; }

/// Explores a floor from a random start until the explorer stops; checks that it came to a good end.
template <class ExplorerType>
void check_mission(ExplorerType& explorer, const std::filesystem::path& file, const OdometryParams& odometry) {
  World world(read_floor_plan(file));
  SimulatorParams simulated;
  simulated.odometry = odometry;
  Random random(1);
  const Pose2 T_world_start = random_start(world, simulated.robot.radius_m, random);
  Simulator simulator(std::move(world), T_world_start, simulated, 1);
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
  CAPTURE(simulator.distance_m(), simulator.time_s());
  CHECK(*explorer.stopped() != StopReason::out_of_time);
  CHECK(*explorer.stopped() != StopReason::lost);
  CHECK(explored > 0.95);
  CHECK(simulator.collisions() == 0);
  CHECK((explorer.belief().pose.position() - simulator.T_start_robot().position()).norm() < 0.1);
}

}  // namespace

TEST_CASE("Every strategy explores a real floor to an end, however it weighs what there is to see", "[exploration][.long]") {
  const std::filesystem::path file = kth_floor("50052749.yaml");
  if (is_missing(file)) return;
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
  DeadReckoning::Params known_pose;
  known_pose.noise = {0.0, 0.0};
  Explorer<Map<>, Behavioral, DeadReckoning> explorer(params, Map<>{}, Behavioral{}, DeadReckoning(known_pose));
  CAPTURE(static_cast<int>(params.strategy), static_cast<int>(params.information), static_cast<int>(params.navigation));
  check_mission(explorer, file, {0.0, 0.0});
}

TEST_CASE("A map of dispersion is as good as another to explore a real floor and to localise in it", "[exploration][dispersion][.long]") {
  const std::filesystem::path file = kth_floor("50052751.yaml");
  if (is_missing(file)) return;
  ExplorerParams params;
  params.duration_max_s = 7200.0;
  const bool by_uncertainty = GENERATE(false, true);
  if (by_uncertainty) {
    params.uncertainty.emplace();
    params.information = FrontierInformation::size;
  }
  CAPTURE(by_uncertainty);
  Explorer<Map<Dispersion>, Behavioral, DvlEkf> explorer(params);
  check_mission(explorer, file, {});
}
