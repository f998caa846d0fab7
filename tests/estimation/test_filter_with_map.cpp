#include <catch2/catch.hpp>
#include <vector>

#include "../exploration/small_office.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/estimation/filter_with_map.hpp"
#include "incognita/loops.hpp"
#include "incognita/map/cells/exact_pose.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/testing/estimator_laws.hpp"
#include "room.hpp"

using namespace incognita;

namespace {

using Localiser = FilterWithMap<Map<TBayes>, DvlEkf>;

template <class Filter>
concept can_keep_a_map = requires { typename FilterWithMap<Map<>, Filter>; };

static_assert(Estimator<Localiser> && Estimator<Localiser, Map<LogOdds>> && !RedrawsMaps<Localiser>);
static_assert(can_keep_a_map<DvlEkf> && can_keep_a_map<DeadReckoning> && !can_keep_a_map<LoopClosingDvlEkf>);

template <class A, class B>
bool same_log_odds(const A& a, const B& b) {
  if (a.grid().size() != b.grid().size()) return false;
  for (Offset offset = 0; offset < static_cast<Offset>(a.grid().size()); ++offset) {
    if (a.log_odds(offset) != b.log_odds(offset)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("A filter with a map of its own keeps the laws of estimators", "[estimation]") {
  CHECK(check_estimator_laws(Localiser()).text() == "");
  CHECK(check_estimator_laws(FilterWithMap<Map<LogOdds>, DeadReckoning>()).text() == "");
}

TEST_CASE("A filter with a map of its own estimates as Slam does, whatever the map for decisions", "[estimation]") {
  const std::vector<room::Wall> walls = room::box(room::kTurned);
  Slam<Map<TBayes>, DvlEkf> alone{DvlEkf()};
  Slam<Map<LogOdds>, Localiser> both{Localiser()};
  Map<LogOdds> at_beliefs;
  Pose2 truth;
  for (int n = 0; n < 60; ++n) {
    const Scan<2> scan = room::scan_of(walls, truth);
    const SlamReport expected = alone.observe(scan);
    const SlamReport report = both.observe(scan);
    REQUIRE(report.correction.associations == expected.correction.associations);
    REQUIRE(both.belief().pose.x_m == alone.belief().pose.x_m);
    REQUIRE(both.belief().covariance == alone.belief().covariance);
    at_beliefs.update(scan, alone.belief().pose, alone.belief().covariance);
    const Pose2 increment{n < 25 ? 0.0 : 0.03, 0.0, n < 25 ? 0.0 : 0.02};
    alone.move(increment, 0.1);
    both.move(increment, 0.1);
    truth = truth * increment;
  }
  CHECK(both.filter().is_ready());
  CHECK(same_log_odds(both.filter().map(), alone.map()));
  CHECK(same_log_odds(both.map(), at_beliefs));
}

TEST_CASE("An explorer decides by one map and localises in another", "[estimation]") {
  const auto explore = [](auto explorer) {
    Simulator simulator = test::office_simulator(0.9, 21, 90);
    const test::Mission mission = test::run_mission(explorer, simulator, 8.0);
    CHECK(mission.goals_m.size() > 0);
    CHECK(simulator.distance_m() > 0.5);
    CHECK((explorer.belief().pose.position() - simulator.T_start_robot().position()).norm() < 0.1);
    CHECK(explorer.filter().map().grid().size() > 0);
    return mission.goals_m;
  };
  ExplorerParams params;
  params.threads = 1;
  const auto inverse = explore(Explorer<Map<LogOdds>, Behavioral, Localiser>(params));
  const auto exact = explore(Explorer<Map<ExactPose<TBayes>>, Behavioral, Localiser>(params));
  CHECK(inverse != exact);
}
