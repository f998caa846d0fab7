#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "incognita/map/cell_policy.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/testing/cell_policy_laws.hpp"

using namespace incognita;

namespace {

static_assert(CellPolicy<TBayes>);
static_assert(CellPolicy<LogOdds>);

/// A policy of one's own, the plainest there is: counts of hits and passes.
struct Counting {
  struct State {
    std::uint16_t hits = 0;
    std::uint16_t passes = 0;
  };
  struct Beam {};
  Beam beam(double) const { return {}; }
  void hit(State& state, const Beam&, float, ScanStamp) const {
    if (state.hits < 1000) ++state.hits;
  }
  void pass(State& state, const Beam&, float, ScanStamp) const {
    if (state.passes < 1000) ++state.passes;
  }
  bool ignores_passes(const State& state) const { return state.passes == 1000; }
  void forget_stamp(State&) const {}
  static float log_odds(const State& state) {
    return std::log(1.0F + state.hits) - std::log(1.0F + state.passes);
  }
};
static_assert(CellPolicy<Counting>);

// What is none: each breaks one requirement of Counting, and that one alone.
struct LargeState : Counting {
  struct State : Counting::State {
    double more = 0.0;
  };
};
static_assert(!CellPolicy<LargeState>);
struct OwningState : Counting {
  struct State : Counting::State {
    State() = default;
    State(const State& other) : Counting::State(other) {}
  };
};
static_assert(!CellPolicy<OwningState>);
struct NoDefaultState : Counting {
  struct State : Counting::State {
    explicit State(int) {}
  };
};
static_assert(!CellPolicy<NoDefaultState>);
struct CannotBeCopied : Counting {
  std::unique_ptr<int> owned;
};
static_assert(!CellPolicy<CannotBeCopied>);
struct AnswersHits : Counting {
  bool hit(State&, const Beam&, float, ScanStamp) const { return true; }
};
static_assert(!CellPolicy<AnswersHits>);
struct ChangesWhenPassed : Counting {
  void pass(State&, const Beam&, float, ScanStamp) { ++passes; }
  int passes = 0;
};
static_assert(!CellPolicy<ChangesWhenPassed>);
struct DoubleLogOdds : Counting {
  static double log_odds(const State&) { return 0.0; }
};
static_assert(!CellPolicy<DoubleLogOdds>);
struct NeedsItselfForLogOdds : Counting {
  float log_odds(const State&) const { return 0.0F; }
};
static_assert(!CellPolicy<NeedsItselfForLogOdds>);
struct RemembersForEver : Counting {
  void forget_stamp(State&) const = delete;
};
static_assert(!CellPolicy<RemembersForEver>);
struct AnswersNoQuestion : Counting {
  void ignores_passes(const State&) const {}
};
static_assert(!CellPolicy<AnswersNoQuestion>);
struct OtherBeam : Counting {
  int beam(double) const { return 0; }
};
static_assert(!CellPolicy<OtherBeam>);
static_assert(!CellPolicy<int>);
static_assert(!CellPolicy<TBayes::State>);

/// LogOdds with one law broken.
struct Wrong {
  struct State {
    float log_odds = 0.0F;
    ScanStamp hit_by = 0;
  };
  struct Beam {};
  Beam beam(double) const { return {}; }
  void hit(State& state, const Beam&, float, ScanStamp stamp) const {
    state.hit_by = stamp;
    state.log_odds = std::min(10.0F, state.log_odds + 1.0F);
  }
  void pass(State& state, const Beam&, float, ScanStamp stamp) const {
    if (state.hit_by != stamp) state.log_odds = std::max(-10.0F, state.log_odds - 0.5F);
  }
  bool ignores_passes(const State& state) const { return state.log_odds == -10.0F; }
  void forget_stamp(State& state) const { state.hit_by = 0; }
  static float log_odds(const State& state) { return state.log_odds; }
};
struct KnownFromTheStart : Wrong {
  static float log_odds(const State& state) { return state.log_odds + 0.01F; }
};
struct HitLowers : Wrong {
  void hit(State& state, const Beam&, float, ScanStamp) const { state.log_odds = -1.0F; }
};
struct PassRaises : Wrong {
  void pass(State& state, const Beam&, float, ScanStamp) const { state.log_odds = 1.0F; }
};
struct DoublesWithoutBound : Wrong {
  void hit(State& state, const Beam&, float, ScanStamp) const {
    state.log_odds = 2.0F * state.log_odds + 1.0F;
  }
};
struct DividesByTheResidual : Wrong {
  void pass(State& state, const Beam&, float residual_m, ScanStamp) const {
    state.log_odds = std::max(-10.0F, state.log_odds - 1.0F / (residual_m * residual_m));
    state.log_odds += 0.0F * (1.0F / residual_m);
  }
};
struct HiddenCount : Wrong {
  void pass(State& state, const Beam&, float, ScanStamp) const {
    state.log_odds = -static_cast<float>(1 + ++*calls % 7);
  }
  std::shared_ptr<int> calls = std::make_shared<int>(0);
};
struct IgnoresTooEarly : Wrong {
  bool ignores_passes(const State& state) const { return state.log_odds <= -9.0F; }
};
struct CountsWhatItIgnores : Wrong {
  void hit(State& state, const Beam& beam, float residual_m, ScanStamp) const {
    if (state.hit_by % 2 == 0) Wrong::hit(state, beam, residual_m, 0);
  }
  void pass(State& state, const Beam&, float, ScanStamp) const {
    state.log_odds = std::max(-10.0F, state.log_odds - 0.5F);
    ++state.hit_by;  // seen by no log-odds, but by the next hit
  }
};
struct ForgetsTooMuch : Wrong {
  void forget_stamp(State& state) const { state = {}; }
};
struct ForgetsNothing : Wrong {
  void forget_stamp(State&) const {}
};

struct ClearsTooEarly : TBayes {
  float clearing_residual_m(const Beam& beam) const { return 0.9F * TBayes::clearing_residual_m(beam); }
};
struct ClearsToAnother : TBayes {
  State cleared() const { return {params().log_odds_min, 0, 1}; }
};
static_assert(ClearingPolicy<TBayes> && ClearingPolicy<ClearsTooEarly>);
static_assert(!ClearingPolicy<LogOdds> && !ClearingPolicy<Counting>);

struct CountsBeams : Wrong {
  static constexpr bool once_a_scan = true;
};
struct CountsBeamsAndSaysSo : Wrong {
  static constexpr bool once_a_scan = false;
};
static_assert(OncePolicy<CountsBeams> && !OncePolicy<CountsBeamsAndSaysSo> && !OncePolicy<LogOdds>);
static_assert(!PoseAwarePolicy<LogOdds> && !PoseAwarePolicy<TBayes>);

template <class Policy>
bool breaks(const std::string& law) {
  static_assert(CellPolicy<Policy>);
  return check_cell_policy_laws(Policy{}).text().find(law) != std::string::npos;
}

}  // namespace

