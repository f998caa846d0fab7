#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/core/random.hpp"
#include "incognita/sensor/dvl.hpp"

using namespace incognita;

namespace {

/// The normal density in its textbook form.
double normal_density(double residual_m, double variance_m2) {
  const double sigma_m = std::sqrt(variance_m2);
  const double standard = residual_m / sigma_m;
  return std::exp(-0.5 * standard * standard) / (sigma_m * std::sqrt(2.0 * std::numbers::pi));
}

/// Composite Simpson rule with an even number of steps.
template <class Function>
double integral(double from, double to, int steps, Function&& function) {
  const double step = (to - from) / steps;
  double sum = function(from) + function(to);
  for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * function(from + i * step);
  return sum * step / 3.0;
}

}  // namespace

TEST_CASE("The log density is that of a normal distribution", "[sensor]") {
  Random random(1);
  for (int draw = 0; draw < 200; ++draw) {
    const double variance_m2 = std::pow(10.0, random.uniform(-3.0, 2.0));
    const double residual_m = std::sqrt(variance_m2) * random.uniform(-5.0, 5.0);
    REQUIRE(std::exp(log_normal_density(residual_m, variance_m2)) ==
            Approx(normal_density(residual_m, variance_m2)).epsilon(1e-12));
  }
  for (const double variance_m2 : {0.39 * 0.39, 9.0}) {
    const double reach_m = 12.0 * std::sqrt(variance_m2);
    const auto density = [&](double residual_m) {
      return std::exp(log_normal_density(residual_m, variance_m2));
    };
    REQUIRE(integral(-reach_m, reach_m, 2000, density) == Approx(1.0).epsilon(1e-12));
    REQUIRE(integral(-reach_m, reach_m, 2000, [&](double r) { return r * r * density(r); }) ==
            Approx(variance_m2).epsilon(1e-12));
  }
}

TEST_CASE("The log density does not underflow", "[sensor]") {
  REQUIRE(normal_density(100.0, 0.01) == 0.0);
  REQUIRE(log_normal_density(100.0, 0.01) == Approx(-5e5).epsilon(1e-4));
}

TEST_CASE("R_x of (10) is half of the mixture's variance at p = 1/2", "[sensor]") {
  const DvlVariances paper;
  REQUIRE(paper.occupied_m2 == 0.39 * 0.39);
  REQUIRE(paper.unoccupied_m2 == 9.0);
  REQUIRE(measurement_variance_m2(paper, 0.5) == Approx(2.29).margin(0.005));
  REQUIRE(measurement_variance_m2(paper, 0.5, MixtureVariance::moment_match) == Approx(4.58).margin(0.005));
  for (const MixtureVariance rule : {MixtureVariance::squared_weights, MixtureVariance::moment_match}) {
    REQUIRE(measurement_variance_m2(paper, 1.0, rule) == paper.occupied_m2);
    REQUIRE(measurement_variance_m2(paper, 0.0, rule) == paper.unoccupied_m2);
  }
}

TEST_CASE("R_x of (10) dips below R_o near p = 0.983", "[sensor]") {
  const DvlVariances paper;
  double lowest_m2 = std::numeric_limits<double>::infinity();
  double lowest_at = 0.0;
  for (int step = 0; step <= 100000; ++step) {
    const double p = step * 1e-5;
    const double variance_m2 = measurement_variance_m2(paper, p);
    if (variance_m2 < lowest_m2) {
      lowest_m2 = variance_m2;
      lowest_at = p;
    }
  }
  REQUIRE(lowest_at == Approx(0.983).margin(0.0005));
  REQUIRE(lowest_m2 < paper.occupied_m2);
  // Two resistors in parallel: the minimum of p^2 a + (1 - p)^2 b is a b / (a + b).
  REQUIRE(1.0 / lowest_m2 == Approx(1.0 / paper.occupied_m2 + 1.0 / paper.unoccupied_m2).epsilon(1e-6));
}

TEST_CASE("The moment match is the variance of the mixture", "[sensor]") {
  Random random(2);
  for (int draw = 0; draw < 20; ++draw) {
    DvlVariances dvl;
    dvl.occupied_m2 = random.uniform(0.1, 1.0);
    dvl.unoccupied_m2 = dvl.occupied_m2 + random.uniform(0.5, 10.0);
    const double p = random.uniform();
    const double reach_m = 12.0 * std::sqrt(dvl.unoccupied_m2);
    const double variance_m2 = integral(-reach_m, reach_m, 4000, [&](double r) {
      return r * r *
             (p * normal_density(r, dvl.occupied_m2) + (1.0 - p) * normal_density(r, dvl.unoccupied_m2));
    });
    REQUIRE(measurement_variance_m2(dvl, p, MixtureVariance::moment_match) ==
            Approx(variance_m2).epsilon(1e-9));
  }
}

TEST_CASE("The decoupled variance does not look at the probability", "[sensor]") {
  const DvlVariances dvl{0.01, 9.0};
  for (const double p : {0.0, 0.3, 1.0}) {
    REQUIRE(measurement_variance_m2(dvl, p, MixtureVariance::occupied_only) == 0.01);
  }
}

TEST_CASE("Variances that are none are refused", "[sensor]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  REQUIRE_NOTHROW(DvlVariances{}.validate());
  REQUIRE_NOTHROW((DvlVariances{1.0, std::nextafter(1.0, 2.0)}.validate()));
  for (const double occupied_m2 : {0.0, -1.0, 9.0, 10.0, kNan, kInfinity}) {
    REQUIRE_THROWS_AS((DvlVariances{occupied_m2, 9.0}.validate()), std::invalid_argument);
  }
  for (const double unoccupied_m2 : {0.1, 0.0, -1.0, kNan, kInfinity}) {
    REQUIRE_THROWS_AS((DvlVariances{0.1, unoccupied_m2}.validate()), std::invalid_argument);
  }
}
