#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/sensor/line_segments.hpp"

using namespace incognita;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn_rad = 0.3;

/// Distances from the sensor to the four walls of a room, whose normals are kTurn_rad + side * pi / 2.
constexpr double kWalls_m[4] = {2.0, 1.5, 2.5, 3.0};

double range_m(double beam_rad) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 4; ++side) {
    const double cosine = std::cos(beam_rad - kTurn_rad - 0.5 * kPi * side);
    if (cosine > 1e-9) nearest_m = std::min(nearest_m, kWalls_m[side] / cosine);
  }
  return nearest_m;
}

/// The room, seen by evenly spaced beams over fov_rad and, with meets_corners, by beams that meet its corners
/// exactly.
Scan<2> room_scan(std::size_t count, double first_rad, double fov_rad = 2.0 * kPi,
                  bool meets_corners = false) {
  std::vector<double> angles_rad;
  for (std::size_t beam = 0; beam < count; ++beam) {
    angles_rad.push_back(first_rad + fov_rad * static_cast<double>(beam) / static_cast<double>(count));
  }
  for (int side = 0; side < 4 && meets_corners; ++side) {
    const double corner_rad =
        std::atan2(kWalls_m[(side + 1) % 4], kWalls_m[side]) + kTurn_rad + 0.5 * kPi * side;
    const double beam_rad = first_rad + std::fmod(corner_rad - first_rad + 2.0 * kPi, 2.0 * kPi);
    if (beam_rad < angles_rad[count - 1]) angles_rad.push_back(beam_rad);
  }
  std::sort(angles_rad.begin(), angles_rad.end());
  BeamPattern<2> beams;
  std::vector<double> ranges_m;
  for (const double angle_rad : angles_rad) {
    beams.directions.emplace_back(std::cos(angle_rad), std::sin(angle_rad));
    ranges_m.push_back(range_m(angle_rad));
  }
  return Scan<2>(beams, ranges_m);
}

/// A wall 2 m ahead, x = 2, seen by `count` beams within +-half_rad.
Scan<2> wall_scan(std::size_t count, double half_rad) {
  const double increment_rad = 2.0 * half_rad / static_cast<double>(count - 1);
  Scan<2> scan(planar_beams(count, -half_rad, increment_rad, 10.0));
  for (std::size_t beam = 0; beam < count; ++beam) scan.set_range_m(beam, 2.0 / scan.direction(beam).x());
  return scan;
}

std::vector<LineSegment> segments_of(const Scan<2>& scan, const LineSegmentParams& params = {}) {
  std::vector<LineSegment> segments;
  find_line_segments(scan, params, segments);
  return segments;
}

/// How far a line is off the walls of the room.
double off_rad(const LineSegment& segment) {
  return std::remainder(segment.angle_rad - kTurn_rad, 0.5 * kPi);
}

bool same(const std::vector<LineSegment>& a, const std::vector<LineSegment>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const LineSegment& one, const LineSegment& other) {
                      return one.angle_rad == other.angle_rad && one.variance_rad2 == other.variance_rad2 &&
                             one.length_m == other.length_m;
                    });
}

}  // namespace

TEST_CASE("The walls of a room are exact between corners that beams meet", "[sensor]") {
  // One corner is in the gap between the last beam and the first.
  for (const double first_rad : {1.1, 1.3, 3.1, 4.5, 5.9}) {
    const std::vector<LineSegment> segments = segments_of(room_scan(720, first_rad, 5.8, true));
    CAPTURE(first_rad, segments.size());
    REQUIRE(segments.size() == 4);
    int whole = 0;
    for (const LineSegment& segment : segments) {
      REQUIRE(std::abs(off_rad(segment)) < 1e-9);
      REQUIRE(std::abs(segment.angle_rad) <= 0.5 * kPi);
      whole += std::abs(segment.length_m - 4.5) < 1e-9;
    }
    REQUIRE(whole == 2);
  }
}

