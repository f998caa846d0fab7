#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "incognita/core/random.hpp"
#include "incognita/entropy/signed_relative_entropy.hpp"
#include "incognita/map/cell_sum.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/map.hpp"

using namespace incognita;
using Catch::Matchers::Contains;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Matrix2d random_covariance(Random& random) {
  Eigen::Matrix2d root;
  for (int i = 0; i < 4; ++i) root(i / 2, i % 2) = random.uniform(-1.0, 1.0);
  return std::pow(10.0, random.uniform(-2.0, 1.0)) * (root * root.transpose() + 0.05 * Eigen::Matrix2d::Identity());
}

/// The integral of P ln(P / Q) over the plane, in coordinates in which P is round, by the trapezium rule, which
/// converges beyond all powers for such integrands.
long double brute_force_divergence(const Eigen::Matrix2d& p, const Eigen::Matrix2d& q) {
  const long double a = std::sqrt(static_cast<long double>(p(0, 0)));
  const long double b = p(1, 0) / a;
  const long double c = std::sqrt(p(1, 1) - b * b);
  const long double det_q = static_cast<long double>(q(0, 0)) * q(1, 1) - static_cast<long double>(q(0, 1)) * q(1, 0);
  const long double log_scale = std::log(std::sqrt(det_q) / (a * c));
  const long double step = 0.1L;
  long double sum = 0;
  for (int i = -110; i <= 110; ++i) {
    for (int j = -110; j <= 110; ++j) {
      const long double u = i * step;
      const long double v = j * step;
      const long double x = a * u;
      const long double y = b * u + c * v;
      const long double square = (q(1, 1) * x * x - 2.0L * q(0, 1) * x * y + q(0, 0) * y * y) / det_q;
      const long double density = std::exp(-(u * u + v * v) / 2) / (2 * std::numbers::pi_v<long double>);
      sum += density * (log_scale - (u * u + v * v) / 2 + square / 2);
    }
  }
  return sum * step * step;
}

Map<Dispersion> empty_map(double resolution_m) {
  Dispersion::Params params;
  params.sigma_max_m = 0.3;
  return Map<Dispersion>({resolution_m, 0.5}, Dispersion(params));
}

}  // namespace

TEST_CASE("D-opt is the product of the principal variances, whichever way they lie", "[siren]") {
  for (const double angle : {0.0, 0.4, 1.2}) {
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const Eigen::Matrix2d covariance = turn * Eigen::Vector2d(9.0, 0.25).asDiagonal() * turn.transpose();
    REQUIRE(d_optimality(covariance) == Approx(1.5));
    REQUIRE(mean_sigma(covariance) == Approx(std::sqrt(1.5)));
  }
  REQUIRE(mean_sigma(Eigen::Matrix3d(Eigen::Vector3d(4.0, 4.0, 4e-4).asDiagonal())) == Approx(0.43089).epsilon(1e-5));  // (A.8)
  Eigen::Matrix2d rounded;  // symmetric but for rounding around 0
  rounded << 1.0, 1e-18, -1e-18, 1.0;
  REQUIRE(d_optimality(rounded) == Approx(1.0));
  REQUIRE_THROWS_WITH(d_optimality(Eigen::Matrix2d(Eigen::Matrix2d::Zero())), Contains("variance is 0"));
  REQUIRE_THROWS_WITH(d_optimality(Eigen::Matrix2d(Eigen::Matrix2d::Ones())), Contains("positive definite"));
  REQUIRE_THROWS_WITH(mean_sigma(Eigen::Matrix2d(Eigen::Matrix2d::Constant(kNan))), Contains("variance is nan"));
  REQUIRE_THROWS_WITH(d_optimality(Eigen::MatrixXd(0, 0)), Contains("columns is 0"));
}

TEST_CASE("The divergence of Gaussians is the integral", "[siren]") {
  Random random(1);
  for (int draw = 0; draw < 20; ++draw) {
    const Eigen::Matrix2d p = random_covariance(random);
    const Eigen::Matrix2d q = random_covariance(random);
    REQUIRE(relative_entropy_nats(p, q) == Approx(static_cast<double>(brute_force_divergence(p, q))).epsilon(1e-9).margin(1e-10));
    REQUIRE(relative_entropy_nats(p, p) == Approx(0.0).margin(1e-12));
    REQUIRE(signed_relative_entropy_nats(p, q) == (p.determinant() < q.determinant() ? 1.0 : -1.0) * relative_entropy_nats(p, q));
    // (21) takes the divergence of round Gaussians for that of others: never more than it.
    const double by_ratio = std::abs(signed_relative_entropy_nats_of_ratio(mean_sigma(p) / mean_sigma(q), 2));
    REQUIRE(by_ratio <= relative_entropy_nats(p, q) + 1e-12);
    const double scale = random.uniform(0.1, 3.0);
    const Eigen::Matrix2d proportional = scale * scale * q;
    REQUIRE(signed_relative_entropy_nats(proportional, q) == Approx(signed_relative_entropy_nats_of_ratio(scale, 2)).margin(1e-12));
  }
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  REQUIRE(signed_relative_entropy_nats(Eigen::Matrix3d(0.25 * unit), unit) == Approx(signed_relative_entropy_nats_of_ratio(0.5, 3)));
  REQUIRE_THROWS_WITH(relative_entropy_nats(Eigen::MatrixXd(Eigen::MatrixXd::Identity(2, 2)), Eigen::MatrixXd(Eigen::MatrixXd::Identity(3, 3))),
                      Contains("the size of p is 2"));
}

