#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "incognita/core/random.hpp"
#include "incognita/map/dispersion_probability.hpp"

namespace {

using Catch::Matchers::Contains;
using incognita::dispersion_log_odds;
using incognita::dispersion_probability;
using incognita::dispersion_probability_of_samples;
using incognita::Random;
using Real = long double;

template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

constexpr Real kPi = std::numbers::pi_v<Real>;

/// Composite Gauss-Legendre of five points.
Real quadrature(const std::function<Real(Real)>& f, Real low, Real high, int panels) {
  const Real root = std::sqrt(Real{10} / 7);
  const Real near = std::sqrt(5 - 2 * root) / 3;
  const Real far = std::sqrt(5 + 2 * root) / 3;
  const Real near_weight = (322 + 13 * std::sqrt(Real{70})) / 900;
  const Real far_weight = (322 - 13 * std::sqrt(Real{70})) / 900;
  const Real half = (high - low) / (2 * panels);
  Real sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const Real middle = low + half * (2 * panel + 1);
    sum += Real{128} / 225 * f(middle) + near_weight * (f(middle - near * half) + f(middle + near * half)) +
           far_weight * (f(middle - far * half) + f(middle + far * half));
  }
  return sum * half;
}

/// Of two dimensions, by another way than the library's: what correlation adds to the product of the marginals is, by Plackett's
/// identity dP/dr = sum of densities at the corners, with r = tanh v, an integral over a smooth positive function of v.
Real reference(const Matrix<2>& covariance, const Vector<2>& sides) {
  const Real sigma_x = std::sqrt(Real{covariance(0, 0)});
  const Real sigma_y = std::sqrt(Real{covariance(1, 1)});
  const Real h = sides[0] / (2 * sigma_x);
  const Real k = sides[1] / (2 * sigma_y);
  const Real correlation = std::abs(Real{covariance(0, 1)}) / (sigma_x * sigma_y);
  const auto added = [&](Real v) {
    const Real c = std::cosh(v);
    const Real s = std::sinh(v);
    return std::exp(-((h - k) * (h - k) * c * c / 2 + h * k * c * std::exp(-v))) * -std::expm1(-2 * h * k * s * c) / (kPi * c);
  };
  return std::erf(h / std::sqrt(Real{2})) * std::erf(k / std::sqrt(Real{2})) + quadrature(added, 0, std::atanh(correlation), 1500);
}

/// Of three dimensions by brute force over the density, for boxes that are not much wider than the narrowest axis.
Real brute_force(const Matrix<3>& covariance, const Vector<3>& sides) {
  const Matrix<3>& s = covariance;
  const Real determinant = Real{s(0, 0)} * (Real{s(1, 1)} * s(2, 2) - Real{s(1, 2)} * s(2, 1)) -
                           Real{s(0, 1)} * (Real{s(1, 0)} * s(2, 2) - Real{s(1, 2)} * s(2, 0)) +
                           Real{s(0, 2)} * (Real{s(1, 0)} * s(2, 1) - Real{s(1, 1)} * s(2, 0));
  const auto inverse = [&](int i, int j) {
    const int a = (i + 1) % 3;
    const int b = (i + 2) % 3;
    const int c = (j + 1) % 3;
    const int d = (j + 2) % 3;
    return (Real{s(a, c)} * s(b, d) - Real{s(a, d)} * s(b, c)) / determinant;
  };
  Eigen::Matrix<Real, 3, 3> information;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) information(i, j) = inverse(i, j);
  }
  const Real scale = 1 / std::sqrt(8 * kPi * kPi * kPi * determinant);
  const auto over = [&](int axis, const auto& f) { return quadrature(f, -sides[axis] / Real{2}, sides[axis] / Real{2}, 16); };
  return scale * over(0, [&](Real x) {
           return over(1, [&](Real y) {
             return over(2, [&](Real z) {
               const Eigen::Matrix<Real, 3, 1> at(x, y, z);
               return std::exp(-at.dot(information * at) / 2);
             });
           });
         });
}

