/// The library beside MRPT's occupancy grid and OctoMap: the same scans and poses into their maps, and rays.
///
/// Every fourth scan of the shared drive, 360 beams of 10 m, each on one thread. The beams end where they
/// were measured, in all maps. `per_scan` is the time of a scan; `touches_per_scan` counts the cells that the
/// beams meet by each contestant's own walk, a cell once for each beam: MRPT steps along the longer axis
/// alone and so meets fewer, OctoMap leaves out the end of a beam that met nothing. `written_per_scan` is
/// what OctoMap writes after it has sorted out duplicates. OctoMap keeps a layer of one octree, a voxel
/// thick, where the others keep a plane.
///
/// `ray/` casts the rays of ray_cast in the office. MRPT's go in steps of a cell and may miss corners:
/// `difference_m` is their mean distance to the exact range.
#include <benchmark/benchmark.h>
#include <octomap/octomap.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#if defined(_OPENMP)
#include <omp.h>
#endif

#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/map.hpp"
#include "peers/mrpt_grid.hpp"
#include "ray_course.hpp"
#include "recording.hpp"

namespace {

using benchmarks::MrptDrive;
using benchmarks::MrptGrid;
using benchmarks::range_max_m;
using benchmarks::Ray;
using benchmarks::RayCourse;
using incognita::Map;
using incognita::Reading;
using incognita::Scan;

/// The drive in the form that each contestant takes.
struct Drive {
  static constexpr std::size_t stride = 4;

  std::vector<Scan<2>> scans;
  std::vector<incognita::Pose2> T_map_sensor;
  std::vector<benchmarks::PlanarScan> planar;

  Drive() {
    const benchmarks::Recording& all = benchmarks::recording();
    for (std::size_t n = 0; n < all.scans.size(); n += stride) {
      const incognita::Pose2& pose = all.T_map_sensor[n];
      scans.push_back(all.scans[n]);
      T_map_sensor.push_back(pose);
      planar.push_back({pose.x_m, pose.y_m, pose.yaw_rad, {}});
      for (std::size_t beam = 0; beam < scans.back().size(); ++beam) {
        planar.back().ranges_m.push_back(scans.back().range_m(beam));
      }
    }
  }
};

const Drive& drive() {
  static const Drive made;
  return made;
}

const MrptDrive& mrpt_drive() {
  static const MrptDrive made(drive().planar, range_max_m);
  return made;
}

/// Scans as clouds in the map's frame; a beam that met nothing ends beyond the range, where OctoMap cuts it
/// off.
struct OctoMapDrive {
  std::vector<octomap::point3d> origins;
  std::vector<octomap::Pointcloud> clouds;

  OctoMapDrive() {
    const auto point = [](const incognita::Point<2>& at_m) {
      constexpr float height_m = 0.01F;  // within the layer of voxels above 0, whatever their size
      return octomap::point3d(static_cast<float>(at_m.x()), static_cast<float>(at_m.y()), height_m);
    };
    for (std::size_t n = 0; n < drive().scans.size(); ++n) {
      const Scan<2>& scan = drive().scans[n];
      origins.push_back(point(drive().T_map_sensor[n].position()));
      octomap::Pointcloud& cloud = clouds.emplace_back();
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        if (scan.reading(beam) == Reading::invalid) continue;
        const double beyond_m = scan.reading(beam) == Reading::clear ? 1.0 : 0.0;
        cloud.push_back(point(drive().T_map_sensor[n] * scan.end_point_m(beam, beyond_m)));
      }
    }
  }
};

const OctoMapDrive& octomap_drive() {
  static const OctoMapDrive made;
  return made;
}

struct Touches {
  double met = 0.0;      ///< a cell once for each beam that meets it
  double written = 0.0;  ///< by the map
};

Touches count_exactly(double resolution_m) {
  const incognita::Lattice<2> lattice(resolution_m);
  Touches touches;
  for (std::size_t n = 0; n < drive().scans.size(); ++n) {
    const Scan<2>& scan = drive().scans[n];
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      if (scan.reading(beam) == Reading::invalid) continue;
      const auto end_m = drive().T_map_sensor[n] * scan.end_point_m(beam);
      incognita::traverse<2>(lattice, drive().T_map_sensor[n].position(), end_m,
                             [&touches](const incognita::Index<2>&) { touches.met += 1.0; });
    }
  }
  touches.written = touches.met;
  return touches;
}

/// From every tenth scan: MRPT does not say what it writes, and finding out takes time.
Touches count_of_mrpt(double resolution_m) {
  constexpr std::size_t sample_stride = 10;
  double touches = 0.0;
  double scans = 0.0;
  for (std::size_t n = 0; n < mrpt_drive().size(); n += sample_stride) {
    touches += static_cast<double>(mrpt_drive().touches(n, resolution_m));
    scans += 1.0;
  }
  touches *= static_cast<double>(mrpt_drive().size()) / scans;
  return {touches, touches};
}

