/// The laws of CellPolicy as a check that any test can call, for the library's policies and for a user's.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string_view>

#include "incognita/core/random.hpp"
#include "incognita/map/cell_policy.hpp"
#include "incognita/testing/law_report.hpp"

namespace incognita {

/// Checks the laws on the page of CellPolicy, and of ClearingPolicy, PriorPolicy and OncePolicy where it is one (map/cell_policy.hpp), on fixed seeded
/// sequences of hits and passes, with residuals up to 100 m and poses from exact to a variance of 100 m^2, and on 20,000 equal
/// updates in a row. A policy that passes may still break a law on another sequence.
template <CellPolicy Policy>
[[nodiscard]] LawReport check_cell_policy_laws(const Policy& policy) {
  using State = typename Policy::State;
  LawReport report;
  const auto check_finite = [&report](const State& state, std::string_view sequence, int step) {
    const float log_odds = Policy::log_odds(state);
    if (std::isfinite(log_odds)) return true;
    std::ostringstream text;
    text << "log-odds stay finite: " << log_odds << " after " << step + 1 << " updates, " << sequence;
    report.check(false, text.str());
    return false;
  };

  // States are compared by what they do: their bytes may hold padding.
  const auto check_ignored = [&report, &policy](const State& state, double variance_m2, float residual_m,
                                                ScanStamp stamp) {
    if (!policy.ignores_passes(state)) return true;
    const auto beam = policy.beam(variance_m2);
    State left = state;
    State passed = state;
    policy.pass(passed, beam, residual_m, stamp);
    bool same = Policy::log_odds(left) == Policy::log_odds(passed);
    for (int hit = 0; hit < 4; ++hit) {
      for (State* const cell : {&left, &passed}) {
        policy.hit(*cell, beam, 0.0F, stamp);
        policy.pass(*cell, beam, residual_m, static_cast<ScanStamp>(stamp + 1));
      }
      same = same && Policy::log_odds(left) == Policy::log_odds(passed);
    }
    report.check(same, "a pass leaves a state for which ignores_passes holds as it is");
    return same;
  };

  const State unknown{};
  report.check(Policy::log_odds(unknown) == 0.0F, "a new cell has log-odds 0");

  const auto exact = policy.beam(0.0);
  State hit{};
  policy.hit(hit, exact, 0.0F, 1);
  report.check(Policy::log_odds(hit) > 0.0F, "a hit at an exact pose with residual 0 raises an unknown cell");
  State passed{};
  policy.pass(passed, exact, 5.0F, 1);
  report.check(Policy::log_odds(passed) < 0.0F, "a pass 5 m before the surface lowers an unknown cell");

  for (const double variance_m2 : {0.0, 1.0}) {
    const auto beam = policy.beam(variance_m2);
    for (const float residual_m : {0.0F, 0.3F, 100.0F}) {
      State hits{};
      State passes{};
      bool hits_finite = true;
      bool passes_finite = true;
      bool ignored = true;
      for (int step = 0; step < 20000; ++step) {
        const auto stamp = static_cast<ScanStamp>(step + 1);
        policy.hit(hits, beam, residual_m, stamp);
        policy.pass(passes, beam, residual_m, stamp);
        hits_finite = hits_finite && check_finite(hits, "hits alone", step);
        passes_finite = passes_finite && check_finite(passes, "passes alone", step);
        ignored = ignored && check_ignored(passes, variance_m2, residual_m, stamp);
      }
    }
  }

  if constexpr (ClearingPolicy<Policy>) {
    Random random(9);
    bool same = true;
    for (int draw = 0; draw < 4000 && same; ++draw) {
      const double variance_m2 = std::pow(10.0, random.uniform(-8.0, 2.0));
      const auto beam = policy.beam(variance_m2);
      const float least_m = policy.clearing_residual_m(beam);
      const float residual_m = least_m * static_cast<float>(draw % 2 == 0 ? 1.0 : random.uniform(1.0, 10.0));
      if (!std::isfinite(residual_m)) continue;  // nothing is cleared
      State left = policy.cleared();
      State far_passed{};
      policy.pass(far_passed, beam, residual_m, 1);
      same = policy.ignores_passes(left) && Policy::log_odds(left) == Policy::log_odds(far_passed);
      for (int next = 0; next < 6; ++next) {
        const auto stamp = static_cast<ScanStamp>(2 + next);
        for (State* const cell : {&left, &far_passed}) {
          policy.hit(*cell, beam, 0.0F, stamp);
          policy.pass(*cell, beam, residual_m, static_cast<ScanStamp>(stamp + next % 2));
        }
        same = same && Policy::log_odds(left) == Policy::log_odds(far_passed);
      }
    }
    report.check(same, "a pass of a new cell at clearing_residual_m or beyond leaves a cleared one, which ignores passes");
  }

  if constexpr (PriorPolicy<Policy>) {
    report.check(Policy::log_odds(policy.state_of_log_odds(0.0F)) == 0.0F, "a prior of 0 is unknown");
    const float least = Policy::log_odds(policy.state_of_log_odds(-std::numeric_limits<float>::infinity()));
    const float most = Policy::log_odds(policy.state_of_log_odds(std::numeric_limits<float>::infinity()));
    report.check(std::isfinite(least) && std::isfinite(most) && least < 0.0F && most > 0.0F, "priors beyond doubt are bounded");
    Random random(11);
    bool is_kept = true;
    bool is_new = true;
    for (int draw = 0; draw < 2000; ++draw) {
      const auto given = static_cast<float>(random.uniform(-1.2, 1.2)) * (draw % 2 == 0 ? 1.0F : 30.0F);
      State state = policy.state_of_log_odds(given);
      const float held = Policy::log_odds(state);
      is_kept = is_kept && std::abs(held - std::clamp(given, least, most)) <= 0.002F;
      is_kept = is_kept && Policy::log_odds(policy.state_of_log_odds(held)) == held;
      const auto stamp = static_cast<ScanStamp>(1 + draw);
      static_cast<void>(check_ignored(state, 0.01, 1.0F, stamp));
      State renewed = state;
      policy.forget_stamp(renewed);
      for (State* const cell : {&state, &renewed}) {
        policy.hit(*cell, exact, 0.0F, stamp);
        policy.pass(*cell, exact, 1.0F, static_cast<ScanStamp>(stamp + 1));
      }
      is_new = is_new && Policy::log_odds(state) == Policy::log_odds(renewed);
    }
    report.check(is_kept, "a prior's log-odds are those given, within the policy's bounds and steps");
    report.check(is_new, "a prior has no stamp");
  }

  if constexpr (OncePolicy<Policy>) {
    Random random(10);
    bool same = true;
    State state{};
    for (ScanStamp stamp = 1; stamp <= 400; ++stamp) {
      const auto beam = policy.beam(std::pow(10.0, random.uniform(-8.0, 2.0)));
      const auto update = [&] {
        const auto residual_m = static_cast<float>(random.uniform(-0.5, 10.0));
        if (random.uniform() < 0.3) {
          policy.hit(state, beam, residual_m, stamp);
        } else {
          policy.pass(state, beam, residual_m, stamp);
        }
      };
      update();
      const float first = Policy::log_odds(state);
      update();
      same = same && Policy::log_odds(state) == first;
    }
    report.check(same, "a cell takes one update a scan");
  }

  const Policy copy = policy;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    State state{};
    State twin{};
    bool finite = true;
    bool equal = true;
    bool keeps = true;
    bool renews = true;
    bool ignored = true;
    ScanStamp stamp = 1;
    for (int step = 0; step < 2000; ++step) {
      const double variance_m2 = std::pow(10.0, random.uniform(-8.0, 2.0));
      const bool is_hit = random.uniform() < 0.3;
      const float residual_m = static_cast<float>(
          is_hit ? random.normal(0.0, 1.0) : (random.uniform() < 0.9 ? random.uniform(-0.5, 10.0) : 100.0));
      if (random.uniform() < 0.5) ++stamp;
      const auto update = [&](const Policy& with, State& cell) {
        const auto beam = with.beam(variance_m2);
        if (is_hit) {
          with.hit(cell, beam, residual_m, stamp);
        } else {
          with.pass(cell, beam, residual_m, stamp);
        }
      };
      update(policy, state);
      update(copy, twin);
      finite = finite && check_finite(state, "hits and passes", step);
      equal = equal && Policy::log_odds(state) == Policy::log_odds(twin);

      ignored = ignored && check_ignored(state, variance_m2, std::abs(residual_m), stamp);

      State forgetful = state;
      policy.forget_stamp(forgetful);
      keeps = keeps && Policy::log_odds(forgetful) == Policy::log_odds(state);
      // The stamp that the cell has just seen must now mean no more to it than one that it never saw.
      State other = forgetful;
      policy.pass(forgetful, policy.beam(0.0), 5.0F, stamp);
      policy.pass(other, policy.beam(0.0), 5.0F, static_cast<ScanStamp>(stamp + 1));
      renews = renews && Policy::log_odds(forgetful) == Policy::log_odds(other);
    }
    if (!finite) continue;
    report.check(equal, "equal sequences give equal states");
    report.check(keeps, "forget_stamp leaves the log-odds as they are");
    report.check(renews, "forget_stamp makes every stamp new");
  }
  return report;
}

}  // namespace incognita
