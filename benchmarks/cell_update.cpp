/// The cost of a map's update per touched cell: each cell policy beside the plainest log-odds grid that one
/// would write.
///
/// A robot drives through a drawn office at 1 m/s and scans it at 10 Hz with 360 beams of 10 m, recorded
/// once; what is timed is the writing of the recorded scans. A touch is one cell met by one beam, counted
/// once for all contestants. `fresh` starts from no storage and includes making it, `revisited` writes into a
/// map that knows the office. The office lies at 0.3 rad to the lattices. `floor` is the least that can be
/// done where every touch is written: an exact traversal and one addition to a float a cell.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "incognita/geometry/pose2.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/map.hpp"
#include "incognita/sensor/scan.hpp"
#include "recording.hpp"

namespace {

using benchmarks::hit_push_cells;
using benchmarks::Recording;
using benchmarks::recording;
using incognita::Dispersion;
using incognita::LogOdds;
using incognita::Map;
using incognita::Pose2;
using incognita::Reading;
using incognita::Scan;
using incognita::TBayes;

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
      const double length_m = scan.range_m(beam) + (is_hit ? hit_push_cells * resolution_m_ : 0.0);
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

/// The least that an update can do where every touch is written: nothing is clamped and no branch is in the
/// walk. A beam leaves each cell through one of the two faces ahead, so it crosses the diagonal between their
/// far ends; seen from the first cell, that of the n-th cell is where the steps along both axes sum up to n
/// + 1. So each cell follows from its number alone, and no touch waits for the one before.
class FloorGrid {
 public:
  explicit FloorGrid(double resolution_m)
      : resolution_m_(resolution_m),
        width_(static_cast<std::ptrdiff_t>(100.0 / resolution_m)),
        cells_(static_cast<std::size_t>(width_ * width_), 0.0F) {}

  /// Returns how many cells it touched.
  std::int64_t update(const Scan<2>& scan, const Pose2& pose) {
    std::int64_t touched = 0;
    const Eigen::Vector2d from = (pose.position().array() + 20.0) / resolution_m_;
    const Pose2::Rotation rotation = pose.rotation() / resolution_m_;
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      const Reading reading = scan.reading(beam);
      if (reading == Reading::invalid) continue;
      const double push_m = reading == Reading::hit ? hit_push_cells * resolution_m_ : 0.0;
      touched += add(from, from + rotation * scan.direction(beam) * (scan.range_m(beam) + push_m));
    }
    return touched;
  }

 private:
  /// Adds 1 to each cell between two places in cells, all coordinates positive.
  std::int64_t add(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int x = static_cast<int>(from.x());
    const int y = static_cast<int>(from.y());
    const double dx = to.x() - from.x();
    const double dy = to.y() - from.y();
    const int count = 1 + std::abs(static_cast<int>(to.x()) - x) + std::abs(static_cast<int>(to.y()) - y);
    const double inside_x = dx > 0.0 ? from.x() - x : x + 1 - from.x();
    const double inside_y = dy > 0.0 ? from.y() - y : y + 1 - from.y();
    const double share_x = std::abs(dx) / (std::abs(dx) + std::abs(dy));
    const double x_of_first = inside_x + share_x * (1.0 - inside_x - inside_y);
    const std::ptrdiff_t stride_x = dx > 0.0 ? 1 : -1;
    const std::ptrdiff_t stride_y = dy > 0.0 ? width_ : -width_;
    const std::ptrdiff_t turn = stride_x - stride_y;  // from a step along y to one along x
    float* at = cells_.data() + y * width_ + x;
    for (int n = 0; n < count; ++n, at += stride_y) {
      at[static_cast<int>(x_of_first + share_x * n) * turn] += 1.0F;
    }
    return count;
  }

  double resolution_m_;
  std::ptrdiff_t width_;
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
    write_drive(state, resolution_m, revisited, Map<Cell>({resolution_m, hit_push_cells}, policy),
                [](Map<Cell>& map, const Scan<2>& scan, const Pose2& T_map_sensor) {
                  map.update(scan, T_map_sensor, recording().covariance);
                });
  })->Unit(benchmark::kMillisecond);
}

template <class DenseGrid>
void register_dense(const std::string& name, double resolution_m, bool revisited, const std::string& where) {
  benchmark::RegisterBenchmark((name + where).c_str(), [=](benchmark::State& state) {
    DenseGrid check(resolution_m);
    std::int64_t touched = 0;
    for (std::size_t n = 0; n < recording().scans.size(); ++n) {
      touched += check.update(recording().scans[n], recording().T_map_sensor[n]);
    }
    const double expected = recording().touches(resolution_m);
    if (std::abs(static_cast<double>(touched) - expected) > 1e-4 * expected) {
      state.SkipWithError("the grid touches other cells than the maps");
      return;
    }
    write_drive(state, resolution_m, revisited, std::optional<DenseGrid>(),
                [resolution_m](auto& grid, const Scan<2>& scan, const Pose2& T_map_sensor) {
                  if (!grid) grid.emplace(resolution_m);
                  benchmark::DoNotOptimize(grid->update(scan, T_map_sensor));
                });
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  for (const bool revisited : {false, true}) {
    for (const double resolution_m : {0.2, 0.1, 0.05}) {
      const std::string where =
          std::string(revisited ? "/revisited/" : "/fresh/") + std::to_string(resolution_m).substr(0, 4);
      register_dense<FloorGrid>("floor", resolution_m, revisited, where);
      register_dense<PlainGrid>("plain", resolution_m, revisited, where);
      register_policy("LogOdds", LogOdds(), resolution_m, revisited, where);
      register_policy("TBayes", TBayes(), resolution_m, revisited, where);
      register_policy("Dispersion", Dispersion(), resolution_m, revisited, where);
      register_policy("TBayes_literal", TBayes(TBayes::literal_params()), resolution_m, revisited, where);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
