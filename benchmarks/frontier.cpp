/// What it costs to know the frontier of a map after each scan of a drive through an office: `follow` keeps it up to date
/// (OccupancyLayer and FrontierLayer), `anew` classifies the whole map and searches it, as explorers do that keep nothing
/// (classify and detect_frontier). `list` lists the frontier's cells, `group` lists and groups them, as a decision does.
/// `per_known_cell` divides by the cells that are known.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>

#include "incognita/frontier/frontier.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/map/map.hpp"
#include "recording.hpp"

namespace {

using namespace incognita;

constexpr double resolution_m = 0.1;

enum class Way { follow, anew, list, group };

void drive(benchmark::State& state, Way way) {
  const benchmarks::Recording& recording = benchmarks::recording();
  double frontier_cells = 0.0;
  double known_cells = 0.0;
  double scans = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    Map<> map(MapParams{.resolution_m = resolution_m});
    OccupancyLayer occupancy(map.lattice());
    FrontierLayer frontier(map.lattice());
    frontier_cells = known_cells = scans = 0.0;
    for (std::size_t n = 0; n < recording.scans.size(); n += 4) {
      map.update(recording.scans[n], recording.T_map_sensor[n], recording.covariance);
      if (way != Way::follow) {
        occupancy.follow(map);
        frontier.follow(occupancy);
      }
      state.ResumeTiming();
      if (way == Way::follow) {
        occupancy.follow(map);
        frontier.follow(occupancy);
      } else if (way == Way::anew) {
        benchmark::DoNotOptimize(detect_frontier<2>(classify(map)));
      } else if (way == Way::list) {
        benchmark::DoNotOptimize(frontier.cells());
      } else {
        benchmark::DoNotOptimize(cluster_frontier<2>(map.lattice(), frontier.cells()));
      }
      state.PauseTiming();
      frontier_cells += static_cast<double>(frontier.cells().size());
      for (const Occupancy cell : occupancy.grid().values()) known_cells += cell != Occupancy::unknown ? 1.0 : 0.0;
      scans += 1.0;
    }
    state.ResumeTiming();
  }
  using benchmark::Counter;
  state.counters["per_scan"] = Counter(scans, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["per_known_cell"] = Counter(known_cells, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["frontier_cells"] = frontier_cells / scans;
}

}  // namespace

BENCHMARK_CAPTURE(drive, follow, Way::follow)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, anew, Way::anew)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, list, Way::list)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(drive, group, Way::group)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
