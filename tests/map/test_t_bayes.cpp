#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "incognita/core/random.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/testing/cell_policy_laws.hpp"

using namespace incognita;

namespace {

static_assert(sizeof(TBayes::State) <= 8);
static_assert(!std::is_convertible_v<TBayes::Params, TBayes>);

long double normal_density(long double residual, long double variance) {
  return std::exp(-residual * residual / (2.0L * variance)) /
         std::sqrt(2.0L * std::numbers::pi_v<long double> * variance);
}

/// (14) and (15) as printed, on both probabilities of a cell, normalised at each step.
struct BayesCell {
  long double occupied = 0.5L;
  long double unoccupied = 0.5L;
  int hits = 0;

  void update(bool is_hit, long double residual, long double pose_variance, const TBayes::Params& params) {
    if (is_hit) hits = std::min(hits + 1, params.hits_max);
    const long double weight_unoccupied = static_cast<long double>(hits) / params.hits_max;
    const long double weight_occupied = static_cast<long double>(params.hits_max - hits) / params.hits_max;
    occupied *= std::pow(normal_density(residual, pose_variance + params.dvl.occupied_m2), weight_occupied);
    unoccupied *=
        std::pow(normal_density(residual, pose_variance + params.dvl.unoccupied_m2), weight_unoccupied);
    const long double sum = occupied + unoccupied;
    occupied /= sum;
    unoccupied /= sum;
  }

