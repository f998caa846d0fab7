/// Arithmetic of columns by coefficient. Eigen's operators say the same, but each kind of expression is a class of its own
/// that every program pays for which includes it: code that is compiled whether it is called or not uses these.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace incognita {

/// A matrix or column of zeros.
template <class Matrix>
[[nodiscard]] Matrix zero() {
  Matrix result;
  for (int row = 0; row < Matrix::RowsAtCompileTime; ++row) {
    for (int column = 0; column < Matrix::ColsAtCompileTime; ++column) result(row, column) = 0;
  }
  return result;
}

/// a + b.
template <class Vector>
[[nodiscard]] Vector sum(const Vector& a, const Vector& b) {
  Vector result;
  for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) result[axis] = a[axis] + b[axis];
  return result;
}

/// a - b.
template <class Vector>
[[nodiscard]] Vector difference(const Vector& a, const Vector& b) {
  Vector result;
  for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) result[axis] = a[axis] - b[axis];
  return result;
}

/// factor * vector.
template <class Vector>
[[nodiscard]] Vector scaled(const Vector& vector, typename Vector::Scalar factor) {
  Vector result;
  for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) result[axis] = factor * vector[axis];
  return result;
}

/// matrix * vector, for a square matrix.
template <class Matrix, class Vector>
[[nodiscard]] Vector product(const Matrix& matrix, const Vector& vector) {
  Vector result;
  for (int row = 0; row < Vector::RowsAtCompileTime; ++row) {
    result[row] = matrix(row, 0) * vector[0];
    for (int column = 1; column < Vector::RowsAtCompileTime; ++column) {
      result[row] += matrix(row, column) * vector[column];
    }
  }
  return result;
}

/// a^T b, in the units of both.
template <class Vector>
[[nodiscard]] double dot(const Vector& a, const Vector& b) {
  double result = a[0] * b[0];
  for (int axis = 1; axis < Vector::RowsAtCompileTime; ++axis) result += a[axis] * b[axis];
  return result;
}

/// Whether all coordinates are, to the bit.
template <class Vector>
[[nodiscard]] bool equal(const Vector& a, const Vector& b) {
  for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
    if (a[axis] != b[axis]) return false;
  }
  return true;
}

/// The length of a vector, in the unit of its coordinates.
template <class Vector>
[[nodiscard]] double norm(const Vector& vector) {
  return std::sqrt(dot(vector, vector));
}

/// How far apart two points are, in the unit of their coordinates.
template <class Vector>
[[nodiscard]] double distance(const Vector& a, const Vector& b) {
  return norm(difference(a, b));
}

}  // namespace incognita
