/// The cost of telling what a drive to a frontier would show: the evaluation of candidates in a half-known
/// office.
///
/// An explorer with the defaults explores the embedded floor for a while; of its decisions the one with the
/// most candidates is kept, with the map and the estimator of that moment. Timed is what it spends on them:
/// `1` candidate at a time, in turn, or `40` at once, those of the decision again and again until they are so
/// many. `per_scan` is the time of a predicted scan of 60 beams. Time on the wall, so that threads count for
/// what they save; `control` is arithmetic that shares nothing, and says what a second thread could save at
/// all while this ran.
#include "incognita/exploration/candidate.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/drive.hpp"
#include "incognita/core/parallel.hpp"
#include "incognita/io/kth_xml.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"

namespace {

using accuracy::Explorer;
using incognita::Candidate;

constexpr double mission_s = 300.0;

/// The explorer at its decision between the most candidates.
Explorer widest_choice() {
  const incognita::World world(
      incognita::read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan"));
  const incognita::SimulatorParams params;
  incognita::Random random(1);
  incognita::Simulator simulator(world, random_start(world, params.robot.radius_m, random), params, 1);
  incognita::ExplorerParams explorer_params;
  explorer_params.threads = 1;
  Explorer explorer(explorer_params);
  std::optional<Explorer> widest;
  explorer.observe(simulator.scan());
  while (!explorer.stopped() && simulator.time_s() < mission_s) {
    explorer.move(simulator.step(explorer.command(simulator.scan())), accuracy::step_s(params));
    if (!simulator.scan_is_new()) continue;
    explorer.observe(simulator.scan());
    if (!explorer.decide()) continue;
    const std::size_t most = widest ? widest->decision().candidates.size() : 0;
    if (explorer.decision().candidates.size() > most) widest = explorer;
  }
  return widest.value();
}

const Explorer& chooser() {
  static const Explorer made = widest_choice();
  return made;
}

std::size_t predicted_scans(const Candidate& candidate) {
  return resample_path(candidate.path, chooser().params().gain.pose_spacing_m).size() - 1;
}

void time_evaluation(benchmark::State& state, std::size_t count, int threads) {
  const std::vector<Candidate>& decided = chooser().decision().candidates;
  incognita::CandidateScratch<incognita::TBayes> scratch;
  std::vector<Candidate> candidates(count);
  std::size_t next = 0;
  double scans = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    for (Candidate& candidate : candidates) {
      candidate = decided[next];
      next = (next + 1) % decided.size();
      scans += static_cast<double>(predicted_scans(candidate));
    }
    state.ResumeTiming();
    evaluate_candidates(chooser().map(), chooser().entropy(), chooser().filter(), candidates,
                        chooser().params().gain, threads, scratch);
    benchmark::DoNotOptimize(candidates);
  }
  state.counters["per_scan"] =
      benchmark::Counter(scans, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["predicted_scans"] = benchmark::Counter(scans, benchmark::Counter::kAvgIterations);
  state.counters["decided_between"] = static_cast<double>(decided.size());
}

/// Not inlined: the compiler would work on several numbers at once on one thread, and on one at a time on
/// two.
[[gnu::noinline]] double do_arithmetic(double x) {
  for (int n = 0; n < 50'000; ++n) x = x * 0.999 + 1.0;
  return x;
}

void time_control(benchmark::State& state, int threads) {
  std::vector<double> results(40);
  for (auto _ : state) {
    incognita::for_each_index(results.size(), threads, [&](std::size_t index, int) {
      results[index] = do_arithmetic(static_cast<double>(index));
    });
    benchmark::DoNotOptimize(results);
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const int threads : {1, 2}) {
    std::string name = "control/";
    name += std::to_string(threads) + "_threads";
    const auto time = [=](benchmark::State& state) { time_control(state, threads); };
    benchmark::RegisterBenchmark(name.c_str(), time)->Unit(benchmark::kMicrosecond)->UseRealTime();
  }
  for (const std::size_t count : {1U, 40U}) {
    for (const int threads : {1, 2}) {
      std::string name = "evaluate/";
      name += std::to_string(count) + "_candidates/" + std::to_string(threads) + "_threads";
      const auto time = [=](benchmark::State& state) { time_evaluation(state, count, threads); };
      benchmark::RegisterBenchmark(name.c_str(), time)->Unit(benchmark::kMicrosecond)->UseRealTime();
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
