/// What a scan costs as the map grows, the scan has more beams, and a decision more candidates.
///
/// `area/...` is one scan in the middle of a building of many equal halls, all of it known but the rims between them, on maps of
/// 1 to 256 times the area (and of 800 x 800 and 4000 x 4000 cells): `update` writes it into the map, obstacle layer
/// included; `follow` brings occupancy, frontier and information up to date with it; `anew` computes these from the whole
/// map, as who does not follow it must. `beams/...` is the update against the number of beams.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/frontier/frontier_layer.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/map/map.hpp"

namespace {

using namespace incognita;

constexpr double resolution_m = 0.1;
constexpr double hall_m = 12.0;  // from one hall to the next; walls are at 5 m from the middle

/// What a sensor in a hall of 10 m x 10 m sees, `at` from its middle.
Scan<2> hall_scan(std::size_t beams, const Eigen::Vector2d& at, Random& random) {
  Scan<2> scan(circular_beams(beams, 10.0));
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const Eigen::Vector2d& direction = scan.direction(beam);
    double range_m = 10.0;
    for (int axis = 0; axis < 2; ++axis) {
      const double wall_m = direction[axis] > 0.0 ? 5.0 : -5.0;
      if (direction[axis] != 0.0) range_m = std::min(range_m, (wall_m - at[axis]) / direction[axis]);
    }
    if (range_m < 10.0) scan.set_range_m(beam, std::min(range_m + random.normal(0.0, 0.01), 9.999));
  }
  return scan;
}

struct Visit {
  Scan<2> scan;
  Pose2 pose;
};

const Eigen::Matrix3d covariance = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();

/// A map of `side` x `side` cells full of known halls.
Map<> known_halls(int side) {
  Random random(1);
  Map<> map(MapParams{.resolution_m = resolution_m});
  const double half_m = 0.5 * side * resolution_m;
  map.reserve({Eigen::Vector2d(-half_m, -half_m), Eigen::Vector2d(half_m, half_m)});
  const int halls = static_cast<int>((half_m - 6.0) / hall_m);
  for (int y = -halls; y <= halls; ++y) {
    for (int x = -halls; x <= halls; ++x) {
      for (int visit = 0; visit < 3; ++visit) {
        const Eigen::Vector2d at(random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0));
        map.update(hall_scan(360, at, random), {x * hall_m + at.x(), y * hall_m + at.y(), 0.0}, covariance);
      }
    }
  }
  return map;
}

/// Scans about the hall in the middle.
std::vector<Visit> visits(std::size_t beams) {
  Random random(2);
  std::vector<Visit> made;
  for (int visit = 0; visit < 64; ++visit) {
    const Eigen::Vector2d at(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    made.push_back({hall_scan(beams, at, random), {at.x(), at.y(), 0.0}});
  }
  return made;
}

/// A map and all that follows it.
struct Followed {
  Map<> map;
  OccupancyLayer<2> occupancy;
  FrontierLayer<2> frontier;
  EntropyTable entropy{Shannon{}};
  EntropyLayer<EntropyTable> information;

  explicit Followed(int side)
      : map(known_halls(side)),
        occupancy(map.lattice()),
        frontier(map.lattice()),
        information(map.lattice(), entropy) {
    occupancy.rebuild(map);
    frontier.rebuild(occupancy);
    information.rebuild(map);
  }

  void follow() {
    occupancy.follow(map);
    frontier.follow(occupancy);
    information.follow(map);
  }
};

Followed& followed(int side) {
  static std::map<int, Followed> made;
  return made.try_emplace(side, side).first->second;
}

enum class Part { update, follow, anew };

void one_scan(benchmark::State& state, int side, Part part) {
  using Clock = std::chrono::steady_clock;
  Followed& all = followed(side);
  const std::vector<Visit> scans = visits(360);
  std::size_t next = 0;
  for (auto _ : state) {
    const Visit& visit = scans[next++ % scans.size()];
    const auto begin = Clock::now();
    all.map.update(visit.scan, visit.pose, covariance);
    const auto written = Clock::now();
    if (part == Part::anew) {
      benchmark::DoNotOptimize(detect_frontier<2>(classify(all.map)));
      benchmark::DoNotOptimize(map_entropy_nats(all.map, all.entropy));
    } else {
      all.follow();
    }
    const auto end = Clock::now();
    if (part == Part::anew) all.follow();
    state.SetIterationTime(std::chrono::duration<double>(part == Part::update ? written - begin : end - written).count());
  }
  state.counters["cells"] = static_cast<double>(all.map.grid().size());
  state.counters["frontier_cells"] = static_cast<double>(all.frontier.cells().size());
}

void beams(benchmark::State& state, std::size_t count) {
  Map<> map = known_halls(500);
  const std::vector<Visit> scans = visits(count);
  std::size_t next = 0;
  for (auto _ : state) {
    const Visit& visit = scans[next++ % scans.size()];
    map.update(visit.scan, visit.pose, covariance);
  }
  state.counters["per_beam"] =
      benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  for (const int side : {250, 500, 800, 1000, 2000, 4000}) {
    const std::string count = std::to_string(side);
    const auto add = [&](const char* name, Part part) {
      benchmark::RegisterBenchmark(std::string(name).append("/").append(count).append("x").append(count).c_str(), [=](benchmark::State& state) {
        one_scan(state, side, part);
      })->UseManualTime()->Unit(benchmark::kMicrosecond);
    };
    add("area/update", Part::update);
    add("area/follow", Part::follow);
    add("area/anew", Part::anew);
  }
  for (const std::size_t count : {45U, 90U, 180U, 360U, 720U, 1440U}) {
    benchmark::RegisterBenchmark(std::string("beams/update/").append(std::to_string(count)).c_str(), [=](benchmark::State& state) {
      beams(state, count);
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
