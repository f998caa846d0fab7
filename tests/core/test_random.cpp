#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "incognita/core/random.hpp"

using namespace incognita;

TEST_CASE("The sequence of uniform draws is pinned by the standard", "[core]") {
  // [rand.predef]: the 10000th invocation of a default-constructed mt19937_64 (seed 5489) gives this value.
  Random random(5489);
  double draw = 0.0;
  for (int i = 0; i < 10000; ++i) draw = random.uniform();
  REQUIRE(draw == std::ldexp(static_cast<double>(9981545732273789042ULL >> 11U), -53));
}

TEST_CASE("Normal draws are Box and Muller's of two uniform draws", "[core]") {
  Random normal(7);
  Random uniform(7);
  for (int i = 0; i < 100; ++i) {
    const double u = uniform.uniform();
    const double v = uniform.uniform();
    const double expected = std::sqrt(-2.0 * std::log(1.0 - u)) * std::cos(2.0 * std::numbers::pi * v);
    REQUIRE(normal.normal() == Approx(expected).epsilon(1e-12).margin(1e-12));
  }
}

TEST_CASE("Equal seeds give equal streams and others do not", "[core]") {
  Random a(11);
  Random b(11);
  Random c(12);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const double draw = a.uniform();
    REQUIRE(draw == b.uniform());
    equal += draw == c.uniform() ? 1 : 0;
  }
  REQUIRE(equal == 0);
}

// Over n draws a sample moment of unit variance errs by 1 / sqrt(n); the bounds are five of those.

TEST_CASE("Uniform draws are uniform and independent of the draw before", "[core]") {
  constexpr int n = 200000;
  Random random(3);
  std::array<int, 20> bins{};
  double lag = 0.0;
  double before = 0.5;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform();
    REQUIRE((u >= 0.0 && u < 1.0));
    ++bins[static_cast<std::size_t>(u * 20.0)];
    lag += 12.0 * (u - 0.5) * (before - 0.5);
    before = u;
  }
  double chi_squared = 0.0;
  for (const int count : bins) chi_squared += std::pow(count - n / 20.0, 2) / (n / 20.0);
  REQUIRE(chi_squared < 19.0 + 5.0 * std::sqrt(2.0 * 19.0));
  REQUIRE(std::abs(lag / n) < 5.0 / std::sqrt(n));
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(-2.0, 5.0);
    REQUIRE((u >= -2.0 && u < 5.0));
  }
}

TEST_CASE("Normal draws have the moments of a normal", "[core]") {
  constexpr int n = 200000;
  Random random(5);
  std::array<double, 4> moment{};
  int within_one_sigma = 0;
  for (int i = 0; i < n; ++i) {
    const double z = (random.normal(3.0, 2.0) - 3.0) / 2.0;
    for (std::size_t power = 0; power < 4; ++power) moment[power] += std::pow(z, power + 1) / n;
    within_one_sigma += std::abs(z) < 1.0 ? 1 : 0;
  }
  const double error = 5.0 / std::sqrt(n);
  REQUIRE(moment[0] == Approx(0.0).margin(error));
  REQUIRE(moment[1] == Approx(1.0).margin(error * std::sqrt(2.0)));
  REQUIRE(moment[2] == Approx(0.0).margin(error * std::sqrt(15.0)));
  REQUIRE(moment[3] == Approx(3.0).margin(error * std::sqrt(96.0)));
  REQUIRE(within_one_sigma / static_cast<double>(n) == Approx(std::erf(std::sqrt(0.5))).margin(error * 0.47));
}

TEST_CASE("Drawn indices cover their range evenly", "[core]") {
  Random random(9);
  std::array<int, 7> count{};
  for (int i = 0; i < 70000; ++i) ++count.at(random.index(7));
  for (const int c : count) REQUIRE(std::abs(c - 10000) < 5.0 * std::sqrt(10000.0));
  REQUIRE(random.index(1) == 0);
}
