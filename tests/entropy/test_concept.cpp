#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "incognita/entropy.hpp"
#include "incognita/entropy/concept.hpp"
#include "incognita/testing/entropy_laws.hpp"

namespace {

using incognita::check_entropy_laws;
using incognita::EntropyMeasure;

// What is a measure.
static_assert(EntropyMeasure<incognita::Shannon>);
static_assert(EntropyMeasure<incognita::Renyi>);
static_assert(EntropyMeasure<incognita::Tsallis>);
static_assert(EntropyMeasure<incognita::Behavioral>);
static_assert(EntropyMeasure<double (*)(double)>);
constexpr auto kGini = [](double p) { return 2.0 * p * (1.0 - p); };
static_assert(EntropyMeasure<decltype(kGini)>);

// What is none: tables and values of log-odds, other results, calls that change the measure, no copy.
static_assert(!EntropyMeasure<incognita::EntropyTable>);
static_assert(!EntropyMeasure<double>);
static_assert(!EntropyMeasure<float (*)(float)>);
static_assert(!EntropyMeasure<double (*)(double, double)>);
struct ChangesWhenCalled {
  double operator()(double p) { return calls += p; }
  double calls = 0.0;
};
static_assert(!EntropyMeasure<ChangesWhenCalled>);
struct CannotBeCopied {
  double operator()(double p) const { return p; }
  std::unique_ptr<int> owned;
};
static_assert(!EntropyMeasure<CannotBeCopied>);

// A parameter is never taken for a measure by accident.
static_assert(!std::is_convertible_v<double, incognita::Renyi>);
static_assert(!std::is_convertible_v<double, incognita::Tsallis>);
static_assert(!std::is_convertible_v<double, incognita::Behavioral>);

bool mentions(const incognita::LawReport& report, const std::string& law) {
  return report.text().find(law) != std::string::npos;
}

}  // namespace

TEST_CASE("A user's measure passes the check of the laws", "[entropy]") {
  REQUIRE(check_entropy_laws(kGini).holds());
  const double scale = 3.0;
  REQUIRE(check_entropy_laws([scale](double p) { return scale * std::min(p, 1.0 - p); }).holds());
}

TEST_CASE("The check of the laws catches a wrong entropy", "[entropy]") {
  SECTION("the textbook form is NaN at 0 and 1") {
    REQUIRE(
        mentions(check_entropy_laws([](double p) { return -p * std::log(p) - (1 - p) * std::log(1 - p); }),
                 "zero at p = 0"));
  }
  SECTION("one outcome forgotten") {
    REQUIRE(
        mentions(check_entropy_laws([](double p) { return p > 0.0 ? -p * std::log(p) : 0.0; }), "symmetric"));
  }
  SECTION("the sign forgotten") {
    REQUIRE(mentions(check_entropy_laws([](double p) { return -2.0 * p * (1.0 - p); }), "finite and >= 0"));
  }
  SECTION("not zero where certain") {
    REQUIRE(mentions(check_entropy_laws([](double p) { return 0.1 + p * (1.0 - p); }), "zero at p = 1"));
  }
  SECTION("greatest elsewhere") {
    const auto two_humps = [](double p) {
      const double s = std::sin(2.0 * std::numbers::pi * p);
      return p > 0.0 && p < 1.0 ? s * s + 0.1 * std::min(p, 1.0 - p) : 0.0;
    };
    REQUIRE(mentions(check_entropy_laws(two_humps), "at most the value at 1/2"));
  }
  SECTION("a hidden state") {
    int calls = 0;
    const auto drifting = [&calls](double p) { return 2.0 * p * (1.0 - p) * (1.0 + 1e-14 * ++calls); };
    REQUIRE(mentions(check_entropy_laws(drifting), "the same each time"));
  }
}
