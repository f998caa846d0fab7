/// The differential variance likelihood (DVL) of one beam and one cell.
#pragma once

#include <cmath>
#include <numbers>

#include "incognita/core/error.hpp"

namespace incognita {

/// The two variances of the DVL, Seo et al., (6): a reading z is N(z; h(x, m), occupied_m2) when the cell is occupied
/// and N(z; h(x, m), unoccupied_m2) when it is not. The paper's bound "5 R_o <= R_u <= 15 R_o" holds for its standard
/// deviations (0.39 m and 3 m), not for variances, so only occupied < unoccupied is required here.
struct DvlVariances {
  double occupied_m2 = 0.39 * 0.39;  ///< R_o
  double unoccupied_m2 = 3.0 * 3.0;  ///< R_u

  /// Throws std::invalid_argument unless 0 < occupied_m2 < unoccupied_m2, finite.
  void validate() const {
    require_positive("DvlVariances", "occupied_m2", occupied_m2);
    require(std::isfinite(unoccupied_m2) && unoccupied_m2 > occupied_m2, "DvlVariances", "unoccupied_m2",
            unoccupied_m2, "finite and > occupied_m2");
  }

  /// For archives of states, see docs/mission_file.md. Throws what the archive throws.
  template <class Fields>
  void list_fields(Fields& fields) const {
    fields("occupied_m2, unoccupied_m2", occupied_m2, unoccupied_m2);
  }
};

/// The natural logarithm of the normal density with variance `variance_m2` at `residual_m`, in ln(1/m).
[[nodiscard]] inline double log_normal_density(double residual_m, double variance_m2) {
  return -0.5 * (std::log(2.0 * std::numbers::pi * variance_m2) + residual_m * residual_m / variance_m2);
}

/// How the two Gaussians of a cell of uncertain occupancy are made one.
enum class MixtureVariance {
  squared_weights,  ///< p^2 R_o + (1 - p)^2 R_u: Seo et al., (10), as printed
  moment_match,     ///< p R_o + (1 - p) R_u: the variance of the mixture
  occupied_only     ///< R_o whatever p: the decoupled baseline, which takes the map for certain
};

/// The measurement variance R_x of a beam that ends in a cell occupied with probability p, in m^2; Seo et al., (10).
/// Note that the printed form is half of the mixture's variance at p = 1/2 and dips below R_o near p = 0.98.
[[nodiscard]] inline double measurement_variance_m2(
    const DvlVariances& dvl, double probability, MixtureVariance rule = MixtureVariance::squared_weights) {
  const double p = probability;
  const double q = 1.0 - p;
  if (rule == MixtureVariance::occupied_only) return dvl.occupied_m2;
  if (rule == MixtureVariance::moment_match) return p * dvl.occupied_m2 + q * dvl.unoccupied_m2;
  return p * p * dvl.occupied_m2 + q * q * dvl.unoccupied_m2;
}

}  // namespace incognita
