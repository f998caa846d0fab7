#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "incognita/map/occupancy.hpp"

using namespace incognita;

TEST_CASE("A cell is free below, occupied above and unknown up to the thresholds", "[map]") {
  const OccupancyThresholds thresholds;
  REQUIRE(thresholds.classify(0.0F) == Occupancy::unknown);
  REQUIRE(thresholds.classify(-1.0F) == Occupancy::unknown);
  REQUIRE(thresholds.classify(1.0F) == Occupancy::unknown);
  REQUIRE(thresholds.classify(std::nextafter(-1.0F, -2.0F)) == Occupancy::free);
  REQUIRE(thresholds.classify(std::nextafter(1.0F, 2.0F)) == Occupancy::occupied);
  REQUIRE(thresholds.classify(-std::numeric_limits<float>::max()) == Occupancy::free);
  REQUIRE(thresholds.classify(std::numeric_limits<float>::max()) == Occupancy::occupied);

  const OccupancyThresholds uneven{-0.2F, 3.0F};
  REQUIRE(uneven.classify(-0.3F) == Occupancy::free);
  REQUIRE(uneven.classify(2.9F) == Occupancy::unknown);
  REQUIRE(uneven.classify(3.1F) == Occupancy::occupied);
}

TEST_CASE("By probabilities, cells are free up to one and occupied from another on", "[map]") {
  const auto thresholds = OccupancyThresholds::of_probabilities(0.2, 0.9);
  const auto log_odds = [](double p) { return static_cast<float>(std::log(p / (1.0 - p))); };
  REQUIRE(thresholds.classify(log_odds(0.2)) == Occupancy::free);
  REQUIRE(thresholds.classify(log_odds(0.2001)) == Occupancy::unknown);
  REQUIRE(thresholds.classify(log_odds(0.5)) == Occupancy::unknown);
  REQUIRE(thresholds.classify(log_odds(0.8999)) == Occupancy::unknown);
  REQUIRE(thresholds.classify(log_odds(0.9)) == Occupancy::occupied);
  const auto extreme = OccupancyThresholds::of_probabilities(0.0, 1.0);
  REQUIRE_NOTHROW(extreme.validate());
  REQUIRE(extreme.classify(-100.0F) == Occupancy::unknown);
  REQUIRE(extreme.classify(100.0F) == Occupancy::unknown);
  for (const auto& [free_max, occupied_min] :
       {std::pair{0.5, 0.9}, {-0.1, 0.9}, {0.2, 0.5}, {0.2, 1.1}, {0.9, 0.2}, {std::nan(""), 0.9}, {0.2, std::nan("")}}) {
    REQUIRE_THROWS_AS(OccupancyThresholds::of_probabilities(free_max, occupied_min), std::invalid_argument);
  }
}

TEST_CASE("Thresholds on the wrong side of 0 are refused", "[map]") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  REQUIRE_NOTHROW(OccupancyThresholds{}.validate());
  for (const float bad : {0.0F, 0.5F, kNan}) {
    REQUIRE_THROWS_AS((OccupancyThresholds{bad, 1.0F}.validate()), std::invalid_argument);
  }
  for (const float bad : {0.0F, -0.5F, kNan}) {
    REQUIRE_THROWS_AS((OccupancyThresholds{-1.0F, bad}.validate()), std::invalid_argument);
  }
}
