/// Shannon entropy of a binary cell.
#pragma once

#include "incognita/entropy/binary_cell.hpp"

namespace incognita {

/// -p ln p - (1 - p) ln(1 - p), in nats; ln 2 at p = 1/2. The entropy of Seo et al. for alpha = 1.
struct Shannon {
  /// In nats, for p in [0, 1], else NaN. Within 1e-15 relative.
  [[nodiscard]] double operator()(double p) const {
    return detail::entropy_of_binary_cell(p, [](double minor, double minor_surprise, double major_surprise) {
      return minor * minor_surprise + (1.0 - minor) * major_surprise;
    });
  }

  friend bool operator==(const Shannon&, const Shannon&) = default;  ///< always: there is one
};

}  // namespace incognita
