#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "coarse_surfaces.hpp"
#include "incognita/core/random.hpp"
#include "incognita/estimation/surface_map.hpp"

using namespace incognita;

namespace {

using std::numbers::pi;

Eigen::Vector2d unit(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

template <int Dim>
std::vector<Surface<Dim>> surfaces_near(const SurfaceMap<Dim>& map, const Point<Dim>& point_m) {
  std::vector<Surface<Dim>> surfaces;
  map.for_each_near(point_m, [&](const Surface<Dim>& surface) { surfaces.push_back(surface); });
  return surfaces;
}

/// Points every centimetre on a line through `through` of the given direction, seen from the side of
/// `towards`.
void add_line(SurfaceMap<2>& map, const Eigen::Vector2d& through, double angle_rad, double half_length_m,
              const Eigen::Vector2d& towards, Random* noise = nullptr) {
  for (double along_m = -half_length_m; along_m <= half_length_m; along_m += 0.01) {
    Eigen::Vector2d point = through + along_m * unit(angle_rad);
    if (noise != nullptr) point += noise->normal(0.0, 0.01) * towards;
    map.add(point, towards);
  }
  map.refresh_normals();
}

}  // namespace

TEST_CASE("A surface's running moments are those of all its points", "[estimation]") {
  Random random(1);
  Surface<3> surface;
  std::vector<Point<3>> points;
  Point<3> view = Point<3>::Zero();
  for (int n = 0; n < 40; ++n) {
    points.emplace_back(100.0 + random.normal(), -50.0 + random.normal(), random.normal(0.0, 0.01));
    const Point<3> direction = Point<3>(random.normal(), random.normal(), random.normal()).normalized();
    surface.add(points.back(), direction);
    view += direction / 40.0;
  }
  Point<3> mean = Point<3>::Zero();
  for (const Point<3>& point : points) mean += point / 40.0;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Point<3>& point : points) scatter += (point - mean) * (point - mean).transpose();
  REQUIRE(surface.count == 40);
  REQUIRE((surface.mean_m - mean).norm() < 1e-12);
  REQUIRE((surface.scatter_m2 - scatter).norm() < 1e-10 * scatter.norm());
  REQUIRE((surface.view - view).norm() < 1e-14);
}