TEST_CASE("The walls of a room are found all around, corners met or not", "[sensor]") {
  // Both walls at a corner share the end point where they are split, which is on one of them only. The first
  // chord, between neighbours, is parallel to the wall opposite, and may split that anywhere: there a corner
  // may be hidden, as far as it deviates from a straight line by no more than 4 cm.
  for (const std::size_t count : {360U, 720U, 1440U}) {
    double squared = 0.0;
    int number = 0;
    for (int draw = 0; draw < 40; ++draw) {
      double length_m = 0.0;
      const std::vector<LineSegment> segments = segments_of(room_scan(count, 0.157 * draw));
      CAPTURE(count, draw, segments.size());
      REQUIRE(segments.size() >= 4);
      REQUIRE(segments.size() <= 6);
      for (const LineSegment& segment : segments) {
        const double off = off_rad(segment);
        REQUIRE(off * off < 4.0 * segment.variance_rad2);
        squared += off * off / segment.variance_rad2;
        ++number;
        length_m += segment.length_m;
      }
      // Four walls of 4.5 m, but for two pieces of divided walls that may be too short.
      REQUIRE(length_m < 18.1);
      REQUIRE(length_m > 18.0 - 2.0 * LineSegmentParams{}.length_min_m - 0.1);
    }
    CAPTURE(count, number);
    REQUIRE(squared < 0.25 * number);
  }
}

TEST_CASE("A segment's angle has the variance that it states", "[sensor]") {
  Random random(1);
  const Scan<2> exact = wall_scan(41, 0.3);
  // Noise as assumed, and twice as much, which the residuals show.
  for (const double noise_m : {0.01, 0.02}) {
    const int draws = 4000;
    double stated_rad2 = 0.0;
    double squared_rad2 = 0.0;
    double mean_rad = 0.0;
    for (int draw = 0; draw < draws; ++draw) {
      Scan<2> scan = exact;
      for (std::size_t beam = 0; beam < scan.size(); ++beam) {
        scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, noise_m));
      }
      const LineSegment segment = fit_line_segment(scan, 0, scan.size() - 1, 0.01);
      const double off = std::remainder(segment.angle_rad - 0.5 * kPi, kPi);
      stated_rad2 += segment.variance_rad2 / draws;
      squared_rad2 += off * off / draws;
      mean_rad += off / draws;
    }
    CAPTURE(noise_m, stated_rad2, squared_rad2, mean_rad);
    REQUIRE(squared_rad2 == Approx(stated_rad2).epsilon(0.2));
    REQUIRE(std::abs(mean_rad) < 4.0 * std::sqrt(squared_rad2 / draws));
  }
}

TEST_CASE("A line is fitted as well whatever its angle, and steep ones too", "[sensor]") {
  for (double angle_rad = -1.5; angle_rad < 1.58; angle_rad += 0.07) {
    // Beams to points every 0.1 m of a line that passes the sensor at 2 m on its right.
    BeamPattern<2> beams;
    std::vector<double> ranges_m;
    double along_m2 = 0.0;
    for (int n = -10; n <= 10; ++n) {
      const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
      const Eigen::Vector2d point = 0.1 * n * along + 2.0 * Eigen::Vector2d(along.y(), -along.x());
      beams.directions.push_back(point / point.norm());
      ranges_m.push_back(point.norm());
      if (std::abs(n) <= 8) along_m2 += 0.01 * n * n;  // two points at each end are left to the corners
    }
    const std::vector<LineSegment> segments = segments_of(Scan<2>(beams, ranges_m));
    CAPTURE(angle_rad);
    REQUIRE(segments.size() == 1);
    REQUIRE(std::abs(std::remainder(segments[0].angle_rad - angle_rad, kPi)) < 1e-12);
    REQUIRE(segments[0].length_m == Approx(2.0));
    REQUIRE(segments[0].variance_rad2 == Approx(1e-4 / along_m2));
  }
}

