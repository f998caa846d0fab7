/// The cost of an exact ray: how far from a point to the first wall of the office, at 0.2 and 0.05 m.
///
/// The rays are those of the shared drive, 360 from a pose, up to 10 m. `plain` is what one writes first. All
/// contestants must find the same ranges; the few rays that graze a corner may differ.
#include "incognita/sensor/ray_cast.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/grid/grid.hpp"
#include "ray_course.hpp"

namespace {

using benchmarks::is_wall;
using benchmarks::range_max_m;
using benchmarks::Ray;
using benchmarks::RayCourse;

const RayCourse& course(double resolution_m) {
  static const RayCourse coarse(0.2);
  static const RayCourse fine(0.05);
  return resolution_m == 0.2 ? coarse : fine;
}

double cast_on_grid_m(const RayCourse& course, const Ray& ray) {
  return incognita::cast_ray_m<std::uint8_t, 2>(course.walls, ray.origin_m, ray.direction, range_max_m,
                                                is_wall);
}

double cast_in_field_m(const RayCourse& course, const Ray& ray) {
  return course.field.cast_ray_m(ray.origin_m, ray.direction, range_max_m);
}

/// The walk of the paper by Amanatides and Woo with its running sums, over an array that no ray leaves.
double cast_plainly_m(const RayCourse& course, const Ray& ray) {
  const double resolution_m = course.walls.resolution_m();
  const int width = course.walls.box().extent().x();
  const std::uint8_t* const walls = course.walls.values().data();
  const double from_x = ray.origin_m.x() / resolution_m;
  const double from_y = ray.origin_m.y() / resolution_m;
  int x = static_cast<int>(from_x);
  int y = static_cast<int>(from_y);
  const int step_x = ray.direction.x() > 0.0 ? 1 : -1;
  const int step_y = ray.direction.y() > 0.0 ? 1 : -1;
  const double delta_x_m = resolution_m / std::abs(ray.direction.x());
  const double delta_y_m = resolution_m / std::abs(ray.direction.y());
  double next_x_m = (ray.direction.x() > 0.0 ? x + 1.0 - from_x : from_x - x) * delta_x_m;
  double next_y_m = (ray.direction.y() > 0.0 ? y + 1.0 - from_y : from_y - y) * delta_y_m;
  double range_m = 0.0;
  while (range_m < range_max_m) {
    if (walls[y * width + x] != 0) return range_m;
    if (next_x_m < next_y_m) {
      range_m = next_x_m;
      next_x_m += delta_x_m;
      x += step_x;
    } else {
      range_m = next_y_m;
      next_y_m += delta_y_m;
      y += step_y;
    }
  }
  return range_max_m;
}

/// The share of the rays that end elsewhere than on the grid by the library's own walk.
template <class Cast>
double share_elsewhere(const RayCourse& course, const Cast& cast) {
  std::size_t elsewhere = 0;
  for (const Ray& ray : course.rays) {
    if (std::abs(cast(course, ray) - cast_on_grid_m(course, ray)) > 1e-6) ++elsewhere;
  }
  return static_cast<double>(elsewhere) / static_cast<double>(course.rays.size());
}

template <class Cast>
void register_cast(const std::string& name, double resolution_m, const Cast& cast) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    const RayCourse& rays = course(resolution_m);
    if (share_elsewhere(rays, cast) > 1e-3) {
      state.SkipWithError("the rays end elsewhere than by incognita::cast_ray_m");
      return;
    }
    for (auto _ : state) {
      for (const Ray& ray : rays.rays) benchmark::DoNotOptimize(cast(rays, ray));
    }
    const auto count = static_cast<double>(rays.rays.size());
    state.counters["rays_per_s"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  for (const double resolution_m : {0.2, 0.05}) {
    // Lambdas, not pointers, so that each loop holds its own cast.
    const auto add = [&](const std::string& name, const auto& cast) {
      register_cast(name + '/' + std::to_string(resolution_m).substr(0, 4), resolution_m, cast);
    };
    add("plain", [](const RayCourse& on, const Ray& ray) { return cast_plainly_m(on, ray); });
    add("grid", [](const RayCourse& on, const Ray& ray) { return cast_on_grid_m(on, ray); });
    add("obstacle_field", [](const RayCourse& on, const Ray& ray) { return cast_in_field_m(on, ray); });
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
