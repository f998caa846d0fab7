/// Axis-aligned boxes, half open: a box holds its lower corner and not its upper one.
#pragma once

#include <string>
#include <string_view>

#include <Eigen/Core>

#include "incognita/core/error.hpp"
#include "incognita/geometry/vector.hpp"

namespace incognita {

/// The set {x : lower <= x < upper}, per axis. `Vector` is an Eigen column of coordinates (metres) or of cell indices.
/// Empty unless lower < upper on every axis.
template <class Vector>
struct Box {
  Vector lower = zero<Vector>();  ///< belongs to the box
  Vector upper = zero<Vector>();  ///< does not

  /// Whether it holds no point: an axis along which upper is not above lower.
  [[nodiscard]] bool empty() const {
    for (int axis = 0; axis < Vector::RowsAtCompileTime; ++axis) {
      if (!(lower[axis] < upper[axis])) return true;
    }
    return false;
  }

  [[nodiscard]] Vector extent() const { return difference(upper, lower); }  ///< upper - lower, along each axis

  /// When both corners are equal; two empty boxes may differ.
  friend bool operator==(const Box& a, const Box& b) {
    return equal(a.lower, b.lower) && equal(a.upper, b.upper);
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
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

  /// Whether lower <= x < upper along each axis.
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

/// "(0, 0) to (4, 2)", for messages.
template <class Vector>
[[nodiscard]] std::string box_text(const Box<Vector>& box) {
  return tuple_text(box.lower) + " to " + tuple_text(box.upper);
}

/// Throws std::invalid_argument, with both boxes, unless that of `field` is that of `other`.
template <class Vector>
void require_equal_boxes(std::string_view where, std::string_view field, const Box<Vector>& box, std::string_view other,
                         const Box<Vector>& other_box) {
  if (box == other_box) return;
  throw_invalid(where, "the box of " + std::string(field), box_text(box), "that of " + std::string(other) + ", " + box_text(other_box));
}

}  // namespace incognita
