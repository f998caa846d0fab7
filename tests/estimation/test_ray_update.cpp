#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/estimation/ray_update.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

/// (10), written out per rule.
double measurement_variance(double p, const RayUpdateParams& params) {
  const double occupied = params.dvl.occupied_m2;
  const double unoccupied = params.dvl.unoccupied_m2;
  switch (params.mixture) {
    case MixtureVariance::squared_weights:
      return std::pow(p, 2) * occupied + std::pow(1.0 - p, 2) * unoccupied;
    case MixtureVariance::moment_match:
      return unoccupied - p * (unoccupied - occupied);
    case MixtureVariance::occupied_only:
      break;
  }
  return occupied;
}

/// The moment form of the Kalman filter with all measurements stacked; a likelihood to the power of t is a
/// Gaussian with variance R / t.
PoseBelief stacked_kalman(const PoseBelief& prior, const std::vector<RayObservation>& hits, double power,
                          const RayUpdateParams& params) {
  const auto rows = static_cast<Eigen::Index>(hits.size());
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, 3);
  Eigen::VectorXd residual(rows);
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const RayObservation& hit = hits[static_cast<std::size_t>(row)];
    // h = ||x - chi|| differentiated numerically, with the cell 3 m away along the beam.
    const Eigen::Vector2d cell = prior.pose.position() + 3.0 * hit.direction;
    jacobian.row(row) = room::numerical_jacobian<1>(prior.pose, [&](const Pose2& at) {
      return Eigen::Matrix<double, 1, 1>((at.position() - cell).norm());
    });
    residual[row] = hit.residual_m;
    noise(row, row) = measurement_variance(hit.probability, params) / power;
  }
  const Eigen::MatrixXd innovation = jacobian * prior.covariance * jacobian.transpose() + noise;
  const Eigen::MatrixXd gain = prior.covariance * jacobian.transpose() * innovation.inverse();
  const Eigen::Vector3d step = gain * residual;
  return {{prior.pose.x_m + step.x(), prior.pose.y_m + step.y(), prior.pose.yaw_rad + step.z()},
          prior.covariance - gain * jacobian * prior.covariance};
}

std::vector<RayObservation> random_hits(Random& random, std::size_t count) {
  std::vector<RayObservation> hits(count);
  for (RayObservation& hit : hits) {
    const double angle_rad = random.uniform(-3.0, 3.0);
    hit = {{std::cos(angle_rad), std::sin(angle_rad)}, random.normal(0.0, 0.2), random.uniform()};
  }
  return hits;
}

}  // namespace

TEST_CASE("The ray form equals a stacked Kalman update in moment form", "[estimation]") {
  Random random(1);
  for (int draw = 0; draw < 300; ++draw) {
    RayUpdateParams params;
    params.gamma = random.uniform(0.2, 20.0);
    params.tempering = draw % 2 == 0 ? Tempering::hits : Tempering::beams;
    params.mixture = std::array{MixtureVariance::squared_weights, MixtureVariance::moment_match,
                                MixtureVariance::occupied_only}[static_cast<std::size_t>(draw % 3)];
    const PoseBelief prior{{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-1.0, 1.0)},
                           room::random_covariance(random, random.uniform(0.05, 0.5))};
    const std::vector<RayObservation> hits = random_hits(random, 1 + random.index(30));
    const std::size_t beams = hits.size() + random.index(100);
    const double divisor = static_cast<double>(params.tempering == Tempering::hits ? hits.size() : beams);

    const PoseBelief posterior = ray_update(prior, hits, beams, params);
    const PoseBelief expected = stacked_kalman(prior, hits, params.gamma / divisor, params);
    REQUIRE(posterior.pose.x_m == Approx(expected.pose.x_m).margin(1e-8));
    REQUIRE(posterior.pose.y_m == Approx(expected.pose.y_m).margin(1e-8));
    REQUIRE(posterior.pose.yaw_rad == Approx(expected.pose.yaw_rad).margin(1e-8));
    REQUIRE((posterior.covariance - expected.covariance).norm() < 1e-8 * prior.covariance.norm());
  }
}