void require_close(double value, Real expected) {
  INFO("value " << value << ", expected " << expected);
  REQUIRE(std::abs(value - expected) < 1e-10L);
  REQUIRE(std::abs(value - expected) < 1e-6L * expected);
}

TEST_CASE("One dimension is the error function", "[dispersion]") {
  for (const double ratio : {1e-6, 1e-3, 0.3, 1.0, 4.0, 20.0}) {
    const Matrix<1> covariance(0.04);
    require_close(dispersion_probability<1>(covariance, Vector<1>(0.2 * ratio)),
                  std::erf(Real{0.5} * ratio / std::sqrt(Real{2})));
  }
}

TEST_CASE("Two dimensions agree with Plackett's identity", "[dispersion]") {
  Random random(3);
  for (int draw = 0; draw < 200; ++draw) {
    const double sigma_x = std::pow(10.0, random.uniform(-2.0, 2.0));
    const double sigma_y = sigma_x * std::pow(10.0, random.uniform(-2.0, 2.0));
    const double closeness = std::pow(10.0, random.uniform(-9.0, 0.0));  // to a correlation of 1
    const double covariance = (draw % 2 == 0 ? 1.0 : -1.0) * (1.0 - closeness) * sigma_x * sigma_y;
    Matrix<2> matrix;
    matrix << sigma_x * sigma_x, covariance, covariance, sigma_y * sigma_y;
    const Vector<2> sides(sigma_x * std::pow(10.0, random.uniform(-6.0, 1.0)), sigma_y * std::pow(10.0, random.uniform(-6.0, 1.0)));
    INFO("sigmas " << sigma_x << ", " << sigma_y << "; 1 - |correlation| " << closeness << "; sides " << sides.transpose());
    require_close(dispersion_probability<2>(matrix, sides), reference(matrix, sides));
  }
}

TEST_CASE("Three dimensions agree with brute force over the density", "[dispersion]") {
  Random random(4);
  for (int draw = 0; draw < 6; ++draw) {
    Matrix<3> factor;
    for (int i = 0; i < 9; ++i) factor(i / 3, i % 3) = random.uniform(-1.0, 1.0);
    const Matrix<3> covariance = factor * factor.transpose() + 0.05 * Matrix<3>::Identity();
    const double size = draw < 2 ? 1e-6 : (draw < 4 ? 0.3 : 2.0);
    const Vector<3> sides(size, 0.7 * size, 1.3 * size);
    require_close(dispersion_probability<3>(covariance, sides), brute_force(covariance, sides));
  }
}

TEST_CASE("Three dimensions, of which one is independent, are a product", "[dispersion]") {
  Random random(5);
  for (int draw = 0; draw < 40; ++draw) {
    const double correlation = 1.0 - std::pow(10.0, random.uniform(-6.0, 0.0));
    Matrix<2> pair;
    pair << 1.0, correlation, correlation, 1.0;
    const Vector<2> sides(std::pow(10.0, random.uniform(-6.0, 1.0)), std::pow(10.0, random.uniform(-6.0, 1.0)));
    const double side = std::pow(10.0, random.uniform(-6.0, 1.0));
    const Real expected = reference(pair, sides) * std::erf(Real{0.5} * side / std::sqrt(Real{2}));
    for (int alone = 0; alone < 3; ++alone) {  // at each place
      Matrix<3> covariance = Matrix<3>::Identity();
      covariance((alone + 1) % 3, (alone + 2) % 3) = covariance((alone + 2) % 3, (alone + 1) % 3) = correlation;
      Vector<3> box;
      box[alone] = side;
      box[(alone + 1) % 3] = sides[0];
      box[(alone + 2) % 3] = sides[1];
      INFO("correlation " << correlation << ", sides " << box.transpose());
      require_close(dispersion_probability<3>(covariance, box), expected);
    }
  }
}

