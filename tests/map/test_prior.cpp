#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/entropy/shannon.hpp"
#include "incognita/exploration/explorer.hpp"
#include "incognita/geometry/pose3.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/cells/t_bayes.hpp"
#include "incognita/map/entropy_layer.hpp"
#include "incognita/map/occupancy_layer.hpp"
#include "incognita/map/overlay.hpp"
#include "incognita/map/prior.hpp"
#include "incognita/testing/cell_policy_laws.hpp"

using namespace incognita;

namespace {

static_assert(PriorPolicy<TBayes> && PriorPolicy<LogOdds> && PriorPolicy<Dispersion>);

/// A policy that cannot start from log-odds, and one that could but says so in another type.
struct Tally {
  struct State {
    int count = 0;
  };
  struct Beam {};
  Beam beam(double) const { return {}; }
  void hit(State& state, const Beam&, float, ScanStamp) const { state.count = std::min(100, state.count + 1); }
  void pass(State& state, const Beam&, float, ScanStamp) const { state.count = std::max(-100, state.count - 1); }
  bool ignores_passes(const State& state) const { return state.count == -100; }
  void forget_stamp(State&) const {}
  static float log_odds(const State& state) { return 0.1F * static_cast<float>(state.count); }
};
struct TallyInFloats : Tally {
  float state_of_log_odds(float log_odds) const { return 10.0F * log_odds; }
};
static_assert(CellPolicy<Tally> && !PriorPolicy<Tally>);
static_assert(CellPolicy<TallyInFloats> && !PriorPolicy<TallyInFloats>);
static_assert(!std::is_constructible_v<Map<Tally>, const Grid<float, 2>&, const MapParams&>);
static_assert(std::is_constructible_v<Map<TBayes>, const Grid<float, 2>&, const MapParams&>);

struct RememberedStamp : LogOdds {
  State state_of_log_odds(float log_odds) const { return {std::clamp(log_odds, -10.0F, 10.0F), 7}; }
};
struct DoublesItsPrior : LogOdds {
  State state_of_log_odds(float log_odds) const { return {std::clamp(2.0F * log_odds, -10.0F, 10.0F), 0}; }
};
struct UnboundedPrior : LogOdds {
  State state_of_log_odds(float log_odds) const { return {log_odds, 0}; }
};

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

double logit(double p) { return std::log(p / (1.0 - p)); }

Grid<float, 2> random_probabilities(std::uint64_t seed, double resolution_m, const Point<2>& origin_m, const IndexBox<2>& box) {
  Random random(seed);
  Grid<float, 2> grid(Lattice<2>(resolution_m, origin_m), box, unknown);
  for (float& p : grid.values()) p = random.uniform() < 0.3 ? unknown : static_cast<float>(random.uniform(0.03, 0.97));
  return grid;
}

/// A room of 6 x 4 m around the origin, in cells of 0.1 m: walls a cell thick, floor within.
Grid<float, 2> room() {
  Grid<float, 2> grid(Lattice<2>(0.1), {Index<2>(-31, -21), Index<2>(31, 21)}, unknown);
  for (Offset offset = 0; offset < static_cast<Offset>(grid.size()); ++offset) {
    const Index<2> at = grid.index_at(offset);
    grid[offset] = at.x() < -30 || at.x() > 29 || at.y() < -20 || at.y() > 19 ? 1.0F : 0.0F;
  }
  return grid;
}

Scan<2> scan_of_room(double range_max_m) {
  Scan<2> scan(circular_beams(360, range_max_m));
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range_m = std::min(3.0 / std::abs(scan.direction(beam).x()), 2.0 / std::abs(scan.direction(beam).y()));
    if (range_m < range_max_m) scan.set_range_m(beam, range_m);
  }
  return scan;
}

}  // namespace

