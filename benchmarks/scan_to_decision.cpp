/// What an explorer's loop costs from a scan to the command that follows from it, over a whole mission.
///
/// A robot explores the embedded floor, as kth_explorer does by default, on one thread, until it finds
/// nothing more to do. A tick is a scan and the five increments of odometry before it: ten a second. One
/// iteration is one mission; its time is that of the explorer and the simulator together, the counters are
/// the explorer's parts alone, a tick each: their medians and means. `choose` is decide() where it decided
/// anew, once in many ticks.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

#include "accuracy/drive.hpp"
#include "incognita/io/kth_xml.hpp"
#include "kth_explorer/embedded_floor_plan.hpp"

namespace {

/// Durations of one part of the loop, a tick each.
class Part {
 public:
  /// Runs the part and returns what it returns.
  template <class Run>
  decltype(auto) time(const Run& run) {
    struct Stop {
      Part& part;
      std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
      ~Stop() {
        part.tick_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      }
    } stop{*this};
    return run();
  }

  /// Ends the tick. Returns its duration.
  double end_tick() {
    ticks_s_.push_back(tick_s_);
    tick_s_ = 0.0;
    return ticks_s_.back();
  }

  void add(double tick_s) { ticks_s_.push_back(tick_s); }

  void report(benchmark::State& state, const std::string& name) {
    if (ticks_s_.empty()) return;
    const auto middle = ticks_s_.begin() + static_cast<std::ptrdiff_t>(ticks_s_.size() / 2);
    std::nth_element(ticks_s_.begin(), middle, ticks_s_.end());
    state.counters[name + "_median_s"] = *middle;
    state.counters[name + "_mean_s"] =
        std::accumulate(ticks_s_.begin(), ticks_s_.end(), 0.0) / static_cast<double>(ticks_s_.size());
  }

 private:
  double tick_s_ = 0.0;
  std::vector<double> ticks_s_;
};

void run_mission(benchmark::State& state) {
  const incognita::World world(
      incognita::read_kth_xml_text(examples::embedded_floor_plan_xml, "embedded floor plan"));
  const incognita::SimulatorParams params;
  for (auto _ : state) {
    const auto begin = std::chrono::steady_clock::now();
    incognita::Random random(1);
    incognita::Simulator simulator(world, random_start(world, params.robot.radius_m, random), params, 1);
    incognita::ExplorerParams explorer_params;
    explorer_params.threads = 1;
    accuracy::Explorer explorer(explorer_params);
    Part move;
    Part observe;
    Part decide;
    Part choose;
    Part command;
    Part tick;
    explorer.observe(simulator.scan());
    explorer.decide();
    incognita::Twist2 twist = explorer.command(simulator.scan());
    while (!explorer.stopped() && simulator.time_s() < 1800.0) {
      const incognita::Pose2 increment = simulator.step(twist);
      move.time([&] { explorer.move(increment, accuracy::step_s(params)); });
      if (!simulator.scan_is_new()) continue;
      observe.time([&] { return explorer.observe(simulator.scan()); });
      const bool has_chosen = decide.time([&] { return explorer.decide(); });
      twist = command.time([&] { return explorer.command(simulator.scan()); });
      const double decide_s = decide.end_tick();
      if (has_chosen) choose.add(decide_s);
      tick.add(move.end_tick() + observe.end_tick() + decide_s + command.end_tick());
    }
    const double mission_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    move.report(state, "move");
    observe.report(state, "observe");
    decide.report(state, "decide");
    choose.report(state, "choose");
    command.report(state, "command");
    tick.report(state, "tick");
    state.counters["ticks"] = static_cast<double>(simulator.steps()) / params.steps_per_scan;
    state.counters["times_real_time"] = simulator.time_s() / mission_s;
  }
}

}  // namespace

BENCHMARK(run_mission)->Name("mission")->Unit(benchmark::kMillisecond)->Iterations(1);

BENCHMARK_MAIN();