TEST_CASE("Three dimensions that are nearly one line are one dimension", "[dispersion]") {
  Random random(6);
  for (const double closeness : {1e-3, 1e-5, 1e-7}) {
    const Vector<3> slopes(1.0, 0.5, 2.0);
    const Matrix<3> covariance = slopes * slopes.transpose() + closeness * closeness * Matrix<3>::Identity();
    // |x| < 0.4, |x / 2| < 0.35 and |2 x| < 0.6: the last decides
    const double p = dispersion_probability<3>(covariance, Vector<3>(0.8, 0.7, 1.2));
    REQUIRE(p == Approx(std::erf(0.3 / std::numbers::sqrt2)).epsilon(2.0 * closeness + 1e-7));
  }
}

TEST_CASE("Wide boxes of three dimensions that hang together are no harder than others", "[dispersion]") {
  // A tolerance below rounding made this take ten seconds.
  Matrix<3> covariance;
  covariance << 1.0, 0.979, 0.972, 0.979, 1.0, 0.904, 0.972, 0.904, 1.0;
  double before = 0.0;
  for (const double side : {3.3, 6.6, 9.9, 13.0}) {
    const double p = dispersion_probability<3>(covariance, Vector<3>::Constant(side));
    Matrix<2> pair;
    pair << 1.0, 0.904, 0.904, 1.0;
    const double marginal = std::erf(0.5 * side / std::numbers::sqrt2);
    REQUIRE(p > before);
    REQUIRE(p <= dispersion_probability<2>(pair, Vector<2>::Constant(side)) + 1e-10);  // one condition more
    REQUIRE(p >= std::pow(marginal, 3));                                               // Sidak's inequality
    before = p;
  }
  int calls = 0;
  const double integral = incognita::integrate(
      [&](double x) {
        ++calls;
        return std::exp(-x * x);
      },
      -3.0, 3.0, 1e-18);
  REQUIRE(integral == Approx(std::sqrt(std::numbers::pi) * std::erf(3.0)).epsilon(1e-14));
  REQUIRE(calls < 2000);
}

TEST_CASE("The example of Appendix A.2", "[dispersion]") {
  const Matrix<3> tolerated = Vector<3>(4.0, 4.0, 4e-4).asDiagonal();
  const Vector<3> sides(0.1, 0.1, 0.002);
  REQUIRE(dispersion_probability<3>(tolerated, sides) == Approx(1.5863e-5).epsilon(1e-4));
  REQUIRE(dispersion_log_odds<3>(tolerated, sides) == Approx(-11.051).epsilon(1e-4));
}

TEST_CASE("Dispersion probability falls as uncertainty grows", "[dispersion]") {
  Random random(7);
  for (int draw = 0; draw < 200; ++draw) {
    Matrix<2> factor;
    for (int i = 0; i < 4; ++i) factor(i / 2, i % 2) = random.uniform(-1.0, 1.0);
    const Matrix<2> covariance = factor * factor.transpose() + 1e-4 * Matrix<2>::Identity();
    const double growth = random.uniform(1.01, 3.0);
    const Vector<2> sides(random.uniform(0.01, 2.0), random.uniform(0.01, 2.0));
    const double before = dispersion_probability<2>(covariance, sides);
    const double after = dispersion_probability<2>(growth * covariance, sides);
    REQUIRE(after < before);
    REQUIRE(after > 0.0);
    REQUIRE(before <= 1.0);
  }
}

