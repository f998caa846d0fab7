/// What it costs a run of an explorer to be recorded: the same run without a recorder, with one that is absent, and with one.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/exploration/explorer.hpp"
#include "incognita/io/kth_xml.hpp"
#include "incognita/io/run_recorder.hpp"
#include "incognita/simulation/simulator.hpp"
#include "incognita/simulation/start.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"

namespace {

using namespace incognita;
using OfficeExplorer = Explorer<>;

constexpr double duration_s = 60.0;
constexpr double step_s = 0.02;
constexpr int steps_per_scan = 5;

ExplorerParams params() {
  ExplorerParams params;
  params.threads = 1;
  return params;
}

/// What a robot measures on its first minute in the embedded office floor; driven by the same explorer, it can be given again as it was.
struct Course {
  std::vector<Pose2> increments;  ///< a step each
  std::vector<Scan<2>> scans;     ///< the first before the first step, then one each steps_per_scan
  std::vector<Pose2> truths;      ///< at the scans

  Course() {
    World world(read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan"));
    Random random(1);
    const SimulatorParams simulated;
    const Pose2 start = random_start(world, simulated.robot.radius_m, random);
    Simulator simulator(std::move(world), start, simulated, 1);
    OfficeExplorer explorer(params());
    Twist2 command;
    while (simulator.time_s() < duration_s) {
      if (simulator.scan_is_new()) {
        scans.push_back(simulator.scan());
        truths.push_back(simulator.T_start_robot());
        explorer.observe(simulator.scan());
        explorer.decide();
        command = explorer.command(simulator.scan());
      }
      increments.push_back(simulator.step(command));
      explorer.move(increments.back(), step_s);
    }
  }
};

const Course& course() {
  static const Course course;
  return course;
}

/// The whole run; observed(explorer, scan, truth) and decided(explorer) are called as RunRecorder's are.
template <class Observed, class Decided>
void run(OfficeExplorer& explorer, Observed&& observed, Decided&& decided) {
  std::size_t scan = 0;
  for (std::size_t step = 0; step < course().increments.size(); ++step) {
    if (step % steps_per_scan == 0) {
      explorer.observe(course().scans[scan]);
      observed(explorer, course().scans[scan], course().truths[scan]);
      if (explorer.decide()) decided(explorer);
      benchmark::DoNotOptimize(explorer.command(course().scans[scan]));
      ++scan;
    }
    explorer.move(course().increments[step], step_s);
  }
}

void without(benchmark::State& state) {
  static_cast<void>(course());
  for ([[maybe_unused]] auto _ : state) {
    OfficeExplorer explorer(params());
    run(explorer, [](const auto&, const auto&, const auto&) {}, [](const auto&) {});
    benchmark::DoNotOptimize(explorer.belief().pose.x_m);
  }
}

/// A pointer to a recorder, as a program holds it that records on request; null without an interval.
void recorded(benchmark::State& state, std::optional<double> interval_s) {
  static_cast<void>(course());
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("incognita-observer-" + std::to_string(getpid()));
  std::size_t size_bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    OfficeExplorer explorer(params());
    std::optional<RunRecorder> recorder;
    if (interval_s) {
      RecordingSetup setup;
      setup.metric_names = {"time_s", "x_m", "y_m"};
      recorder.emplace(file, explorer, course().scans.front(), std::move(setup), RunRecorder::Params{*interval_s, true});
    }
    RunRecorder* observer = recorder ? &*recorder : nullptr;
    benchmark::DoNotOptimize(observer);
    const auto metrics = [&] { return std::array{explorer.time_s(), explorer.belief().pose.x_m, explorer.belief().pose.y_m}; };
    run(
        explorer,
        [&](const OfficeExplorer& of, const Scan<2>& scan, const Pose2& truth) {
          if (observer != nullptr) observer->observed(of, scan, truth, metrics);
        },
        [&](const OfficeExplorer& of) {
          if (observer != nullptr) observer->decided(of);
        });
    benchmark::DoNotOptimize(explorer.belief().pose.x_m);
    if (recorder) size_bytes = recorder->size_bytes();
  }
  if (interval_s) {
    state.counters["bytes_per_minute"] = static_cast<double>(size_bytes) * 60.0 / duration_s;
    std::filesystem::remove(file);
  }
}

}  // namespace

BENCHMARK(without)->Name("run/without")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recorded, off, std::nullopt)->Name("run/off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recorded, on, 0.5)->Name("run/on/0.5_s")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recorded, each_scan, 0.0)->Name("run/on/each_scan")->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
