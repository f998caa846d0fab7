#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
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

/// Makes `piece` the reference.
void refer_to(MapDrift& drift, int piece, const Eigen::Vector2d& position_m = {0.0, 0.0}) {
  drift.begin_matches(position_m);
  drift.add_match(piece);
  (void)drift.choose_reference();
}

/// Where a piece was moved to, from how far points of it are shifted.
Eigen::Vector3d twist_of(const MapDrift& drift, int piece) {
  const Eigen::Vector2d origin = drift.shift_m(piece, {0.0, 0.0});
  return {origin.x(), origin.y(), drift.shift_m(piece, {1.0, 0.0}).y() - origin.y()};
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

TEST_CASE("Pieces take over the drift of the reference and a share of the pose's covariance",
          "[estimation]") {
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

TEST_CASE("The reference is the oldest piece in sight, and going back to it keeps the uncertainty",
          "[estimation]") {
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

TEST_CASE("A newer piece is uncertain beyond the reference by the difference of their drifts",
          "[estimation]") {
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
  const double link_m2 = params.inherited_share * jacobian.dot(covariance * jacobian);
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
  refer_to(drift, drift.piece_of_scan(covariance, {0.0, 0.0}));
  const Eigen::Vector3d twist = drift.correct_turn(0.02, 0.01);
  REQUIRE(1.0 / drift.covariance()(2, 2) == Approx(1.0 / covariance(2, 2) + 100.0));
  REQUIRE(smallest_eigenvalue(drift.covariance()) > 0.0);
  const Eigen::Vector3d gain = covariance.col(2) / (covariance(2, 2) + 0.01);
  REQUIRE((twist - 0.02 * gain).norm() < 1e-12);
}

TEST_CASE("A measured turn moves a chain of pieces as a joint Kalman update does", "[estimation]") {
  Random random(7);
  constexpr int size = 6;
  for (int draw = 0; draw < 200; ++draw) {
    MapDrift::Params params;
    params.inherited_share = 1.0;
    params.scans_per_piece = 1;
    MapDrift drift(params);
    Eigen::Matrix<double, 3 * size, 3 * size> prior;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int piece = 0; piece < size; ++piece) {
      const Eigen::Vector2d position(random.normal(0.0, 5.0), random.normal(0.0, 5.0));
      const Eigen::Matrix3d step = room::random_covariance(random, 0.1);
      refer_to(drift, drift.piece_of_scan(step, position));
      const Eigen::Matrix3d jacobian = twist_jacobian({position.x(), position.y(), 0.0}).inverse();
      sum += jacobian * step * jacobian.transpose();
      // What happened up to the older one of two pieces is common to both.
      for (int newer = piece; newer < size; ++newer) {
        prior.block<3, 3>(3 * piece, 3 * newer) = sum;
        prior.block<3, 3>(3 * newer, 3 * piece) = sum;
      }
    }
    const int reference = draw % size;
    refer_to(drift, reference);

    const double turn_rad = random.normal(0.0, 0.1);
    const double variance_rad2 = std::pow(random.uniform(0.001, 0.3), 2);
    const Eigen::Matrix<double, 3 * size, 1> to_turn = prior.col(3 * reference + 2);
    const double innovation_rad2 = prior(3 * reference + 2, 3 * reference + 2) + variance_rad2;
    const Eigen::Matrix<double, 3 * size, 1> moved = to_turn * (turn_rad / innovation_rad2);
    const Eigen::Matrix<double, 3 * size, 3 * size> posterior =
        prior - to_turn * to_turn.transpose() / innovation_rad2;

    const Eigen::Vector3d twist = drift.correct_turn(turn_rad, variance_rad2);
    REQUIRE((twist - moved.segment<3>(3 * reference)).norm() < 1e-6 * twist.norm());
    const Eigen::Matrix3d of_reference = drift.covariance();
    REQUIRE((of_reference - posterior.block<3, 3>(3 * reference, 3 * reference)).norm() <
            1e-6 * of_reference.norm());
    for (int piece = 0; piece < size; ++piece) {
      CAPTURE(draw, reference, piece);
      const Eigen::Vector3d expected = moved.segment<3>(3 * piece);
      if (piece >= reference) REQUIRE((expected - twist).norm() < 1e-6 * twist.norm());
      for (int n = 0; n < 5; ++n) {
        const Eigen::Vector2d at(random.normal(0.0, 10.0), random.normal(0.0, 10.0));
        const Eigen::Vector2d shift(expected[0] - expected[2] * at.y(), expected[1] + expected[2] * at.x());
        REQUIRE((drift.shift_m(piece, at) - shift).norm() < 1e-6 * (shift.norm() + expected.norm()));
      }
      const double turn_rad2 = posterior(3 * piece + 2, 3 * piece + 2);
      const double beyond_rad2 = std::max(0.0, turn_rad2 - of_reference(2, 2));
      REQUIRE(drift.variance_beyond_reference_m2(piece, {0.0, 0.0, 1.0}) ==
              Approx(beyond_rad2).epsilon(1e-6).margin(1e-12));
      MapDrift seen = drift;
      refer_to(seen, piece);
      REQUIRE(seen.covariance()(2, 2) == Approx(turn_rad2).epsilon(1e-6));
      // Of newer pieces only the turn is that of the joint update.
      if (piece > reference) continue;
      REQUIRE((seen.covariance() - posterior.block<3, 3>(3 * piece, 3 * piece)).norm() <
              1e-6 * seen.covariance().norm());
    }
  }
}

TEST_CASE("Pieces that are turned again move further", "[estimation]") {
  Random random(8);
  MapDrift::Params params;
  params.scans_per_piece = 1;
  MapDrift drift(params);
  for (int link = 0; link < 3; ++link) {
    refer_to(drift, drift.piece_of_scan(room::random_covariance(random, 0.1), {1.0, 2.0}));
  }
  refer_to(drift, 0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const double turn_rad : {0.01, -0.03, 0.005}) {
    sum += drift.correct_turn(turn_rad, 1e-4);
    for (const int piece : {0, 1, 2}) REQUIRE((twist_of(drift, piece) - sum).norm() < 1e-12);
  }
  // A piece is born where its surfaces were seen.
  const int born = drift.piece_of_scan(room::random_covariance(random, 0.1), {1.0, 2.0});
  REQUIRE(twist_of(drift, born).norm() == 0.0);
}

TEST_CASE("A twist moves poses as a small motion about the origin, and back", "[estimation]") {
  Random random(12);
  for (int draw = 0; draw < 100; ++draw) {
    const Pose2 pose{random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-3.1, 3.1)};
    const Eigen::Vector3d twist(random.normal(0.0, 0.1), random.normal(0.0, 0.1), random.normal(0.0, 1e-4));
    const Pose2 moved = moved_pose(pose, twist);
    const Pose2 exact = Pose2{twist[0], twist[1], twist[2]} * pose;
    REQUIRE(distance(moved.position(), exact.position()) < 1e-5);
    REQUIRE(std::abs(angle_between_rad(moved.yaw_rad, exact.yaw_rad)) < 1e-12);
    REQUIRE((twist_between(pose, moved) - twist).norm() < 1e-9);
  }
}

TEST_CASE("Pieces are shifted by what they were moved and have not settled", "[estimation]") {
  MapDrift::Params params;
  params.scans_per_piece = 2;
  MapDrift drift(params);
  const Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 0);
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 0);
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 1);
  drift.begin_piece();
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 2);
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 2);
  CHECK(drift.piece_of_scan(covariance, {0.0, 0.0}) == 3);

  const Eigen::Vector2d at_m(3.0, -2.0);
  drift.set_twist(1, {0.1, 0.2, 0.01});
  CHECK((drift.shift_m(1, at_m) - Eigen::Vector2d(0.1 + 0.02, 0.2 + 0.03)).norm() < 1e-12);
  CHECK(drift.shift_m(0, at_m).norm() == 0.0);
  drift.settle();
  CHECK(drift.shift_m(1, at_m).norm() == 0.0);
  CHECK(drift.twist(1) == Eigen::Vector3d(0.1, 0.2, 0.01));
  drift.set_twist(1, {0.1, 0.25, 0.01});
  CHECK((drift.shift_m(1, at_m) - Eigen::Vector2d(0.0, 0.05)).norm() < 1e-12);
}

