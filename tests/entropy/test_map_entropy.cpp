#include <array>
#include <catch2/catch.hpp>
#include <list>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/entropy/shannon.hpp"

using incognita::Behavioral;
using incognita::entropy_change;
using incognita::entropy_sum;
using incognita::EntropyTable;
using incognita::Shannon;

namespace {

std::vector<float> random_log_odds(incognita::Random& random, std::size_t count) {
  std::vector<float> log_odds(count);
  for (float& l : log_odds) l = static_cast<float>(random.uniform(-20.0, 20.0));
  return log_odds;
}

}  // namespace

TEST_CASE("Unknown cells have ln 2 each, with a measure and with a table", "[entropy]") {
  const std::vector<float> unknown(2, 0.0F);
  REQUIRE(entropy_sum(unknown, Behavioral{3.0}) == 2.0 * std::numbers::ln2);
  REQUIRE(entropy_sum(unknown, EntropyTable(Behavioral{3.0})) == 2.0 * std::numbers::ln2);
  REQUIRE(entropy_sum(std::vector<float>{}, Shannon{}) == 0.0);
}

TEST_CASE("The entropy of a range is the sum over its probabilities", "[entropy]") {
  // p = 1/4 and 3/4, in a range that is not contiguous.
  const std::list<float> cells = {std::log(3.0F), -std::log(3.0F), 0.0F};
  const double quarter_nats = 2.0 * std::numbers::ln2 - 0.75 * std::log(3.0);
  REQUIRE(entropy_sum(cells, Shannon{}) == Approx(2.0 * quarter_nats + std::numbers::ln2).epsilon(1e-7));
}

TEST_CASE("A table's sum is within its bound", "[entropy]") {
  incognita::Random random(22);
  const std::vector<float> cells = random_log_odds(random, 5000);
  const EntropyTable table(Behavioral{3.0});
  REQUIRE(std::abs(entropy_sum(cells, table) - entropy_sum(cells, Behavioral{3.0})) <=
          static_cast<double>(cells.size()) * table.max_error_nats());
}

TEST_CASE("The gain is what the sum loses", "[entropy]") {
  incognita::Random random(23);
  const std::vector<float> before = random_log_odds(random, 5000);
  const std::vector<float> after = random_log_odds(random, 5000);
  const EntropyTable table(Behavioral{0.2});
  REQUIRE(entropy_change(before, after, table) ==
          Approx(entropy_sum(before, table) - entropy_sum(after, table)).epsilon(1e-9));
  REQUIRE(entropy_change(before, after, table) ==
          Approx(-entropy_change(after, before, table)).epsilon(1e-12));
  REQUIRE(entropy_change(before, before, table) == 0.0);
}

TEST_CASE("Cells that become certain gain, cells that become uncertain lose", "[entropy]") {
  const std::array<float, 2> unknown = {0.0F, 0.0F};
  const std::array<float, 2> known = {-3.0F, 2.0F};
  REQUIRE(entropy_change(unknown, known, Shannon{}) > 0.0);
  REQUIRE(entropy_change(known, unknown, Shannon{}) < 0.0);
}

TEST_CASE("A gain needs pairs", "[entropy]") {
  REQUIRE_THROWS_AS(entropy_change(std::vector<float>(2), std::vector<float>(3), Shannon{}),
                    std::invalid_argument);
}
