#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <list>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/behavioral.hpp"
#include "incognita/entropy/map_entropy.hpp"
#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"

using incognita::Behavioral;
using incognita::entropy_change;
using incognita::entropy_sum;
using incognita::EntropyTable;
using incognita::map_entropy_nats;
using incognita::Renyi;
using incognita::Shannon;
using incognita::Tsallis;

namespace {

std::vector<float> random_log_odds(incognita::Random& random, std::size_t count) {
  std::vector<float> log_odds(count);
  for (float& l : log_odds) l = static_cast<float>(random.uniform(-20.0, 20.0));
  return log_odds;
}

/// The sum by the table is within 1e-4 of that by the measure, for one cell and for many.
template <class Measure>
void require_sums(const Measure& measure) {
  const EntropyTable table(measure);
  REQUIRE(table.has_fast_sum());
  const auto require_sum = [&](const std::vector<float>& cells) {
    const double exact_nats = entropy_sum(cells, measure);
    CAPTURE(cells.size(), cells.front(), exact_nats);
    // Below that, a cell is nothing: it may underflow.
    REQUIRE(std::abs(entropy_sum(cells, table) - exact_nats) <= 1e-4 * std::max(exact_nats, 1e-28));
  };
  incognita::Random random(24);
  require_sum(random_log_odds(random, 20000));
  // Cells that are saturated where TBayes and LogOdds saturate them, alone and beside others.
  for (const float saturated : {-20.0F, 6.0F, -10.0F, 10.0F}) {
    std::vector<float> cells(10001, saturated);
    require_sum(cells);
    cells[5000] = 0.0F;
    cells[10000] = -0.4F;
    require_sum(cells);
  }
  for (int draw = 0; draw < 5000; ++draw) {
    const double range = draw % 2 == 0 ? 1.0 : 22.0;
    require_sum({static_cast<float>(random.uniform(-range, range))});
  }
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

TEST_CASE("A table's sum is within 1e-4 of the measure's for every entropy", "[entropy]") {
  require_sums(Shannon{});
  for (const double alpha : {0.05, 0.2, 0.5, 0.9, 1.0 + 1e-9, 1.5, 2.0, 3.0, 5.0, 10.0}) {
    CAPTURE(alpha);
    require_sums(Behavioral(alpha));
    require_sums(Renyi(alpha));
    require_sums(Tsallis(alpha));
  }
  require_sums(Renyi(50.0));
  require_sums(Tsallis(50.0));
  require_sums([](double p) { return 2.0 * p * (1.0 - p); });
  require_sums([](double p) { return std::min(p, 1.0 - p); });
}

TEST_CASE("Entropies too rough for lines are added as the table has them", "[entropy]") {
  incognita::Random random(25);
  const std::vector<float> cells = random_log_odds(random, 1000);
  const auto require_plain_sum = [&](const EntropyTable& table) {
    REQUIRE_FALSE(table.has_fast_sum());
    double sum_nats = 0.0;
    for (const float log_odds : cells) sum_nats += table(log_odds);
    REQUIRE(entropy_sum(cells, table) == sum_nats);
  };
  require_plain_sum(EntropyTable(Behavioral{50.0}));
  require_plain_sum(EntropyTable([](double p) { return p > 0.3 && p < 0.7 ? 1.0 : 0.0; }));
  require_plain_sum(EntropyTable([](double) { return 0.0; }));
  require_plain_sum(EntropyTable(Shannon{}, {.log_odds_max = 1e6}));
}

TEST_CASE("A sum by a table depends on neither the kind of range nor what lies around it", "[entropy]") {
  struct Cell {
    int id;
    float log_odds;
    double weight;
  };
  incognita::Random random(26);
  const EntropyTable table(Shannon{});
  const std::vector<float> all = random_log_odds(random, 2100);
  for (const int part_size : {0, 1, 3, 4, 5, 7, 8, 9, 15, 16, 17, 511, 512, 513, 1023, 1024, 1031, 2063}) {
    const auto count = static_cast<std::size_t>(part_size);
    CAPTURE(count);
    const std::span<const float> part(all.data() + 1, count);
    const double sum_nats = entropy_sum(part, table);
    double plain_sum_nats = 0.0;
    for (const float log_odds : part) plain_sum_nats += table(log_odds);
    REQUIRE(sum_nats == Approx(plain_sum_nats).epsilon(1e-4).margin(0.0));
    REQUIRE(entropy_sum(std::vector<float>(part.begin(), part.end()), table) == sum_nats);
    REQUIRE(entropy_sum(std::list<float>(part.begin(), part.end()), table) == sum_nats);
    std::vector<Cell> cells;
    for (const float log_odds : part) cells.push_back({1, log_odds, 2.0});
    REQUIRE(entropy_sum(cells, table, [](const Cell& cell) { return cell.log_odds; }) == sum_nats);
  }
}

TEST_CASE("A table's sum is symmetric to the bit, exact for unknown cells and constant beyond the ends", "[entropy]") {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const EntropyTable table(Behavioral{0.2}, {.log_odds_max = 7.3, .intervals = 4096});
  REQUIRE(table.has_fast_sum());
  incognita::Random random(27);
  std::vector<float> cells = random_log_odds(random, 999);
  const double sum_nats = entropy_sum(cells, table);
  for (float& log_odds : cells) log_odds = -log_odds;
  REQUIRE(entropy_sum(cells, table) == sum_nats);
  for (const int cell_count : {1, 8, 100'003}) {
    const auto count = static_cast<std::size_t>(cell_count);
    REQUIRE(entropy_sum(std::vector<float>(count, 0.0F), table) == cell_count * std::numbers::ln2);
    REQUIRE(entropy_sum(std::vector<float>(count, -0.0F), table) == cell_count * std::numbers::ln2);
    const double end_nats = entropy_sum(std::vector<float>(count, 7.3F), table);
    REQUIRE(end_nats == Approx(cell_count * table.end_nats()).epsilon(1e-4));
    for (const float beyond : {7.4F, 1e30F, std::numeric_limits<float>::max(), kInfinity, kNan}) {
      REQUIRE(entropy_sum(std::vector<float>(count, beyond), table) == end_nats);
      REQUIRE(entropy_sum(std::vector<float>(count, -beyond), table) == end_nats);
    }
  }
}

TEST_CASE("A map's entropy is that of its cells", "[entropy]") {
  const auto require_map_sum = [](auto map) {
    REQUIRE(map_entropy_nats(map, EntropyTable(Shannon{})) == 0.0);
    incognita::Scan<2> scan(incognita::circular_beams(90, 5.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      scan.set_range_m(beam, 3.0 + 0.02 * static_cast<double>(beam));
    }
    for (int turn = 0; turn < 30; ++turn) map.update(scan, {0.3, 0.1, 0.2}, Eigen::Matrix3d::Identity() * 1e-4);
    std::vector<float> cells;
    for (incognita::Offset cell = 0; cell < static_cast<incognita::Offset>(map.grid().size()); ++cell) {
      cells.push_back(map.log_odds(cell));
    }
    REQUIRE(cells.size() > 5000);
    REQUIRE(std::ranges::count(cells, 0.0F) < static_cast<std::ptrdiff_t>(cells.size()));
    for (const double alpha : {0.2, 1.0, 3.0}) {
      const EntropyTable table{Behavioral(alpha)};
      REQUIRE(map_entropy_nats(map, table) == entropy_sum(cells, table));
      REQUIRE(map_entropy_nats(map, Behavioral(alpha)) == entropy_sum(cells, Behavioral(alpha)));
      REQUIRE(map_entropy_nats(map, table) == Approx(map_entropy_nats(map, Behavioral(alpha))).epsilon(1e-4));
    }
  };
  require_map_sum(incognita::Map<incognita::TBayes>());
  require_map_sum(incognita::Map<incognita::LogOdds>());
}

TEST_CASE("The gain is what the sum loses", "[entropy]") {
  incognita::Random random(23);
  const std::vector<float> before = random_log_odds(random, 5000);
  const std::vector<float> after = random_log_odds(random, 5000);
  const auto require_loss = [&](const auto& entropy) {
    REQUIRE(entropy_change(before, after, entropy) ==
            Approx(entropy_sum(before, entropy) - entropy_sum(after, entropy)).epsilon(1e-9));
  };
  require_loss(Behavioral(0.2));
  require_loss(EntropyTable(Behavioral(50.0)));
  // A fast sum has an error of its own, and a gain is small beside a sum.
  const EntropyTable table(Behavioral{0.2});
  const double sum_nats = entropy_sum(before, table);
  REQUIRE(entropy_change(before, after, table) ==
          Approx(sum_nats - entropy_sum(after, table)).margin(1e-4 * sum_nats).epsilon(0.0));
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