TEST_CASE("Drifts stay covariances through thousands of pieces, references and turns", "[estimation]") {
  Random random(9);
  for (int draw = 0; draw < 10; ++draw) {
    MapDrift::Params params;
    params.scans_per_piece = 1;
    params.inherited_share = draw % 2 == 0 ? 1.0 : 0.15;
    MapDrift drift(params);
    int piece = -1;
    for (int step = 0; step < 2000; ++step) {
      const Eigen::Vector2d position(random.normal(0.0, 20.0), random.normal(0.0, 20.0));
      const double choice = random.uniform();
      if (piece < 0 || choice < 0.2) {
        piece = drift.piece_of_scan(room::random_covariance(random, 0.03), position);
      } else if (choice < 0.6) {
        drift.begin_matches(position);
        for (int beam = 0; beam < 10; ++beam) drift.add_match(static_cast<int>(random.index(drift.size())));
        const Eigen::Matrix3d added = drift.choose_reference();
        REQUIRE(smallest_eigenvalue(added) >= -1e-12 * (1.0 + added.trace()));
      } else {
        const double before_rad2 = drift.covariance()(2, 2);
        const Eigen::Vector3d twist =
            drift.correct_turn(random.normal(0.0, 0.03), std::pow(10.0, random.uniform(-8.0, 0.0)));
        REQUIRE(twist.allFinite());
        REQUIRE(drift.covariance()(2, 2) <= before_rad2);
      }
      REQUIRE(smallest_eigenvalue(drift.covariance()) >= -1e-12 * (1.0 + drift.covariance().trace()));
      if (step % 200 != 199) continue;
      for (int other = 0; other <= piece; ++other) {
        MapDrift seen = drift;
        refer_to(seen, other);
        REQUIRE(seen.covariance().allFinite());
        REQUIRE(smallest_eigenvalue(seen.covariance()) >= -1e-12 * (1.0 + seen.covariance().trace()));
        REQUIRE(twist_of(drift, other).allFinite());
      }
    }
  }
}

