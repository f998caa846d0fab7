#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <vector>

#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"
#include "reference.hpp"

using namespace incognita;

namespace {

/// Every cell of the map's box against its bits.
template <class Cell>
void require_layers_of(const Map<Cell>& map, const Map<Cell>& before) {
  const CellLayers<2>& layers = map.layers();
  for (const CellBits* layer : {&layers.blocked, &layers.written, &layers.changed}) {
    REQUIRE(layer->tiles().box() == layers.heeding.tiles().box());
  }
  std::size_t changed = 0;
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    const Index<2> index = map.grid().index_at(offset);
    const typename Cell::State& state = map.grid()[offset];
    REQUIRE(layers.heeding.get(index) == !map.cell().ignores_passes(state));
    REQUIRE(layers.blocked.get(index) == (map.log_odds(offset) > map.blocked_above()));
    const bool is_changed = layers.changed.get(index);
    if (is_changed || before.layers().written.get(index)) REQUIRE(layers.written.get(index));
    if (!layers.written.get(index)) REQUIRE(map.log_odds(offset) == 0.0F);
    if (map.log_odds(index) != before.log_odds(index) && before.stamp() + 1 == map.stamp()) REQUIRE(is_changed);
    changed += static_cast<std::size_t>(is_changed);
  }
  std::size_t listed = 0;
  for (const Index<2>& tile : layers.changed_tiles) {
    const CellBits::Word word = layers.changed.tiles().value(tile);
    REQUIRE(word != 0);
    listed += static_cast<std::size_t>(std::popcount(word));
  }
  REQUIRE(listed == changed);  // so no tile is listed twice, nor left out
}

template <class Cell>
void check_layers(const Cell& policy) {
  Random random(1);
  Map<Cell> map({0.2, 0.5}, policy);
  for (int n = 0; n < 60; ++n) {
    const Map<Cell> before = map;
    Pose2 T_map_sensor = reference::random_pose<2>(random);
    if (n % 3 == 0) {  // on the corner of a cell, in the lattice's axes
      T_map_sensor = {0.2 * std::round(5.0 * T_map_sensor.x_m), 0.2 * std::round(5.0 * T_map_sensor.y_m), 0.0};
    }
    map.update(reference::random_scan<2>(random, 40, 5.0, 0.1), T_map_sensor, reference::random_covariance<2>(random));
    require_layers_of(map, before);
  }
}

}  // namespace

TEST_CASE("A map's layers say of every cell what its state does, scan after scan", "[map]") {
  SECTION("TBayes") { check_layers(TBayes()); }
  SECTION("TBayes, literal") { check_layers(TBayes(TBayes::literal_params())); }
  SECTION("LogOdds") { check_layers(LogOdds()); }
  SECTION("Dispersion") { check_layers(Dispersion()); }
}

TEST_CASE("A map that makes room keeps its layers and the changes of the last scan", "[map]") {
  Random random(2);
  Map<> map({0.2, 0.5});
  map.update(reference::random_scan<2>(random, 40, 5.0), {}, Eigen::Matrix3d::Zero());
  const Map<> before = map;
  map.reserve({Point<2>(-60.0, -7.0), Point<2>(9.0, 80.0)});
  REQUIRE(map.layers().changed_tiles == before.layers().changed_tiles);
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    const Index<2> index = map.grid().index_at(offset);
    const bool was_there = before.grid().contains(index);
    REQUIRE(map.layers().heeding.get(index) == (!was_there || before.layers().heeding.get(index)));
    REQUIRE(map.layers().blocked.get(index) == (was_there && before.layers().blocked.get(index)));
    REQUIRE(map.layers().changed.get(index) == (was_there && before.layers().changed.get(index)));
  }
}

TEST_CASE("What blocks predicted rays must not be free", "[map]") {
  REQUIRE_THROWS_WITH(Map<>(MapParams{.blocked_above = -0.1F}), Catch::Matchers::Contains("blocked_above"));
  for (const float above : {0.0F, 0.4F, 7.0F}) {
    Random random(3);
    Map<> map(MapParams{.resolution_m = 0.2, .blocked_above = above});
    for (int n = 0; n < 5; ++n) map.update(reference::random_scan<2>(random, 40, 5.0), {}, Eigen::Matrix3d::Zero());
    require_layers_of(map, Map<>(MapParams{.resolution_m = 0.2}));
    std::size_t blocked = 0;
    for (const CellBits::Word word : map.layers().blocked.tiles().values()) blocked += static_cast<std::size_t>(std::popcount(word));
    REQUIRE((blocked > 0) == (above < TBayes::Params{}.log_odds_max));
  }
}