TEST_CASE("Lines at any angle get their normal, against the view", "[estimation]") {
  Random random(2);
  for (int draw = 0; draw < 100; ++draw) {
    SurfaceMap<2> map;
    const double angle_rad = random.uniform(-pi, pi);
    const Eigen::Vector2d through(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    // Seen at up to 60 degrees from the perpendicular, from either side.
    const double side = draw % 2 == 0 ? 1.0 : -1.0;
    const Eigen::Vector2d towards = unit(angle_rad + side * 0.5 * pi + random.uniform(-1.0, 1.0));
    const bool noisy = draw % 4 >= 2;
    add_line(map, through, angle_rad, 1.0, towards, noisy ? &random : nullptr);
    const Eigen::Vector2d normal = -side * unit(angle_rad + 0.5 * pi);

    const auto surfaces = surfaces_near<2>(map, through);
    REQUIRE(surfaces.size() >= 3);
    for (const Surface<2>& surface : surfaces) {
      CAPTURE(draw, angle_rad, surface.count);
      // A cell that the line cuts by a corner holds few points, but pools those of its neighbours.
      REQUIRE(surface.planar);
      REQUIRE(surface.normal.norm() == Approx(1.0).epsilon(1e-12));
      REQUIRE(surface.normal.dot(surface.view) < 0.0);
      REQUIRE(std::acos(std::min(1.0, surface.normal.dot(normal))) < (noisy ? 0.06 : 1e-6));
      REQUIRE(std::abs(normal.dot(surface.mean_m - through)) < (noisy ? 0.03 : 1e-9));
    }
  }
}

TEST_CASE("The two sides of a thin wall are kept apart", "[estimation]") {
  // 5 cm thick, at 0.3 rad, within the cells of 0.2 m.
  const double angle_rad = 0.3;
  const Eigen::Vector2d left = unit(angle_rad + 0.5 * pi);
  SurfaceMap<2> map(coarse_params());
  add_line(map, 0.025 * left, angle_rad, 1.0, -left);
  add_line(map, -0.025 * left, angle_rad, 1.0, left);
  int seen_from_left = 0;
  int seen_from_right = 0;
  for (const Surface<2>& surface : surfaces_near<2>(map, {0.0, 0.0})) {
    const bool from_left = surface.view.dot(left) < 0.0;
    (from_left ? seen_from_left : seen_from_right) += 1;
    REQUIRE(surface.planar);
    REQUIRE(left.dot(surface.mean_m) == Approx(from_left ? 0.025 : -0.025).margin(1e-9));
    REQUIRE(surface.normal.dot(left) == Approx(from_left ? 1.0 : -1.0).epsilon(1e-9));
    REQUIRE(surface.faces(from_left ? Eigen::Vector2d(-left) : left));
    REQUIRE_FALSE(surface.faces(from_left ? left : Eigen::Vector2d(-left)));
  }
  REQUIRE(seen_from_left >= 3);
  REQUIRE(seen_from_left == seen_from_right);
}

TEST_CASE("Beams that graze a wall from either end see the same side", "[estimation]") {
  SurfaceMap<2> map(coarse_params());
  // A wall along x seen from below: first along it from the left, then from the right, nearly the other way.
  add_line(map, {0.0, 0.1}, 0.0, 0.5, unit(0.2));
  const std::size_t count = map.size();
  map.add({0.05, 0.1}, unit(0.05));
  map.add({0.05, 0.1}, unit(pi - 0.05));
  REQUIRE(map.size() == count);
  map.add({0.05, 0.1}, unit(-0.05));
  REQUIRE(map.size() == count + 1);
}

TEST_CASE("A surface is frozen when it has its points", "[estimation]") {
  SurfaceMap<2>::Params params = coarse_params();
  params.count_max = 5;
  SurfaceMap<2> map(params);
  for (int n = 0; n < 5; ++n) map.add({0.05, 0.02 * n}, unit(0.0));
  map.refresh_normals();
  const Surface<2> before = surfaces_near<2>(map, {0.05, 0.05}).at(0);
  for (int n = 0; n < 20; ++n) map.add({0.15, 0.02 * n / 4}, unit(0.3));
  map.refresh_normals();
  const auto after = surfaces_near<2>(map, {0.05, 0.05});
  REQUIRE(after.size() == 1);
  REQUIRE(after[0].count == 5);
  REQUIRE(after[0].mean_m == before.mean_m);
  REQUIRE(after[0].scatter_m2 == before.scatter_m2);
  REQUIRE(after[0].view == before.view);
  REQUIRE(after[0].normal == before.normal);
}

TEST_CASE("A cell holds three sides, among which all beams divide", "[estimation]") {
  SurfaceMap<2> map(coarse_params());
  int added = 0;
  for (const double degrees : {0.0, 120.0, 240.0, 30.0, 100.0, 150.0, 200.0, 250.0, 330.0}) {
    map.add({0.1, 0.1}, unit(degrees * pi / 180.0));
    REQUIRE(map.size() == static_cast<std::size_t>(std::min(++added, 3)));
  }
  int count = 0;
  for (const Surface<2>& surface : surfaces_near<2>(map, {0.1, 0.1})) count += surface.count;
  REQUIRE(count == added);
}

TEST_CASE("What is no line is not taken for one", "[estimation]") {
  Random random(3);
  SurfaceMap<2> blob(coarse_params());
  for (int n = 0; n < 40; ++n) blob.add({random.uniform(0.0, 0.2), random.uniform(0.0, 0.2)}, unit(0.3));
  blob.refresh_normals();
  REQUIRE_FALSE(surfaces_near<2>(blob, {0.1, 0.1}).at(0).planar);

  SurfaceMap<2> point(coarse_params());
  for (int n = 0; n < 40; ++n) point.add({0.1 + random.normal(0.0, 0.005), 0.1}, unit(0.3));
  point.refresh_normals();
  REQUIRE_FALSE(surfaces_near<2>(point, {0.1, 0.1}).at(0).planar);

  SurfaceMap<2> few(coarse_params());
  for (const double y_m : {0.02, 0.08, 0.15}) few.add({0.1, y_m}, unit(0.3));
  few.refresh_normals();
  REQUIRE_FALSE(surfaces_near<2>(few, {0.1, 0.1}).at(0).planar);
  few.add({0.1, 0.18}, unit(0.3));
  few.refresh_normals();
  REQUIRE(surfaces_near<2>(few, {0.1, 0.1}).at(0).planar);
}

TEST_CASE("Surfaces are found in the cell of a point and its neighbours, and nowhere else", "[estimation]") {
  SurfaceMap<2> map(coarse_params());
  map.add({-1.05, 2.13}, unit(0.0));
  REQUIRE(surfaces_near<2>(map, {-1.05, 2.13}).size() == 1);
  REQUIRE(surfaces_near<2>(map, {-1.05 + 0.2, 2.13 - 0.2}).size() == 1);
  REQUIRE(surfaces_near<2>(map, {-1.05 + 0.4, 2.13}).empty());
  REQUIRE(surfaces_near<2>(map, {1000.0, 1000.0}).empty());
  REQUIRE(SurfaceMap<2>().size() == 0);
  REQUIRE(surfaces_near<2>(SurfaceMap<2>(), {0.0, 0.0}).empty());
}

TEST_CASE("A surface map that was told its room holds the same as one that grows", "[estimation]") {
  Random random(4);
  SurfaceMap<2> grows;
  SurfaceMap<2> reserved;
  reserved.reserve({{-20.0, -20.0}, {20.0, 20.0}});
  std::vector<Eigen::Vector2d> points;
  for (int n = 0; n < 500; ++n) {
    points.emplace_back(random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0));
    const Eigen::Vector2d direction = unit(random.uniform(-3.0, 3.0));
    grows.add(points.back(), direction);
    reserved.add(points.back(), direction);
  }
  grows.refresh_normals();
  reserved.refresh_normals();
  REQUIRE(grows.size() == reserved.size());
  for (const Eigen::Vector2d& point : points) {
    const auto a = surfaces_near<2>(grows, point);
    const auto b = surfaces_near<2>(reserved, point);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) REQUIRE(a[i].mean_m == b[i].mean_m);
  }
}

