#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/log_odds_table.hpp"
#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"

using incognita::Behavioral;
using incognita::entropy_of_log_odds;
using incognita::EntropyTable;
using incognita::Renyi;
using incognita::Shannon;
using incognita::Tsallis;

namespace {

/// The largest difference between the table and the measure: near 0, where the curvature is greatest, and
/// everywhere.
template <class Measure>
double measured_error_nats(const EntropyTable& table, const Measure& measure) {
  incognita::Random random(20);
  double largest_nats = 0.0;
  for (int draw = 0; draw < 20000; ++draw) {
    const double range = draw % 2 == 0 ? 0.5 : table.log_odds_max();
    const auto log_odds = static_cast<float>(random.uniform(-range, range));
    largest_nats = std::max(largest_nats, std::abs(table(log_odds) - entropy_of_log_odds(measure, log_odds)));
  }
  return largest_nats;
}

template <class Measure>
void require_bounded(const Measure& measure, double allowed_nats) {
  const EntropyTable table(measure);
  const double error_nats = measured_error_nats(table, measure);
  CAPTURE(error_nats, table.max_error_nats());
  REQUIRE(error_nats <= table.max_error_nats());
  // The bound is not idle either.
  REQUIRE(error_nats >= 0.2 * table.max_error_nats());
  REQUIRE(table.max_error_nats() <= allowed_nats);
  REQUIRE(table(0.0F) == measure(0.5));
}

}  // namespace

TEST_CASE("Entropy of log-odds is exact where 1/(1+e^-l) is not", "[entropy]") {
  // Computed with 400 decimal digits.
  struct Row {
    double log_odds, shannon_nats, behavioral_half_nats;
  };
  for (const Row& row :
       {Row{0.5, 0.6628473185791794, 0.68442076652930195}, Row{5, 0.040179603110542346, 0.35288901640219578},
        Row{30, 2.9008631203401871e-12, 0.047703913542674409},
        Row{200, 2.7816320187408424e-85, 9.0677799237015161e-5},
        Row{700, 6.9116332571755994e-302, 5.9788306427095806e-9}}) {
    for (const double sign : {-1.0, 1.0}) {
      REQUIRE(entropy_of_log_odds(Shannon{}, sign * row.log_odds) == Approx(row.shannon_nats).epsilon(1e-13));
      REQUIRE(entropy_of_log_odds(Behavioral{0.5}, sign * row.log_odds) ==
              Approx(row.behavioral_half_nats).epsilon(1e-13));
    }
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  REQUIRE(entropy_of_log_odds(Shannon{}, 0.0) == std::numbers::ln2);
  REQUIRE(entropy_of_log_odds(Shannon{}, kInfinity) == 0.0);
  REQUIRE(entropy_of_log_odds(Behavioral{0.2}, -kInfinity) == 0.0);
  REQUIRE(std::isnan(entropy_of_log_odds(Shannon{}, std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("A table is within its bound for every entropy", "[entropy]") {
  require_bounded(Shannon{}, 2e-6);
  for (const double alpha : {0.05, 0.2, 0.5, 1.0 + 1e-9, 2.0, 3.0}) {
    CAPTURE(alpha);
    require_bounded(Behavioral(alpha), 1.5e-5);
    require_bounded(Renyi(alpha), 6e-6);
    require_bounded(Tsallis(alpha), 2e-6);
  }
  // Large alpha bends the curve within a few hundredths of 0; the bound says how much the table pays.
  for (const double alpha : {10.0, 50.0}) {
    CAPTURE(alpha);
    require_bounded(Behavioral(alpha), 5e-3);
    require_bounded(Renyi(alpha), 1e-4);
    require_bounded(Tsallis(alpha), 1e-6);
  }
  require_bounded([](double p) { return 2.0 * p * (1.0 - p); }, 2e-6);
}

TEST_CASE("Twice the intervals take a quarter of the error", "[entropy]") {
  const double coarse_nats =
      EntropyTable(Shannon{}, {.log_odds_max = 22.0, .intervals = 2048}).max_error_nats();
  const double fine_nats =
      EntropyTable(Shannon{}, {.log_odds_max = 22.0, .intervals = 4096}).max_error_nats();
  REQUIRE(coarse_nats / fine_nats == Approx(4.0).epsilon(0.01));
}

TEST_CASE("A table is symmetric to the bit, exact at 0 and constant beyond its ends", "[entropy]") {
  const EntropyTable table(Behavioral{0.2}, {.log_odds_max = 7.3, .intervals = 100});
  incognita::Random random(21);
  for (int draw = 0; draw < 1000; ++draw) {
    const auto log_odds = static_cast<float>(random.uniform(-10.0, 10.0));
    REQUIRE(table(log_odds) == table(-log_odds));
  }
  REQUIRE(table(0.0F) == std::numbers::ln2);
  REQUIRE(table(-0.0F) == std::numbers::ln2);
  REQUIRE(table.end_nats() == Approx(entropy_of_log_odds(Behavioral{0.2}, 7.3)).epsilon(1e-14));
  for (const float log_odds :
       {7.3F, 7.4F, 1e30F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    REQUIRE(table(log_odds) == Approx(table.end_nats()).epsilon(1e-7));
    REQUIRE(table(-log_odds) == table(log_odds));
  }
  REQUIRE(entropy_of_log_odds(table, 1.5F) == table(1.5F));
}

TEST_CASE("A table refuses bad parameters and bad measures", "[entropy]") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double log_odds_max : {0.0, -1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    REQUIRE_THROWS_AS(EntropyTable(Shannon{}, {.log_odds_max = log_odds_max}), std::invalid_argument);
  }
  REQUIRE_THROWS_AS(EntropyTable(Shannon{}, {.intervals = 0}), std::invalid_argument);
  REQUIRE_THROWS_AS(EntropyTable(Shannon{}, {.intervals = 1'000'001}), std::invalid_argument);
  REQUIRE_THROWS_AS(EntropyTable([](double p) { return p - 1.0; }), std::invalid_argument);
  REQUIRE_THROWS_AS(EntropyTable([](double p) { return 1.0 / (p - 0.5); }), std::invalid_argument);
}
