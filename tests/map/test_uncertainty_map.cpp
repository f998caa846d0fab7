#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>

#include "incognita/core/random.hpp"
#include "incognita/geometry/d_optimality.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/dispersion_probability.hpp"
#include "incognita/map/map.hpp"
#include "incognita/map/uncertainty_map.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

TEST_CASE("Gauss' bound holds for Gaussians, up to the widest box it is for", "[uncertainty]") {
  for (const double share : {0.01, 0.3, 0.99, 1.0}) {
    const double sigma = 0.7;
    const double side = share * 4.0 * sigma / std::sqrt(3.0);
    REQUIRE(gauss_bound(side, sigma) == Approx(side / (2.0 * sigma * std::sqrt(3.0))));
    REQUIRE(dispersion_probability<1>(Eigen::Matrix<double, 1, 1>(sigma * sigma), Eigen::Matrix<double, 1, 1>(side)) >=
            gauss_bound(side, sigma));
  }
  REQUIRE_THROWS_WITH(gauss_bound(2.4, 1.0), Contains("side is 2.4"));
  REQUIRE_THROWS_WITH(gauss_bound(0.0, 1.0), Contains("side is 0"));
  REQUIRE_THROWS_WITH(gauss_bound(1.0, -1.0), Contains("sigma is -1"));
}

TEST_CASE("The example of Appendix A.2 in metres", "[uncertainty]") {
  const Eigen::Vector3d sides(0.1, 0.1, 0.002);
  const double a = gauss_scale(sides);
  REQUIRE(a == Approx(7.8358e-3).epsilon(1e-4));
  const Eigen::Matrix3d tolerated = Eigen::Vector3d(4.0, 4.0, 4e-4).asDiagonal();
  const double u = uncertainty_of_probability(dispersion_probability<3>(tolerated, sides), a, 3);
  REQUIRE(u == Approx(0.31186).epsilon(1e-4));
  REQUIRE(u < mean_sigma(tolerated));
}

TEST_CASE("The bound (9) holds without correlation, and fails for strong ones", "[uncertainty]") {
  Random random(1);
  const Eigen::Vector2d sides(0.1, 0.1);
  const double a = gauss_scale(sides);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Matrix2d covariance = Eigen::Vector2d(std::pow(10.0, random.uniform(-2.4, 1.0)), std::pow(10.0, random.uniform(-2.4, 1.0))).asDiagonal();
    REQUIRE(mean_sigma(covariance) >= uncertainty_of_probability(dispersion_probability<2>(covariance, sides), a, 2));
  }
  Eigen::Matrix2d line;
  line << 1.0, 0.99999, 0.99999, 1.0;
  REQUIRE(mean_sigma(line) < uncertainty_of_probability(dispersion_probability<2>(line, sides), a, 2));
}

TEST_CASE("An uncertainty map has what is tolerated where nothing was seen, and sigma where all was", "[uncertainty]") {
  Dispersion::Params params;
  params.sigma_max_m = 0.8;
  params.noise = {0.3, 0.0};
  params.kappa = 1.0;
  Map<Dispersion> map({0.1, 0.5}, Dispersion(params));
  Scan<2> scan(circular_beams(400, 3.0));
  map.reserve({{-5.0, -5.0}, {5.0, 5.0}});
  map.update(scan, {}, Eigen::Vector3d(0.16, 0.16, 0.0).asDiagonal());
  const Grid<float, 2> calibrated_m = uncertainty_map(map);
  REQUIRE(calibrated_m.box() == map.grid().box());
  REQUIRE(calibrated_m.value({45, 45}) == Approx(0.8));
  // Along x the range adds to the variance, across it does not: 0.5 and 0.4.
  REQUIRE(calibrated_m.value({20, 0}) == Approx(std::sqrt(0.5 * 0.4)).epsilon(0.01));
  const Grid<float, 2> gauss_m = uncertainty_map(map, UncertaintyScale::gauss);
  REQUIRE(gauss_m.value({20, 0}) == Approx(0.7236 * std::sqrt(0.5 * 0.4)).epsilon(0.01));
  REQUIRE(gauss_m.value({45, 45}) == Approx(0.7236 * 0.8).epsilon(0.01));
}

TEST_CASE("Uncertainty refuses what has no meaning", "[uncertainty]") {
  REQUIRE_THROWS_WITH(uncertainty_of_probability(0.0, 1.0, 2), Contains("probability is 0"));
  REQUIRE_THROWS_WITH(uncertainty_of_probability(1.5, 1.0, 2), Contains("probability is 1.5"));
  REQUIRE_THROWS_WITH(uncertainty_of_probability(0.5, 0.0, 2), Contains("a is 0"));
  REQUIRE_THROWS_WITH(uncertainty_of_probability(0.5, 1.0, 0), Contains("dimension is 0"));
  REQUIRE_THROWS_WITH(gauss_scale(Eigen::Vector2d(0.1, 0.0)), Contains("a side is 0"));
}
