#include <catch2/catch.hpp>
#include <vector>

#include "support/statistics.hpp"

namespace examples {
namespace {

TEST_CASE("Quartiles and lines as one would draw them", "[statistics]") {
  const Spread spread = spread_of({5.0, 1.0, 3.0, 2.0, 4.0});
  CHECK(spread.least == 1.0);
  CHECK(spread.lower_quartile == 2.0);
  CHECK(spread.median == 3.0);
  CHECK(spread.upper_quartile == 4.0);
  CHECK(spread.greatest == 5.0);
  CHECK(spread_of({1.0, 2.0}).median == 1.5);
  CHECK(spread_of({7.0}).lower_quartile == 7.0);
  CHECK(median({4.0, 1.0, 2.0, 3.0}) == 2.5);
  CHECK(median({}) == 0.0);
  const Line line = fitted_line({0.0, 1.0, 2.0, 3.0}, {1.0, 3.0, 5.0, 7.0});
  CHECK(line.slope == Approx(2.0));
  CHECK(line.offset == Approx(1.0));
  CHECK(line.correlation == Approx(1.0));
}

}  // namespace
}  // namespace examples
