#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

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
