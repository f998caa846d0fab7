#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "incognita/core/parallel.hpp"
#include "office_exploration/averages.hpp"

namespace office_exploration {
namespace {

using incognita::FrontierInformation;
using incognita::NavigationCost;
using incognita::Strategy;

Arena arena_of(const std::string& name, std::size_t starts) {
  return name == "small" ? small_office_arena(starts) : name == "large" ? large_office_arena(starts) : room_arena(starts);
}

Series run_series(const Arena& arena, const Choice& choice) {
  Series series{"test", std::make_shared<const Arena>(arena), choice, {}};
  series.trials.resize(arena.starts.size());
  incognita::for_each_index(arena.starts.size(), 0, [&](std::size_t start, int) {
    series.trials[start] = run_trial(arena, arena.starts[start], explorer_params(arena.robot, choice));
  });
  return series;
}

void check_all_complete(const Series& series) {
  for (std::size_t start = 0; start < series.trials.size(); ++start) {
    const Trial& trial = series.trials[start];
    CAPTURE(series.arena->name, static_cast<int>(series.choice.strategy), start, to_string(trial.stop_reason));
    CHECK(trial.is_complete());
    CHECK(trial.mapped_fraction() >= 0.98);
    CHECK(trial.collisions == 0);
    CHECK(trial.position_error_max_m < 1e-9);
  }
}

/// Of persistent planning minus that of last-mile prevention, both by the way.
double mean_saving_m(const Series& persistent, const Series& last_mile) {
  const auto distance_m = [](const Trial& trial) { return trial.distance_m; };
  return mean_of(persistent, distance_m) - mean_of(last_mile, distance_m);
}

}  // namespace

TEST_CASE("the robot gets to see all of each world's floor") {
  const std::string name = GENERATE("small", "large", "room");
  const Arena arena = arena_of(name, 1);
  std::size_t floor = 0;
  std::size_t visible = 0;
  for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(arena.visible.size()); ++cell) {
    floor += arena.world.plan()[cell] == incognita::FloorCell::floor ? 1 : 0;
    visible += arena.visible[cell] != 0 ? 1 : 0;
  }
  CAPTURE(name);
  CHECK(floor == visible);
}

TEST_CASE("starts are clear, spread, and the first of many are those of few") {
  const Arena few = small_office_arena(3);
  const Arena many = small_office_arena(8);
  for (std::size_t i = 0; i < many.starts.size(); ++i) {
    const incognita::Pose2& start = many.starts[i];
    CHECK(many.world.disc_is_clear(start.position(), many.robot.radius_m));
    for (std::size_t j = 0; j < i; ++j) CHECK(incognita::distance(start.position(), many.starts[j].position()) > 3.0);
    if (i >= few.starts.size()) continue;
    CHECK(start.position() == few.starts[i].position());
    CHECK(start.yaw_rad == few.starts[i].yaw_rad);
  }
  CHECK_THROWS_WITH(room_arena(100000), Catch::Contains("100000"));
}

TEST_CASE("a curve holds what was mapped, and stays at the end") {
  Series series{"test", nullptr, {}, {}};
  series.trials.resize(2);
  series.trials[0].progress = {{0.0, 0.1}, {0.0, 0.2}, {1.5, 0.5}, {3.0, 0.9}};
  series.trials[1].progress = {{0.0, 0.0}, {1.0, 0.3}};
  const std::vector<Progress> means = mean_progress(series, 4.0);
  REQUIRE(means.size() == 5);
  const std::vector<double> expected{0.1, 0.25, 0.4, 0.6, 0.6};
  for (std::size_t i = 0; i < means.size(); ++i) CHECK(means[i].mapped_fraction == Approx(expected[i]));
  CHECK(series.trials[0].distance_to_m(0.9) == 3.0);
  CHECK_FALSE(series.trials[1].distance_to_m(0.9));
  CHECK(std::isnan(mean_distance_to_m(series, 0.9)));
}

TEST_CASE("every strategy by the way explores the room from every start, without a collision") {
  const Strategy strategy = GENERATE(Strategy::persistent, Strategy::last_mile, Strategy::online);
  check_all_complete(run_series(room_arena(4), {strategy, FrontierInformation::size, NavigationCost::geodesic}));
}

TEST_CASE("every strategy by the way explores both offices from every start, and last-mile prevention saves some",
          "[.long]") {
  const std::string name = GENERATE("small", "large");
#ifdef __SANITIZE_ADDRESS__
  constexpr std::size_t starts = 1;  // it takes a quarter of an hour with all
#else
  constexpr std::size_t starts = 8;
#endif
  const Arena arena = arena_of(name, starts);
  double saving_m = 0.0;
  for (const FrontierInformation information : {FrontierInformation::size, FrontierInformation::big}) {
    const Series persistent = run_series(arena, {Strategy::persistent, information, NavigationCost::geodesic});
    const Series last_mile = run_series(arena, {Strategy::last_mile, information, NavigationCost::geodesic});
    const Series online = run_series(arena, {Strategy::online, information, NavigationCost::geodesic});
    for (const Series* series : {&persistent, &last_mile, &online}) check_all_complete(*series);
    saving_m += mean_saving_m(persistent, last_mile);
  }
  if (starts > 1) CHECK(saving_m > 0.0);
}

}  // namespace office_exploration
