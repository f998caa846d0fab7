#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/planning/polyline.hpp"

using namespace incognita;

namespace {

std::vector<Eigen::Vector2d> random_points(Random& random) {
  std::vector<Eigen::Vector2d> points_m;
  const std::size_t count = 1 + random.index(8);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector2d point_m{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    points_m.push_back(point_m);
    if (random.uniform() < 0.2) points_m.push_back(point_m);  // a corner given twice
  }
  return points_m;
}

/// The place `along_m` along the points, by walking them off.
Eigen::Vector2d walk(const std::vector<Eigen::Vector2d>& points_m, double along_m) {
  if (along_m <= 0.0) return points_m.front();
  for (std::size_t i = 1; i < points_m.size(); ++i) {
    const double length_m = (points_m[i] - points_m[i - 1]).norm();
    if (along_m < length_m) return points_m[i - 1] + along_m / length_m * (points_m[i] - points_m[i - 1]);
    along_m -= length_m;
  }
  return points_m.back();
}

}  // namespace

TEST_CASE("Places on a path are known by their distance along it", "[planning]") {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const auto points_m = random_points(random);
    const Polyline path(points_m);
    double length_m = 0.0;
    for (std::size_t i = 1; i < points_m.size(); ++i) length_m += (points_m[i] - points_m[i - 1]).norm();
    REQUIRE(path.length_m() == Approx(length_m).margin(1e-12));
    for (int sample = 0; sample < 20; ++sample) {
      const double along_m = random.uniform(-0.5, length_m + 0.5);
      REQUIRE((path.point_at(along_m) - walk(points_m, along_m)).norm() < 1e-9);
    }
    for (std::size_t i = 0; i < points_m.size(); ++i) {
      REQUIRE((path.point_at(path.arc_m(i)) - points_m[i]).norm() < 1e-9);
    }
  }
}

TEST_CASE("The nearest place of a path is nearest among all between its bounds", "[planning]") {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const auto points_m = random_points(random);
    const Polyline path(points_m);
    const Eigen::Vector2d point_m{random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const double from_m = random.uniform(0.0, path.length_m());
    const double to_m = random.uniform(from_m, path.length_m() + 1.0);
    const double along_m = path.nearest_along_m(point_m, from_m, to_m);
    REQUIRE(along_m >= from_m - 1e-12);
    REQUIRE(along_m <= std::min(to_m, path.length_m()) + 1e-12);
    const double distance_m = (path.point_at(along_m) - point_m).norm();
    double sampled_m = std::numeric_limits<double>::infinity();
    for (int sample = 0; sample <= 2000; ++sample) {
      const double at_m = from_m + (std::min(to_m, path.length_m()) - from_m) * sample / 2000.0;
      sampled_m = std::min(sampled_m, (path.point_at(at_m) - point_m).norm());
    }
    REQUIRE(distance_m <= sampled_m + 1e-9);
  }
}

TEST_CASE("A resampled path has even spacing and the same ends", "[planning]") {
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const auto points_m = random_points(random);
    const Polyline path(points_m);
    const double spacing_m = random.uniform(0.05, 3.0);
    const auto resampled_m = resample_path(path, spacing_m);
    REQUIRE(resampled_m.front() == points_m.front());
    REQUIRE((resampled_m.back() - points_m.back()).norm() < 1e-12);
    const double steps = static_cast<double>(resampled_m.size()) - 1.0;
    if (points_m.size() < 2) continue;
    REQUIRE(path.length_m() / steps <= spacing_m * (1.0 + 1e-6));
    if (steps > 1.0) REQUIRE(path.length_m() / (steps - 1.0) > spacing_m);
    for (std::size_t i = 0; i < resampled_m.size(); ++i) {
      const double along_m = path.length_m() * static_cast<double>(i) / steps;
      REQUIRE((resampled_m[i] - walk(points_m, along_m)).norm() < 1e-9);
    }
  }
  REQUIRE(resample_path(Polyline(), 1.0).empty());
  REQUIRE(Polyline().length_m() == 0.0);
  REQUIRE(Polyline().empty());
  REQUIRE_THROWS_AS(resample_path(Polyline(), 0.0), std::invalid_argument);
}
