/// Axis-aligned boxes, half open: a box holds its lower corner and not its upper one.
#pragma once

#include <Eigen/Core>

#include "incognita/geometry/vector.hpp"

namespace incognita {

/// The set {x : lower <= x < upper}, per axis. `Vector` is an Eigen column of coordinates (metres) or of cell indices.
/// Empty unless lower < upper on every axis.
template <class Vector>
struct Box {
  Vector lower = zero<Vector>();
  Vector upper = zero<Vector>();

  [[nodiscard]] bool empty() const {
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      if (!(lower[axis] < upper[axis])) return true;
    }
    return false;
  }

  [[nodiscard]] Vector extent() const { return difference(upper, lower); }

  friend bool operator==(const Box& a, const Box& b) {
    return equal(a.lower, b.lower) && equal(a.upper, b.upper);
  }

  /// For archives of states, see docs/mission_file.md.
  template <class Archive>
  void archive_state(Archive& archive) {
    archive(lower, upper);
  }

  /// This box with `margin` more on every side.
  [[nodiscard]] Box padded(typename Vector::Scalar margin) const {
    Box larger = *this;
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      larger.lower[axis] -= margin;
      larger.upper[axis] += margin;
    }
    return larger;
  }

  /// Moves the faces as little as makes `x` lie between them or on one.
  void stretch_to(const Vector& x) {
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      if (x[axis] < lower[axis]) lower[axis] = x[axis];
      if (x[axis] > upper[axis]) upper[axis] = x[axis];
    }
  }

  [[nodiscard]] bool contains(const Vector& x) const {
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      if (!(lower[axis] <= x[axis] && x[axis] < upper[axis])) return false;
    }
    return true;
  }

  /// True when every point of `other` is in this box; an empty box is inside every other.
  [[nodiscard]] bool contains(const Box& other) const {
    if (other.empty()) return true;
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      if (!(lower[axis] <= other.lower[axis] && other.upper[axis] <= upper[axis])) return false;
    }
    return true;
  }
};

/// The smallest box that holds both; an empty one adds nothing.
template <class Vector>
[[nodiscard]] Box<Vector> enclosing_box(const Box<Vector>& a, const Box<Vector>& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  Box<Vector> both = a;
  both.stretch_to(b.lower);
  both.stretch_to(b.upper);
  return both;
}

}  // namespace incognita
