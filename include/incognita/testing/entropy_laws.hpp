/// The laws of EntropyMeasure as a check that any test can call, for the library's measures and for a user's.
#pragma once

#include <cmath>
#include <sstream>
#include <string_view>

#include "incognita/entropy/concept.hpp"
#include "incognita/testing/law_report.hpp"

namespace incognita {

/// Checks the laws on the page of EntropyMeasure (entropy.hpp) at fixed probabilities: powers of two from
/// 2^-1000, 511 equal steps, and their mirror images where 1 - p has no rounding. Values are compared within
/// 1e-12 of the greatest. A measure that passes may still break a law in between.
template <EntropyMeasure Measure>
[[nodiscard]] LawReport check_entropy_laws(const Measure& measure) {
  LawReport report;
  const auto at = [](std::string_view law, double p) {
    std::ostringstream text;
    text << law << " at p = " << p;
    return text.str();
  };

  const double greatest_nats = measure(0.5);
  report.check(std::isfinite(greatest_nats) && greatest_nats > 0.0, at("finite and > 0", 0.5));
  report.check(measure(0.0) == 0.0, at("zero", 0.0));
  report.check(measure(1.0) == 0.0, at("zero", 1.0));

  const double tolerance_nats = 1e-12 * std::abs(greatest_nats);
  const Measure copy = measure;
  const auto check_at = [&](double p) {
    const double entropy_nats = measure(p);
    report.check(std::isfinite(entropy_nats) && entropy_nats >= 0.0, at("finite and >= 0", p));
    report.check(entropy_nats <= greatest_nats + tolerance_nats, at("at most the value at 1/2", p));
    report.check(measure(p) == entropy_nats && copy(p) == entropy_nats, at("the same each time", p));
    const double mirrored = 1.0 - p;
    if (1.0 - mirrored == p) {
      report.check(std::abs(measure(mirrored) - entropy_nats) <= tolerance_nats, at("symmetric", p));
    }
  };
  for (int exponent = -1000; exponent < -60; exponent += 20) check_at(std::ldexp(1.0, exponent));
  for (int exponent = -60; exponent < -10; ++exponent) check_at(std::ldexp(1.0, exponent));
  for (int step = 1; step < 512; ++step) check_at(step / 1024.0);
  return report;
}

}  // namespace incognita
