#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>

#include "incognita/core/random.hpp"
#include "incognita/estimation/information.hpp"
#include "room.hpp"

using namespace incognita;

TEST_CASE("Information is the normal equations of its measurements", "[estimation]") {
  Random random(1);
  Eigen::Matrix<double, 7, 3> jacobians;
  Eigen::Matrix<double, 7, 1> residuals;
  Eigen::Matrix<double, 7, 1> weights;
  Information information;
  for (int row = 0; row < 7; ++row) {
    for (int column = 0; column < 3; ++column) jacobians(row, column) = random.normal();
    residuals[row] = random.normal();
    weights[row] = random.uniform(0.1, 5.0);
    information.add(jacobians.row(row).transpose(), residuals[row], weights[row]);
  }
  REQUIRE((information.matrix - jacobians.transpose() * weights.asDiagonal() * jacobians).norm() < 1e-12);
  REQUIRE((information.vector - jacobians.transpose() * weights.asDiagonal() * residuals).norm() < 1e-12);
}

TEST_CASE("The updated covariance is (11a), for singular priors too", "[estimation]") {
  Random random(2);
  for (int draw = 0; draw < 300; ++draw) {
    const Eigen::Matrix3d prior = room::random_covariance(random, std::pow(10.0, random.uniform(-3.0, 1.0)));
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    const auto measurements = random.index(5);
    for (std::uint64_t n = 0; n < measurements; ++n) {
      const Eigen::Vector3d jacobian(random.normal(), random.normal(), random.normal());
      information += std::pow(10.0, random.uniform(-1.0, 3.0)) * jacobian * jacobian.transpose();
    }
    const Eigen::Matrix3d updated = updated_covariance(prior, information);
    using Exact = Eigen::Matrix<long double, 3, 3>;
    const Exact exact = (prior.cast<long double>().inverse() + information.cast<long double>()).inverse();
    // In the metric of the posterior itself, so that its smallest variance counts as much as its largest.
    const Eigen::Matrix3d whiten =
        exact.cast<double>().llt().matrixL().solve(Eigen::Matrix3d::Identity().eval());
    REQUIRE((whiten * updated * whiten.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-8);
    REQUIRE(updated == updated.transpose());

    // A direction that is known exactly: the same update in the plane of the other two.
    const Eigen::Vector3d known =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    Eigen::Matrix<double, 3, 2> plane;
    plane.col(0) = known.unitOrthogonal();
    plane.col(1) = known.cross(plane.col(0));
    const Eigen::Matrix2d inside = plane.transpose() * prior * plane;
    const Eigen::Matrix2d inside_updated =
        (inside.inverse() + plane.transpose() * information * plane).inverse();
    const Eigen::Matrix3d singular = plane * inside * plane.transpose();
    const Eigen::Matrix3d at_limit = updated_covariance(singular, information);
    REQUIRE((at_limit - plane * inside_updated * plane.transpose()).norm() <= 1e-8 * prior.norm());
    REQUIRE((at_limit * known).norm() <= 1e-9 * prior.norm());
  }
  const Eigen::Matrix3d some = room::random_covariance(random, 1.0);
  REQUIRE(updated_covariance(Eigen::Matrix3d::Zero(), some) == Eigen::Matrix3d::Zero());
  REQUIRE((updated_covariance(some, Eigen::Matrix3d::Zero()) - some).norm() < 1e-14 * some.norm());
}
