#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/core/fast_log.hpp"
#include "incognita/core/random.hpp"

using namespace incognita;

TEST_CASE("The fast logarithm agrees with the library's to its stated error", "[core]") {
  Random random(1);
  for (int draw = 0; draw < 200000; ++draw) {
    const double x = std::exp(random.uniform(-700.0, 700.0));
    REQUIRE(fast_log(x) == Approx(std::log(x)).epsilon(1e-10));
  }
  // Near 1, where the logarithm vanishes, and around the ends of the mantissa's interval.
  for (const double center : {1.0, std::sqrt(0.5), std::sqrt(2.0), 2.0, 0.5}) {
    for (int draw = 0; draw < 20000; ++draw) {
      const double x = center * (1.0 + random.uniform(-1e-3, 1e-3));
      REQUIRE(std::abs(fast_log(x) - std::log(x)) <= 1e-10 * std::abs(std::log(x)) + 1e-16);
    }
  }
  REQUIRE(fast_log(1.0) == 0.0);
  REQUIRE(fast_log(std::numeric_limits<double>::max()) == Approx(std::log(std::numeric_limits<double>::max())).epsilon(1e-10));
  REQUIRE(fast_log(std::numeric_limits<double>::min()) == Approx(std::log(std::numeric_limits<double>::min())).epsilon(1e-10));
}
