/// The cost of planning an exploration in a large, half-known building.
///
/// Offices as those of the other benchmarks stand side by side until the building is 132 x 44 m, with cells of 0.1 m. It is known
/// where the lines of sight from sixty places reach within 10 m. `spaces` erodes the free space, measures the distances of the
/// visit costs and searches one field of travel costs over all of it; `views` finds the viewpoint of every frontier and what is
/// seen from there. `exact_distances` is the floor for distances that are not cut off, two of them, for comparison.
#include "incognita/exploration/action_aware.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/grid/distance_transform.hpp"
#include "incognita/sensor/field_of_view.hpp"
#include "ray_course.hpp"

namespace {

using namespace incognita;

struct Building {
  OccupancyGrid<2> belief{Lattice<2>(0.1), {{0, 0}, {1320, 440}}, Occupancy::unknown};
  Eigen::Vector2d start_m{0.0, 0.0};
};

Building half_known_building() {
  const Grid<std::uint8_t, 2> office = benchmarks::draw_office(0.1);
  const Index<2> extent = office.box().extent();
  Building building;
  Grid<std::uint8_t, 2> walls(building.belief.lattice(), building.belief.box(), 0);
  for (Offset i = 0; i < static_cast<Offset>(walls.size()); ++i) {
    const Index<2> at = walls.index_at(i);
    const Index<2> within(at[0] % extent[0], at[1] % extent[1]);
    const bool is_corridor = within[1] >= 113 && within[1] < 137;  // which joins the offices
    walls[i] = is_corridor ? 0 : office.value({office.box().lower[0] + within[0], office.box().lower[1] + within[1]});
  }
  Random random(1);
  FieldOfView view;
  const auto is_wall = [](std::uint8_t wall) { return wall != 0; };
  for (int place = 0; place < 60;) {
    const Index<2> from = walls.index_at(static_cast<Offset>(random.index(walls.size())));
    if (walls.value(from) != 0) continue;
    if (place++ == 0) building.start_m = walls.lattice().center_m(from);
    view.visit_visible(walls, from, 10.0, is_wall, [&](const Index<2>& seen) {
      building.belief.set(seen, Occupancy::free);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const Index<2> beside(seen[0] + dx, seen[1] + dy);
          if (walls.value(beside) != 0) building.belief.set(beside, Occupancy::occupied);
        }
      }
    });
  }
  return building;
}

const Building& building() {
  static const Building made = half_known_building();
  return made;
}

const ActionAwareParams params;

void spaces(benchmark::State& state) {
  TravelCostField field(building().belief.lattice());
  for (auto _ : state) {
    const SafeSpaces safe = safe_spaces(building().belief, params.body);
    field.restart(visit_cost(building().belief, safe.plan, params.visit), building().start_m);
    benchmark::DoNotOptimize(field);
  }
  std::size_t reached = 0;
  for (Offset i = 0; i < static_cast<Offset>(building().belief.size()); ++i) reached += field.reaches(building().belief.index_at(i));
  state.counters["cells"] = static_cast<double>(building().belief.size());
  state.counters["reached_cells"] = static_cast<double>(reached);
}

void views(benchmark::State& state) {
  const OccupancyGrid<2>& belief = building().belief;
  const FrontierParams grouping;
  const std::vector<Index<2>> cells = detect_frontier<2>(belief, grouping);
  const std::vector<Frontier<2>> frontiers = cluster_frontier<2>(belief.lattice(), cells, grouping);
  const SafeSpaces safe = safe_spaces(belief, params.body);
  const CellBits free = free_cells(belief);
  const ReliableVisibility visibility(belief, free, params.visibility);
  ViewpointSearch search;
  std::size_t found = 0;
  for (auto _ : state) {
    found = find_views(frontiers,
                       [&](const Index<2>& cell) { return std::binary_search(cells.begin(), cells.end(), cell, is_stored_before<2>); },
                       [&](const Index<2>& cell) { return safe.plan.value(cell) != 0; }, visibility, 0.01, search).size();
  }
  state.counters["frontiers"] = static_cast<double>(frontiers.size());
  state.counters["frontier_cells"] = static_cast<double>(cells.size());
  state.counters["views"] = static_cast<double>(found);
}

void exact_distances(benchmark::State& state) {
  Grid<float, 2> distances(building().belief.lattice());
  for (auto _ : state) {
    for (const Occupancy source : {Occupancy::occupied, Occupancy::unknown}) {
      distance_transform_m(building().belief, [=](Occupancy cell) { return cell == source; }, distances);
      benchmark::DoNotOptimize(distances);
    }
  }
}

BENCHMARK(spaces)->Unit(benchmark::kMillisecond);
BENCHMARK(views)->Unit(benchmark::kMillisecond);
BENCHMARK(exact_distances)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
