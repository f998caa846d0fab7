#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "incognita/core/random.hpp"
#include "incognita/geometry/principal_axes.hpp"

using namespace incognita;

namespace {

template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

template <int Dim>
Matrix<Dim> random_symmetric(Random& random, double scale) {
  Matrix<Dim> root;
  for (int i = 0; i < Dim * Dim; ++i) root(i) = scale * random.normal(0.0, 1.0);
  return root + root.transpose();
}

template <int Dim>
void check(const Matrix<Dim>& matrix) {
  const PrincipalAxes<Dim> found = principal_axes<Dim>(matrix);
  const Eigen::SelfAdjointEigenSolver<Matrix<Dim>> expected(matrix);
  const double scale = std::max(matrix.cwiseAbs().maxCoeff(), 1e-300);
  CAPTURE(matrix, found.values, found.axes, expected.eigenvalues());
  REQUIRE((found.values - expected.eigenvalues()).cwiseAbs().maxCoeff() < 1e-14 * scale * Dim);
  REQUIRE((found.axes.transpose() * found.axes - Matrix<Dim>::Identity()).cwiseAbs().maxCoeff() < 1e-14);
  const Matrix<Dim> again = found.axes * found.values.asDiagonal() * found.axes.transpose();
  REQUIRE((again - matrix).cwiseAbs().maxCoeff() < 2e-14 * scale);
}

template <int Dim>
void check_many() {
  Random random(Dim);
  for (int draw = 0; draw < 3000; ++draw) {
    check<Dim>(random_symmetric<Dim>(random, std::pow(10.0, random.uniform(-8.0, 8.0))));
    // Thin in one direction, as the points of a wall are.
    Matrix<Dim> points = Matrix<Dim>::Zero();
    for (int n = 0; n < 5; ++n) {
      Eigen::Matrix<double, Dim, 1> at;
      for (int axis = 0; axis < Dim; ++axis) at[axis] = random.normal(0.0, axis == 0 ? 1e-6 : 1.0);
      points += at * at.transpose();
    }
    check<Dim>(points);
    const Matrix<Dim> turn = principal_axes<Dim>(random_symmetric<Dim>(random, 1.0)).axes;
    check<Dim>(turn * points * turn.transpose());
  }
  check<Dim>(Matrix<Dim>::Zero());
  check<Dim>(Matrix<Dim>::Identity());
  check<Dim>(Matrix<Dim>::Ones());
  check<Dim>(-3.0 * Matrix<Dim>::Ones());
  Matrix<Dim> graded = Matrix<Dim>::Identity();
  graded(0, 0) = 1e12;
  graded(0, 1) = graded(1, 0) = 1e3;
  check<Dim>(graded);
}

}  // namespace

TEST_CASE("Principal axes equal Eigen's in the plane", "[geometry]") { check_many<2>(); }

TEST_CASE("Principal axes equal Eigen's in space", "[geometry]") { check_many<3>(); }
