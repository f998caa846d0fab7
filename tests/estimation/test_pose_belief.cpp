#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/estimation/pose_belief.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Pose2 random_pose(Random& random) {
  return {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.0, 3.0)};
}

}  // namespace

TEST_CASE("The motion's Jacobian is the derivative of the motion", "[estimation]") {
  Random random(1);
  for (int draw = 0; draw < 200; ++draw) {
    const Pose2 pose = random_pose(random);
    const Pose2 increment = random_pose(random);
    const Eigen::Matrix3d numerical = room::numerical_jacobian<3>(pose, [&](const Pose2& at) {
      const Pose2 next = at * increment;
      // Unwrapped, or the difference quotient would see the cut.
      return Eigen::Vector3d(next.x_m, next.y_m, at.yaw_rad + increment.yaw_rad);
    });
    REQUIRE((motion_jacobian(pose, increment) - numerical).norm() < 1e-7);
  }
}

TEST_CASE("Prediction follows (7)", "[estimation]") {
  Random random(2);
  for (int draw = 0; draw < 100; ++draw) {
    const PoseBelief belief{random_pose(random), room::random_covariance(random, 0.3)};
    const Pose2 increment = random_pose(random);
    const double duration_s = random.uniform(0.01, 3.0);
    const PoseBelief next = propagate(belief, increment, {0.3, 0.2}, duration_s);

    const double c = std::cos(belief.pose.yaw_rad);
    const double s = std::sin(belief.pose.yaw_rad);
    REQUIRE(next.pose.x_m == Approx(belief.pose.x_m + c * increment.x_m - s * increment.y_m));
    REQUIRE(next.pose.y_m == Approx(belief.pose.y_m + s * increment.x_m + c * increment.y_m));
    REQUIRE(std::remainder(next.pose.yaw_rad - belief.pose.yaw_rad - increment.yaw_rad,
                           2.0 * std::acos(-1.0)) == Approx(0.0).margin(1e-12));

    // Entry by entry: x' = x - yaw b, y' = y + yaw a with (a, b) the displacement in the map's axes.
    const double a = c * increment.x_m - s * increment.y_m;
    const double b = s * increment.x_m + c * increment.y_m;
    const Eigen::Matrix3d& p = belief.covariance;
    REQUIRE(next.covariance(0, 0) ==
            Approx(p(0, 0) - 2.0 * b * p(0, 2) + b * b * p(2, 2) + 0.09 * duration_s));
    REQUIRE(next.covariance(1, 1) ==
            Approx(p(1, 1) + 2.0 * a * p(1, 2) + a * a * p(2, 2) + 0.09 * duration_s));
    REQUIRE(next.covariance(2, 2) == Approx(p(2, 2) + 0.04 * duration_s));
    REQUIRE(next.covariance(0, 1) ==
            Approx(p(0, 1) + a * p(0, 2) - b * p(1, 2) - a * b * p(2, 2)).margin(1e-12));
    REQUIRE(next.covariance(0, 2) == Approx(p(0, 2) - b * p(2, 2)).margin(1e-12));
    REQUIRE(next.covariance(1, 2) == Approx(p(1, 2) + a * p(2, 2)).margin(1e-12));
  }
}

TEST_CASE("Process noise does not depend on how time is cut into steps", "[estimation]") {
  PoseBelief many;
  for (int step = 0; step < 500; ++step) many = propagate(many, {}, {0.07, 0.03}, 0.02);
  const PoseBelief one = propagate({}, {}, {0.07, 0.03}, 10.0);
  REQUIRE((many.covariance - one.covariance).norm() < 1e-15);
  REQUIRE(one.covariance(0, 0) == Approx(0.07 * 0.07 * 10.0));
  REQUIRE(one.covariance(1, 1) == Approx(0.07 * 0.07 * 10.0));
  REQUIRE(one.covariance(2, 2) == Approx(0.03 * 0.03 * 10.0));
}

TEST_CASE("The position's sigma is that of its worst direction", "[estimation]") {
  Random random(3);
  for (int draw = 0; draw < 100; ++draw) {
    const Eigen::Matrix3d covariance = room::random_covariance(random, random.uniform(0.01, 3.0));
    double worst_m2 = 0.0;
    for (int step = 0; step < 20000; ++step) {
      const double angle_rad = step * 3.1415926535 / 20000;
      const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
      worst_m2 = std::max(worst_m2, direction.dot(covariance.topLeftCorner<2, 2>() * direction));
    }
    REQUIRE(position_sigma_m(covariance) == Approx(std::sqrt(worst_m2)).epsilon(1e-6));
  }
  REQUIRE(position_sigma_m(Eigen::Matrix3d::Zero()) == 0.0);
}

TEST_CASE("Noise and beliefs that are none are refused", "[estimation]") {
  for (const double bad : {-0.1, kNan, kInfinity}) {
    REQUIRE_THROWS_AS((MotionNoise{bad, 0.1}.validate()), std::invalid_argument);
    REQUIRE_THROWS_AS((MotionNoise{0.1, bad}.validate()), std::invalid_argument);
  }
  REQUIRE_NOTHROW(MotionNoise{}.validate());
  PoseBelief belief;
  REQUIRE_NOTHROW(require_belief("Here", belief));
  belief.pose.yaw_rad = kNan;
  REQUIRE_THROWS_WITH(require_belief("Here", belief), "Here: the start pose is (0, 0, nan), but must be finite");
  belief.pose.yaw_rad = 0.0;
  belief.covariance(1, 1) = -1.0;
  REQUIRE_THROWS_WITH(require_belief("Here", belief),
                      "Here: the start covariance is [0, 0, 0; 0, -1, 0; 0, 0, 0], but must be finite, symmetric and positive "
                      "semi-definite");
}
