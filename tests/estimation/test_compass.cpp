#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/compass.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

using std::numbers::pi;

LineSegment segment(double angle_rad, double length_m, double variance_rad2 = 1e-6) {
  return {std::remainder(angle_rad, pi), variance_rad2, length_m};
}

Scan<2> noisy_scan(Random& random, const std::vector<room::Wall>& walls, const Pose2& T_map_sensor,
                   double noise_m = 0.01) {
  Scan<2> scan = room::scan_of(walls, T_map_sensor);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (scan.reading(beam) == Reading::hit)
      scan.set_range_m(beam, scan.range_m(beam) + random.normal(0.0, noise_m));
  }
  return scan;
}

Pose2 pose_inside(Random& random) {
  return room::kTurned *
         Pose2{random.uniform(-2.0, 2.0), random.uniform(-1.0, 1.0), random.uniform(-pi, pi)};
}

/// A room of straight walls that do not meet: no corner falls between two beams.
std::vector<room::Wall> open_room() {
  std::vector<room::Wall> walls = room::box(room::kTurned);
  for (room::Wall& wall : walls) {
    const Eigen::Vector2d shorter = 0.1 * (wall.to - wall.from);
    wall.from += shorter;
    wall.to -= shorter;
  }
  return walls;
}

/// The closed polygon with these corners, counter-clockwise.
std::vector<room::Wall> polygon(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<room::Wall> walls;
  for (std::size_t n = 0; n < corners.size(); ++n)
    walls.push_back({corners[n], corners[(n + 1) % corners.size()]});
  return walls;
}

/// A room of four walls at distances from the origin, each turned about its middle by the given angle.
std::vector<room::Wall> crooked_room(const double (&turns_rad)[4]) {
  const auto corner = [&](int side) {
    Eigen::Matrix2d normals;
    Eigen::Vector2d offsets;
    for (int n = 0; n < 2; ++n) {
      const double middle_rad = 0.3 + 0.5 * pi * (side + n);
      const double normal_rad = middle_rad + turns_rad[(side + n) % 4];
      normals.row(n) << std::cos(normal_rad), std::sin(normal_rad);
      offsets[n] = 3.0 * normals.row(n).dot(Eigen::RowVector2d(std::cos(middle_rad), std::sin(middle_rad)));
    }
    return Eigen::Vector2d(normals.inverse() * offsets);
  };
  return polygon({corner(0), corner(1), corner(2), corner(3)});
}

/// The scans of a building from random poses near its middle, measured with true headings.
template <class Walls>
void require_silent(const Walls& walls) {
  Random random(11);
  Compass compass;
  for (int n = 0; n < 200; ++n) {
    const Pose2 pose{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-pi, pi)};
    CAPTURE(n);
    REQUIRE_FALSE(compass.measure(noisy_scan(random, walls, pose), pose.yaw_rad).has_value());
  }
}

}  // namespace

TEST_CASE("Angles are wrapped by quarter turns", "[estimation]") {
  Random random(1);
  for (int draw = 0; draw < 1000; ++draw) {
    const double angle_rad = random.uniform(-20.0, 20.0);
    const double wrapped_rad = wrap_quarter_turn_rad(angle_rad);
    REQUIRE(std::abs(wrapped_rad) <= 0.25 * pi);
    const double quarters = (angle_rad - wrapped_rad) / (0.5 * pi);
    REQUIRE(quarters == Approx(std::round(quarters)).margin(1e-12));
  }
}