  [[nodiscard]] double log_odds() const {
    return static_cast<double>(std::log(occupied) - std::log(unoccupied));
  }
};

float update(const TBayes& policy, TBayes::State& state, bool is_hit, double residual_m, double variance_m2,
             ScanStamp stamp) {
  const TBayes::Beam beam = policy.beam(variance_m2);
  if (is_hit) {
    policy.hit(state, beam, static_cast<float>(residual_m), stamp);
  } else {
    policy.pass(state, beam, static_cast<float>(residual_m), stamp);
  }
  return TBayes::log_odds(state);
}

/// What one pass or hit adds to a cell with log-odds 0.
double increment(const TBayes& policy, int hits, bool is_hit, double residual_m, double sigma_m) {
  TBayes::State state;
  state.hits = static_cast<std::uint8_t>(hits);
  return static_cast<double>(update(policy, state, is_hit, residual_m, sigma_m * sigma_m, 1));
}

/// Where a function that changes its sign once between low and high is 0.
template <class Function>
double root(double low, double high, Function&& function) {
  const bool rises = function(high) > 0.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    ((function(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TBayes::State saturated(float log_odds) { return {log_odds, 0, 3}; }

}  // namespace

TEST_CASE("Literal T-Bayes equals (15) from any state", "[map]") {
  Random random(1);
  for (int draw = 0; draw < 5000; ++draw) {
    TBayes::Params params = TBayes::literal_params();
    params.dvl.occupied_m2 = random.uniform(0.02, 1.0);
    params.dvl.unoccupied_m2 = params.dvl.occupied_m2 + random.uniform(0.1, 12.0);
    params.hits_max = 1 + static_cast<int>(random.index(8));
    const double variance_m2 = random.uniform() < 0.2 ? 0.0 : std::pow(10.0, random.uniform(-4.0, 1.0));
    const bool is_hit = random.uniform() < 0.5;
    const float residual_m = static_cast<float>(random.uniform(is_hit ? -2.0 : 0.0, is_hit ? 2.0 : 10.0));

    TBayes::State state;
    state.log_odds = static_cast<float>(random.uniform(-20.0, 20.0));
    state.hits = static_cast<std::uint8_t>(random.index(static_cast<std::uint64_t>(params.hits_max) + 1));
    BayesCell cell;
    const long double odds = std::exp(static_cast<long double>(state.log_odds));
    cell.occupied = odds / (1.0L + odds);
    cell.unoccupied = 1.0L / (1.0L + odds);
    cell.hits = state.hits;

    const double size = std::abs(static_cast<double>(state.log_odds));
    const double updated =
        static_cast<double>(update(TBayes(params), state, is_hit, residual_m, variance_m2, 1));
    cell.update(is_hit, residual_m, variance_m2, params);
    CAPTURE(draw, is_hit, residual_m, variance_m2, params.hits_max, cell.hits);
    REQUIRE(state.hits == cell.hits);
    REQUIRE(updated == Approx(cell.log_odds()).epsilon(1e-6).margin(1e-6 * (5.0 + size)));
  }
}

TEST_CASE("Literal T-Bayes equals (15) over sequences", "[map]") {
  Random random(2);
  const TBayes::Params params = TBayes::literal_params();
  const TBayes policy(params);
  for (int sequence = 0; sequence < 100; ++sequence) {
    TBayes::State state;
    BayesCell cell;
    double size = 0.0;
    for (int step = 0; step < 60; ++step) {
      const bool is_hit = random.uniform() < 0.2;
      const float residual_m =
          static_cast<float>(is_hit ? random.normal(0.0, 0.3) : random.uniform(0.0, 3.0));
      const double variance_m2 = std::pow(10.0, random.uniform(-4.0, 0.5));
      const double updated = static_cast<double>(
          update(policy, state, is_hit, residual_m, variance_m2, static_cast<ScanStamp>(step + 1)));
      cell.update(is_hit, residual_m, variance_m2, params);
      size += 5.0 + std::abs(cell.log_odds());
      REQUIRE(std::abs(updated - cell.log_odds()) <= 2e-7 * size);
    }
    REQUIRE(state.hits == cell.hits);
  }
}

TEST_CASE("A beam's constants are the likelihoods of (6) marginalised over the pose (13)", "[map]") {
  Random random(3);
  const DvlVariances dvl;
  for (int draw = 0; draw < 50; ++draw) {
    const double pose_variance_m2 = std::pow(10.0, random.uniform(-4.0, 1.0));
    const double residual_m = random.uniform(-3.0, 3.0);
    const TBayes::Beam beam = TBayes().beam(pose_variance_m2);
    // A robot on a line at x ~ N(0, pose_variance), a cell at 5 m: h = 5 - x. Simpson over 12 sigmas.
    const auto marginal = [&](double variance_m2) {
      const double sigma_m = std::sqrt(pose_variance_m2);
      const int steps = 4000;
      const double width_m = 24.0 * sigma_m / steps;
      long double sum = 0.0L;
      for (int i = 0; i <= steps; ++i) {
        const double x_m = -12.0 * sigma_m + i * width_m;
        const long double weight = i == 0 || i == steps ? 1.0L : (i % 2 == 1 ? 4.0L : 2.0L);
        sum += weight * normal_density(5.0 + residual_m - (5.0 - x_m), variance_m2) *
               normal_density(x_m, pose_variance_m2);
      }
      return static_cast<double>(std::log(sum * width_m / 3.0L));
    };
    const double r2 = residual_m * residual_m;
    REQUIRE(static_cast<double>(beam.occupied_offset) -
                r2 * static_cast<double>(beam.occupied_half_precision) ==
            Approx(marginal(dvl.occupied_m2)).epsilon(1e-5).margin(1e-5));
    REQUIRE(static_cast<double>(beam.unoccupied_offset) -
                r2 * static_cast<double>(beam.unoccupied_half_precision) ==
            Approx(marginal(dvl.unoccupied_m2)).epsilon(1e-5).margin(1e-5));
  }
}

TEST_CASE("The count of hits is raised before the update and stays at its maximum", "[map]") {
  const TBayes policy;
  TBayes::State state;
  // By hand for N = 1 of 3 and the paper's variances: -(1/3) ln(2 pi 0.1521) + (1/6) ln(2 pi 9) = 0.0151 +
  // 0.6725.
  REQUIRE(static_cast<double>(update(policy, state, true, 0.0, 0.0, 1)) == Approx(0.6876).margin(1e-4));
  for (int n = 1; n <= 6; ++n) {
    REQUIRE(static_cast<int>(state.hits) == std::min(n, 3));
    update(policy, state, true, 0.0, 0.0, static_cast<ScanStamp>(n + 1));
  }
  TBayes::Params params;
  params.hits_max = 255;
  TBayes::State many;
  for (int n = 1; n <= 600; ++n) update(TBayes(params), many, true, 0.0, 0.0, static_cast<ScanStamp>(n));
  REQUIRE(many.hits == 255);
}

TEST_CASE("A pass through a saturated cell raises it as printed and erodes it when robust", "[map]") {
  const TBayes literal(TBayes::literal_params());
  const TBayes robust;
  for (const double residual_m : {0.0, 0.7, 2.0, 9.0}) {
    const double raised = increment(literal, 3, false, residual_m, 0.0);
    REQUIRE(raised == Approx(2.02 + residual_m * residual_m / 18.0).margin(0.003));
    const double eroded = increment(robust, 3, false, residual_m, 0.0);
    REQUIRE(eroded == (residual_m > 0.6 ? Approx(-0.4).epsilon(1e-6) : Approx(0.0).margin(0.0)));
  }
}

TEST_CASE("As printed a pass raises what was hit once or twice, near the surface", "[map]") {
  const TBayes literal(TBayes::literal_params());
  const auto turns_at_m = [](const TBayes& policy, int hits) {
    return root(0.0, 5.0, [&](double residual_m) { return increment(policy, hits, false, residual_m, 0.0); });
  };
  REQUIRE(turns_at_m(literal, 1) == Approx(0.56).margin(0.005));
  REQUIRE(turns_at_m(literal, 2) == Approx(1.13).margin(0.005));
  // The robust rule takes the lowering part alone.
  const TBayes robust;
  for (const int hits : {0, 1, 2}) {
    for (double residual_m = 0.0; residual_m < 5.0; residual_m += 0.05) {
      const double printed = increment(literal, hits, false, residual_m, 0.1);
      REQUIRE(increment(robust, hits, false, residual_m, 0.1) == std::max(-20.0, std::min(0.0, printed)));
    }
  }
}

TEST_CASE("Robust T-Bayes erases ghosts, the printed rule keeps them", "[map]") {
  Random random(4);
  const TBayes robust;
  const TBayes literal(TBayes::literal_params());
  for (int ghost = 0; ghost < 50; ++ghost) {
    TBayes::State erased;
    TBayes::State kept;
    const auto hits = 3 + static_cast<int>(random.index(40));
    ScanStamp stamp = 0;
    for (int n = 0; n < hits; ++n) {
      ++stamp;
      const double residual_m = random.normal(0.0, 0.05);
      update(robust, erased, true, residual_m, 1e-4, stamp);
      update(literal, kept, true, residual_m, 1e-4, stamp);
    }
    const float before = TBayes::log_odds(kept);
    for (int n = 0; n < 40; ++n) {
      ++stamp;
      const double residual_m = random.uniform(1.0, 8.0);
      update(robust, erased, false, residual_m, 1e-4, stamp);
      update(literal, kept, false, residual_m, 1e-4, stamp);
    }
    REQUIRE(TBayes::log_odds(erased) < -1.0F);
    REQUIRE(TBayes::log_odds(kept) > before);
  }
}

TEST_CASE("A saturated cell erodes once a scan, not when that scan hit it, and starts again below 0",
          "[map]") {
  const TBayes policy;
  TBayes::State state = saturated(1.0F);
  for (int pass = 0; pass < 5; ++pass) update(policy, state, false, 4.0, 0.0, 1);
  REQUIRE(TBayes::log_odds(state) == 1.0F - 0.4F);
  update(policy, state, false, 4.0, 0.0, 2);
  REQUIRE(TBayes::log_odds(state) == Approx(0.2F));
  REQUIRE(state.hits == 3);
  update(policy, state, false, 4.0, 0.0, 3);
  REQUIRE(TBayes::log_odds(state) == Approx(-0.2F));
  REQUIRE(state.hits == 0);

  TBayes::State wall = saturated(1.0F);
  update(policy, wall, true, 0.0, 0.0, 7);
  const float hit = TBayes::log_odds(wall);
  REQUIRE(hit > 1.0F);
  for (int pass = 0; pass < 5; ++pass) update(policy, wall, false, 4.0, 0.0, 7);
  REQUIRE(TBayes::log_odds(wall) == hit);
}

TEST_CASE("A surface near for the pose's uncertainty is not eroded", "[map]") {
  const TBayes policy;
  for (const double sigma_m : {0.0, 0.1, 0.2, 0.5, 2.0}) {
    const double bound_m = std::max(0.6, 3.0 * sigma_m);
    REQUIRE(increment(policy, 3, false, bound_m - 1e-4, sigma_m) == 0.0);
    REQUIRE(increment(policy, 3, false, bound_m + 1e-4, sigma_m) == Approx(-0.4).epsilon(1e-6));
  }
}

TEST_CASE("Log-odds stay within their caps", "[map]") {
  const TBayes policy;
  TBayes::State high;
  TBayes::State low;
  for (ScanStamp stamp = 1; stamp < 50; ++stamp) {
    update(policy, high, true, 0.0, 0.0, stamp);
    update(policy, low, false, 8.0, 0.0, stamp);
  }
  REQUIRE(TBayes::log_odds(high) == 6.0F);
  REQUIRE(TBayes::log_odds(low) == -20.0F);
}

TEST_CASE("First hits turn negative above about 1 m of pose sigma (Fig. 5b)", "[map]") {
  const double sigma_m =
      root(0.1, 3.0, [](double sigma) { return increment(TBayes(), 0, true, 0.0, sigma); });
  // (1/6) ln(2 pi S_u) = (1/3) ln(2 pi S_o) is a quadratic in S_o: 2 pi S_o^2 = S_o + R_u - R_o.
  const double a = 2.0 * std::numbers::pi;
  const double occupied_m2 = (1.0 + std::sqrt(1.0 + 4.0 * a * (9.0 - 0.1521))) / (2.0 * a);
  REQUIRE(sigma_m == Approx(std::sqrt(occupied_m2 - 0.1521)).epsilon(1e-4));
  REQUIRE(sigma_m == Approx(1.0).margin(0.1));
  REQUIRE(increment(TBayes(), 0, true, 0.0, 0.1) > 0.5);
  REQUIRE(increment(TBayes(), 0, true, 0.0, 1.5) < 0.0);
}

TEST_CASE("An uncertain pose weakens passes of unknown cells where r^2 >= S", "[map]") {
  const TBayes literal(TBayes::literal_params());
  for (const double residual_m : {1.5, 3.0, 8.0}) {
    double weaker = -std::numeric_limits<double>::infinity();
    for (double sigma_m = 0.0; sigma_m * sigma_m + 0.1521 <= residual_m * residual_m; sigma_m += 0.05) {
      const double lowered = increment(literal, 0, false, residual_m, sigma_m);
      REQUIRE(lowered > weaker);
      weaker = lowered;
    }
    REQUIRE(weaker < 0.0);
  }
}

TEST_CASE("T-Bayes keeps the laws of a cell policy", "[map]") {
  CHECK(check_cell_policy_laws(TBayes()).text() == "");
  CHECK(check_cell_policy_laws(TBayes(TBayes::literal_params())).text() == "");
  TBayes::Params params;
  params.hits_max = 1;
  params.dvl = {0.01, 4.0};
  CHECK(check_cell_policy_laws(TBayes(params)).text() == "");
  params.hits_max = 255;
  params.erosion_log_odds = 0.0F;
  params.dvl.occupied_m2 = 1e-12;
  CHECK(check_cell_policy_laws(TBayes(params)).text() == "");
}

TEST_CASE("T-Bayes refuses parameters outside of their bounds", "[map]") {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const auto refuses = [](auto&& change) {
    TBayes::Params params;
    change(params);
    REQUIRE_THROWS_AS(TBayes(params), std::invalid_argument);
  };
  for (const int hits_max : {-1, 0, 256}) refuses([&](TBayes::Params& p) { p.hits_max = hits_max; });
  for (const float bad : {0.0F, 1.0F, kNan, -kInfinity})
    refuses([&](TBayes::Params& p) { p.log_odds_min = bad; });
  for (const float bad : {0.0F, -1.0F, kNan, kInfinity})
    refuses([&](TBayes::Params& p) { p.log_odds_max = bad; });
  for (const float bad : {-0.1F, kNan, kInfinity}) {
    refuses([&](TBayes::Params& p) { p.erosion_log_odds = bad; });
    refuses([&](TBayes::Params& p) { p.erosion_residual_m = static_cast<double>(bad); });
    refuses([&](TBayes::Params& p) { p.erosion_residual_sigmas = static_cast<double>(bad); });
  }
  refuses([](TBayes::Params& p) { p.dvl = {9.0, 9.0}; });
  refuses([](TBayes::Params& p) { p.dvl.occupied_m2 = 1e-13; });
  TBayes::Params params;
  params.hits_max = 0;
  REQUIRE_THROWS_WITH(TBayes(params), "TBayes: hits_max is 0, but must be in 1..255");
}
