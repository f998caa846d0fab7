/// The cost of a scan to the estimator, in a room and on a floor that it knows, against the number of beams.
///
/// An explorer's mission through the building is driven again and mapped from its true poses; then its scans
/// are taken once more, each from a pose believed about a centimetre off. `register_scan` is registration
/// alone, against surfaces taken as certain; `dvl_ekf` is all that the estimator does with a scan, correct
/// and learn, and the same without the compass; `ray_form` is the correction of Seo et al., Lemma 4.1, as the
/// baseline. One iteration is one scan.
#include "incognita/estimation/registration.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/buildings.hpp"
#include "accuracy/drive.hpp"
#include "incognita/core/random.hpp"
#include "incognita/estimation/dvl_ekf.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/map/map.hpp"
#include "incognita/simulation/simulator.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"

namespace {

using incognita::DvlEkf;
using incognita::Map;
using incognita::Pose2;
using incognita::Scan;
using incognita::World;

enum class Place : std::uint8_t { room, floor };

/// 6 m x 5 m.
World make_room() {
  return World(accuracy::draw_plan({-3.2, -2.7}, {3.2, 2.7}, [](const Eigen::Vector2d& at_m) {
    const bool is_inside = std::abs(at_m.x()) < 3.0 && std::abs(at_m.y()) < 2.5;
    return is_inside ? incognita::FloorCell::floor : incognita::FloorCell::wall;
  }));
}

World make_floor() {
  return World(incognita::read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan"));
}

/// A building and a mission through it, made once.
struct Course {
  World world;
  accuracy::Mission mission;

  explicit Course(World building)
      : world(std::move(building)), mission(accuracy::explore(world, 1, 1600.0)) {}
};

const Course& course(Place place) {
  static const Course room(make_room());
  if (place == Place::room) return room;
  static const Course floor(make_floor());
  return floor;
}

/// The mission's scans with the given number of beams, and what was mapped from them.
struct Mapped {
  std::vector<Scan<2>> scans;
  std::vector<Pose2> T_map_robot;  ///< where each scan was taken
  std::vector<Pose2> believed;     ///< where the robot thinks that it was taken
  Map<> map;
  DvlEkf filter;

  Mapped(Place place, std::size_t beams, const DvlEkf::Params& params) : filter(params) {
    incognita::SimulatorParams simulated;
    simulated.sensor.beams = incognita::circular_beams(beams, 10.0);
    const Course& of = course(place);
    incognita::Simulator simulator(of.world, of.mission.T_world_start, simulated, 1);
    const Pose2 T_map_start{1.3, -0.4, 0.3};
    incognita::Random random(1);
    for (const incognita::Twist2& command : of.mission.commands) {
      simulator.step(command);
      if (!simulator.scan_is_new()) continue;
      scans.push_back(simulator.scan());
      T_map_robot.push_back(T_map_start * simulator.T_start_robot());
      const Pose2 error{random.normal(0.0, 0.01), random.normal(0.0, 0.01), random.normal(0.0, 0.003)};
      believed.push_back(T_map_robot.back() * error);
      // Without noise in the motion: the filter believes in the true pose.
      filter.predict(filter.belief().pose.inverse() * T_map_robot.back(), 0.0);
      map.update(scans.back(), filter.belief().pose, filter.belief().covariance);
      filter.learn(scans.back());
    }
  }
};

void time_registration(benchmark::State& state, Place place, std::size_t beams) {
  const Mapped mapped(place, beams, {});
  const auto covariance = incognita::diagonal_covariance(1e-4, 1e-4, 1e-5);
  std::size_t n = 0;
  double associations = 0.0;
  for (auto _ : state) {
    const incognita::Registration found =
        register_scan({mapped.believed[n], covariance}, mapped.scans[n], mapped.filter.surfaces(), {});
    associations += static_cast<double>(found.associations);
    n = (n + 1) % mapped.scans.size();
  }
  state.counters["associations"] = benchmark::Counter(associations, benchmark::Counter::kAvgIterations);
  state.counters["surfaces"] = static_cast<double>(mapped.filter.surfaces().size());
}

void time_filter(benchmark::State& state, Place place, std::size_t beams, const DvlEkf::Params& params) {
  Mapped mapped(place, beams, params);
  constexpr double scan_interval_s = 0.1;
  std::size_t n = 0;
  double associations = 0.0;
  double untrusted = 0.0;
  for (auto _ : state) {
    DvlEkf& filter = mapped.filter;
    filter.predict(filter.belief().pose.inverse() * mapped.believed[n], scan_interval_s);
    const incognita::CorrectionReport report = filter.correct(mapped.scans[n], mapped.map);
    if (report.trusted) filter.learn(mapped.scans[n]);
    associations += static_cast<double>(report.associations);
    untrusted += report.trusted ? 0.0 : 1.0;
    n = (n + 1) % mapped.scans.size();
  }
  state.counters["associations"] = benchmark::Counter(associations, benchmark::Counter::kAvgIterations);
  state.counters["untrusted"] = benchmark::Counter(untrusted, benchmark::Counter::kAvgIterations);
  state.counters["surfaces"] = static_cast<double>(mapped.filter.surfaces().size());
}

void register_course(Place place, std::size_t beams) {
  const std::string where =
      std::string(place == Place::room ? "/room/" : "/floor/") + std::to_string(beams) + "_beams";
  const auto add = [](const std::string& name, const auto& time) {
    benchmark::RegisterBenchmark(name.c_str(), time)->Unit(benchmark::kMicrosecond);
  };
  const DvlEkf::Params defaults;
  DvlEkf::Params without_compass;
  without_compass.uses_compass = false;
  DvlEkf::Params rays = without_compass;
  rays.form = DvlEkf::Form::ray;
  add("register_scan" + where, [=](benchmark::State& state) { time_registration(state, place, beams); });
  add("dvl_ekf" + where, [=](benchmark::State& state) { time_filter(state, place, beams, defaults); });
  add("dvl_ekf_without_compass" + where,
      [=](benchmark::State& state) { time_filter(state, place, beams, without_compass); });
  add("ray_form" + where, [=](benchmark::State& state) { time_filter(state, place, beams, rays); });
}

}  // namespace

int main(int argc, char** argv) {
  for (const Place place : {Place::room, Place::floor}) {
    for (const std::size_t beams : {90U, 180U, 360U}) register_course(place, beams);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
