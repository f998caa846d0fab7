/// The eigenvalues and eigenvectors of a small symmetric matrix, without the parsing time of Eigen's solvers.
#pragma once

#include <cmath>
#include <utility>

#include <Eigen/Core>

namespace incognita {

/// values[i] belongs to axes.col(i), of length 1 and of either sign; smallest first.
template <int Dim>
struct PrincipalAxes {
  Eigen::Matrix<double, Dim, 1> values;  ///< the eigenvalues, in the unit of the matrix
  Eigen::Matrix<double, Dim, Dim> axes;  ///< one a column
};

/// The principal axes of a symmetric matrix by Jacobi's rotations, to rounding. The matrix must be finite.
template <int Dim>
[[nodiscard]] PrincipalAxes<Dim> principal_axes(Eigen::Matrix<double, Dim, Dim> matrix) {
  constexpr int sweeps_max = Dim == 2 ? 1 : 50;  // one rotation makes two by two diagonal; else they converge quadratically
  PrincipalAxes<Dim> result;
  result.axes.setIdentity();
  bool is_diagonal = false;
  for (int sweep = 0; sweep < sweeps_max && !is_diagonal; ++sweep) {
    is_diagonal = true;
    for (int p = 0; p < Dim; ++p) {
      for (int q = p + 1; q < Dim; ++q) {
        const double off = matrix(p, q);
        if (matrix(p, p) + off == matrix(p, p) && matrix(q, q) + off == matrix(q, q)) continue;
        is_diagonal = false;
        // The smaller of the two angles that make the entry (p, q) zero.
        const double cotangent = (matrix(q, q) - matrix(p, p)) / (2.0 * off);
        const double tangent = std::copysign(1.0, cotangent) / (std::abs(cotangent) + std::hypot(cotangent, 1.0));
        const double cosine = 1.0 / std::hypot(tangent, 1.0);
        const double sine = tangent * cosine;
        matrix(p, p) -= tangent * off;
        matrix(q, q) += tangent * off;
        matrix(p, q) = matrix(q, p) = 0.0;
        for (int k = 0; k < Dim; ++k) {
          const double axis_p = result.axes(k, p);
          const double axis_q = result.axes(k, q);
          result.axes(k, p) = cosine * axis_p - sine * axis_q;
          result.axes(k, q) = sine * axis_p + cosine * axis_q;
          if (k == p || k == q) continue;
          const double entry_p = matrix(k, p);
          const double entry_q = matrix(k, q);
          matrix(k, p) = matrix(p, k) = cosine * entry_p - sine * entry_q;
          matrix(k, q) = matrix(q, k) = sine * entry_p + cosine * entry_q;
        }
      }
    }
  }
  for (int i = 0; i < Dim; ++i) result.values[i] = matrix(i, i);
  for (int i = 1; i < Dim; ++i) {
    for (int j = i; j > 0 && result.values[j] < result.values[j - 1]; --j) {
      std::swap(result.values[j], result.values[j - 1]);
      for (int k = 0; k < Dim; ++k) std::swap(result.axes(k, j), result.axes(k, j - 1));
    }
  }
  return result;
}

}  // namespace incognita
