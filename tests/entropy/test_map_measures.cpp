#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/entropy/map_measures.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

Map<LogOdds> scanned_map() {
  Random random(1);
  Map<LogOdds> map({0.2, 0.5});
  for (int n = 0; n < 8; ++n) {
    Scan<2> scan(circular_beams(60, 4.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, random.uniform(0.5, 4.5));
    map.update(scan, {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0), 0.0}, Eigen::Matrix3d::Zero());
  }
  return map;
}

}  // namespace

TEST_CASE("Measures of a map are their sums over probabilities", "[entropy]") {
  const Map<LogOdds> map = scanned_map();
  long double shannon_nats = 0.0L;
  for (const double alpha : {0.5, 2.0, 5.0}) {
    long double powers = 0.0L;
    shannon_nats = 0.0L;
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      const long double p = 1.0L / (1.0L + std::exp(-static_cast<long double>(map.log_odds(offset))));
      powers += std::pow(p, static_cast<long double>(alpha));
      shannon_nats -= p * std::log(p) + (1.0L - p) * std::log(1.0L - p);
    }
    const auto renyi_bits = static_cast<double>(std::log2(powers) / (1.0L - alpha));
    REQUIRE(map_renyi_bits(map, alpha) == Approx(renyi_bits));
    REQUIRE(map_information_difference_bits(map, alpha) == Approx(static_cast<double>(shannon_nats / std::log(2.0L)) - renyi_bits));
  }
  REQUIRE(map_entropy_nats_by_size(map) == Approx(static_cast<double>(0.04L * shannon_nats)));
}

TEST_CASE("Unlike SiREn, they depend on the room that a map has", "[entropy]") {
  Map<LogOdds> map = scanned_map();
  const double before = map_entropy_nats_by_size(map);
  const auto cells = map.grid().size();
  map.reserve({{-20.0, -20.0}, {20.0, 20.0}});
  REQUIRE(map_entropy_nats_by_size(map) == Approx(before + 0.04 * std::log(2.0) * static_cast<double>(map.grid().size() - cells)));
}

TEST_CASE("Measures of a map refuse orders that they have no meaning for", "[entropy]") {
  const Map<LogOdds> map;
  REQUIRE_THROWS_WITH(map_renyi_bits(map, 1.0), Contains("alpha is 1"));
  REQUIRE_THROWS_WITH(map_renyi_bits(map, 0.0), Contains("alpha is 0"));
  REQUIRE_THROWS_WITH(map_information_difference_bits(map, std::numeric_limits<double>::quiet_NaN()), Contains("alpha is nan"));
}
