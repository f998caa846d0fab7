/// Cells that take every pose for exact.
#pragma once

#include "incognita/map/cell_policy.hpp"

namespace incognita {

/// `Cell` with Sigma = 0, whatever the pose's covariance: the beam likelihood of (6) without the pose (B2 of Seo et al., section VI-B3, with
/// TBayes). States, bounds and laws are those of `Cell`.
template <CellPolicy Cell>
  requires(!PoseAwarePolicy<Cell>)
class ExactPose : public Cell {
 public:
  using Cell::Cell;
  /// The parameters of another cell.
  explicit ExactPose(const Cell& cell) : Cell(cell) {}

  /// That of a pose without variance.
  [[nodiscard]] typename Cell::Beam beam(double /*variance_m2*/) const { return Cell::beam(0.0); }
};

}  // namespace incognita
