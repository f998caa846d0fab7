#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/grid/grid.hpp"
#include "incognita/metrics/map_error.hpp"

namespace {

using namespace incognita;

double log_odds_of(double p) { return std::log(p / (1.0 - p)); }

/// What map_error asks of a map.
struct Belief {
  static constexpr int dimension = 2;
  Grid<float, 2> cells;
  const Grid<float, 2>& grid() const { return cells; }
  float log_odds(Offset offset) const { return cells[offset]; }
};

}  // namespace

TEST_CASE("Map error worked out by hand", "[metrics]") {
  MapError error;
  CHECK(error.value() == 0.0);
  error.add(log_odds_of(0.9), true);
  error.add(log_odds_of(0.6), true);
  error.add(log_odds_of(0.2), false);
  error.add(0.0, true);  // never touched
  error.add(0.0, false);
  CHECK(error.occupied_count() == 2);
  CHECK(error.free_count() == 1);
  CHECK(error.value() == Approx(std::sqrt((0.01 + 0.16) / 2.0 + 0.04)));
}

TEST_CASE("The ends of map error's range, and a class without cells", "[metrics]") {
  MapError best;
  best.add(800.0, true);
  best.add(-800.0, false);
  CHECK(best.value() == 0.0);
  MapError worst;
  worst.add(-800.0, true);
  CHECK(worst.value() == 1.0);
  worst.add(std::numeric_limits<double>::infinity(), false);
  CHECK(worst.value() == Approx(std::sqrt(2.0)));
  MapError free_only;
  free_only.add(log_odds_of(0.25), false);
  CHECK(free_only.value() == Approx(0.25));
}

TEST_CASE("The error of a map takes the truth cell by cell, nothing true outside of its box", "[metrics]") {
  const Lattice<2> lattice(0.1);
  Belief belief{Grid<float, 2>(lattice, {{-1, -1}, {2, 2}}, 0.0F)};
  Grid<std::uint8_t, 2> truth(lattice, {{0, 0}, {5, 5}}, 0);
  truth.set({0, 0}, 1);
  truth.set({4, 4}, 1);  // outside of the belief
  belief.cells.set({0, 0}, 2.0F);
  belief.cells.set({1, 0}, -1.0F);
  belief.cells.set({-1, -1}, 1.0F);  // outside of the truth's box: free
  const MapError error = map_error(belief, truth);
  const auto p = [](double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); };
  CHECK(error.occupied_count() == 1);
  CHECK(error.free_count() == 2);
  CHECK(error.value() ==
        Approx(std::sqrt(std::pow(1.0 - p(2.0), 2) + 0.5 * (std::pow(p(-1.0), 2) + std::pow(p(1.0), 2)))));
}

TEST_CASE("Map uncertainty is the mean loss of entropy a step, in bits", "[metrics]") {
  CHECK(map_uncertainty_bits_per_step(100.0 * std::log(2.0), 20.0 * std::log(2.0), 40) == Approx(2.0));
  CHECK(map_uncertainty_bits_per_step(1.0, 3.0, 1) == Approx(-2.0 / std::log(2.0)));
  CHECK(map_uncertainty_bits_per_step(5.0, 5.0, 0) == 0.0);
}
