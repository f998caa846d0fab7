/// What it costs to steer by MPPI, along a way through an office as a robot's own map shows it.
///
/// The map is that of the recorded drive, cells of 0.1 m; the way leads from one of its ends to the other, and the robot is where its commands
/// take it, so each is one of a mission. `command` is a whole call with the default parameters; `samples_per_s` counts plans, `steps_per_s`
/// the commands in them. `floor` drives as many arcs, of the plan that pure pursuit begins with, and does nothing else; `poses` is the same by
/// poses and unicycle_motion. `noise` only draws the noise. `window` measures the clearance within the plans' reach, `whole_map` all of it.
/// Time on the wall, so that threads count for what they save.
#include "incognita/planning/mppi.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "incognita/grid/distance_transform.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/occupancy_layer.hpp"
#include "incognita/planning/clearance_window.hpp"
#include "incognita/planning/path.hpp"
#include "recording.hpp"

namespace {

using namespace incognita;

struct Office {
  OccupancyGrid<2> occupancy{Lattice<2>(0.1), {}, Occupancy::unknown};
  std::vector<Eigen::Vector2d> path_m;
  Pose2 T_map_start;
};

Office known_office() {
  const benchmarks::Recording& recording = benchmarks::recording();
  Map<> map(MapParams{.resolution_m = 0.1});
  for (std::size_t n = 0; n < recording.scans.size(); ++n) map.update(recording.scans[n], recording.T_map_sensor[n], recording.covariance);
  OccupancyLayer<2> layer(map.lattice());
  layer.rebuild(map);
  Office office;
  office.occupancy = layer.grid();
  office.T_map_start = recording.T_map_sensor.front();
  const auto clearance_m = distance_transform_m(office.occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; });
  const TravelCostField field(office.occupancy, clearance_m, office.T_map_start.position());
  office.path_m = shorten_path(field, find_path(field, office.occupancy.lattice().index_of(recording.T_map_sensor.back().position())));
  return office;
}

const Office& office() {
  static const Office made = known_office();
  return made;
}

bool is_occupied(const Index<2>& index) { return office().occupancy.value(index) == Occupancy::occupied; }

void count(benchmark::State& state, const MppiParams& params) {
  using benchmark::Counter;
  const double samples = static_cast<double>(params.samples) * static_cast<double>(state.iterations());
  state.counters["samples_per_s"] = Counter(samples, Counter::kIsRate);
  state.counters["steps_per_s"] = Counter(samples * params.horizon_steps, Counter::kIsRate);
}

void command(benchmark::State& state, int threads) {
  MppiParams params;
  params.threads = threads;
  MppiController controller(params);
  ClearanceWindow window(office().occupancy.lattice());
  PathFollower course(office().path_m);
  Pose2 pose = office().T_map_start;
  for (auto _ : state) {
    state.PauseTiming();
    course.advance(pose);
    if (course.is_finished()) {
      pose = office().T_map_start;
      course = PathFollower(office().path_m);
    }
    const Grid<float, 2>& clearance_m = window.measure(pose.position(), params.reach_m() + params.robot_radius_m + params.margin_m, is_occupied);
    state.ResumeTiming();
    const Twist2 twist = controller.command(pose, course, clearance_m);
    state.PauseTiming();
    pose = pose * unicycle_motion(twist, params.step_s);
    state.ResumeTiming();
  }
  count(state, params);
}

/// The commands that the plans begin with.
std::vector<Twist2> first_plan() { return MppiController().warm_started(office().T_map_start, PathFollower(office().path_m)); }

void floor_of(benchmark::State& state) {
  const MppiParams params;
  const std::vector<Twist2> plan = first_plan();
  for (auto _ : state) {
    for (int sample = 0; sample < params.samples; ++sample) {
      UnicycleState at(office().T_map_start);
      for (const Twist2& twist : plan) at.drive(twist, params.step_s);
      benchmark::DoNotOptimize(at);
    }
  }
  count(state, params);
}

void poses(benchmark::State& state) {
  const MppiParams params;
  const std::vector<Twist2> plan = first_plan();
  for (auto _ : state) {
    for (int sample = 0; sample < params.samples; ++sample) {
      Pose2 at = office().T_map_start;
      for (const Twist2& twist : plan) at = at * unicycle_motion(twist, params.step_s);
      benchmark::DoNotOptimize(at);
    }
  }
  count(state, params);
}

void noise(benchmark::State& state) {
  const MppiController controller;
  std::uint64_t call = 0;
  for (auto _ : state) {
    double sum = 0.0;
    for (std::size_t sample = 0; sample < static_cast<std::size_t>(controller.params().samples); ++sample) {
      controller.for_each_noise(call, sample, [&](std::size_t, const Twist2& twist) { sum += twist.speed_m_per_s + twist.turn_rate_rad_per_s; });
    }
    benchmark::DoNotOptimize(sum);
    ++call;
  }
  count(state, controller.params());
}

void window(benchmark::State& state) {
  const MppiParams params;
  ClearanceWindow window(office().occupancy.lattice());
  for (auto _ : state) {
    benchmark::DoNotOptimize(window.measure(office().T_map_start.position(), params.reach_m() + params.robot_radius_m + params.margin_m, is_occupied));
  }
}

void whole_map(benchmark::State& state) {
  Grid<float, 2> clearance_m(office().occupancy.lattice());
  for (auto _ : state) {
    distance_transform_m(office().occupancy, [](Occupancy cell) { return cell == Occupancy::occupied; }, clearance_m);
    benchmark::DoNotOptimize(clearance_m);
  }
  state.counters["cells"] = static_cast<double>(office().occupancy.size());
}

[[maybe_unused]] const bool registered = [] {
  for (const int threads : {1, 2}) {
    const std::string name = "command/" + std::to_string(threads) + "_threads";
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) { command(state, threads); })->UseRealTime();
  }
  return true;
}();
BENCHMARK(floor_of)->Name("floor");
BENCHMARK(poses);
BENCHMARK(noise);
BENCHMARK(window);
BENCHMARK(whole_map);

}  // namespace

BENCHMARK_MAIN();
