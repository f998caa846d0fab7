/// What a cell of a map's entropy costs: by a table and by the measure itself, over floats and over the cells of maps,
/// of a map that stays in the cache and of one of 4000 x 4000 cells. `read` only adds the log-odds up: what memory
/// allows.
///
/// Log-odds are those of a map half explored: 40 % unknown, 30 % saturated, the others anywhere between. The counter
/// `error` is the sum's relative difference from the measure's own values, added in doubles.
#include <benchmark/benchmark.h>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"

namespace {

using incognita::entropy_sum;
using incognita::EntropyTable;

struct FloatCell {
  using State = float;
  static float log_odds(float state) { return state; }
  static void set(float& state, float log_odds) { state = log_odds; }
};

template <class Policy>
struct CellOf {
  using State = typename Policy::State;
  static float log_odds(const State& state) { return Policy::log_odds(state); }
  static void set(State& state, float log_odds) { state.log_odds = log_odds; }
};

template <class Cell>
std::vector<typename Cell::State> half_explored(std::size_t side) {
  incognita::Random random(1);
  std::vector<typename Cell::State> cells(side * side);
  for (auto& cell : cells) {
    const double kind = random.uniform();
    if (kind < 0.4) continue;
    Cell::set(cell, kind < 0.65 ? -20.0F : kind < 0.7 ? 6.0F : static_cast<float>(random.uniform(-20.0, 6.0)));
  }
  return cells;
}

template <class Cell, class Entropy>
double sum_of(const std::vector<typename Cell::State>& cells, const Entropy& entropy) {
  if constexpr (std::same_as<Cell, FloatCell>) {
    return entropy_sum(cells, entropy);
  } else {
    return entropy_sum(cells, entropy, [](const typename Cell::State& state) { return Cell::log_odds(state); });
  }
}

void set_cell_time(benchmark::State& state, std::size_t cells) {
  state.counters["cell"] = benchmark::Counter(
      static_cast<double>(cells), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Cell, class Entropy, class Measure>
void run_sum(benchmark::State& state, std::size_t side, const Entropy& entropy, const Measure& measure) {
  const auto cells = half_explored<Cell>(side);
  double sum_nats = 0.0;
  for (auto _ : state) benchmark::DoNotOptimize(sum_nats = sum_of<Cell>(cells, entropy));
  set_cell_time(state, cells.size());
  state.counters["error"] = std::abs(sum_nats / sum_of<Cell>(cells, measure) - 1.0);
}

/// The bytes of all cells, added up as floats.
template <class Cell>
void run_read(benchmark::State& state, std::size_t side) {
  using Floats [[gnu::vector_size(32)]] = float;
  const auto cells = half_explored<Cell>(side);
  const std::size_t vectors = cells.size() * sizeof(typename Cell::State) / sizeof(Floats);
  const auto* const bytes = reinterpret_cast<const std::byte*>(cells.data());
  for (auto _ : state) {
    Floats sums[4] = {};
    for (std::size_t i = 0; i + 4 <= vectors; i += 4) {
      for (std::size_t k = 0; k < 4; ++k) {
        Floats loaded;
        __builtin_memcpy(&loaded, bytes + (i + k) * sizeof(Floats), sizeof(Floats));
        sums[k] += loaded;
      }
    }
    benchmark::DoNotOptimize(sums);
  }
  set_cell_time(state, cells.size());
}

template <class Cell, class Measure>
void register_measure(const std::string& cells, const std::string& name, const Measure& measure) {
  for (const std::size_t side : {std::size_t{128}, std::size_t{4000}}) {
    const std::string where = "/" + name + "/" + cells + "/" + std::to_string(side);
    benchmark::RegisterBenchmark(("table" + where).c_str(), [=](benchmark::State& state) {
      run_sum<Cell>(state, side, EntropyTable(measure), measure);
    });
    // The measure needs no larger map to be slow.
    if (side == 128 && std::same_as<Cell, FloatCell>) {
      benchmark::RegisterBenchmark(("measure" + where).c_str(), [=](benchmark::State& state) {
        run_sum<Cell>(state, side, measure, measure);
      });
    }
  }
}

template <class Cell>
void register_cells(const std::string& cells) {
  for (const std::size_t side : {std::size_t{128}, std::size_t{4000}}) {
    benchmark::RegisterBenchmark(("read/" + cells + "/" + std::to_string(side)).c_str(),
                                 [=](benchmark::State& state) { run_read<Cell>(state, side); });
  }
  register_measure<Cell>(cells, "Shannon", incognita::Shannon{});
  for (const double alpha : {0.2, 0.5, 2.0, 3.0}) {
    const std::string parameter = std::to_string(alpha).substr(0, 3);
    register_measure<Cell>(cells, "Behavioral" + parameter, incognita::Behavioral(alpha));
    register_measure<Cell>(cells, "Renyi" + parameter, incognita::Renyi(alpha));
    register_measure<Cell>(cells, "Tsallis" + parameter, incognita::Tsallis(alpha));
  }
}

}  // namespace

int main(int argc, char** argv) {
  register_cells<FloatCell>("floats");
  register_cells<CellOf<incognita::TBayes>>("TBayes");
  register_cells<CellOf<incognita::LogOdds>>("LogOdds");
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
