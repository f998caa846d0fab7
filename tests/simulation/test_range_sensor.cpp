#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "incognita/simulation/range_sensor.hpp"
#include "incognita/simulation/world.hpp"
#include "plans.hpp"

using namespace incognita;

TEST_CASE("Without noise a scan's ends lie on the walls, in the sensor's frame", "[simulation]") {
  const World world(test::room(100, 60, 0.05));  // free from 0.05 to 4.95 and 2.95
  RangeSensor sensor({.range_sigma_m = 0.0}, 1);
  const Pose2 T_world_sensor{1.2, 0.9, 0.7};
  const Scan<2>& scan = sensor.measure(world, T_world_sensor);
  REQUIRE(scan.size() == 360);
  REQUIRE(scan.range_max_m() == 10.0);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    REQUIRE(scan.reading(beam) == Reading::hit);
    const Point<2> end_m = T_world_sensor * scan.end_point_m(beam);
    const double off_m = std::min(std::min(std::abs(end_m.x() - 0.05), std::abs(end_m.x() - 4.95)),
                                  std::min(std::abs(end_m.y() - 0.05), std::abs(end_m.y() - 2.95)));
    REQUIRE(off_m < 1e-9);
  }
  CHECK(scan.range_m(0) == Approx(std::min(3.75 / std::cos(0.7), 2.05 / std::sin(0.7))));
  CHECK(&sensor.scan() == &scan);
}

TEST_CASE("Noise is normal on hits, and what is out of range reads the end of the range", "[simulation]") {
  const World world(test::room(1000, 60, 0.05));  // 50 m long
  RangeSensor sensor({}, 2);
  RangeSensor exact({.range_sigma_m = 0.0}, 2);
  const Pose2 T_world_sensor{25.0, 1.5, 0.2};
  const Scan<2> truth = exact.measure(world, T_world_sensor);
  double sum = 0.0, squares = 0.0;
  int hits = 0;
  int clear = 0;
  for (int i = 0; i < 100; ++i) {
    const Scan<2>& scan = sensor.measure(world, T_world_sensor);
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      REQUIRE(scan.reading(beam) != Reading::invalid);
      if (truth.reading(beam) == Reading::clear) {
        REQUIRE(scan.range_m(beam) == 10.0);
        ++clear;
      } else if (truth.range_m(beam) < 9.9) {
        const double noise = (scan.range_m(beam) - truth.range_m(beam)) / 0.01;
        sum += noise;
        squares += noise * noise;
        ++hits;
      }
    }
  }
  REQUIRE(hits > 30000);
  REQUIRE(clear > 1000);
  CHECK(sum / hits == Approx(0.0).margin(0.03));
  CHECK(squares / hits == Approx(1.0).margin(0.04));
}

TEST_CASE("With wild noise readings still lie in (0, range_max_m]", "[simulation]") {
  const World world(test::room(60, 60, 0.05));
  RangeSensor sensor({.beams = circular_beams(90, 2.0), .range_sigma_m = 3.0}, 3);
  int at_the_end = 0;
  int at_the_start = 0;
  for (int i = 0; i < 20; ++i) {
    const Scan<2>& scan = sensor.measure(world, {1.5, 1.5, 0.0});
    for (std::size_t beam = 0; beam < scan.size(); ++beam) {
      REQUIRE(scan.reading(beam) != Reading::invalid);
      REQUIRE(scan.range_m(beam) >= RangeSensor::hit_min_m);
      at_the_end += scan.range_m(beam) == 2.0 ? 1 : 0;
      at_the_start += scan.range_m(beam) == RangeSensor::hit_min_m ? 1 : 0;
    }
  }
  CHECK(at_the_end > 100);
  CHECK(at_the_start > 100);
}

TEST_CASE("A scan's noise does not depend on what earlier scans met", "[simulation]") {
  const World world(test::room(1000, 60, 0.05));
  RangeSensor one({}, 4);
  RangeSensor other({}, 4);
  one.measure(world, {25.0, 1.5, 0.0});
  other.measure(world, {1.0, 1.5, 0.9});
  const Scan<2> a = one.measure(world, {5.0, 1.0, 0.1});
  const Scan<2> b = other.measure(world, {5.0, 1.0, 0.1});
  for (std::size_t beam = 0; beam < a.size(); ++beam) CHECK(a.range_m(beam) == b.range_m(beam));
}

TEST_CASE("A sensor refuses bad parameters", "[simulation]") {
  CHECK_THROWS_AS(RangeSensor({.range_sigma_m = -0.01}, 1), std::invalid_argument);
  RangeSensorParams params;
  params.beams.range_max_m = 0.0;
  CHECK_THROWS_AS(RangeSensor(params, 1), std::invalid_argument);
}
