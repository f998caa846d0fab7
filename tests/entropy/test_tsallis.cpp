#include <numbers>

#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/tsallis.hpp"
#include "reference.hpp"

using incognita::Renyi;
using incognita::Tsallis;

TEST_CASE("Tsallis equals its formula to 1e-12, next to q = 1 too", "[entropy]") {
  reference::require_rows<Tsallis>(std::array<reference::Row, 11>{{
      {0.2,
       {1.2499999999999904e-60, 0.0049763396316687142, 0.4951239027686538, 0.89644125086432558,
        0.92637640824031034, 0.078869418060377728}},
      {0.5,
       {2.0e-150, 1.999999e-6, 0.18997487421323991, 0.76876516807848332, 0.8284271247461901,
        0.0019989999997787268}},
      {1 - 1e-6,
       {6.9201416825900258e-298, 2.8631402856107962e-11, 0.056001640442971908, 0.61086456401351852,
        0.69314742078650778, 1.4815605492967367e-5}},
      {1 - 1e-9,
       {6.9177576648367688e-298, 2.8631021497664704e-11, 0.0560015344609353, 0.61086430231685198,
        0.69314718080017181, 1.4815510153795546e-5}},
      {1.0,
       {6.9177552789821372e-298, 2.8631021115928048e-11, 0.056001534354847341, 0.61086430205489345,
        0.69314718055994531, 1.4815510058361382e-5}},
      {1 + 1e-9,
       {6.9177528931283395e-298, 2.8631020734191356e-11, 0.056001534248759371, 0.6108643017929349,
        0.69314718031971878, 1.4815509962927208e-5}},
      {1 + 1e-6,
       {6.9153699741009795e-298, 2.8630639382780025e-11, 0.056001428267048336, 0.61086404009645352,
        0.69314694033349387, 1.4815414624634388e-5}},
      {1.9999,
       {2.0001000100010001e-300, 2.0001000099989972e-12, 0.019800948998680587, 0.42001368757725648,
        0.50001534297410912, 2.00009800862586e-6}},
      {2.0,
       {2.0000000000000001e-300, 1.999999999998e-12, 0.0198, 0.41999999999999999, 0.5,
        1.9999980000575112e-6}},
      {3.0, {1.5e-300, 1.4999999999985e-12, 0.01485, 0.31499999999999999, 0.375, 1.4999985000431334e-6}},
      {50.0,
       {1.0204081632653061e-300, 1.0204081632403061e-12, 0.0080611006706625175, 0.02040816289827244,
        0.020408163265306086, 1.0203831636946425e-6}},
  }});
}

TEST_CASE("Tsallis keeps the laws", "[entropy]") { reference::require_laws<Tsallis>(); }

TEST_CASE("Tsallis at its edges", "[entropy]") { reference::require_edges<Tsallis>(); }

TEST_CASE("Tsallis is non-increasing in q", "[entropy]") {
  reference::require_non_increasing_in_parameter<Tsallis>();
}

TEST_CASE("Tsallis is (1 - 2^(1-q)) / (q - 1) at most", "[entropy]") {
  for (const double q : {0.05, 0.2, 0.5, 2.0, 3.0, 50.0}) {
    REQUIRE(Tsallis(q)(0.5) == Approx((1.0 - std::exp2(1.0 - q)) / (q - 1.0)).epsilon(1e-12));
  }
  REQUIRE(Tsallis(0.2)(0.5) > std::numbers::ln2);
  REQUIRE(Tsallis(2.0)(0.5) < std::numbers::ln2);
}

TEST_CASE("Tsallis and Renyi are functions of one another", "[entropy]") {
  for (const double q : {0.2, 0.9, 1.0 + 1e-6, 1.5, 3.0}) {
    for (const double p : {1e-9, 0.01, 0.25, 0.5, 0.75}) {
      REQUIRE(Renyi(q)(p) == Approx(std::log1p((1.0 - q) * Tsallis(q)(p)) / (1.0 - q)).epsilon(1e-12));
    }
  }
}

TEST_CASE("Tsallis is Gini's 2 p (1 - p) at q = 2, and does not overflow for large q", "[entropy]") {
  for (const double p : {0.01, 0.1, 0.25, 0.5, 0.75}) {
    REQUIRE(Tsallis(2.0)(p) == Approx(2.0 * p * (1.0 - p)).epsilon(1e-13));
  }
  REQUIRE(Tsallis(1e300)(0.3) == Approx(1e-300).epsilon(1e-12));
}
