/// The cost of a map's update per touched cell: each cell policy beside the plainest log-odds grid that one
/// would write.
///
/// A robot drives through a drawn office at 1 m/s and scans it at 10 Hz with 360 beams of 10 m, recorded
/// once; what is timed is the writing of the recorded scans. A touch is one cell met by one beam, counted
/// once for all contestants. `fresh` starts from no storage and includes making it, `revisited` writes into a
/// map that knows the office. The office lies at 0.3 rad to the lattices.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose2.hpp"
#include "incognita/grid/grid.hpp"
#include "incognita/grid/traversal.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/map.hpp"
#include "incognita/sensor/ray_cast.hpp"
#include "incognita/sensor/scan.hpp"

namespace {

using incognita::Index;
using incognita::LogOdds;
using incognita::Map;
using incognita::MapParams;
using incognita::Point;
using incognita::Pose2;
using incognita::Reading;
using incognita::Scan;
using incognita::TBayes;

constexpr double kHitPushCells = 0.5;

/// 55 m x 25 m at 0.05 m: a corridor along the middle, eleven rooms on either side with doors of 0.9 m, two
/// columns in each. True is wall.
incognita::Grid<std::uint8_t, 2> draw_office() {
  constexpr int width = 1100;
  constexpr int height = 500;
  incognita::Grid<std::uint8_t, 2> office(incognita::Lattice<2>(0.05), {{0, 0}, {width, height}},
                                          std::uint8_t{1});
  const auto fill = [&](int x0, int y0, int x1, int y1, std::uint8_t value) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) office.set({x, y}, value);
    }
  };
  fill(4, 226, width - 4, 274, 0);  // 2.4 m
  for (int room = 0; room < 11; ++room) {
    const int left = room * 100;
    fill(left + 4, 4, left + 96, 222, 0);
    fill(left + 4, 278, left + 96, height - 4, 0);
    fill(left + 41, 222, left + 59, 226, 0);
    fill(left + 41, 274, left + 59, 278, 0);
    fill(left + 20, 100, left + 28, 108, 1);
    fill(left + 70, 380, left + 78, 388, 1);
  }
  return office;
}

/// What a drive along the corridor, with a visit to every other room, would record, in a turned frame.
struct Recording {
  std::vector<Scan<2>> scans;
  std::vector<Pose2> T_map_sensor;
  Eigen::Matrix3d covariance = Eigen::Vector3d(4e-4, 4e-4, 1e-4).asDiagonal();

  Recording() {
    const auto office = draw_office();
    const Pose2 T_map_office{-3.7, 8.1, 0.3};
    incognita::Random random(1);
    std::vector<Point<2>> path{{1.0, 12.5}};
    for (int room = 0; room < 11; room += 2) {
      const double door_m = 5.0 * room + 2.5;
      const double inside_m = room % 4 == 0 ? 5.0 : 20.0;
      path.insert(path.end(), {{door_m, 12.5}, {door_m, inside_m}, {door_m, 12.5}});
    }
    path.emplace_back(54.0, 12.5);
    for (std::size_t leg = 1; leg < path.size(); ++leg) {
      const Point<2> way = path[leg] - path[leg - 1];
      const double yaw_rad = std::atan2(way.y(), way.x());
      for (double along_m = 0.0; along_m < way.norm(); along_m += 0.1) {
        const Point<2> at = path[leg - 1] + way.normalized() * along_m;
        const Pose2 T_office_sensor{at.x(), at.y(), yaw_rad};
        Scan<2> scan(incognita::circular_beams(360, 10.0));
        for (std::size_t beam = 0; beam < scan.size(); ++beam) {
          const double range_m = incognita::cast_ray_m<std::uint8_t, 2>(
              office, at, T_office_sensor.rotation() * scan.direction(beam), 10.0,
              [](std::uint8_t wall) { return wall != 0; });
          if (range_m < 10.0) scan.set_range_m(beam, range_m + random.normal(0.0, 0.01));
        }
        scans.push_back(scan);
        T_map_sensor.push_back(T_map_office * T_office_sensor);
      }
    }
  }

  /// Where the walk of a beam ends; the same for all contestants.
  [[nodiscard]] Point<2> end_m(std::size_t n, std::size_t beam, double resolution_m) const {
    const bool is_hit = scans[n].reading(beam) == Reading::hit;
    return T_map_sensor[n] * scans[n].end_point_m(beam, is_hit ? kHitPushCells * resolution_m : 0.0);
  }

  [[nodiscard]] double touches(double resolution_m) const {
    const incognita::Lattice<2> lattice(resolution_m);
    std::int64_t count = 0;
    for (std::size_t n = 0; n < scans.size(); ++n) {
      for (std::size_t beam = 0; beam < scans[n].size(); ++beam) {
        if (scans[n].reading(beam) == Reading::invalid) continue;
        incognita::traverse<2>(lattice, T_map_sensor[n].position(), end_m(n, beam, resolution_m),
                               [&count](const Index<2>&) { ++count; });
      }
    }
    return static_cast<double>(count);
  }
};

const Recording& recording() {
  static const Recording drive;
  return drive;
}