TEST_CASE("The laws of a prior hold, and their check catches a wrong one", "[map]") {
  CHECK(check_cell_policy_laws(TBayes()).text() == "");
  CHECK(check_cell_policy_laws(TBayes(TBayes::literal_params())).text() == "");
  CHECK(check_cell_policy_laws(LogOdds(LogOdds::octomap_params())).text() == "");
  const auto breaks = [](const auto& policy, const std::string& law) {
    return check_cell_policy_laws(policy).text().find(law) != std::string::npos;
  };
  CHECK(breaks(DoublesItsPrior{}, "a prior's log-odds are those given"));
  CHECK(breaks(UnboundedPrior{}, "priors beyond doubt are bounded"));
  struct StampMatters : RememberedStamp {
    void hit(State& state, const Beam& beam, float residual_m, ScanStamp stamp) const {
      if (state.hit_by != 7) LogOdds::hit(state, beam, residual_m, stamp);
    }
  };
  CHECK(breaks(StampMatters{}, "a prior has no stamp"));
}

TEST_CASE("A T-Bayes prior was hit as often as hits take to raise a cell so far", "[map]") {
  const TBayes policy;
  const auto exact = policy.beam(0.0);
  TBayes::State seen;
  for (int hits = 1; hits <= 5; ++hits) {
    policy.hit(seen, exact, 0.0F, static_cast<ScanStamp>(hits));
    const TBayes::State prior = policy.state_of_log_odds(seen.log_odds - 1e-4F);
    CHECK(static_cast<int>(prior.hits) == static_cast<int>(seen.hits));
  }
  CHECK(static_cast<int>(policy.state_of_log_odds(-3.0F).hits) == 0);
  // So a prior wall is worn down by scans through it as a wall is, not cleared by the first.
  TBayes::State wall = policy.state_of_log_odds(4.0F);
  policy.pass(wall, exact, 5.0F, 1);
  CHECK(wall.log_odds == Approx(3.6F));
}

TEST_CASE("A prior of dispersion cells says nothing of where things are", "[map]") {
  const Dispersion policy;
  const Dispersion::State state = policy.state_of_log_odds(2.0F);
  CHECK(Dispersion::log_odds(state) == 2.0F);
  CHECK_FALSE(state.is_explored);
  CHECK(policy.dispersion_log_odds(state) == policy.beta_log_odds());
}

TEST_CASE("A prior on the map's own lattice comes over as it is", "[map]") {
  const Grid<float, 2> given = random_probabilities(1, 0.1, {0.0, 0.0}, {Index<2>(-40, 7), Index<2>(13, 31)});
  const Grid<float, 2> log_odds = prior_log_odds(given, 0.1);
  REQUIRE(log_odds.box() == given.box());
  for (Offset offset = 0; offset < static_cast<Offset>(given.size()); ++offset) {
    const double p = static_cast<double>(given[offset]);
    REQUIRE(log_odds[offset] == (std::isnan(p) ? 0.0F : static_cast<float>(logit(p))));
  }
  const Map<LogOdds> map = map_with_prior<LogOdds>(given);
  CHECK(map.update_count() == 1);
  CHECK(map.grid().values().size() == given.size());
  CHECK(map.log_odds(Index<2>(-40, 7)) == log_odds[0]);
}

TEST_CASE("A prior beyond doubt is held within the bounds", "[map]") {
  Grid<float, 2> given(Lattice<2>(0.1), {Index<2>(0, 0), Index<2>(4, 1)}, unknown);
  given.values() = {0.0F, 1.0F, 0.5F, unknown};
  const auto values = prior_log_odds(given, 0.1, {.probability_min = 0.1, .probability_max = 0.8}).values();
  CHECK(values[0] == Approx(logit(0.1)));
  CHECK(values[1] == Approx(logit(0.8)));
  CHECK(values[2] == 0.0F);
  CHECK(values[3] == 0.0F);
}

TEST_CASE("A prior of smaller cells keeps its thin walls", "[map]") {
  const Grid<float, 2> fine = random_probabilities(2, 0.025, {0.0, 0.0}, {Index<2>(-16, -8), Index<2>(24, 12)});
  const Grid<float, 2> coarse = prior_log_odds(fine, 0.1);
  REQUIRE(coarse.box() == IndexBox<2>{Index<2>(-4, -2), Index<2>(6, 3)});
  for (Offset offset = 0; offset < static_cast<Offset>(coarse.size()); ++offset) {
    const Index<2> at = coarse.index_at(offset);
    double most = -1.0;
    for (int y = 4 * at.y(); y < 4 * at.y() + 4; ++y) {
      for (int x = 4 * at.x(); x < 4 * at.x() + 4; ++x) {
        const float p = fine.value({x, y});
        if (!std::isnan(p)) most = std::max(most, static_cast<double>(p));
      }
    }
    REQUIRE(coarse[offset] == (most < 0.0 ? 0.0F : static_cast<float>(logit(most))));
  }
}

