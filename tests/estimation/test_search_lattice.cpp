#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "incognita/estimation/search_lattice.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

using std::numbers::pi;

}  // namespace

TEST_CASE("A lattice holds its centre and the multiples of its steps within the window", "[estimation]") {
  const SearchLattice lattice({1.0, 2.0, 3.0}, {0.3, 0.12, 0.21}, 0.05, 0.07);
  REQUIRE(lattice.size.x == 13);
  REQUIRE(lattice.size.y == 5);
  REQUIRE(lattice.size.turn == 7);
  REQUIRE_FALSE(lattice.is_circle);
  const Pose2 middle = lattice.pose(lattice.half);
  REQUIRE(middle.x_m == 1.0);
  REQUIRE(middle.y_m == 2.0);
  REQUIRE(middle.yaw_rad == Approx(3.0).epsilon(1e-15));
  const Pose2 first = lattice.pose({0, 0, 0});
  REQUIRE(first.x_m == Approx(0.7));
  REQUIRE(first.y_m == Approx(1.9));
  REQUIRE(first.yaw_rad == Approx(2.79));
  REQUIRE(lattice.pose({0, 0, 6}).yaw_rad == Approx(3.21 - 2.0 * pi));
  REQUIRE(lattice.turns_between(0, 6) == 6);
}

TEST_CASE("All around, turns divide the circle evenly and close it", "[estimation]") {
  for (const double yaw_rad : {pi, 10.0, 3.1}) {
    for (const double step_rad : {0.1, 0.75, 2.0 * pi / 64.0}) {
      if (yaw_rad == 3.1 && step_rad != 0.1) continue;  // the last turns leave a gap
      const SearchLattice lattice({0.0, 0.0, 0.4}, {0.0, 0.0, yaw_rad}, 0.05, step_rad);
      REQUIRE(lattice.is_circle);
      REQUIRE(lattice.yaw_step_rad <= step_rad + 1e-12);
      REQUIRE(lattice.size.turn == static_cast<int>(std::ceil(2.0 * pi / step_rad - 1e-9)));
      REQUIRE(lattice.pose(lattice.half).yaw_rad == Approx(0.4));
      REQUIRE(lattice.turns_between(0, lattice.size.turn - 1) == 1);
      for (int turn = 0; turn < lattice.size.turn; ++turn) {
        const double next_rad = lattice.pose({0, 0, (turn + 1) % lattice.size.turn}).yaw_rad;
        REQUIRE(angle_between_rad(lattice.pose({0, 0, turn}).yaw_rad, next_rad) ==
                Approx(lattice.yaw_step_rad));
      }
    }
  }
}

TEST_CASE("The prior is the Mahalanobis distance, and bounds every pose of a rectangle", "[estimation]") {
  Random random(1);
  const SearchLattice lattice({}, {}, 0.05, 0.02);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::Matrix3d covariance =
        draw == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : room::random_covariance(random, 0.2);
    const SearchPrior prior(covariance, lattice);
    const Eigen::Matrix3d rounded =
        covariance + diagonal_covariance(0.05 * 0.05 / 12.0, 0.05 * 0.05 / 12.0, 0.02 * 0.02 / 12.0);
    const Eigen::Matrix3d information = rounded.inverse();
    const double yaw_rad = random.uniform(-0.3, 0.3);
    const double x_m = random.uniform(-1.0, 1.0);
    const double y_m = random.uniform(-1.0, 1.0);
    const double side_m = random.uniform(0.0, 0.8);
    const double bound = prior.distance_min(yaw_rad, x_m, x_m + side_m, y_m, y_m + side_m);
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const Eigen::Vector3d offset(x_m + 0.1 * i * side_m, y_m + 0.1 * j * side_m, yaw_rad);
        const double expected = offset.dot(information * offset);
        REQUIRE(prior.distance_min(offset[2], offset[0], offset[0], offset[1], offset[1]) ==
                Approx(expected).epsilon(1e-9));
        REQUIRE(bound <= expected * (1.0 + 1e-9));
      }
    }
  }
}

TEST_CASE("Covariances too large to add a step to are still priors", "[estimation]") {
  const SearchLattice lattice({}, {}, 0.05, 0.02);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Constant(1e20);
  const SearchPrior prior(covariance, lattice);
  REQUIRE(std::isfinite(prior.distance_min(0.1, 0.1, 0.1, -0.1, -0.1)));
}

TEST_CASE("Windows with bad values or too many steps are refused", "[estimation]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-0.1, nan, std::numeric_limits<double>::infinity()}) {
    REQUIRE_THROWS_AS((SearchWindow{bad, 0.3, 0.2}.validate()), std::invalid_argument);
    REQUIRE_THROWS_AS((SearchWindow{0.3, bad, 0.2}.validate()), std::invalid_argument);
    REQUIRE_THROWS_AS((SearchWindow{0.3, 0.3, bad}.validate()), std::invalid_argument);
  }
  REQUIRE_NOTHROW(SearchLattice({}, {409.6, 409.6, 0.1}, 0.1, 0.01));
  REQUIRE_THROWS_AS(SearchLattice({}, {409.8, 0.3, 0.1}, 0.1, 0.01), std::invalid_argument);
  REQUIRE_THROWS_AS(SearchLattice({}, {0.3, 409.8, 0.1}, 0.1, 0.01), std::invalid_argument);
  REQUIRE_THROWS_AS(SearchLattice({}, {0.3, 0.3, 0.4}, 0.1, 1e-5), std::invalid_argument);
}