TEST_CASE("Corners, gaps and beams without an end point divide a wall", "[sensor]") {
  const Scan<2> whole = wall_scan(81, 0.6);
  REQUIRE(segments_of(whole).size() == 1);
  const double length_m = segments_of(whole)[0].length_m;

  // A wall that turns by 0.3 rad at x = 2, y = 0: y sin(0.3) + (x - 2) cos(0.3) = 0 on its right.
  Scan<2> corner = whole;
  for (std::size_t beam = 0; beam < 40; ++beam) {
    const Point<2> direction = corner.direction(beam);
    const double facing = direction.x() * std::cos(0.3) + direction.y() * std::sin(0.3);
    corner.set_range_m(beam, 2.0 * std::cos(0.3) / facing);
  }
  const std::vector<LineSegment> two = segments_of(corner);
  REQUIRE(two.size() == 2);
  REQUIRE(std::abs(std::remainder(two[0].angle_rad - 0.5 * kPi - 0.3, kPi)) < 1e-9);
  REQUIRE(std::abs(std::remainder(two[1].angle_rad - 0.5 * kPi, kPi)) < 1e-9);

  // A doorway: the beams through it end 3 m farther away, and are too few for a piece.
  Scan<2> doorway = whole;
  for (std::size_t beam = 38; beam < 43; ++beam) doorway.set_range_m(beam, doorway.range_m(beam) + 3.0);
  REQUIRE(segments_of(doorway).size() == 2);

  for (const double none : {whole.range_max_m(), std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0, 11.0}) {
    Scan<2> divided = whole;
    divided.set_range_m(40, none);
    const std::vector<LineSegment> halves = segments_of(divided);
    CAPTURE(none);
    REQUIRE(halves.size() == 2);
    REQUIRE(halves[0].length_m == Approx(halves[1].length_m));
    REQUIRE(halves[0].length_m + halves[1].length_m < length_m);
  }

  // Neighbours are the nearest to each other at the middle, and the farthest at the ends.
  LineSegmentParams params;
  params.gap_max_m = 0.99 * distance(whole.end_point_m(40), whole.end_point_m(41));
  REQUIRE(segments_of(whole, params).empty());
  params.gap_max_m = 1.01 * distance(whole.end_point_m(0), whole.end_point_m(1));
  REQUIRE(segments_of(whole, params).size() == 1);
}

TEST_CASE("Pieces of too few points or too short are no segments", "[sensor]") {
  const Scan<2> scan = wall_scan(9, 0.3);
  const std::vector<LineSegment> segments = segments_of(scan);
  REQUIRE(segments.size() == 1);
  LineSegmentParams params;
  params.points_min = 9;
  REQUIRE(same(segments_of(scan, params), segments));
  params.points_min = 10;
  REQUIRE(segments_of(scan, params).empty());
  params = {};
  params.length_min_m = segments[0].length_m - 1e-9;
  REQUIRE(same(segments_of(scan, params), segments));
  params.length_min_m = segments[0].length_m + 1e-9;
  REQUIRE(segments_of(scan, params).empty());
}

TEST_CASE("Scans without end points have no segments, and scratch is cleared", "[sensor]") {
  std::vector<LineSegment> segments;
  find_line_segments(room_scan(720, 0.0), {}, segments);
  REQUIRE_FALSE(segments.empty());
  find_line_segments(Scan<2>(circular_beams(90, 10.0)), {}, segments);
  REQUIRE(segments.empty());

  find_line_segments(room_scan(720, 0.0), {}, segments);
  find_line_segments(Scan<2>(BeamPattern<2>{}), {}, segments);
  REQUIRE(segments.empty());

  find_line_segments(room_scan(360, 1.0), {}, segments);
  find_line_segments(room_scan(720, 2.0), {}, segments);
  REQUIRE(same(segments, segments_of(room_scan(720, 2.0))));
}

TEST_CASE("What counts as straight is refused outside of its bounds", "[sensor]") {
  using Params = LineSegmentParams;
  REQUIRE_NOTHROW(Params{}.validate());
  const std::vector<std::pair<double Params::*, std::string>> fields{
      {&Params::gap_max_m, "gap_max_m"},
      {&Params::deviation_max_m, "deviation_max_m"},
      {&Params::length_min_m, "length_min_m"},
      {&Params::noise_m, "noise_m"}};
  for (const double bad :
       {0.0, -0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const auto& [field, name] : fields) {
      Params params;
      params.*field = bad;
      REQUIRE_THROWS_WITH(params.validate(), Catch::Contains("LineSegmentParams: " + name));
    }
  }
  Params params;
  params.points_min = 2;
  REQUIRE_THROWS_WITH(params.validate(), Catch::Contains("points_min is 2"));
}
