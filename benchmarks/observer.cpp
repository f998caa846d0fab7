/// What it costs a run of an explorer to be recorded, and to have a recorder that is absent, beside the same run without any.
#include <benchmark/benchmark.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numeric>
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
constexpr std::size_t steps_per_scan = 5;

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

[[nodiscard]] double processor_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// What each scan of a run costs, at the best of several runs: they are the same, and whatever else the machine does befalls some.
class Costs {
 public:
  void add(std::size_t scan, double cost_s) {
    costs_s_.resize(std::max(costs_s_.size(), scan + 1), std::numeric_limits<double>::infinity());
    costs_s_[scan] = std::min(costs_s_[scan], cost_s);
  }

  [[nodiscard]] double sum_s() const { return std::accumulate(costs_s_.begin(), costs_s_.end(), 0.0); }

 private:
  std::vector<double> costs_s_;
};

/// From a scan to the next; observed(explorer, scan, truth) and decided(explorer) are called as RunRecorder's are. Returns what it has cost.
template <class Observed, class Decided>
double advance_s(OfficeExplorer& explorer, std::size_t scan, Observed&& observed, Decided&& decided) {
  const double begin_s = processor_s();
  explorer.observe(course().scans[scan]);
  observed(explorer, course().scans[scan], course().truths[scan]);
  if (explorer.decide()) decided(explorer);
  benchmark::DoNotOptimize(explorer.command(course().scans[scan]));
  for (std::size_t step = scan * steps_per_scan; step < (scan + 1) * steps_per_scan; ++step) explorer.move(course().increments[step], step_s);
  return processor_s() - begin_s;
}

/// Two robots on the course take turns, scan by scan. One has a pointer to a recorder, as a program holds it that records on request: null without
/// an interval. `ratio` is what its run costs by what the other's does.
void recorded(benchmark::State& state, std::optional<double> interval_s) {
  constexpr int runs = 7;
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("incognita-observer-" + std::to_string(getpid()));
  const std::size_t scans = course().increments.size() / steps_per_scan;
  Costs with_costs;
  Costs without_costs;
  for ([[maybe_unused]] auto _ : state) {
    for (int run = 0; run < runs; ++run) {
      OfficeExplorer with(params());
      OfficeExplorer without(params());
      std::optional<RunRecorder> recorder;
      if (interval_s) {
        RecordingSetup setup;
        setup.metric_names = {"time_s", "x_m", "y_m"};
        recorder.emplace(file, with, course().scans.front(), std::move(setup), RunRecorder::Params{*interval_s, true});
      }
      RunRecorder* volatile at_run_time = recorder ? &*recorder : nullptr;  // the compiler must not know
      RunRecorder* const observer = at_run_time;
      const auto observed = [&](const OfficeExplorer& explorer, const Scan<2>& scan, const Pose2& truth) {
        if (observer == nullptr) return;
        const auto metrics = [&] { return std::array{explorer.time_s(), explorer.belief().pose.x_m, explorer.belief().pose.y_m}; };
        observer->observed(explorer, scan, truth, metrics);
      };
      const auto decided = [&](const OfficeExplorer& explorer) {
        if (observer != nullptr) observer->decided(explorer);
      };
      for (std::size_t scan = 0; scan < scans; ++scan) {
        const bool is_first = (scan + static_cast<std::size_t>(run)) % 2 == 0;
        if (is_first) with_costs.add(scan, advance_s(with, scan, observed, decided));
        without_costs.add(scan, advance_s(without, scan, [](const auto&, const auto&, const auto&) {}, [](const auto&) {}));
        if (!is_first) with_costs.add(scan, advance_s(with, scan, observed, decided));
      }
      if (recorder) state.counters["bytes_per_minute"] = static_cast<double>(recorder->size_bytes()) * 60.0 / duration_s;
    }
  }
  state.counters["ratio"] = with_costs.sum_s() / without_costs.sum_s();
  std::filesystem::remove(file);
}

}  // namespace

BENCHMARK_CAPTURE(recorded, off, std::nullopt)->Name("run/off")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recorded, on, 0.5)->Name("run/0.5_s")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(recorded, each_scan, 0.0)->Name("run/each_scan")->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