TEST_CASE("Parallel and perpendicular walls have one direction, exactly", "[estimation]") {
  Random random(2);
  for (int draw = 0; draw < 200; ++draw) {
    const double angle_rad = random.uniform(-pi, pi);
    const double wall_rad2 = draw % 2 == 0 ? 0.0 : 1e-4;
    std::vector<LineSegment> segments;
    double information = 0.0;
    for (int n = 0; n < 6; ++n) {
      const double quarters = static_cast<double>(random.index(4));
      segments.push_back(
          segment(angle_rad + 0.5 * pi * quarters, random.uniform(0.6, 5.0), random.uniform(1e-7, 1e-5)));
      information += 1.0 / (segments.back().variance_rad2 + wall_rad2);
    }
    const std::optional<WallDirection> found = wall_direction(segments, wall_rad2, {});
    REQUIRE(found.has_value());
    REQUIRE(std::abs(wrap_quarter_turn_rad(found->angle_rad - angle_rad)) < 1e-12);
    REQUIRE(std::abs(found->angle_rad) <= 0.25 * pi);
    REQUIRE(found->share == Approx(1.0));
    REQUIRE(found->walls == 6);
    // Independent errors: the variance of a mean weighted by information is the information's inverse.
    REQUIRE(found->noise_variance_rad2 + found->walls_variance_rad2 == Approx(1.0 / information));
    REQUIRE((found->walls_variance_rad2 > 0.0) == (wall_rad2 > 0.0));
    // None is off by more than nothing, less than their noise lets expect.
    REQUIRE(found->wall_scatter_rad2 < 0.0);
  }
}

TEST_CASE("Walls that are off count by their information, and outliers not at all", "[estimation]") {
  // Off by +-: the mean is weighted by 1 / (variance + wall variance).
  const double wall_rad2 = 1e-4;
  const std::vector<LineSegment> two{segment(0.2 + 0.01, 3.0, 1e-5),
                                     segment(0.2 - 0.02 + 0.5 * pi, 2.0, 4e-5)};
  const double w0 = 1.0 / (1e-5 + wall_rad2);
  const double w1 = 1.0 / (4e-5 + wall_rad2);
  const double mean_rad = 0.2 + (w0 * 0.01 - w1 * 0.02) / (w0 + w1);
  const std::optional<WallDirection> of_two = wall_direction(two, wall_rad2, {});
  REQUIRE(of_two.has_value());
  REQUIRE(of_two->angle_rad == Approx(mean_rad).epsilon(1e-9));
  REQUIRE(of_two->noise_variance_rad2 == Approx((w0 * w0 * 1e-5 + w1 * w1 * 4e-5) / std::pow(w0 + w1, 2)));
  REQUIRE(of_two->walls_variance_rad2 == Approx((w0 * w0 + w1 * w1) * wall_rad2 / std::pow(w0 + w1, 2)));

  // 8 m of walls and 2 m of others, which turn the first guess but not the result.
  const std::vector<LineSegment> walls{segment(0.3, 5.0), segment(0.3 + 0.5 * pi, 3.0)};
  for (const double off_rad : {-0.7, -0.3, -0.15, 0.15, 0.5}) {
    std::vector<LineSegment> with_outliers = walls;
    with_outliers.push_back(segment(0.3 + off_rad, 1.2));
    with_outliers.push_back(segment(0.3 - 0.5 * off_rad + 0.5 * pi, 0.8));
    const std::optional<WallDirection> found = wall_direction(with_outliers, wall_rad2, {});
    CAPTURE(off_rad);
    REQUIRE(found.has_value());
    REQUIRE(found->angle_rad == Approx(0.3).margin(1e-12));
    REQUIRE(found->walls == 2);
    REQUIRE(found->share == Approx(0.8));
  }
}

TEST_CASE("Scattered walls show how far they are off", "[estimation]") {
  Random random(3);
  std::vector<LineSegment> segments;
  for (int n = 0; n < 4000; ++n) {
    segments.push_back(
        segment(0.1 + 0.5 * pi * (n % 2) + random.normal(0.0, std::sqrt(1e-4 + 2e-5)), 1.0, 2e-5));
  }
  const std::optional<WallDirection> found = wall_direction(segments, 1e-4, {});
  REQUIRE(found.has_value());
  REQUIRE(found->wall_scatter_rad2 == Approx(1e-4).epsilon(0.1));
}

TEST_CASE("Too short walls have no direction", "[estimation]") {
  CompassParams params;
  params.length_min_m = 3.0;
  REQUIRE_FALSE(wall_direction({}, 1e-4, params).has_value());
  REQUIRE_FALSE(wall_direction({segment(0.3, 1.0), segment(0.3, 1.9)}, 1e-4, params).has_value());
  REQUIRE(wall_direction({segment(0.3, 1.0), segment(0.3, 2.1)}, 1e-4, params).has_value());
}

