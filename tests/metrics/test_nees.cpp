#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/metrics/nees.hpp"

namespace {

using namespace incognita;

Pose2::Covariance random_covariance(Random& random) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i / 3, i % 3) = random.normal(0.0, 0.1);
  return root * root.transpose() + 1e-4 * Eigen::Matrix3d::Identity();
}

}  // namespace

TEST_CASE("NEES against the explicit inverse", "[metrics]") {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Pose2::Covariance covariance = random_covariance(random);
    const Pose2 truth{random.normal(), random.normal(), random.uniform(-3.0, 3.0)};
    const Pose2 estimated{truth.x_m + 0.1, truth.y_m - 0.2, truth.yaw_rad + 0.05};
    const Eigen::Vector3d error(0.1, -0.2, 0.05);
    const Eigen::Vector2d e = error.head<2>();
    const Eigen::Matrix2d xy = covariance.topLeftCorner<2, 2>();
    CHECK(pose_nees(estimated, truth, covariance) == Approx(error.dot(covariance.inverse() * error)));
    CHECK(position_nees(estimated, truth, covariance) == Approx(e.dot(xy.inverse() * e)));
  }
}

TEST_CASE("Errors drawn from the covariance have a mean NEES of 2 and 3", "[metrics]") {
  Random random(2);
  MeanNees mean;
  CHECK(mean.position() == 0.0);
  const Pose2::Covariance covariance = random_covariance(random);
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d error = root * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    const Pose2 truth{5.0, -3.0, 3.1};
    mean.add({5.0 + error.x(), -3.0 + error.y(), wrap_angle_rad(3.1 + error.z())}, truth, covariance);
  }
  CHECK(mean.count() == count);
  // Chi-squared: the standard deviations of these means are 0.014 and 0.017.
  CHECK(mean.position() == Approx(2.0).margin(0.06));
  CHECK(mean.pose() == Approx(3.0).margin(0.07));
}

TEST_CASE("A heading error is taken the short way round", "[metrics]") {
  const double turn_rad = pose_error({0.0, 0.0, 3.1}, {0.0, 0.0, -3.1}).z();
  CHECK(turn_rad == Approx(6.2 - 2.0 * std::numbers::pi));
}

TEST_CASE("A covariance that is none is refused and nothing is added", "[metrics]") {
  MeanNees mean;
  const Pose2 pose;
  Pose2::Covariance covariance = Pose2::Covariance::Zero();
  CHECK_THROWS_AS(mean.add(pose, pose, covariance), std::invalid_argument);
  covariance.diagonal() << 1.0, 1.0, -1.0;
  CHECK_THROWS_AS(mean.add(pose, pose, covariance), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity}) {
    for (const auto& [row, column] : {std::pair{1, 1}, {1, 0}, {2, 1}, {2, 0}}) {
      covariance = Pose2::Covariance::Identity();
      covariance(row, column) = covariance(column, row) = bad;
      CHECK_THROWS_AS(mean.add(pose, pose, covariance), std::invalid_argument);
    }
  }
  CHECK(mean.count() == 0);
  CHECK(mean.position() == 0.0);
  CHECK(mean.pose() == 0.0);
}