TEST_CASE("Log-odds keep their digits where the probability is 1 to a double", "[dispersion]") {
  for (const double half_side : {0.5, 3.0, 7.0, 12.0}) {
    const Real inside = std::erf(Real{half_side} / std::sqrt(Real{2}));
    const Real outside = std::erfc(Real{half_side} / std::sqrt(Real{2}));
    const auto expected = static_cast<double>(std::log(inside / outside));
    REQUIRE(dispersion_log_odds<1>(Matrix<1>(1.0), Vector<1>(2.0 * half_side)) == Approx(expected).epsilon(1e-12));
    // Both sides must hold: the mass outside is that of two, less what is counted twice.
    const auto expected2 = static_cast<double>(std::log(inside * inside / (outside * (2 - outside))));
    REQUIRE(dispersion_log_odds<2>(Matrix<2>::Identity(), Vector<2>::Constant(2.0 * half_side)) ==
            Approx(expected2).epsilon(1e-10));
    const auto expected3 =
        static_cast<double>(std::log(inside * inside * inside / (outside * (3 - 3 * outside + outside * outside))));
    REQUIRE(dispersion_log_odds<3>(Matrix<3>::Identity(), Vector<3>::Constant(2.0 * half_side)) ==
            Approx(expected3).epsilon(1e-9));
  }
  REQUIRE(dispersion_probability<2>(Matrix<2>::Identity(), Vector<2>::Constant(1e-170)) > 0.0);
  REQUIRE(dispersion_log_odds<2>(1e-12 * Matrix<2>::Identity(), Vector<2>::Constant(1.0)) <= 700.0);
}

TEST_CASE("Samples of a Gaussian, and of a distribution that is none", "[dispersion]") {
  Random random(8);
  constexpr int kCount = 200000;
  Eigen::Matrix<double, 2, Eigen::Dynamic> samples(2, kCount);
  const Vector<2> mean(3.0, -1.0);
  for (int i = 0; i < kCount; ++i) {
    const double x = random.normal();
    samples.col(i) = mean + Vector<2>(0.3 * x, 0.2 * x + 0.1 * random.normal());
  }
  Matrix<2> covariance;
  covariance << 0.09, 0.06, 0.06, 0.05;
  const Vector<2> sides(0.5, 0.3);
  const double exact = dispersion_probability<2>(covariance, sides);
  const double error = std::sqrt(exact * (1.0 - exact) / kCount);
  REQUIRE(std::abs(dispersion_probability_of_samples<2>(samples, mean, sides) - exact) < 4.0 * error);

  for (int i = 0; i < kCount; ++i) samples.col(i) = Vector<2>(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  REQUIRE(dispersion_probability_of_samples<2>(samples, Vector<2>::Zero(), Vector<2>(1.0, 0.5)) == Approx(0.125).margin(0.004));
}

TEST_CASE("Gaussians and boxes that are none are refused", "[dispersion]") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Vector<2> sides(0.1, 0.1);
  const auto covariance = [](double xx, double xy, double yx, double yy) {
    Matrix<2> matrix;
    matrix << xx, xy, yx, yy;
    return matrix;
  };
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(1.0, 1.0, 1.0, 1.0), sides), Contains("positive definite"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(1.0, 2.0, 2.0, 1.0), sides), Contains("positive definite"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(1.0, 0.1, 0.0, 1.0), sides), Contains("symmetric"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(1.0, kNan, kNan, 1.0), sides), Contains("nan"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(kNan, 0.0, 0.0, 1.0), sides), Contains("variance is nan"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(covariance(0.0, 0.0, 0.0, 1.0), sides), Contains("variance is 0"));
  REQUIRE_THROWS_WITH(dispersion_probability<2>(Matrix<2>::Identity(), Vector<2>(0.1, 0.0)), Contains("a side of the box is 0"));
  REQUIRE_THROWS_WITH(dispersion_log_odds<2>(Matrix<2>::Identity(), Vector<2>(-0.1, 1.0)), Contains("a side of the box is -0.1"));
  REQUIRE_THROWS_WITH(dispersion_probability_of_samples<1>(Eigen::Matrix<double, 1, Eigen::Dynamic>(1, 0), Vector<1>(0.0), Vector<1>(1.0)),
                      Contains("the number of samples is 0"));
  REQUIRE_THROWS_WITH(
      dispersion_probability_of_samples<1>(Eigen::Matrix<double, 1, Eigen::Dynamic>::Constant(1, 2, kNan), Vector<1>(0.0), Vector<1>(1.0)),
      Contains("finite"));
}

}  // namespace