TEST_CASE("A prior of larger cells, moved and turned, has no holes", "[map]") {
  Random random(3);
  for (int draw = 0; draw < 20; ++draw) {
    const Pose2 T_map_prior{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0), random.uniform(-3.1, 3.1)};
    const double prior_resolution_m = random.uniform(0.04, 0.3);
    Grid<float, 2> given(Lattice<2>(prior_resolution_m, Point<2>(random.uniform(-1.0, 1.0), 0.3)), {Index<2>(-9, 4), Index<2>(20, 30)},
                         unknown);
    for (float& p : given.values()) p = 0.1F;
    const Index<2> wall(3, 17);
    given.set(wall, 0.9F);
    const Grid<float, 2> log_odds = prior_log_odds(given, 0.1, {.T_map_prior = T_map_prior});
    const Point<2> wall_m = T_map_prior * given.lattice().center_m(wall);
    CHECK(log_odds.value(log_odds.lattice().index_of(wall_m)) == Approx(logit(0.9)));
    const Pose2 T_prior_map = T_map_prior.inverse();
    for (Offset offset = 0; offset < static_cast<Offset>(log_odds.size()); ++offset) {
      const Point<2> center_m = log_odds.lattice().center_m(log_odds.index_at(offset));
      const Point<2> in_prior = given.lattice().to_cells(T_prior_map * center_m);
      const double outside_x = std::max(-9.0 - in_prior.x(), in_prior.x() - 20.0);
      const double outside_y = std::max(4.0 - in_prior.y(), in_prior.y() - 30.0);
      if (std::max(outside_x, outside_y) < 0.0) {
        REQUIRE(log_odds[offset] != 0.0F);
      } else if (std::max(outside_x, outside_y) * prior_resolution_m > 0.1) {
        REQUIRE(log_odds[offset] == 0.0F);  // no prior within a cell
      }
      if (log_odds[offset] > 0.0F) REQUIRE((center_m - wall_m).norm() < prior_resolution_m + 0.1);
    }
  }
}

TEST_CASE("Layers, overlays and scans take a prior as what was measured", "[map]") {
  const Grid<float, 2> given = room();
  const auto follows = [&]<class Cell>(Cell cell) {
    Map<Cell> map = map_with_prior<Cell>(given, {}, {}, cell);
    OccupancyLayer<2> followed(map.lattice());
    followed.follow(map);
    OccupancyLayer<2> rebuilt(map.lattice());
    rebuilt.rebuild(map);
    const EntropyTable entropy{Shannon{}};
    for (Offset offset = 0; offset < static_cast<Offset>(given.size()); ++offset) {
      const Occupancy is = given[offset] == 1.0F ? Occupancy::occupied : Occupancy::free;
      REQUIRE(followed.grid().value(given.index_at(offset)) == is);
      REQUIRE(rebuilt.grid().value(given.index_at(offset)) == is);
    }
    // A predicted beam ends in a wall of the prior.
    map.reserve({{-12.0, -12.0}, {12.0, 12.0}});
    Overlay<Cell> overlay;
    overlay.look_at(map);
    double read_m = 0.0;
    overlay.cast(circular_beams(1, 10.0), Point<2>(0.05, 0.05), [&](const Point<2>&, const Index<2>& cell_hit) {
      return read_m = map.lattice().center_m(cell_hit).x() - 0.05;
    });
    CHECK(read_m == Approx(3.0));
    // The states that scans leave do not depend on whether bits or cells are asked.
    const Scan<2> scan = scan_of_room(10.0);
    for (int count = 0; count < 3; ++count) map.update(scan, {0.0, 0.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity());
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      const Index<2> at = map.grid().index_at(offset);
      REQUIRE(map.layers().blocked.get(at) == (map.log_odds(offset) > map.blocked_above()));
      if (!map.layers().heeding.get(at)) REQUIRE(map.cell().ignores_passes(map.grid()[offset]));
    }
    followed.follow(map);
    CHECK(followed.grid().value({0, 0}) == Occupancy::free);
    CHECK(followed.grid().value({30, 0}) == Occupancy::occupied);
  };
  follows(TBayes());
  follows(LogOdds());
  follows(Dispersion());
}

