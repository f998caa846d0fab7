#include <catch2/catch.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "incognita/core/random.hpp"
#include "incognita/estimation/map_drift.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

/// What a small twist about the origin does to a pose: the derivative of exp(twist) * pose.
Eigen::Matrix3d twist_jacobian(const Pose2& pose) {
  return room::numerical_jacobian<3>(Pose2{}, [&](const Pose2& twist) {
    const Pose2 moved = twist * pose;
    return Eigen::Vector3d(moved.x_m, moved.y_m, moved.yaw_rad);
  });
}

double smallest_eigenvalue(const Eigen::Matrix3d& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(matrix).eigenvalues()[0];
}

}  // namespace

TEST_CASE("A carried covariance is that of a pose on the same body", "[estimation]") {
  Random random(1);
  for (int draw = 0; draw < 100; ++draw) {
    const Eigen::Matrix3d drift = room::random_covariance(random, 0.1);
    const Pose2 pose{random.normal(0.0, 20.0), random.normal(0.0, 20.0), random.uniform(-3.0, 3.0)};
    const Eigen::Matrix3d jacobian = twist_jacobian(pose);
    const Eigen::Matrix3d expected = jacobian * drift * jacobian.transpose();
    const Eigen::Matrix3d carried = carried_covariance(drift, pose.position());
    REQUIRE((carried - expected).norm() < 1e-6 * expected.norm());
    REQUIRE((carried_covariance(carried, -pose.position()) - drift).norm() < 1e-9 * carried.norm());
  }
}

TEST_CASE("Motion does not change the drift that a pose has from its map", "[estimation]") {
  Random random(2);
  const Eigen::Matrix3d drift = room::random_covariance(random, 0.01);
  Pose2 pose{3.0, -2.0, 0.4};
  PoseBelief belief{pose, carried_covariance(drift, pose.position())};
  for (int step = 0; step < 100; ++step) {
    belief = propagate(belief, {random.normal(), random.normal(), random.normal()}, MotionNoise{}, 0.1);
  }
  const Eigen::Matrix3d expected = carried_covariance(drift, belief.pose.position());
  REQUIRE((belief.covariance - expected).norm() < 1e-9 * expected.norm());
}

TEST_CASE("Pieces take over the drift of the reference and a share of the pose's covariance", "[estimation]") {
  Random random(3);
  MapDrift::Params params;
  params.inherited_share = 0.25;
  params.scans_per_piece = 3;
  MapDrift drift(params);
  REQUIRE(drift.covariance() == Eigen::Matrix3d::Zero());
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (int link = 0; link < 10; ++link) {
    const Eigen::Vector2d position(random.normal(0.0, 5.0), random.normal(0.0, 5.0));
    const Eigen::Matrix3d covariance = room::random_covariance(random, 0.05);
    for (int scan = 0; scan < 3; ++scan) REQUIRE(drift.piece_of_scan(covariance, position) == link);
    drift.begin_matches(position);
    drift.add_match(link);
    (void)drift.choose_reference();
    const Eigen::Matrix3d jacobian = twist_jacobian({position.x(), position.y(), 0.0}).inverse();
    expected += 0.25 * jacobian * covariance * jacobian.transpose();
    REQUIRE((drift.covariance() - expected).norm() < 1e-6 * expected.norm());
  }
  REQUIRE(drift.size() == 10);
}

TEST_CASE("The reference is the oldest piece in sight, and going back to it keeps the uncertainty", "[estimation]") {
  Random random(4);
  MapDrift::Params params;
  params.scans_per_piece = 1;
  params.inherited_share = 1.0;
  MapDrift drift(params);
  const Eigen::Vector2d here(2.0, 1.0);
  const Eigen::Matrix3d covariance = room::random_covariance(random, 0.03);
  for (int link = 0; link < 5; ++link) {
    const int piece = drift.piece_of_scan(covariance, here);
    drift.begin_matches(here);
    drift.add_match(piece);
    (void)drift.choose_reference();
  }
  const Eigen::Matrix3d before = drift.covariance_at(here);
  // One beam in twelve sees the first piece, less than the quantile; then one in six.
  for (const int old_beams : {1, 2}) {
    drift.begin_matches(here);
    for (int beam = 0; beam < 12; ++beam) drift.add_match(beam < old_beams ? 0 : 4);
    const Eigen::Matrix3d added = drift.choose_reference();
    const Eigen::Matrix3d after = added + drift.covariance_at(here);
    REQUIRE(smallest_eigenvalue(added) > -1e-12);
    REQUIRE(after.trace() == Approx(before.trace()).epsilon(0.2));
    if (old_beams == 2) REQUIRE(drift.covariance_at(here).trace() < 0.5 * before.trace());
  }
  const Eigen::Matrix3d kept = drift.covariance();
  drift.begin_matches(here);
  REQUIRE(drift.choose_reference() == Eigen::Matrix3d::Zero());
  REQUIRE(drift.covariance() == kept);
}

TEST_CASE("A newer piece is uncertain beyond the reference by the difference of their drifts", "[estimation]") {
  Random random(5);
  MapDrift::Params params;
  params.scans_per_piece = 1;
  MapDrift drift(params);
  const Eigen::Matrix3d covariance = room::random_covariance(random, 0.1);
  for (int link = 0; link < 3; ++link) {
    const int piece = drift.piece_of_scan(covariance, {0.0, 0.0});
    if (link == 2) break;
    drift.begin_matches({0.0, 0.0});
    drift.add_match(piece);
    (void)drift.choose_reference();
  }
  const Eigen::Vector3d jacobian(0.6, 0.8, -1.7);
  const double link_m2 = 0.1 * jacobian.dot(covariance * jacobian);
  REQUIRE(drift.variance_beyond_reference_m2(2, jacobian) == Approx(link_m2));
  REQUIRE(drift.variance_beyond_reference_m2(1, jacobian) == Approx(0.0).margin(1e-15));
  REQUIRE(drift.variance_beyond_reference_m2(0, jacobian) == 0.0);
}

TEST_CASE("A measured heading reduces the turn of the reference", "[estimation]") {
  Random random(6);
  MapDrift::Params params;
  params.inherited_share = 1.0;
  MapDrift drift(params);
  const Eigen::Matrix3d covariance = room::random_covariance(random, 0.1);
  drift.begin_matches({0.0, 0.0});
  drift.add_match(drift.piece_of_scan(covariance, {0.0, 0.0}));
  (void)drift.choose_reference();
  drift.correct_turn(0.01);
  REQUIRE(1.0 / drift.covariance()(2, 2) == Approx(1.0 / covariance(2, 2) + 100.0));
  REQUIRE(smallest_eigenvalue(drift.covariance()) > 0.0);
}

TEST_CASE("The drift model refuses parameters outside of their bounds", "[estimation]") {
  MapDrift::Params params;
  params.inherited_share = -0.1;
  REQUIRE_THROWS_WITH(MapDrift(params), Catch::Contains("inherited_share") && Catch::Contains("-0.1"));
  params = {};
  params.reference_quantile = 1.5;
  REQUIRE_THROWS_WITH(MapDrift(params), Catch::Contains("reference_quantile") && Catch::Contains("1.5"));
  params = {};
  params.scans_per_piece = 0;
  REQUIRE_THROWS_WITH(MapDrift(params), Catch::Contains("scans_per_piece") && Catch::Contains("0"));
}