/// What one writes first: a dense array of floats that is known to be large enough, the walk of the paper by
/// Amanatides and Woo with its running sums, one constant for a cell passed and one for a cell hit, both
/// clamped.
class PlainGrid {
 public:
  explicit PlainGrid(double resolution_m)
      : resolution_m_(resolution_m),
        width_(static_cast<int>(100.0 / resolution_m)),
        cells_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_), 0.0F) {}

  /// Returns how many cells it touched.
  std::int64_t update(const Scan<2>& scan, const Pose2& pose) {
    std::int64_t touched = 0;
    const double c = std::cos(pose.yaw_rad);
    const double s = std::sin(pose.yaw_rad);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const Reading reading = scan.reading(beam);
      if (reading == Reading::invalid) continue;
      const bool is_hit = reading == Reading::hit;
      const double length_m = scan.range_m(beam) + (is_hit ? kHitPushCells * resolution_m_ : 0.0);
      const double dx =
          (c * scan.direction(beam).x() - s * scan.direction(beam).y()) * length_m / resolution_m_;
      const double dy =
          (s * scan.direction(beam).x() + c * scan.direction(beam).y()) * length_m / resolution_m_;
      const double from_x = (pose.x_m + 20.0) / resolution_m_;
      const double from_y = (pose.y_m + 20.0) / resolution_m_;
      int x = static_cast<int>(std::floor(from_x));
      int y = static_cast<int>(std::floor(from_y));
      const int last_x = static_cast<int>(std::floor(from_x + dx));
      const int last_y = static_cast<int>(std::floor(from_y + dy));
      const int step_x = dx > 0.0 ? 1 : -1;
      const int step_y = dy > 0.0 ? 1 : -1;
      const double delta_x = std::abs(1.0 / dx);
      const double delta_y = std::abs(1.0 / dy);
      double next_x = (dx > 0.0 ? x + 1.0 - from_x : from_x - x) * delta_x;
      double next_y = (dy > 0.0 ? y + 1.0 - from_y : from_y - y) * delta_y;
      for (;;) {
        float& cell = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(x)];
        ++touched;
        if (x == last_x && y == last_y) {
          cell = is_hit ? std::min(10.0F, cell + 0.85F) : std::max(-10.0F, cell - 0.4F);
          break;
        }
        cell = std::max(-10.0F, cell - 0.4F);
        if (next_x < next_y) {
          next_x += delta_x;
          x += step_x;
        } else {
          next_y += delta_y;
          y += step_y;
        }
        if (std::min(next_x - delta_x, next_y - delta_y) > 1.0) break;  // rounding has missed the last cell
      }
    }
    return touched;
  }

 private:
  double resolution_m_;
  int width_;
  std::vector<float> cells_;
};

void report(benchmark::State& state, double touches) {
  state.counters["per_touch"] = benchmark::Counter(
      touches, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["touches_per_scan"] = touches / static_cast<double>(recording().scans.size());
}

template <class Contestant, class Write>
void write_drive(benchmark::State& state, double resolution_m, bool revisited, const Contestant& empty,
                 Write&& write) {
  const Recording& drive = recording();
  const auto write_all = [&](Contestant& contestant) {
    for (std::size_t n = 0; n < drive.scans.size(); ++n)
      write(contestant, drive.scans[n], drive.T_map_sensor[n]);
  };
  Contestant known = empty;
  if (revisited) write_all(known);
  for (auto _ : state) {
    if (revisited) {
      write_all(known);
    } else {
      Contestant contestant = empty;
      write_all(contestant);
      benchmark::DoNotOptimize(contestant);
    }
    benchmark::ClobberMemory();
  }
  report(state, drive.touches(resolution_m));
}

template <class Cell>
void register_policy(const std::string& name, const Cell& policy, double resolution_m, bool revisited,
                     const std::string& where) {
  benchmark::RegisterBenchmark((name + where).c_str(), [=](benchmark::State& state) {
    write_drive(state, resolution_m, revisited, Map<Cell>({resolution_m, kHitPushCells}, policy),
                [](Map<Cell>& map, const Scan<2>& scan, const Pose2& T_map_sensor) {
                  map.update(scan, T_map_sensor, recording().covariance);
                });
  })->Unit(benchmark::kMillisecond);
}

void register_plain(double resolution_m, bool revisited, const std::string& where) {
  benchmark::RegisterBenchmark(("plain" + where).c_str(), [=](benchmark::State& state) {
    PlainGrid check(resolution_m);
    std::int64_t touched = 0;
    for (std::size_t n = 0; n < recording().scans.size(); ++n) {
      touched += check.update(recording().scans[n], recording().T_map_sensor[n]);
    }
    const double expected = recording().touches(resolution_m);
    if (std::abs(static_cast<double>(touched) - expected) > 1e-4 * expected) {
      state.SkipWithError("the plain grid touches other cells than the maps");
      return;
    }
    write_drive(state, resolution_m, revisited, std::pair(resolution_m, std::vector<PlainGrid>{}),
                [](auto& grid, const Scan<2>& scan, const Pose2& T_map_sensor) {
                  if (grid.second.empty()) grid.second.emplace_back(grid.first);
                  benchmark::DoNotOptimize(grid.second[0].update(scan, T_map_sensor));
                });
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  for (const bool revisited : {false, true}) {
    for (const double resolution_m : {0.2, 0.1, 0.05}) {
      const std::string where =
          std::string(revisited ? "/revisited/" : "/fresh/") + std::to_string(resolution_m).substr(0, 4);
      register_plain(resolution_m, revisited, where);
      register_policy("LogOdds", LogOdds(), resolution_m, revisited, where);
      register_policy("TBayes", TBayes(), resolution_m, revisited, where);
      register_policy("TBayes_literal", TBayes(TBayes::literal_params()), resolution_m, revisited, where);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
