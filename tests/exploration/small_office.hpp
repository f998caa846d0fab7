/// A small building and a mission in it, for the tests of the explorer.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "../simulation/plans.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/simulation/simulator.hpp"

namespace incognita::test {

/// Two rooms, 8 x 6 m together, with a door of door_m between them; 5 cm pixels.
inline FloorPlan two_rooms(double door_m) {
  FloorPlan plan = room(160, 120, 0.05);
  const int half_door = static_cast<int>(door_m / 0.1 + 0.5);
  for (int y = 0; y < 120; ++y) {
    if (y < 70 - half_door || y >= 70 + half_door) {
      plan.set({79, y}, FloorCell::wall);
      plan.set({80, y}, FloorCell::wall);
    }
  }
  return plan;
}

/// In the left room, turned so that no wall is parallel to the belief's cells.
inline Pose2 left_start() { return {1.83, 2.21, 0.63}; }

inline Simulator office_simulator(double door_m, std::uint64_t seed, std::size_t beams = 180) {
  SimulatorParams params;
  params.sensor.beams = circular_beams(beams, 10.0);
  return Simulator(World(two_rooms(door_m)), left_start(), params, seed);
}

/// Few beams for the gain and one thread.
inline ExplorerParams quick_params() {
  ExplorerParams params;
  params.gain.beams = 30;
  params.threads = 1;
  return params;
}

/// A scan from which nothing is learned.
inline Scan<2> blind_scan() {
  return {circular_beams(4, 10.0), std::vector<double>(4, std::numeric_limits<double>::quiet_NaN())};
}

struct Mission {
  std::vector<Pose2> estimated;           ///< after each scan
  std::vector<Eigen::Vector2d> goals_m;   ///< one a decision
  std::vector<double> gains_nats;         ///< of the goals
};

/// Drives until the explorer stops or the simulated time is over.
template <class ExplorerType>
Mission run_mission(ExplorerType& explorer, Simulator& simulator, double duration_s) {
  Mission mission;
  Twist2 command;
  for (bool first = true; first || (!explorer.stopped() && simulator.time_s() < duration_s - 1e-9); first = false) {
    if (!first) explorer.move(simulator.step(command), 0.02);
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    if (explorer.decide() && explorer.goal()) {
      mission.goals_m.push_back(*explorer.goal());
      mission.gains_nats.push_back(explorer.decision().chosen()->gain_nats);
    }
    command = explorer.command(simulator.scan());
    mission.estimated.push_back(explorer.belief().pose);
  }
  return mission;
}

}  // namespace incognita::test
