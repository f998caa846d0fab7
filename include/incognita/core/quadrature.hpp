/// Integrals over an interval to a stated error.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace incognita {

namespace detail {

struct QuadraturePanel {
  double integral;
  double error;
};

/// The 15-point rule of Gauss and Kronrod over [low, high]; the error is its difference from the 7-point rule inside it.
template <class Integrand>
[[nodiscard]] QuadraturePanel gauss_kronrod(Integrand& integrand, double low, double high) {
  static constexpr std::array<double, 8> nodes{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                               0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                               0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
                                               0.207784955007898467600689403773245, 0.0};
  static constexpr std::array<double, 8> weights{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                                 0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                                 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                                 0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr std::array<double, 4> inner_weights{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                                       0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  const double middle = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  const double at_middle = integrand(middle);
  double sum = weights[7] * at_middle;
  double inner_sum = inner_weights[3] * at_middle;
  for (std::size_t i = 0; i < 7; ++i) {
    const double both = integrand(middle - half * nodes[i]) + integrand(middle + half * nodes[i]);
    sum += weights[i] * both;
    if (i % 2 == 1) inner_sum += inner_weights[i / 2] * both;
  }
  return {half * sum, half * std::abs(sum - inner_sum)};
}

template <class Integrand>
[[nodiscard]] double integrate_panel(Integrand& integrand, double low, double high, const QuadraturePanel& panel,
                                     double tolerance, int halvings_left) {
  // Below the second bound the error is that of rounding, which halving does not lessen.
  if (panel.error <= std::max(tolerance, 1e-14 * std::abs(panel.integral)) || halvings_left == 0) return panel.integral;
  const double middle = 0.5 * (low + high);
  const QuadraturePanel left = gauss_kronrod(integrand, low, middle);
  const QuadraturePanel right = gauss_kronrod(integrand, middle, high);
  return integrate_panel(integrand, low, middle, left, 0.5 * tolerance, halvings_left - 1) +
         integrate_panel(integrand, middle, high, right, 0.5 * tolerance, halvings_left - 1);
}

}  // namespace detail

/// The integral of `integrand` over [low, high], halving the interval until the estimated error is below
/// `relative_tolerance` of the first estimate, `absolute_tolerance`, or rounding, at most 24 times. A feature that none of the 15 points of
/// an interval meets goes unseen: split the interval where one is known. The interval may be of any unit; the integral, and with it
/// absolute_tolerance, is in its unit times the integrand's, and relative_tolerance is a ratio.
template <class Integrand>
[[nodiscard]] double integrate(Integrand&& integrand, double low, double high, double relative_tolerance,
                               double absolute_tolerance = 0.0) {
  const detail::QuadraturePanel whole = detail::gauss_kronrod(integrand, low, high);
  const double tolerance = std::max(absolute_tolerance, relative_tolerance * std::abs(whole.integral));
  return detail::integrate_panel(integrand, low, high, whole, tolerance, 24);
}

}  // namespace incognita