TEST_CASE("A compass measures the heading in a room to its noise", "[estimation]") {
  // Walls are known to be straight and scans to be independent, so that the stated variance is that of the
  // ranges.
  CompassParams params;
  params.scans_a_view = 1;
  params.wall_sigma_rad = 1e-6;
  params.wall_sigma_walls = 1e6;
  for (const bool is_open : {true, false}) {
    const std::vector<room::Wall> walls = is_open ? open_room() : room::box(room::kTurned);
    const int seeds = 200;
    double mean_rad = 0.0;
    double ratio = 0.0;
    double sigma_rad = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
      Random random(static_cast<std::uint64_t>(100 + seed));
      Compass compass(params);
      REQUIRE(compass.share() == 0.0);
      for (int n = 0; n < 10; ++n) {
        const Pose2 pose = pose_inside(random);
        const auto heading = compass.measure(noisy_scan(random, walls, pose), pose.yaw_rad);
        // The first scan says where the walls stand.
        REQUIRE(heading.has_value() == (n > 0));
      }
      const Pose2 truth = pose_inside(random);
      const double believed_rad = wrap_angle_rad(truth.yaw_rad + (seed % 2 == 0 ? 0.03 : -0.03));
      const auto heading = compass.measure(noisy_scan(random, walls, truth), believed_rad);
      REQUIRE(heading.has_value());
      const double error_rad = angle_between_rad(heading->yaw_rad, truth.yaw_rad);
      CAPTURE(is_open, seed, error_rad, heading->variance_rad2);
      REQUIRE(std::abs(heading->yaw_rad) <= pi);
      REQUIRE(error_rad * error_rad < 16.0 * heading->variance_rad2);
      REQUIRE(compass.share() > 0.9);
      mean_rad += error_rad / seeds;
      ratio += error_rad * error_rad / heading->variance_rad2 / seeds;
      sigma_rad += std::sqrt(heading->variance_rad2) / seeds;
    }
    CAPTURE(is_open, mean_rad, sigma_rad, ratio);
    REQUIRE(sigma_rad < 0.001);
    REQUIRE(std::abs(mean_rad) < 0.3 * sigma_rad);
    REQUIRE(ratio > 0.4);
    REQUIRE(ratio < 1.2);
  }
}

TEST_CASE("A compass with its defaults errs by less than twice what it states", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Random random(12);
  Compass compass;
  int measured = 0;
  for (int n = 0; n < 200; ++n) {
    const Pose2 truth = pose_inside(random);
    const auto heading = compass.measure(noisy_scan(random, walls, truth),
                                         wrap_angle_rad(truth.yaw_rad + random.normal(0.0, 0.01)));
    if (!heading) continue;
    ++measured;
    REQUIRE(std::abs(angle_between_rad(heading->yaw_rad, truth.yaw_rad)) <
            2.0 * std::sqrt(heading->variance_rad2));
  }
  REQUIRE(measured > 190);
}

TEST_CASE("Scans of one view count as one", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  std::vector<double> variances_rad2;
  for (const double scans : {1.0, 100.0}) {
    Random random(4);
    CompassParams params;
    params.scans_a_view = scans;
    Compass compass(params);
    std::optional<Compass::Heading> heading;
    for (int n = 0; n < 2; ++n) {
      const Pose2 pose = pose_inside(random);
      heading = compass.measure(noisy_scan(random, walls, pose), pose.yaw_rad);
    }
    REQUIRE(heading.has_value());
    variances_rad2.push_back(heading->variance_rad2);
  }
  REQUIRE(variances_rad2[1] == Approx(100.0 * variances_rad2[0]));
}

TEST_CASE("A heading is as uncertain as its scan and the mean of those before", "[estimation]") {
  CompassParams params;
  params.wall_sigma_walls = 1e9;
  Compass compass(params);
  const Scan<2> scan = room::scan_of(open_room(), room::kTurned);
  REQUIRE_FALSE(compass.measure(scan, room::kTurned.yaw_rad).has_value());
  std::vector<double> variances_rad2;
  for (int n = 1; n <= 20; ++n) {
    const auto heading = compass.measure(scan, room::kTurned.yaw_rad);
    REQUIRE(heading.has_value());
    variances_rad2.push_back(heading->variance_rad2);
    REQUIRE(variances_rad2.back() == Approx(0.5 * variances_rad2.front() * (1.0 + 1.0 / n)));
  }
}

