#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/core/angles.hpp"
#include "incognita/core/random.hpp"

using namespace incognita;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE("Wrapped angles lie in (-pi, pi] and point the same way", "[core]") {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double angle_rad = random.uniform(-100.0, 100.0);
    const double wrapped_rad = wrap_angle_rad(angle_rad);
    REQUIRE(wrapped_rad > -pi);
    REQUIRE(wrapped_rad <= pi);
    REQUIRE(std::cos(wrapped_rad) == Approx(std::cos(angle_rad)).margin(1e-12));
    REQUIRE(std::sin(wrapped_rad) == Approx(std::sin(angle_rad)).margin(1e-12));
  }
}

TEST_CASE("Half a turn wraps to plus pi from both sides", "[core]") {
  for (const double turns : {-3.0, -1.0, 1.0, 3.0, 5.0}) REQUIRE(wrap_angle_rad(turns * pi) == pi);
  REQUIRE(wrap_angle_rad(std::nextafter(pi, 4.0)) < 0.0);
  REQUIRE(wrap_angle_rad(std::nextafter(-pi, 0.0)) == std::nextafter(-pi, 0.0));
}

TEST_CASE("Angles in range stay as they are to the last bit", "[core]") {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const double angle_rad = random.uniform(-3.14, 3.14);
    REQUIRE(wrap_angle_rad(angle_rad) == angle_rad);
  }
}

TEST_CASE("An angle that is not finite wraps to one that is not finite", "[core]") {
  REQUIRE_FALSE(std::isfinite(wrap_angle_rad(std::numeric_limits<double>::infinity())));
  REQUIRE_FALSE(std::isfinite(wrap_angle_rad(std::numeric_limits<double>::quiet_NaN())));
}

TEST_CASE("The angle between two directions is the shortest turn", "[core]") {
  REQUIRE(angle_between_rad(3.0, -3.0) == Approx(2.0 * pi - 6.0));
  REQUIRE(angle_between_rad(-3.0, 3.0) == Approx(6.0 - 2.0 * pi));
  REQUIRE(angle_between_rad(0.5, 0.75) == Approx(0.25));
}
