#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <string>
#include <tuple>

#include "incognita/entropy/renyi.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/entropy/tsallis.hpp"
#include "incognita/estimation/dead_reckoning.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "small_office.hpp"

namespace incognita {

// The entropy's type matters to the constructor alone, so each of the four is given to one explorer type as a function.
TEMPLATE_PRODUCT_TEST_CASE("every map explores with every entropy and every filter", "", std::tuple,
                           ((TBayes, DvlEkf), (TBayes, DeadReckoning), (LogOdds, DvlEkf), (LogOdds, DeadReckoning),
                            (Dispersion, DvlEkf), (Dispersion, DeadReckoning))) {
  using Cell = std::tuple_element_t<0, TestType>;
  using Filter = std::tuple_element_t<1, TestType>;
  using Measure = std::function<double(double)>;
  const auto run = [](const std::string& name, const Measure& measure) {
    Simulator simulator = test::office_simulator(0.9, 21, 90);
    ExplorerParams params;
    params.gain.beams = 30;
    params.threads = 1;
    Explorer<Map<Cell>, Measure, Filter> explorer(params, Map<Cell>{}, measure);
    const test::Mission mission = test::run_mission(explorer, simulator, 5.0);
    CAPTURE(name);
    CHECK(mission.goals_m.size() > 0);
    for (const double gain_nats : mission.gains_nats) CHECK((std::isfinite(gain_nats) && gain_nats > 0.0));
    CHECK(simulator.distance_m() > 0.2);
    CHECK(simulator.collisions() == 0);
    CHECK(explorer.belief().pose.is_finite());
    CHECK((explorer.belief().pose.position() - simulator.T_start_robot().position()).norm() < 0.3);
  };
  run("shannon", Shannon{});
  run("renyi", Renyi{0.5});
  run("tsallis", Tsallis{2.0});
  run("behavioral", Behavioral{0.2});
}

// And each is a type argument as well.
static_assert(EntropyMeasure<Shannon> && EntropyMeasure<Renyi> && EntropyMeasure<Tsallis> && EntropyMeasure<Behavioral>);
TEST_CASE("an explorer takes the entropy as a type") {
  const Explorer<Map<LogOdds>, Tsallis, DeadReckoning> explorer({}, Map<LogOdds>{}, Tsallis{2.0});
  CHECK(explorer.entropy()(0.0F) == Approx(0.5));  // 1 - 2 / 4
}

}  // namespace incognita