TEST_CASE("Tempering by hits does not count beams that say the same twice", "[estimation]") {
  Random random(2);
  const PoseBelief prior{{}, room::random_covariance(random, 0.3)};
  const std::vector<RayObservation> once = random_hits(random, 9);
  std::vector<RayObservation> twice = once;
  twice.insert(twice.end(), once.begin(), once.end());
  RayUpdateParams params;
  REQUIRE((ray_update(prior, once, 60, params).covariance - ray_update(prior, twice, 60, params).covariance)
              .norm() < 1e-12);
  // By beams, nine hits among 60 weigh 9/60 of what nine among nine do.
  params.tempering = Tempering::beams;
  const Eigen::Matrix3d few = ray_information(once, 60, params).matrix;
  const Eigen::Matrix3d all = ray_information(once, 9, params).matrix;
  REQUIRE((few * 60.0 - all * 9.0).norm() < 1e-12 * all.norm());
}

TEST_CASE("Without hits the posterior is the prior", "[estimation]") {
  Random random(3);
  const PoseBelief prior{{1.0, 2.0, 3.0}, room::random_covariance(random, 0.3)};
  const PoseBelief posterior = ray_update(prior, {}, 60, {});
  REQUIRE(posterior.pose.x_m == 1.0);
  REQUIRE(posterior.pose.y_m == 2.0);
  REQUIRE(posterior.pose.yaw_rad == 3.0);
  REQUIRE((posterior.covariance - prior.covariance).norm() < 1e-14);
  REQUIRE(ray_information({}, 0, {}).matrix == Eigen::Matrix3d::Zero());
}

TEST_CASE("The ray form sees the heading only through its covariance with the position", "[estimation]") {
  Random random(4);
  const std::vector<RayObservation> hits = random_hits(random, 20);
  PoseBelief prior{{0.0, 0.0, 0.5}, Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal()};
  const PoseBelief apart = ray_update(prior, hits, 20, {});
  REQUIRE(apart.pose.yaw_rad == 0.5);
  REQUIRE(apart.covariance(2, 2) == Approx(0.3).epsilon(1e-12));
  REQUIRE(std::abs(apart.pose.x_m) > 1e-4);
  prior.covariance(0, 2) = prior.covariance(2, 0) = 0.1;
  const PoseBelief together = ray_update(prior, hits, 20, {});
  REQUIRE(std::abs(together.pose.yaw_rad - 0.5) > 1e-5);
  REQUIRE(together.covariance(2, 2) < 0.3 - 1e-5);
}

TEST_CASE("The heading wraps when the ray form corrects it", "[estimation]") {
  PoseBelief prior{{0.0, 0.0, 3.14}, Eigen::Matrix3d::Identity()};
  prior.covariance(0, 2) = prior.covariance(2, 0) = 0.9;
  const std::vector<RayObservation> hits{{{1.0, 0.0}, -0.5, 1.0}};
  const PoseBelief posterior = ray_update(prior, hits, 1, {});
  REQUIRE(posterior.pose.x_m > 0.1);
  REQUIRE(posterior.pose.yaw_rad < -2.0);
}

TEST_CASE("The more certain the map, the more a hit tells", "[estimation]") {
  double looser_m2 = std::numeric_limits<double>::infinity();
  for (const double p : {0.0, 0.25, 0.5, 0.75, 0.95}) {
    const std::vector<RayObservation> hits{{{1.0, 0.0}, 0.0, p}};
    const PoseBelief prior{{}, Eigen::Matrix3d::Identity()};
    const double variance_m2 = ray_update(prior, hits, 1, {}).covariance(0, 0);
    REQUIRE(variance_m2 < looser_m2);
    looser_m2 = variance_m2;
  }
}

TEST_CASE("The ray form refuses parameters outside of their bounds", "[estimation]") {
  REQUIRE_NOTHROW(RayUpdateParams{}.validate());
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    RayUpdateParams params;
    params.gamma = bad;
    REQUIRE_THROWS_AS(params.validate(), std::invalid_argument);
    params = {};
    params.dvl.occupied_m2 = bad;
    REQUIRE_THROWS_AS(params.validate(), std::invalid_argument);
  }
}
