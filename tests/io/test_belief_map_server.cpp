#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "incognita/core/random.hpp"
#include "incognita/io/belief_map_server.hpp"
#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "support.hpp"

using namespace incognita;
using Catch::Contains;

namespace {

/// A belief of all strengths, with cells that were never measured.
template <class Cell>
Map<Cell> random_belief(std::uint64_t seed) {
  Random random(seed);
  Grid<float, 2> log_odds(Lattice<2>(0.1), {Index<2>(-8, -3), Index<2>(9, 14)}, 0.0F);
  for (float& value : log_odds.values()) value = random.uniform() < 0.3 ? 0.0F : static_cast<float>(random.uniform(-5.0, 5.0));
  log_odds.set({-8, -3}, 3.0F);
  log_odds.set({8, 13}, -3.0F);
  return Map<Cell>(log_odds);
}

}  // namespace

TEST_CASE("A belief as map_server map: trinary goes by log-odds thresholds") {
  const io_test::TemporaryFolder folder;
  Grid<float, 2> given(Lattice<2>(0.1), {Index<2>(-2, 5), Index<2>(3, 6)}, 0.0F);
  given.values() = {-1.1F, -0.9F, 0.0F, 0.9F, 1.1F};
  const Map<LogOdds> map(given);
  write_belief_map_server(folder / "m.yaml", map);
  // map_saver's grey values: 254 free, 205 unknown, 0 occupied.
  CHECK(read_png(folder / "m.png").values == std::vector<std::uint8_t>{254, 205, 205, 205, 0});
  const MapMetadata metadata = read_map_metadata(folder / "m.yaml");
  CHECK(metadata.origin_m.x() == Approx(-0.2));
  CHECK(metadata.origin_m.y() == Approx(0.5));
  CHECK(metadata.resolution_m == 0.1);
  write_belief_map_server(folder / "m.yaml", map, {.thresholds = OccupancyThresholds::octomap()});
  CHECK(read_png(folder / "m.png").values == std::vector<std::uint8_t>{254, 254, 205, 0, 0});
}

TEMPLATE_TEST_CASE("A belief as map_server map: it comes back as a prior", "", LogOdds, TBayes, Dispersion) {
  const io_test::TemporaryFolder folder;
  const Map<TestType> map = random_belief<TestType>(7);
  for (const MapMode mode : {MapMode::trinary, MapMode::scale, MapMode::raw}) {
    write_belief_map_server(folder / "m.yaml", map, {.mode = mode});
    const Map<TestType> back = read_prior_map_server<TestType>(folder / "m.yaml");
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      const Index<2> at = map.grid().index_at(offset);
      const float was = map.log_odds(offset);
      const double p = probability_of_log_odds(static_cast<double>(was));
      CAPTURE(static_cast<int>(mode), was);
      if (mode == MapMode::trinary) {
        const double expected = was < -1.0F ? 0.02 : was > 1.0F ? 0.98 : 0.5;
        REQUIRE(back.probability(at) == Approx(expected).margin(1e-3));
      } else {
        // Half a step of the format, and that of Dispersion's states.
        const double step = mode == MapMode::scale ? 0.5 / 255.0 : 0.005;
        REQUIRE(back.probability(at) == Approx(std::min(std::max(p, 0.02), 0.98)).margin(step + 1e-3));
        if (was == 0.0F) REQUIRE(back.log_odds(at) == 0.0F);
      }
    }
  }
}

TEST_CASE("A prior from a hand-made map of another resolution, placed where the robot starts") {
  const io_test::TemporaryFolder folder;
  static_cast<void>(folder.with("m.pgm", "P2 2 2 255\n0 205\n254 254\n"));
  const auto yaml = folder.with("m.yaml",
                                "image: m.pgm\nresolution: 0.5\norigin: [10, 20, 0]\nnegate: 0\n"
                                "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  // The robot starts at (10.5, 20.5), looking along y: the corner that all four cells share is the map's origin.
  const Pose2 T_prior_map{10.5, 20.5, std::acos(0.0)};
  const Map<TBayes> map = read_prior_map_server(yaml, {}, {.T_map_prior = T_prior_map.inverse()});
  CHECK(map.probability(map.lattice().index_of({0.25, 0.25})) == Approx(0.98));   // upper left: ahead, to the left
  CHECK(map.log_odds(map.lattice().index_of({0.25, -0.25})) == 0.0F);             // upper right: unknown
  CHECK(map.probability(map.lattice().index_of({-0.25, 0.25})) == Approx(0.02));  // below: behind
  CHECK(map.probability(map.lattice().index_of({-0.25, -0.25})) == Approx(0.02));
}

TEST_CASE("Beliefs that cannot be written as map_server maps") {
  const io_test::TemporaryFolder folder;
  const Map<LogOdds> map = random_belief<LogOdds>(8);
  CHECK_THROWS_AS(write_belief_map_server(folder / "m.yaml", Map<LogOdds>()), std::invalid_argument);
  CHECK_THROWS_AS(write_belief_map_server(folder / "m.yaml", map, {.mode = MapMode::scale, .format = MapImage::pgm}),
                  std::invalid_argument);
  CHECK_THROWS_AS(write_belief_map_server(folder / "m.yaml", map, {.thresholds = {.free_below = 1.0F, .occupied_above = 2.0F}}),
                  std::invalid_argument);
  CHECK(folder.names().empty());
  CHECK_THAT(io_test::refusal([&] { return read_prior_map_server(folder / "missing.yaml").update_count(); }),
             Contains("no such file"));
}
