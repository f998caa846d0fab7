#include <catch2/catch.hpp>
#include <array>
#include <limits>

#include "incognita/core/error.hpp"

using namespace incognita;

TEST_CASE("A refusal names where, the field, its value and the bound", "[core]") {
  REQUIRE_THROWS_WITH(require_positive("Scan", "range_max_m", -1.5),
                      "Scan: range_max_m is -1.5, but must be finite and > 0");
  REQUIRE_THROWS_AS(throw_invalid("a", "b", 0.0, "c"), std::invalid_argument);
  REQUIRE_THROWS_WITH(throw_invalid("a", "b", "none", "c"), "a: b is none, but must be c");
  CHECK(tuple_text(std::array{1.5, std::numeric_limits<double>::quiet_NaN()}) == "(1.5, nan)");
}

TEST_CASE("Bounds hold at their ends and refuse what is not finite", "[core]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  REQUIRE_NOTHROW(require_positive("w", "f", 1e-300));
  REQUIRE_NOTHROW(require_non_negative("w", "f", 0.0));
  REQUIRE_THROWS_AS(require_positive("w", "f", 0.0), std::invalid_argument);
  REQUIRE_THROWS_AS(require_non_negative("w", "f", -1e-300), std::invalid_argument);
  for (const double bad : {infinity, -infinity, nan}) {
    REQUIRE_THROWS_AS(require_positive("w", "f", bad), std::invalid_argument);
    REQUIRE_THROWS_AS(require_non_negative("w", "f", bad), std::invalid_argument);
  }
}
