/// What is compared with what: section V of Isleyen et al.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/parallel.hpp"
#include "office_exploration/trial.hpp"

namespace office_exploration {

/// The trials of one choice from all starts of an arena.
struct Series {
  std::string experiment;
  std::shared_ptr<const Arena> arena;
  Choice choice;
  std::vector<Trial> trials;  ///< one for each start
};

/// V-A: any information over any cost, with persistent planning, in the small office.
[[nodiscard]] inline std::vector<Series> utility_experiment(std::size_t start_count) {
  using namespace incognita;
  const auto arena = std::make_shared<const Arena>(small_office_arena(start_count));
  std::vector<Series> all;
  for (const NavigationCost navigation : {NavigationCost::uniform, NavigationCost::euclidean, NavigationCost::geodesic}) {
    for (const FrontierInformation information : {FrontierInformation::uniform, FrontierInformation::size,
                                                  FrontierInformation::entropy, FrontierInformation::big}) {
      all.push_back({"utility", arena, {Strategy::persistent, information, navigation}, {}});
    }
  }
  return all;
}

/// V-B: any strategy by the straight line and by the way, in both offices. The paper takes the frontier's size; the
/// information gain of the path is the library's own default.
[[nodiscard]] inline std::vector<Series> strategy_experiment(std::size_t start_count) {
  using namespace incognita;
  std::vector<Series> all;
  for (const auto& arena : {std::make_shared<const Arena>(small_office_arena(start_count)),
                            std::make_shared<const Arena>(large_office_arena(start_count))}) {
    for (const auto& [information, navigation] : {std::pair(FrontierInformation::size, NavigationCost::euclidean),
                                                  std::pair(FrontierInformation::size, NavigationCost::geodesic),
                                                  std::pair(FrontierInformation::big, NavigationCost::geodesic)}) {
      for (const Strategy strategy : {Strategy::persistent, Strategy::last_mile, Strategy::online}) {
        all.push_back({"strategy", arena, {strategy, information, navigation}, {}});
      }
    }
  }
  return all;
}

/// V-C: costs with persistent planning, then strategies by the way, for a TurtleBot3 in a cluttered room.
[[nodiscard]] inline std::vector<Series> turtlebot_experiment(std::size_t start_count) {
  using namespace incognita;
  const auto arena = std::make_shared<const Arena>(room_arena(start_count));
  std::vector<Series> all;
  for (const auto& [strategy, navigation] : {std::pair(Strategy::persistent, NavigationCost::uniform),
                                             std::pair(Strategy::persistent, NavigationCost::euclidean),
                                             std::pair(Strategy::persistent, NavigationCost::geodesic),
                                             std::pair(Strategy::last_mile, NavigationCost::geodesic),
                                             std::pair(Strategy::online, NavigationCost::geodesic)}) {
    all.push_back({"turtlebot", arena, {strategy, FrontierInformation::size, navigation}, {}});
  }
  return all;
}

/// Runs all trials side by side; none depends on another or on the number of threads (0: OpenMP's own number).
/// report(done, all) is called as trials end, by any thread.
inline void run_trials(std::vector<Series>& all, int threads, const std::function<void(std::size_t, std::size_t)>& report) {
  std::vector<std::pair<Series*, std::size_t>> trials;
  for (Series& series : all) {
    series.trials.resize(series.arena->starts.size());
    for (std::size_t start = 0; start < series.trials.size(); ++start) trials.emplace_back(&series, start);
  }
  std::atomic<std::size_t> done = 0;
  incognita::for_each_index(trials.size(), threads, [&](std::size_t index, int) {
    const auto [series, start] = trials[index];
    const Arena& arena = *series->arena;
    series->trials[start] = run_trial(arena, arena.starts[start], explorer_params(arena.robot, series->choice));
    if (report) report(++done, trials.size());
  });
}

}  // namespace office_exploration