TEST_CASE("A compass is silent where buildings have no direction", "[estimation]") {
  std::vector<Eigen::Vector2d> corners;
  for (int n = 0; n < 48; ++n)
    corners.emplace_back(3.0 * std::cos(n * pi / 24.0), 3.0 * std::sin(n * pi / 24.0));
  SECTION("a round room") { require_silent(polygon(corners)); }

  SECTION("two grids, turned by 30 degrees against each other") {
    // Eight walls of one length in the order of their angles close to a convex room.
    corners = {{0.6, -3.2}};
    for (const double degrees : {0.0, 30.0, 90.0, 120.0, 180.0, 210.0, 270.0}) {
      const double angle_rad = 0.2 + degrees * pi / 180.0;
      corners.push_back(corners.back() + 2.2 * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
    }
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : corners) middle += corner / 8.0;
    for (Eigen::Vector2d& corner : corners) corner -= middle;
    require_silent(polygon(corners));
  }

  SECTION("an empty scan") {
    Compass compass;
    REQUIRE_FALSE(compass.measure(Scan<2>(circular_beams(360, 10.0)), 0.0).has_value());
    REQUIRE(compass.share() == 0.0);
  }
}

TEST_CASE("A compass is silent until most of the walls it saw had a direction", "[estimation]") {
  // 4 m of wall along x, and 2 m at 22.5 degrees to either side of a right angle with it: a share of a half.
  const Eigen::Vector2d oblique = 2.0 * Eigen::Vector2d(std::cos(0.375 * pi), std::sin(0.375 * pi));
  const Eigen::Vector2d right(2.5, -1.0);
  const std::vector<room::Wall> half{
      {{-2.0, -3.0}, {2.0, -3.0}},
      {right, right + oblique},
      {{-right.x(), right.y()}, {-right.x() - oblique.x(), right.y() + oblique.y()}}};
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Random random(5);
  Compass compass;
  for (int n = 0; n < 40; ++n) {
    const Pose2 pose{0.0, 0.0, random.uniform(-pi, pi)};
    REQUIRE_FALSE(compass.measure(noisy_scan(random, half, pose, 0.001), pose.yaw_rad).has_value());
    REQUIRE(compass.share() == Approx(0.5).margin(0.03));
  }
  // Forty halves and n ones have a mean of 0.6 at n = 10, and the first measurement says where the walls
  // stand.
  for (int n = 1; n <= 40; ++n) {
    const Pose2 pose = pose_inside(random);
    const bool is_silent = !compass.measure(noisy_scan(random, walls, pose, 0.001), pose.yaw_rad).has_value();
    CAPTURE(n, compass.share());
    if (n < 7) REQUIRE(is_silent);
    if (n > 14) REQUIRE_FALSE(is_silent);
  }
}

TEST_CASE("A compass falls silent in a building of two wings at an angle", "[estimation]") {
  const Pose2 T_first_second{0.0, 0.0, pi / 6.0};
  const std::vector<room::Wall> wings[] = {room::box(room::kTurned), room::box(room::kTurned * T_first_second)};
  Random random(12);
  Compass compass;
  const auto headings_in = [&](int wing, int scans) {
    int headings = 0;
    for (int n = 0; n < scans; ++n) {
      const Pose2 pose = pose_inside(random);
      if (compass.measure(noisy_scan(random, wings[wing], pose), pose.yaw_rad)) ++headings;
    }
    return headings;
  };
  REQUIRE(headings_in(0, 60) == 59);  // it cannot know, and is right
  REQUIRE(headings_in(1, 60) == 0);
  REQUIRE(compass.share() == Approx(0.5).margin(0.05));
  REQUIRE(headings_in(0, 10) == 0);
  // A few oblique scans in a building that is else at right angles do not silence it.
  (void)headings_in(0, 200);
  REQUIRE(headings_in(1, 10) == 0);
  REQUIRE(headings_in(0, 10) == 10);
}