Touches count_of_octomap(double resolution_m) {
  octomap::OcTree tree(resolution_m);
  octomap::KeyRay keys;
  Touches touches;
  for (std::size_t n = 0; n < octomap_drive().clouds.size(); ++n) {
    const octomap::point3d& origin = octomap_drive().origins[n];
    for (const octomap::point3d& point : octomap_drive().clouds[n]) {
      const octomap::point3d way = point - origin;
      const bool is_hit = way.norm() <= range_max_m;
      const octomap::point3d end =
          is_hit ? point : origin + way.normalized() * static_cast<float>(range_max_m);
      tree.computeRayKeys(origin, end, keys);
      touches.met += static_cast<double>(keys.size()) + (is_hit ? 1.0 : 0.0);
    }
    octomap::KeySet free;
    octomap::KeySet occupied;
    tree.computeUpdate(octomap_drive().clouds[n], origin, free, occupied, range_max_m);
    touches.written += static_cast<double>(free.size() + occupied.size());
  }
  return touches;
}

struct Case {
  double resolution_m;
  bool revisited;
};

/// Counted once: each repetition asks again.
const Touches& counted(Touches (*count)(double), double resolution_m) {
  static std::map<std::pair<Touches (*)(double), double>, Touches> known;
  const auto [place, is_new] = known.try_emplace({count, resolution_m});
  if (is_new) place->second = count(resolution_m);
  return place->second;
}

