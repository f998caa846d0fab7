#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/estimation/likelihood_grid.hpp"

using namespace incognita;

namespace {

using std::numbers::pi;

SurfaceMap<2> random_lines(Random& random) {
  SurfaceMap<2> surfaces;
  for (int piece = 0; piece < 5; ++piece) {
    const Eigen::Vector2d from{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    const double angle_rad = random.uniform(-pi, pi);
    const double view_rad = random.uniform(-pi, pi);
    for (int n = 0; n < 40; ++n) {
      const double along_m = piece == 0 ? 0.0 : 0.02 * n;
      surfaces.add(from + along_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)),
                   {std::cos(view_rad), std::sin(view_rad)});
    }
  }
  surfaces.refresh_normals();
  return surfaces;
}

}  // namespace

TEST_CASE("The likelihood is that of the distance to the nearest surface that faces the beam",
          "[estimation]") {
  Random random(1);
  for (const double sigma_m : {0.1, 0.06}) {
    const SurfaceMap<2> surfaces = random_lines(random);
    const double half_length_m = 0.5 * surfaces.params().cell_m;
    const Lattice<2> lattice(0.05, {-1.03, -1.21});
    LikelihoodGrid<2> grid;
    grid.rebuild(surfaces, lattice, 41, 53, sigma_m);
    REQUIRE(grid.columns() == 41);
    REQUIRE(grid.rows() == 53);
    int positive = 0;
    for (int layer = 0; layer < 8; ++layer) {
      const Eigen::Vector2d direction(std::cos(layer * pi / 4.0), std::sin(layer * pi / 4.0));
      for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
          const Eigen::Vector2d center = lattice.center_m({column, row});
          double nearest_m = std::numeric_limits<double>::infinity();
          surfaces.for_each_in({{-9.0, -9.0}, {9.0, 9.0}}, [&](const Surface<2>& surface) {
            if (!surface.faces(direction)) return;
            Eigen::Vector2d offset = center - surface.mean_m;
            if (surface.planar) {
              const Eigen::Vector2d along(surface.normal.y(), -surface.normal.x());
              offset -= std::clamp(along.dot(offset), -half_length_m, half_length_m) * along;
            }
            nearest_m = std::min(nearest_m, offset.norm());
          });
          const double ratio = nearest_m / sigma_m;
          const double expected = ratio < 3.0 ? 255.0 * std::exp(-0.5 * ratio * ratio) : 0.0;
          // Half a unit of rounding and a quarter of the table's steps; at 3 sigma it drops from 3 to 0.
          if (std::abs(ratio - 3.0) > 1e-3)
            REQUIRE(std::abs(grid.value(layer, column, row) - expected) < 0.8);
          positive += grid.value(layer, column, row) > 0;
        }
      }
    }
    REQUIRE(positive > 1000);
  }
}

TEST_CASE("A direction's layer is the nearest of eight", "[estimation]") {
  Random random(2);
  for (int draw = 0; draw < 1000; ++draw) {
    const double angle_rad = random.uniform(-20.0, 20.0);
    const int layer = LikelihoodGrid<2>::layer_of(angle_rad);
    REQUIRE(layer >= 0);
    REQUIRE(layer < 8);
    REQUIRE(std::abs(std::remainder(angle_rad - layer * pi / 4.0, 2.0 * pi)) <= pi / 8.0 + 1e-9);
  }
}

TEST_CASE("A likelihood can be rebuilt smaller, and needs a width", "[estimation]") {
  Random random(3);
  const SurfaceMap<2> surfaces = random_lines(random);
  LikelihoodGrid<2> used;
  LikelihoodGrid<2> fresh;
  used.rebuild(surfaces, Lattice<2>(0.05, {-1.5, -1.5}), 60, 60, 0.2);
  used.rebuild(surfaces, Lattice<2>(0.1, {-1.0, -0.5}), 17, 11, 0.1);
  fresh.rebuild(surfaces, Lattice<2>(0.1, {-1.0, -0.5}), 17, 11, 0.1);
  REQUIRE(used.values() == fresh.values());
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    REQUIRE_THROWS_AS(fresh.rebuild(surfaces, Lattice<2>(0.1), 5, 5, bad), std::invalid_argument);
  }
}