TEST_CASE("Without drift a measured turn moves nothing", "[estimation]") {
  Random random(10);
  MapDrift::Params params;
  params.inherited_share = 0.0;
  params.scans_per_piece = 1;
  MapDrift certain(params);
  REQUIRE(certain.correct_turn(0.1, 1e-4) == Eigen::Vector3d::Zero());
  for (int link = 0; link < 3; ++link) {
    refer_to(certain, certain.piece_of_scan(room::random_covariance(random, 0.1), {3.0, 1.0}));
    REQUIRE(certain.correct_turn(0.1, 1e-4) == Eigen::Vector3d::Zero());
  }
  for (const int piece : {0, 1, 2}) REQUIRE(certain.shift_m(piece, {5.0, -7.0}) == Eigen::Vector2d::Zero());
  REQUIRE(certain.covariance() == Eigen::Matrix3d::Zero());

  // A reference without drift says nothing of others that have drifted from it.
  MapDrift drift;
  const Eigen::Matrix3d covariance = room::random_covariance(random, 0.1);
  REQUIRE(drift.piece_of_scan(covariance, {0.0, 0.0}) == 0);
  REQUIRE(drift.correct_turn(0.1, 1e-4) == Eigen::Vector3d::Zero());
  REQUIRE(drift.shift_m(0, {5.0, -7.0}) == Eigen::Vector2d::Zero());
  REQUIRE(drift.variance_beyond_reference_m2(0, {0.0, 0.0, 1.0}) ==
          Approx(MapDrift::Params{}.inherited_share * covariance(2, 2)));
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
