#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/core/random.hpp"
#include "uncertainty_frontiers/experiments.hpp"

namespace uncertainty_frontiers {
namespace {

TEST_CASE("R2 is an uncertainty frontier that classical ones miss, and closing the loop there makes the map more certain",
          "[uncertainty_frontiers]") {
  const CorridorDrive drive = corridor_drive(1);
  CHECK(cells_of_r2(drive.around, drive.around.uncertain) > 5);
  CHECK(cells_of_r2(drive.around, drive.around.classical) == 0);
  CHECK_FALSE(drive.around.classical.empty());  // the corridors that lead away are frontiers of both kinds
  CHECK(drive.home.mean_uncertainty_m < 0.9 * drive.around.mean_uncertainty_m);
  CHECK(drive.home.siren_nats_m2 > 1.1 * drive.around.siren_nats_m2);
  CHECK(cells_of_r2(drive.home, drive.home.uncertain) == 0);
}

TEST_CASE("A robot's sigma tells of its errors", "[uncertainty_frontiers]") {
  const Place place = hall(false);
  double square = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    // Into the open half, where there are no landmarks
    Robot robot(place, {15.0, 2.3}, {}, static_cast<std::uint64_t>(run));
    for (int pace = 0; pace < 40; ++pace) robot.step({pace_m, 0.05});
    const Eigen::Vector2d error_m = robot.position_m() - robot.truth_m();
    square += 0.5 * error_m.squaredNorm() / (robot.position_sigma_m() * robot.position_sigma_m()) / kRuns;
  }
  CHECK(square == Approx(1.0).margin(0.45));  // of 80 squares
}

TEST_CASE("By uncertainty frontiers the hall is explored, and the same again", "[uncertainty_frontiers][.long]") {
  const Setting setting{planning_systems[3], true, 1};
  const Trial trial = run_trial(setting, 1);
  CHECK(trial.is_done);
  CHECK(trial.explored_m2 > 0.9 * hall_width_m * hall_height_m);
  CHECK(trial.position_error_m < 1.0);
  CHECK(trial.siren_nats_m2[1] > trial.siren_nats_m2[0]);  // what is tolerated less is worth less
  const Trial again = run_trial(setting, 1);
  CHECK(again.siren_nats_m2[1] == trial.siren_nats_m2[1]);
  CHECK(again.path_m == trial.path_m);
}

}  // namespace
}  // namespace uncertainty_frontiers
