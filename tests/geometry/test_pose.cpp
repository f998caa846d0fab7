#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "incognita/core/random.hpp"
#include "incognita/geometry/pose3.hpp"

using namespace incognita;

static_assert(std::is_same_v<Pose<2>, Pose2>);
static_assert(std::is_same_v<Pose<3>, Pose3>);

namespace {

template <int Dim>
Pose<Dim> random_pose(Random& random) {
  if constexpr (Dim == 2) {
    return {random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(-3.14, 3.14)};
  } else {
    const Eigen::Vector3d position{random.uniform(-9.0, 9.0), random.normal(), random.normal()};
    const Eigen::Vector4d q{random.normal(), random.normal(), random.normal(), random.normal()};
    return {position, Eigen::Quaterniond(q).normalized()};
  }
}

template <int Dim>
typename Pose<Dim>::Vector random_point(Random& random) {
  typename Pose<Dim>::Vector point;
  for (int axis = 0; axis < Dim; ++axis) point[axis] = random.uniform(-9.0, 9.0);
  return point;
}

/// Poses as homogeneous matrices: the independent reference of the group.
template <int Dim>
Eigen::Matrix<double, Dim + 1, Dim + 1> matrix(const Pose<Dim>& pose) {
  Eigen::Matrix<double, Dim + 1, Dim + 1> result = Eigen::Matrix<double, Dim + 1, Dim + 1>::Identity();
  result.template topLeftCorner<Dim, Dim>() = pose.rotation();
  result.template topRightCorner<Dim, 1>() = pose.position();
  return result;
}

template <int Dim>
void check_group_laws() {
  Random random(Dim);
  for (int trial = 0; trial < 300; ++trial) {
    const Pose<Dim> a = random_pose<Dim>(random);
    const Pose<Dim> b = random_pose<Dim>(random);
    const Pose<Dim> c = random_pose<Dim>(random);
    const auto point = random_point<Dim>(random);
    REQUIRE(matrix<Dim>(a * b).isApprox(matrix<Dim>(a) * matrix<Dim>(b), 1e-12));
    REQUIRE(matrix<Dim>((a * b) * c).isApprox(matrix<Dim>(a * (b * c)), 1e-12));
    REQUIRE(matrix<Dim>(a.inverse()).isApprox(matrix<Dim>(a).inverse(), 1e-12));
    REQUIRE((matrix<Dim>(a * a.inverse()) - matrix<Dim>(Pose<Dim>{})).norm() < 1e-12);
    REQUIRE(matrix<Dim>(a * Pose<Dim>{}).isApprox(matrix<Dim>(a), 1e-12));
    REQUIRE((a * b * point).isApprox(a * (b * point), 1e-12));
    const auto rotation = a.rotation();
    REQUIRE((rotation.transpose() * rotation - Pose<Dim>::Rotation::Identity()).norm() < 1e-12);
    REQUIRE(rotation.determinant() == Approx(1.0));
  }
}

}  // namespace

TEST_CASE("SE(2) is a group that acts on points", "[geometry]") { check_group_laws<2>(); }

TEST_CASE("SE(3) is a group that acts on points", "[geometry]") { check_group_laws<3>(); }

TEST_CASE("A planar pose turns counter-clockwise and keeps its yaw in range", "[geometry]") {
  const Pose2 T_world_robot{1.0, 2.0, std::numbers::pi / 2.0};
  REQUIRE((T_world_robot * Eigen::Vector2d(1.0, 0.0)).isApprox(Eigen::Vector2d(1.0, 3.0)));
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const Pose2 product = random_pose<2>(random) * random_pose<2>(random);
    REQUIRE((product.yaw_rad > -std::numbers::pi && product.yaw_rad <= std::numbers::pi));
  }
  REQUIRE(Pose2{0.0, 0.0, std::numbers::pi}.inverse().yaw_rad == std::numbers::pi);
}

TEST_CASE("A long chain of turns in space keeps its quaternion at unit length", "[geometry]") {
  Random random(5);
  const Pose3 step = random_pose<3>(random);
  Pose3 pose;
  for (int i = 0; i < 10000; ++i) pose = pose * step;
  REQUIRE(pose.orientation.norm() == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("A pose with a number that is not finite says so", "[geometry]") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(Pose2{1.0, 2.0, 3.0}.is_finite());
  REQUIRE_FALSE(Pose2{nan, 0.0, 0.0}.is_finite());
  REQUIRE_FALSE(Pose2{0.0, 0.0, std::numeric_limits<double>::infinity()}.is_finite());
  REQUIRE(Pose3{}.is_finite());
  REQUIRE_FALSE(Pose3{Eigen::Vector3d(0.0, nan, 0.0), Eigen::Quaterniond::Identity()}.is_finite());
  REQUIRE_FALSE(Pose3{Eigen::Vector3d::Zero(), Eigen::Quaterniond(1.0, 0.0, nan, 0.0)}.is_finite());
  REQUIRE_THROWS_WITH(require_finite_pose("here", "it", Pose2{nan, 0.5, 3.0}), "here: it is (nan, 0.5, 3), but must be finite");
  REQUIRE_THROWS_WITH(require_finite_pose("here", "it", Pose3{Eigen::Vector3d(0.0, nan, 2.0), Eigen::Quaterniond::Identity()}),
                      "here: it is (0, nan, 2) turned by (0, 0, 0, 1), but must be finite");
  REQUIRE_NOTHROW(require_finite_pose("here", "it", Pose2{}));
}

TEST_CASE("Covariances are finite, symmetric and without negative eigenvalues", "[geometry]") {
  Random random(6);
  const auto draw = [&] {
    Eigen::Matrix3d root;
    for (int i = 0; i < 9; ++i) root(i) = random.normal();
    return root;
  };
  for (int trial = 0; trial < 200; ++trial) {
    const double scale = std::pow(10.0, random.uniform(-8.0, 4.0));
    Eigen::Matrix3d root = draw();
    if (trial % 2 == 0) root.col(0).setZero();  // of rank 2
    const Eigen::Matrix3d covariance = scale * root * root.transpose();
    REQUIRE(is_covariance(covariance));
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(covariance);
    const Eigen::Vector3d axis = eigen.eigenvectors().col(0);
    const double too_much = eigen.eigenvalues()[0] + 1e-6 * eigen.eigenvalues()[2];
    REQUIRE_FALSE(is_covariance(Eigen::Matrix3d(covariance - too_much * axis * axis.transpose())));
    Eigen::Matrix3d skewed = covariance;
    skewed(0, 1) += 1e-6 * covariance.cwiseAbs().maxCoeff();
    REQUIRE_FALSE(is_covariance(skewed));
  }
  REQUIRE(is_covariance(Eigen::Matrix2d::Zero().eval()));
  REQUIRE_FALSE(is_covariance(Eigen::Matrix2d((-1e-20 * Eigen::Matrix2d::Identity()))));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
    matrix(1, 1) = bad;
    REQUIRE_FALSE(is_covariance(matrix));
  }
}
