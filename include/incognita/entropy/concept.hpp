/// The concept of an entropy of one binary cell: what a user writes to bring a measure of uncertainty of
/// their own.
#pragma once

#include <concepts>

namespace incognita {

/// A measure of the uncertainty of one cell that is occupied with probability p and free with probability 1 -
/// p: measure(p), in nats, for p in [0, 1]. Any copyable value will do, a lambda too.
///
/// Laws that the compiler cannot see, and check_entropy_laws (testing/entropy_laws.hpp) does:
/// - certain is zero: measure(0) = measure(1) = 0;
/// - finite and never negative;
/// - symmetric: measure(p) = measure(1 - p), to rounding;
/// - greatest at p = 1/2, where it is positive;
/// - a function: the same p gives the same bits, from a copy as well.
///
/// A call is const and safe from several threads at once. It need not be fast: the exploration calls an
/// EntropyTable that is filled from the measure once.
template <class Measure>
concept EntropyMeasure = requires(const Measure& measure, double p) {
  { measure(p) } -> std::same_as<double>;
  // Asked last, because a constructor that is constrained by this concept would ask again.
  requires std::copy_constructible<Measure>;
};

}  // namespace incognita