/// Times the writing of the drive into what make(resolution) returns by write(map, scan number), then
/// finish(map).
template <class Make, class Write, class Finish>
void register_map(const std::string& name, const Case& of, Touches (*count)(double), const Make& make,
                  const Write& write, const Finish& finish) {
  const std::string where =
      std::string(of.revisited ? "/revisited/" : "/fresh/") + std::to_string(of.resolution_m).substr(0, 4);
  benchmark::RegisterBenchmark((name + where).c_str(), [=](benchmark::State& state) {
    const auto write_all = [&](auto& map) {
      for (std::size_t n = 0; n < drive().scans.size(); ++n) write(map, n);
      finish(map);
    };
    const Touches& touches = counted(count, of.resolution_m);  // makes the drive, too
    auto known = make(of.resolution_m);
    if (of.revisited) write_all(known);
    for (auto _ : state) {
      if (of.revisited) {
        write_all(known);
      } else {
        auto fresh = make(of.resolution_m);
        write_all(fresh);
        benchmark::DoNotOptimize(fresh);
      }
      benchmark::ClobberMemory();
    }
    const auto inverse_rate = [](double count_of_all) {
      return benchmark::Counter(count_of_all,
                                benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    };
    const auto scans = static_cast<double>(drive().scans.size());
    state.counters["per_scan"] = inverse_rate(scans);
    state.counters["per_touch"] = inverse_rate(touches.met);
    state.counters["touches_per_scan"] = touches.met / scans;
    state.counters["written_per_scan"] = touches.written / scans;
  })->Unit(benchmark::kMillisecond);
}

template <class Cell>
void register_incognita(const std::string& name, const Case& of) {
  register_map(
      name, of, count_exactly,
      [](double resolution_m) {
        return Map<Cell>({resolution_m, 0.0});
      },
      [](Map<Cell>& map, std::size_t n) {
        map.update(drive().scans[n], drive().T_map_sensor[n], benchmarks::recording().covariance);
      },
      [](const Map<Cell>&) {});
}

void register_mrpt(const Case& of) {
  register_map(
      "mrpt", of, count_of_mrpt, [](double resolution_m) { return MrptGrid(resolution_m, range_max_m); },
      [](MrptGrid& grid, std::size_t n) { grid.insert(mrpt_drive(), n); }, [](const MrptGrid&) {});
}

/// insert(tree, cloud, origin); lazy modes owe the inner nodes, once a drive.
template <class Insert>
void register_octomap(const std::string& name, const Case& of, bool is_lazy, const Insert& insert) {
  register_map(
      name, of, count_of_octomap, [](double resolution_m) { return octomap::OcTree(resolution_m); },
      [insert](octomap::OcTree& tree, std::size_t n) {
        insert(tree, octomap_drive().clouds[n], octomap_drive().origins[n]);
      },
      [is_lazy](octomap::OcTree& tree) {
        if (is_lazy) tree.updateInnerOccupancy();
      });
}

void register_maps(const Case& of) {
  using octomap::OcTree;
  using octomap::point3d;
  using octomap::Pointcloud;
  register_incognita<incognita::TBayes>("incognita_TBayes", of);
  register_incognita<incognita::LogOdds>("incognita_LogOdds", of);
  register_mrpt(of);
  register_octomap("octomap_default", of, false,
                   [](OcTree& tree, const Pointcloud& cloud, const point3d& origin) {
                     tree.insertPointCloud(cloud, origin, range_max_m);
                   });
  register_octomap("octomap_lazy", of, true,
                   [](OcTree& tree, const Pointcloud& cloud, const point3d& origin) {
                     tree.insertPointCloud(cloud, origin, range_max_m, true);
                   });
  register_octomap("octomap_discretized", of, true,
                   [](OcTree& tree, const Pointcloud& cloud, const point3d& origin) {
                     tree.insertPointCloud(cloud, origin, range_max_m, true, true);  // lazy, too
                   });
  register_octomap("octomap_rays_lazy", of, true,
                   [](OcTree& tree, const Pointcloud& cloud, const point3d& origin) {
                     tree.insertPointCloudRays(cloud, origin, range_max_m, true);
                   });
}

const RayCourse& course(double resolution_m) {
  static const RayCourse coarse(0.2);
  static const RayCourse fine(0.05);
  return resolution_m == 0.2 ? coarse : fine;
}

double cast_m(const RayCourse& on, std::size_t ray) {
  return on.field.cast_ray_m(on.rays[ray].origin_m, on.rays[ray].direction, range_max_m);
}

MrptGrid mrpt_office(const RayCourse& on) {
  const incognita::Index<2> extent = on.walls.box().extent();
  return MrptGrid(on.walls.resolution_m(), extent.x(), extent.y(), on.walls.values());
}

/// cast_all(take) calls take(ray number, range) for all rays of the course.
template <class CastAll>
void time_rays(benchmark::State& state, const RayCourse& on, const CastAll& cast_all) {
  double difference_m = 0.0;
  cast_all([&](std::size_t ray, double range_m) { difference_m += std::abs(range_m - cast_m(on, ray)); });
  for (auto _ : state) {
    cast_all([](std::size_t, double range_m) { benchmark::DoNotOptimize(range_m); });
  }
  const auto count = static_cast<double>(on.rays.size());
  state.counters["rays_per_s"] = benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["difference_m"] = difference_m / count;
}

void register_rays(double resolution_m) {
  const auto add = [&](const std::string& name, const auto& time) {
    const std::string full_name = name + '/' + std::to_string(resolution_m).substr(0, 4);
    benchmark::RegisterBenchmark(full_name.c_str(), time)->Unit(benchmark::kMillisecond);
  };
  add("ray/incognita_obstacle_field", [=](benchmark::State& state) {
    const RayCourse& on = course(resolution_m);
    time_rays(state, on, [&](const auto& take) {
      for (std::size_t ray = 0; ray < on.rays.size(); ++ray) take(ray, cast_m(on, ray));
    });
  });
  add("ray/mrpt_simulateScanRay", [=](benchmark::State& state) {
    const RayCourse& on = course(resolution_m);
    const MrptGrid office = mrpt_office(on);
    std::vector<double> directions_rad;
    for (const Ray& ray : on.rays) directions_rad.push_back(std::atan2(ray.direction.y(), ray.direction.x()));
    time_rays(state, on, [&](const auto& take) {
      for (std::size_t ray = 0; ray < on.rays.size(); ++ray) {
        const incognita::Point<2>& from_m = on.rays[ray].origin_m;
        take(ray, office.cast_ray_m(from_m.x(), from_m.y(), directions_rad[ray], range_max_m));
      }
    });
  });
  add("ray/mrpt_laserScanSimulator", [=](benchmark::State& state) {
    const RayCourse& on = course(resolution_m);
    MrptGrid office = mrpt_office(on);
    const std::size_t beams = on.rays.size() / on.T_office_sensor.size();
    time_rays(state, on, [&](const auto& take) {
      for (std::size_t n = 0; n < on.T_office_sensor.size(); ++n) {
        const incognita::Pose2& pose = on.T_office_sensor[n];
        office.simulate_scan(pose.x_m, pose.y_m, pose.yaw_rad, beams, range_max_m);
        for (std::size_t beam = 0; beam < beams; ++beam) take(n * beams + beam, office.simulated_m(beam));
      }
    });
  });
}

}  // namespace

int main(int argc, char** argv) {
#if defined(_OPENMP)
  omp_set_num_threads(1);  // OctoMap would use more
#endif
  for (const bool revisited : {false, true}) {
    for (const double resolution_m : {0.2, 0.05}) register_maps({resolution_m, revisited});
  }
  for (const double resolution_m : {0.2, 0.05}) register_rays(resolution_m);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
