#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "incognita/sensor/scan.hpp"

using namespace incognita;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Reading reading_of(double range_m, double range_min_m, double range_max_m) {
  BeamPattern<2> beams;
  beams.directions = {{1.0, 0.0}};
  beams.range_min_m = range_min_m;
  beams.range_max_m = range_max_m;
  return Scan<2>(beams, {range_m}).reading(0);
}

BeamPattern<2> pattern_with(double range_min_m, double range_max_m) {
  BeamPattern<2> beams;
  beams.range_min_m = range_min_m;
  beams.range_max_m = range_max_m;
  return beams;
}

}  // namespace

TEST_CASE("A reading says what the beam met", "[sensor]") {
  const double below_max_m = std::nextafter(10.0, 0.0);
  const double above_max_m = std::nextafter(10.0, 11.0);
  for (const double range_min_m : {0.0, 0.1}) {
    REQUIRE(reading_of(0.1, range_min_m, 10.0) == Reading::hit);
    REQUIRE(reading_of(below_max_m, range_min_m, 10.0) == Reading::hit);
    REQUIRE(reading_of(10.0, range_min_m, 10.0) == Reading::clear);
    for (const double bad_m : {kNan, kInfinity, -kInfinity, -1.0, -0.0, 0.0, above_max_m, 1e300}) {
      CAPTURE(bad_m);
      REQUIRE(reading_of(bad_m, range_min_m, 10.0) == Reading::invalid);
    }
  }
  REQUIRE(reading_of(std::nextafter(0.1, 0.0), 0.1, 10.0) == Reading::invalid);
  REQUIRE(reading_of(std::numeric_limits<double>::denorm_min(), 0.0, 10.0) == Reading::hit);
}

TEST_CASE("A scan reads its maximum range until told otherwise", "[sensor]") {
  Scan<2> scan(circular_beams(4, 7.5));
  REQUIRE(scan.size() == 4);
  REQUIRE(scan.range_max_m() == 7.5);
  for (std::size_t beam = 0; beam < 4; ++beam) REQUIRE(scan.reading(beam) == Reading::clear);
  scan.set_range_m(2, 1.25);
  REQUIRE(scan.reading(2) == Reading::hit);
  REQUIRE(scan.range_m(2) == 1.25);
  REQUIRE((scan.end_point_m(2) - Point<2>(-1.25, 0.0)).norm() < 1e-15);
  REQUIRE((scan.end_point_m(2, 0.25) - Point<2>(-1.5, 0.0)).norm() < 1e-15);
}

TEST_CASE("Beams in the plane start where they are told and turn counter-clockwise", "[sensor]") {
  const double pi = std::numbers::pi;
  const BeamPattern<2> beams = planar_beams(3, -0.25 * pi, 0.25 * pi, 5.0);
  REQUIRE(beams.range_max_m == 5.0);
  const double half = std::sqrt(0.5);
  REQUIRE((beams.directions[0] - Point<2>(half, -half)).norm() < 1e-15);
  REQUIRE((beams.directions[1] - Point<2>(1.0, 0.0)).norm() < 1e-15);
  REQUIRE((beams.directions[2] - Point<2>(half, half)).norm() < 1e-15);

  const BeamPattern<2> circle = circular_beams(360, 10.0);
  REQUIRE(circle.directions.size() == 360);
  Point<2> sum = Point<2>::Zero();
  for (const Point<2>& direction : circle.directions) sum += direction;
  REQUIRE(sum.norm() < 1e-12);
  REQUIRE((circle.directions[90] - Point<2>(0.0, 1.0)).norm() < 1e-15);
  REQUIRE(circular_beams(0, 10.0).directions.empty());
}

TEST_CASE("A bad beam pattern is refused with its field and value", "[sensor]") {
  for (const double range_min_m : {-0.1, kNan, kInfinity}) {
    REQUIRE_THROWS_AS(pattern_with(range_min_m, 10.0).validate(), std::invalid_argument);
  }
  for (const double range_max_m : {0.5, 0.2, -1.0, 0.0, kNan, kInfinity}) {
    REQUIRE_THROWS_AS(pattern_with(0.5, range_max_m).validate(), std::invalid_argument);
    REQUIRE_THROWS_AS(Scan<2>(pattern_with(0.5, range_max_m)), std::invalid_argument);
  }
  REQUIRE_THROWS_WITH(pattern_with(-0.1, 10.0).validate(),
                      "BeamPattern: range_min_m is -0.1, but must be finite and >= 0");
  REQUIRE_THROWS_WITH(pattern_with(2.0, 1.0).validate(),
                      "BeamPattern: range_max_m is 1, but must be finite and > range_min_m");

  for (const Point<2>& direction :
       {Point<2>(0.0, 0.0), Point<2>(1.0, 0.01), Point<2>(kNan, 0.0), Point<2>(kInfinity, 0.0)}) {
    BeamPattern<2> beams = pattern_with(0.0, 10.0);
    beams.directions = {Point<2>(0.0, 1.0), direction};
    REQUIRE_THROWS_AS(beams.validate(), std::invalid_argument);
  }
  BeamPattern<3> space;
  space.directions = {Point<3>(2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0)};
  REQUIRE_NOTHROW(space.validate());
  space.directions.emplace_back(1.0, 1.0, 1.0);
  REQUIRE_THROWS_AS(Scan<3>(space), std::invalid_argument);
}

TEST_CASE("A scan has as many ranges as beams", "[sensor]") {
  REQUIRE_THROWS_WITH(Scan<2>(circular_beams(4, 10.0), {1.0, 2.0, 3.0}), "Scan: 3 ranges for 4 beams, but must be as many");
  REQUIRE_THROWS_AS(Scan<2>(circular_beams(0, 10.0), {1.0}), std::invalid_argument);
  REQUIRE(Scan<2>(circular_beams(0, 10.0), {}).size() == 0);
}

TEST_CASE("Scans of the same beams are told from others, whatever they read", "[sensor]") {
  Scan<2> scan(circular_beams(8, 10.0));
  Scan<2> other(circular_beams(8, 10.0));
  other.set_range_m(3, 1.0);
  CHECK(scan.has_beams_of(other));
  CHECK_FALSE(scan.has_beams_of(Scan<2>(circular_beams(9, 10.0))));
  CHECK_FALSE(scan.has_beams_of(Scan<2>(circular_beams(8, 9.0))));
  CHECK_FALSE(scan.has_beams_of(Scan<2>(planar_beams(8, 0.1, 0.785398163, 10.0))));
}
