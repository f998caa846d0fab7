#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "incognita/map/cells/log_odds.hpp"
#include "incognita/testing/cell_policy_laws.hpp"

using namespace incognita;

namespace {

static_assert(sizeof(LogOdds::State) <= 8);
static_assert(!std::is_convertible_v<LogOdds::Params, LogOdds>);

double probability(float log_odds) { return 1.0 / (1.0 + std::exp(-static_cast<double>(log_odds))); }

}  // namespace

TEST_CASE("Log-odds cells take a step for a hit and one for a pass", "[map]") {
  const LogOdds policy;
  LogOdds::State state;
  policy.hit(state, policy.beam(0.0), 0.0F, 1);
  REQUIRE(probability(LogOdds::log_odds(state)) == Approx(0.7).margin(0.001));
  policy.pass(state, policy.beam(0.0), 3.0F, 2);
  REQUIRE(LogOdds::log_odds(state) == 0.85F - 0.4F);

  LogOdds::State passed;
  policy.pass(passed, policy.beam(0.0), 3.0F, 1);
  REQUIRE(probability(LogOdds::log_odds(passed)) == Approx(0.4).margin(0.002));
}

TEST_CASE("Log-odds cells do not look at the residual or the pose", "[map]") {
  const LogOdds policy;
  for (const float residual_m : {-1.0F, 0.0F, 8.0F}) {
    LogOdds::State hit;
    LogOdds::State pass;
    policy.hit(hit, policy.beam(100.0), residual_m, 1);
    policy.pass(pass, policy.beam(100.0), residual_m, 1);
    REQUIRE(LogOdds::log_odds(hit) == 0.85F);
    REQUIRE(LogOdds::log_odds(pass) == -0.4F);
  }
}

TEST_CASE("Log-odds cells stay within their clamps and come back from them", "[map]") {
  LogOdds::Params params;
  params.log_odds_min = -1.5F;
  params.log_odds_max = 2.5F;
  const LogOdds policy(params);
  LogOdds::State state;
  for (ScanStamp stamp = 1; stamp < 20; ++stamp) policy.hit(state, {}, 0.0F, stamp);
  REQUIRE(LogOdds::log_odds(state) == 2.5F);
  policy.pass(state, {}, 1.0F, 20);
  REQUIRE(LogOdds::log_odds(state) == 2.5F - 0.4F);
  for (ScanStamp stamp = 21; stamp < 60; ++stamp) policy.pass(state, {}, 1.0F, stamp);
  REQUIRE(LogOdds::log_odds(state) == -1.5F);
}

TEST_CASE("What a scan hit its passes leave alone, when hits win", "[map]") {
  for (const bool hits_win : {true, false}) {
    LogOdds::Params params;
    params.hits_win = hits_win;
    const LogOdds policy(params);
    LogOdds::State state;
    policy.hit(state, {}, 0.0F, 4);
    for (int pass = 0; pass < 3; ++pass) policy.pass(state, {}, 1.0F, 4);
    REQUIRE(LogOdds::log_odds(state) == Approx(hits_win ? 0.85F : 0.85F - 3 * 0.4F));
    // Two beams of one scan that end in the cell both count.
    policy.hit(state, {}, 0.0F, 5);
    policy.hit(state, {}, 0.0F, 5);
    REQUIRE(LogOdds::log_odds(state) == Approx(hits_win ? 3 * 0.85F : 3 * 0.85F - 3 * 0.4F));
    policy.pass(state, {}, 1.0F, 6);
    REQUIRE(LogOdds::log_odds(state) == Approx(hits_win ? 3 * 0.85F - 0.4F : 3 * 0.85F - 4 * 0.4F));
  }
}

TEST_CASE("Log-odds cells keep the laws of a cell policy", "[map]") {
  CHECK(check_cell_policy_laws(LogOdds()).text() == "");
  LogOdds::Params params;
  params.hits_win = false;
  params.log_odds_max = 1e-3F;
  params.pass = -100.0F;
  CHECK(check_cell_policy_laws(LogOdds(params)).text() == "");
}

TEST_CASE("Log-odds cells refuse parameters outside of their bounds", "[map]") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto refuses = [](float LogOdds::Params::*field, float value) {
    LogOdds::Params params;
    params.*field = value;
    REQUIRE_THROWS_AS(LogOdds(params), std::invalid_argument);
  };
  for (const float bad : {0.0F, -1.0F, kNan, kInfinity}) {
    refuses(&LogOdds::Params::hit, bad);
    refuses(&LogOdds::Params::log_odds_max, bad);
  }
  for (const float bad : {0.0F, 1.0F, kNan, -kInfinity}) {
    refuses(&LogOdds::Params::pass, bad);
    refuses(&LogOdds::Params::log_odds_min, bad);
  }
  LogOdds::Params params;
  params.pass = 0.5F;
  REQUIRE_THROWS_WITH(LogOdds(params), "LogOdds: pass is 0.5, but must be finite and < 0");
}