TEST_CASE("Surfaces that are moved are found where they then lie, by piece, with their normals", "[estimation]") {
  Random random(5);
  SurfaceMap<2> map;
  const auto stays = [](int /*piece*/, const Eigen::Vector2d& /*at_m*/) { return Eigen::Vector2d(0.0, 0.0); };
  const Eigen::Vector2d up = unit(0.5 * pi);
  for (int piece = 0; piece < 2; ++piece) {
    for (double x_m = 0.0; x_m < 2.0; x_m += 0.01) {
      map.add({x_m, 1.03 + 2.0 * piece + random.normal(0.0, 0.003)}, up, piece, stays);
    }
  }
  map.refresh_normals();
  const std::size_t size = map.size();
  const Eigen::Vector2d moved(0.13, -0.32);
  map.rearrange([&](int piece, const Eigen::Vector2d&) { return piece == 1 ? moved : Eigen::Vector2d(0.0, 0.0); });
  CHECK(map.size() == size);
  CHECK(surfaces_near<2>(map, {1.0, 3.13}).empty());
  for (const Eigen::Vector2d& at_m : {Eigen::Vector2d(1.0, 1.03), Eigen::Vector2d(1.0, 3.03 + moved.y())}) {
    const auto found = surfaces_near<2>(map, at_m);
    REQUIRE(found.size() >= 2);
    for (const Surface<2>& surface : found) {
      CHECK(std::abs(surface.mean_m.y() - at_m.y()) < 0.01);
      CHECK(surface.planar);
      CHECK(surface.normal.y() < -0.99);
      CHECK(surface.piece == (at_m.y() > 2.0 ? 1 : 0));
    }
  }
}

TEST_CASE("A surface that finds no side free where it is moved is left out", "[estimation]") {
  SurfaceMap<2> map;
  for (int piece = 0; piece < 5; ++piece) {
    map.add({0.05 + 0.3 * piece, 0.05}, unit(0.0), piece, [](int, const Eigen::Vector2d&) { return Eigen::Vector2d(0.0, 0.0); });
  }
  REQUIRE(map.size() == 5);
  map.rearrange([](int piece, const Eigen::Vector2d&) { return Eigen::Vector2d(-0.3 * piece, 0.0); });
  CHECK(map.size() == SurfaceMap<2>::sides_max);
  CHECK(surfaces_near<2>(map, {0.05, 0.05}).size() == SurfaceMap<2>::sides_max);
}

TEST_CASE("Planes in space get their normal, and lines in space get none", "[estimation]") {
  Random random(5);
  const Point<3> normal = Point<3>(0.3, -0.5, 0.8).normalized();
  const Point<3> u = normal.unitOrthogonal();
  const Point<3> v = normal.cross(u);
  SurfaceMap<3> plane;
  SurfaceMap<3> edge;
  for (int n = 0; n < 3000; ++n) {
    plane.add(random.uniform(-0.5, 0.5) * u + random.uniform(-0.5, 0.5) * v, -normal);
    edge.add(random.uniform(-0.5, 0.5) * u, -normal);
  }
  plane.refresh_normals();
  edge.refresh_normals();
  const auto surfaces = surfaces_near<3>(plane, Point<3>::Zero());
  REQUIRE(surfaces.size() >= 9);
  for (const Surface<3>& surface : surfaces) {
    REQUIRE(surface.planar);
    REQUIRE((surface.normal - normal).norm() < 1e-6);
  }
  for (const Surface<3>& surface : surfaces_near<3>(edge, Point<3>::Zero())) REQUIRE_FALSE(surface.planar);
}

TEST_CASE("A surface map refuses parameters outside of their bounds", "[estimation]") {
  const auto refuses = [](auto&& change) {
    SurfaceMap<2>::Params params;
    change(params);
    REQUIRE_THROWS_AS(SurfaceMap<2>(params), std::invalid_argument);
  };
  using Params = SurfaceMap<2>::Params;
  for (const double bad :
       {-0.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (double Params::*field : {&Params::cell_m, &Params::pool_radius_m, &Params::pool_offset_m,
                                  &Params::flatness, &Params::roughness_m2, &Params::spread_min_m}) {
      refuses([&](Params& params) { params.*field = bad; });
    }
  }
  refuses([](Params& params) { params.cell_m = 0.0; });
  refuses([](Params& params) { params.count_max = 0; });
  refuses([](Params& params) { params.planar_count_min = 1; });
}
