/// Reference values and what the tests of every entropy family ask alike.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/testing/entropy_laws.hpp"

namespace reference {

/// The probabilities of the columns of a reference table, as the doubles they are.
inline constexpr std::array<double, 6> kProbabilities = {1e-300, 1e-12, 0.01, 0.3, 0.5, 1 - 1e-6};

/// One row: the parameter and the entropies at kProbabilities. They were computed from the printed formulas
/// with 60 to 900 decimal digits on the exact values of the doubles; 0 stands for anything below 1e-300.
struct Row {
  double parameter;
  std::array<double, 6> entropy_nats;
};

inline void require_close(double value, double expected) {
  if (std::abs(expected) < 1e-290) {
    REQUIRE(std::abs(value) < 1e-290);
  } else {
    REQUIRE(std::abs(value - expected) <= 1e-12 * std::abs(expected));
  }
}

template <class Measure, std::size_t kRows>
void require_rows(const std::array<Row, kRows>& rows) {
  for (const Row& row : rows) {
    const Measure measure(row.parameter);
    for (std::size_t i = 0; i < kProbabilities.size(); ++i) {
      CAPTURE(row.parameter, kProbabilities[i]);
      require_close(measure(kProbabilities[i]), row.entropy_nats[i]);
    }
  }
}

/// Parameters for properties: next to 1 on both sides, small, large.
inline constexpr std::array<double, 15> kParameters = {
    0.05, 0.2, 0.5, 0.9, 1 - 1e-6, 1 - 1e-15, 1, 1 + 1e-15, 1 + 1e-6, 1.5, 1.999999, 2.000001, 3, 10, 50};

template <class Measure>
void require_laws() {
  for (const double parameter : kParameters) {
    CAPTURE(parameter);
    const incognita::LawReport report = incognita::check_entropy_laws(Measure(parameter));
    INFO(report.text());
    REQUIRE(report.holds());
  }
}

/// p outside [0, 1] gives NaN; a parameter that is not finite and > 0 throws; the parameter 1, which is the
/// default, gives Shannon's bits.
template <class Measure>
void require_edges() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double parameter : kParameters) {
    for (const double p : {-1e-300, -1.0, 1.0 + 1e-15, 2.0, kInfinity, -kInfinity, kNan}) {
      REQUIRE(std::isnan(Measure(parameter)(p)));
    }
  }
  for (const double parameter : {0.0, -0.0, -1.0, kNan, kInfinity, -kInfinity}) {
    REQUIRE_THROWS_AS(Measure(parameter), std::invalid_argument);
  }
  incognita::Random random(17);
  for (int draw = 0; draw < 1000; ++draw) {
    const double p = random.uniform();
    REQUIRE(Measure{}(p) == incognita::Shannon{}(p));
    REQUIRE(Measure{1.0}(p) == incognita::Shannon{}(p));
  }
  REQUIRE(Measure{} == Measure{1.0});
  REQUIRE_FALSE(Measure{} == Measure{2.0});
}

/// At a fixed p the entropy falls, or stays, as the parameter grows.
template <class Measure>
void require_non_increasing_in_parameter() {
  incognita::Random random(18);
  for (int draw = 0; draw < 2000; ++draw) {
    const double p = 1.0 / (1.0 + std::exp(random.uniform(-40.0, 40.0)));
    const double smaller = std::exp(random.uniform(-3.0, 4.0));
    const double larger = smaller * std::exp(random.uniform(0.0, 1.0));
    CAPTURE(p, smaller, larger);
    REQUIRE(Measure(larger)(p) <= Measure(smaller)(p) * (1.0 + 1e-12));
  }
}

}  // namespace reference