TEST_CASE("Scans unlearn a prior wall that is not there, and learn one that is", "[map]") {
  Grid<float, 2> given = room();
  for (int y = -20; y < 20; ++y) given.set({10, y}, 1.0F);  // a partition that was removed
  given.set({-10, 0}, 0.0F);
  Map<TBayes> map = map_with_prior<TBayes>(given);
  CHECK(map.probability({10, 0}) == Approx(0.98));
  const Scan<2> scan = scan_of_room(10.0);
  int scans = 0;
  while (map.log_odds(Index<2>(10, 0)) >= -1.0F && scans < 100) {
    map.update(scan, {0.0, 0.0, 0.0}, 1e-4 * Eigen::Matrix3d::Identity());
    ++scans;
  }
  CHECK(scans > 3);   // one scan does not outweigh it
  CHECK(scans < 20);  // some do
}

TEST_CASE("An explorer that knows the building is done when it has looked around", "[map]") {
  Explorer<Map<TBayes>, Shannon, DvlEkf> explorer({}, map_with_prior(room()));
  CHECK(explorer.frontiers().empty());
  CHECK(explorer.occupancy().grid().value({5, 5}) == Occupancy::free);
  const Scan<2> scan = scan_of_room(10.0);
  for (int count = 0; count < 40 && !explorer.stopped(); ++count) {
    explorer.observe(scan);
    CHECK(explorer.correction().trusted);
    explorer.decide();
  }
  REQUIRE(explorer.stopped());
  CHECK(*explorer.stopped() == StopReason::complete);
}

TEST_CASE("A prior in space starts a map in space", "[map]") {
  Grid<float, 3> given(Lattice<3>(0.1), {Index<3>(0, 0, 0), Index<3>(2, 2, 2)}, 0.0F);
  given.set({1, 0, 1}, 2.5F);
  given.set({0, 1, 0}, -1.5F);
  const Map<LogOdds, 3> map(given);
  CHECK(map.log_odds(Index<3>(1, 0, 1)) == 2.5F);
  CHECK(map.log_odds(Index<3>(0, 1, 0)) == -1.5F);
  CHECK(map.log_odds(Index<3>(0, 0, 0)) == 0.0F);
}

TEST_CASE("Bad priors are refused", "[map]") {
  const Grid<float, 2> given = room();
  CHECK_THROWS_WITH(prior_log_odds(given, 0.1, {.probability_min = 0.5}),
                    "PriorParams: probability_min is 0.5, but must be in (0, 0.5)");
  CHECK_THROWS_AS(prior_log_odds(given, 0.1, {.probability_min = 0.1, .probability_max = 1.0}), std::invalid_argument);
  CHECK_THROWS_AS(prior_log_odds(given, 0.1, {.T_map_prior = {NAN, 0.0, 0.0}}), std::invalid_argument);
  CHECK_THROWS_AS(prior_log_odds(given, 0.1, {.T_map_prior = {1e9, 0.0, 0.0}}), std::length_error);
  CHECK_THROWS_AS(prior_log_odds(given, 1e-6), std::length_error);
  CHECK_THROWS_AS(prior_log_odds(given, 0.0), std::invalid_argument);
  Grid<float, 2> more = given;
  more.set({0, 0}, 1.5F);
  CHECK_THROWS_WITH(prior_log_odds(more, 0.1), "prior_log_odds: a probability is 1.5, but must be in 0..1, or NaN");
  CHECK_THROWS_AS(Map<TBayes>(Grid<float, 2>(Lattice<2>(0.2))), std::invalid_argument);
  CHECK_THROWS_AS(Map<TBayes>(Grid<float, 2>(Lattice<2>(0.1, Point<2>(0.05, 0.0)))), std::invalid_argument);
  const Map<TBayes> empty = map_with_prior(Grid<float, 2>(Lattice<2>(0.1)));
  CHECK(empty.update_count() == 0);
}