TEST_CASE("A user's cell policy passes the check of the laws", "[map]") {
  CHECK(check_cell_policy_laws(Counting{}).text() == "");
  CHECK(check_cell_policy_laws(Wrong{}).text() == "");
}

TEST_CASE("The check of the laws catches a wrong cell policy", "[map]") {
  CHECK(breaks<KnownFromTheStart>("a new cell has log-odds 0"));
  CHECK(breaks<HitLowers>("a hit at an exact pose with residual 0 raises an unknown cell"));
  CHECK(breaks<PassRaises>("a pass 5 m before the surface lowers an unknown cell"));
  CHECK(breaks<DoublesWithoutBound>("log-odds stay finite: inf after 128 updates, hits alone"));
  CHECK(breaks<DividesByTheResidual>("log-odds stay finite"));
  CHECK(breaks<HiddenCount>("equal sequences give equal states"));
  CHECK(breaks<IgnoresTooEarly>("a pass leaves a state for which ignores_passes holds as it is"));
  CHECK(breaks<CountsWhatItIgnores>("a pass leaves a state for which ignores_passes holds as it is"));
  CHECK(breaks<ForgetsTooMuch>("forget_stamp leaves the log-odds as they are"));
  CHECK(breaks<ClearsTooEarly>("a pass of a new cell at clearing_residual_m or beyond leaves a cleared one"));
  CHECK(breaks<ClearsToAnother>("a pass of a new cell at clearing_residual_m or beyond leaves a cleared one"));
  CHECK(breaks<CountsBeams>("a cell takes one update a scan"));
  CHECK(breaks<ForgetsNothing>("forget_stamp makes every stamp new"));
}

TEST_CASE("What a far pass clears obeys the laws for other parameters, too", "[map]") {
  CHECK(check_cell_policy_laws(TBayes(TBayes::literal_params())).text() == "");
  TBayes::Params params;
  params.log_odds_min = -2.0F;
  params.hits_max = 1;
  CHECK(check_cell_policy_laws(TBayes(params)).text() == "");
  params.log_odds_min = -1000.0F;
  CHECK(check_cell_policy_laws(TBayes(params)).text() == "");
}

TEST_CASE("Parameters that are valid can still break a law of a cell policy", "[map]") {
  // Densities in metres with different powers: with R_o = 1 m^2 a hit speaks against the cell.
  TBayes::Params params;
  params.dvl = {1.0, 2.0};
  REQUIRE_FALSE(check_cell_policy_laws(TBayes(params)).holds());
}