TEST_CASE("A compass does not believe in a turn beyond its walls, nor learn from it", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  for (const double off_rad : {0.06, -0.06, 0.3, 0.7}) {
    Random random(6);
    Compass compass;
    for (int n = 0; n < 200; ++n) {
      const Pose2 pose = pose_inside(random);
      (void)compass.measure(noisy_scan(random, walls, pose), pose.yaw_rad);
    }
    for (int n = 0; n < 50; ++n) {
      const Pose2 pose = pose_inside(random);
      const double turned_rad = wrap_angle_rad(pose.yaw_rad + off_rad);
      REQUIRE_FALSE(compass.measure(noisy_scan(random, walls, pose), turned_rad).has_value());
    }
    const Pose2 truth = pose_inside(random);
    const auto heading = compass.measure(noisy_scan(random, walls, truth), truth.yaw_rad);
    REQUIRE(heading.has_value());
    REQUIRE(std::abs(angle_between_rad(heading->yaw_rad, truth.yaw_rad)) < 0.003);
  }
}

TEST_CASE("A compass learns how far the walls of a building are off", "[estimation]") {
  Random random(7);
  Compass in_open_room;
  Compass in_room;
  Compass in_crooked;
  const double assumed_rad2 = in_room.wall_variance_rad2();
  REQUIRE(assumed_rad2 == Approx(1e-4));
  double scatter_rad2 = 0.0;
  const int scans = 1500;
  for (int n = 0; n < scans; ++n) {
    const Pose2 pose = pose_inside(random);
    (void)in_open_room.measure(noisy_scan(random, open_room(), pose, 0.005), pose.yaw_rad);
    (void)in_room.measure(noisy_scan(random, room::box(room::kTurned), pose), pose.yaw_rad);
    double turns_rad[4];
    double mean_rad = 0.0;
    for (double& turn_rad : turns_rad) mean_rad += 0.25 * (turn_rad = random.normal(0.0, 0.02));
    for (const double turn_rad : turns_rad) scatter_rad2 += std::pow(turn_rad - mean_rad, 2) / (4.0 * scans);
    const Pose2 inside{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-pi, pi)};
    (void)in_crooked.measure(noisy_scan(random, crooked_room(turns_rad), inside), inside.yaw_rad);
  }
  // Only what was assumed is left, of 4 walls a scan or more.
  REQUIRE(in_open_room.wall_variance_rad2() > 0.0);
  REQUIRE(in_open_room.wall_variance_rad2() <= assumed_rad2 * 50.0 / (50.0 + 4.0 * scans));
  // Corners that fall between two beams bend short pieces, which passes for walls that are off.
  REQUIRE(in_room.wall_variance_rad2() < 0.3 * assumed_rad2);
  // About their scan's mean, walls scatter by 3/4 of their variance.
  REQUIRE(scatter_rad2 == Approx(0.75 * 4e-4).epsilon(0.1));
  REQUIRE(in_crooked.wall_variance_rad2() == Approx(scatter_rad2).epsilon(0.3));
}

TEST_CASE("A compass refuses parameters outside of their bounds", "[estimation]") {
  using Params = CompassParams;
  REQUIRE_NOTHROW(Compass(Params{}));
  const std::vector<std::pair<double Params::*, std::string>> fields{
      {&Params::wall_sigma_rad, "wall_sigma_rad"},     {&Params::inlier_max_rad, "inlier_max_rad"},
      {&Params::length_min_m, "length_min_m"},         {&Params::share_min, "share_min"},
      {&Params::wall_sigma_walls, "wall_sigma_walls"}, {&Params::scans_a_view, "scans_a_view"}};
  for (const double bad : {0.0, -0.1, std::numeric_limits<double>::quiet_NaN()}) {
    for (const auto& [field, name] : fields) {
      Params params;
      params.*field = bad;
      REQUIRE_THROWS_WITH(Compass(params), Catch::Contains("CompassParams: " + name));
    }
  }
  Params params;
  params.share_min = 1.01;
  REQUIRE_THROWS_WITH(Compass(params), Catch::Contains("share_min is 1.01"));
  params = {};
  params.segments.points_min = 2;
  REQUIRE_THROWS_WITH(Compass(params), Catch::Contains("points_min is 2"));
}