TEST_CASE("SiREn falls strictly with sigma, through 0 at what is tolerated", "[siren]") {
  for (const int dimension : {1, 2, 3}) {
    double before = std::numeric_limits<double>::infinity();
    for (double ratio = 0.01; ratio < 5.0; ratio *= 1.01) {
      const double value = signed_relative_entropy_nats_of_ratio(ratio, dimension);
      REQUIRE(value < before);
      REQUIRE((value > 0.0) == (ratio < 1.0));
      before = value;
      // The same by probabilities, p / beta = ratio^-N.
      REQUIRE(signed_relative_entropy_nats_of_probability(std::pow(ratio, -dimension), dimension) == Approx(value).margin(1e-12));
    }
    REQUIRE(signed_relative_entropy_nats_of_ratio(1.0, dimension) == 0.0);
    REQUIRE(signed_relative_entropy_nats_of_probability(1.0, dimension) == 0.0);
  }
  // (20)
  REQUIRE(signed_relative_entropy_nats_of_ratio(0.5, 1) == Approx(-std::log(0.5) + 0.5 * (0.25 - 1.0)));
  REQUIRE(signed_relative_entropy_nats_of_ratio(2.0, 1) == Approx(std::log(2.0) - 0.5 * 3.0));
}

TEST_CASE("With the exponent that is printed in (22) a divergence would be negative", "[siren]") {
  const double ratio = 0.9;
  const double printed = std::log(ratio) - 1.0 + std::pow(1.0 / ratio, 1.0 / 2.0);
  REQUIRE(printed == Approx(-0.051).margin(5e-4));
  const double corrected = std::log(ratio) - 1.0 + std::pow(1.0 / ratio, 2.0 / 2.0);
  REQUIRE(corrected > 0.0);
  REQUIRE(signed_relative_entropy_nats_of_probability(ratio, 2) == Approx(-corrected));
}

TEST_CASE("A map's SiREn is that of its cells, and follows it to the bit", "[siren]") {
  Random random(2);
  Map<Dispersion> map = empty_map(0.1);
  map.reserve({{-1.0, -1.0}, {1.0, 1.0}});
  REQUIRE(map.grid().size() > 100);
  REQUIRE(map_signed_relative_entropy_nats_m2(map) == 0.0);
  const SignedRelativeEntropy measure(0.01);
  CellSum<SignedRelativeEntropy> followed(map.lattice(), measure);
  for (int n = 0; n < 30; ++n) {
    Scan<2> scan(circular_beams(60, 4.0));
    for (std::size_t beam = 0; beam < scan.size(); ++beam) scan.set_range_m(beam, random.uniform(0.5, 4.5));
    const double sigma_m = random.uniform(0.01, 0.6);
    map.update(scan, {random.uniform(-6.0, 6.0), random.uniform(-6.0, 6.0), 0.3},
               Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, 1e-4).asDiagonal());
    followed.follow(map);
    double by_cells = 0.0;
    for (const Dispersion::State& state : map.grid().values()) {
      if (!state.is_explored) continue;
      by_cells += 0.01 * signed_relative_entropy_nats_of_probability(map.cell().dispersion_probability(state) / map.cell().beta(), 2);
    }
    REQUIRE(followed.value() == Approx(by_cells).margin(1e-6));
    REQUIRE(map_signed_relative_entropy_nats_m2(map) == Approx(by_cells).margin(1e-6));
  }
  CellSum<SignedRelativeEntropy> anew(map.lattice(), measure);
  anew.rebuild(map);
  REQUIRE(anew.value() == followed.value());

  // Room that nobody has seen does not count.
  const double before = map_signed_relative_entropy_nats_m2(map);
  map.reserve({{-30.0, -30.0}, {30.0, 30.0}});
  REQUIRE(map_signed_relative_entropy_nats_m2(map) == before);
  anew.rebuild(map);
  REQUIRE(anew.value() == followed.value());
}

TEST_CASE("Cells of half the side, four times as many, make the same SiREn", "[siren]") {
  double siren[2];
  for (const bool fine : {false, true}) {
    Map<Dispersion> map = empty_map(fine ? 0.05 : 0.1);
    for (int n = 0; n < 3; ++n) map.update(Scan<2>(circular_beams(1440, 5.0)), {}, Eigen::Vector3d(0.01, 0.01, 1e-6).asDiagonal());
    siren[fine ? 1 : 0] = map_signed_relative_entropy_nats_m2(map);
  }
  REQUIRE(siren[0] > 10.0);
  REQUIRE(siren[1] == Approx(siren[0]).epsilon(0.03));  // but for the rim
  REQUIRE(SignedRelativeEntropy(0.01)(Dispersion(), {}) == 0.0);
}

TEST_CASE("Signed relative entropy refuses what has no meaning", "[siren]") {
  REQUIRE_THROWS_WITH(SignedRelativeEntropy(0.0), Contains("cell_size is 0"));
  REQUIRE_THROWS_WITH(signed_relative_entropy_nats_of_ratio(0.0, 2), Contains("ratio is 0"));
  REQUIRE_THROWS_WITH(signed_relative_entropy_nats_of_ratio(1.0, 0), Contains("dimension is 0"));
  REQUIRE_THROWS_WITH(signed_relative_entropy_nats_of_probability(kNan, 2), Contains("ratio is nan"));
  REQUIRE_THROWS_WITH(signed_relative_entropy_nats_of_probability(1.0, -1), Contains("dimension is -1"));
}
