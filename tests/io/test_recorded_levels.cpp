#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "../estimation/room.hpp"
#include "incognita/core/random.hpp"
#include "incognita/io/recorded_levels.hpp"
#include "incognita/map/cells/log_odds.hpp"
#include "incognita/map/map.hpp"
#include "levels.hpp"

using namespace incognita;

namespace {

/// The thresholds as floats, and a setup with them.
std::pair<RecordingSetup, OccupancyThresholds> setup_of(double resolution_m, double step, float free_below, float occupied_above) {
  RecordingSetup setup;
  setup.resolution_m = resolution_m;
  setup.log_odds_step = step;
  setup.free_below = static_cast<double>(free_below);
  setup.occupied_above = static_cast<double>(occupied_above);
  setup.validate();
  return {setup, {free_below, occupied_above}};
}

/// A map of one tile, the log-odds of which are what one likes.
struct ValueMap {
  struct CellType {
    static float log_odds(float state) { return state; }
  };
  Grid<float, 2> grid_{Lattice<2>(0.1), {{0, 0}, {8, 8}}};
  CellLayers<2> layers_{Lattice<2>(0.1)};

  ValueMap() { layers_.grow_to_include(grid_.box()); }
  [[nodiscard]] std::uint64_t update_count() const { return 0; }
  [[nodiscard]] const CellLayers<2>& layers() const { return layers_; }
  [[nodiscard]] const Grid<float, 2>& grid() const { return grid_; }
  [[nodiscard]] auto states_of(const Index<2>& /*tile*/) const {
    return [this](int bit) { return grid_[bit]; };
  }
};

template <class MapType>
void check_levels(const io_test::LevelMap& levels, const MapType& map, const RecordingSetup& setup, const OccupancyThresholds& thresholds) {
  CHECK(levels.count_wrong(map, setup, thresholds) == 0);
}

}  // namespace

TEST_CASE("levels lie on the side of the thresholds on which their log-odds do, whatever the step") {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const double step = trial % 3 == 0 ? 0.5 : random.uniform(0.05, 1.0);
    const bool are_multiples = trial % 2 == 0;
    const float free_below = static_cast<float>(are_multiples ? -step * (1.0 + static_cast<double>(random.index(9))) : -random.uniform(0.02, 5.0));
    const float occupied_above = static_cast<float>(are_multiples ? step * (1.0 + static_cast<double>(random.index(9))) : random.uniform(0.02, 5.0));
    const std::pair made = setup_of(0.1, step, free_below, occupied_above);
    const RecordingSetup& setup = made.first;
    const OccupancyThresholds& thresholds = made.second;
    ValueMap map;
    for (float& value : map.grid_.values()) {
      const float near = random.index(2) == 0 ? free_below : occupied_above;
      switch (random.index(4)) {
        case 0: value = near; break;
        case 1: value = std::nextafter(near, random.index(2) == 0 ? 100.0F : -100.0F); break;
        case 2: value = static_cast<float>(random.uniform(-200.0, 200.0)); break;
        default: value = static_cast<float>(random.uniform(-6.0, 6.0)); break;
      }
    }
    RecordedLevels levels(setup, thresholds);
    RecordedFrame frame;
    levels.note(map, false);
    levels.take(map, frame);
    frame.validate(0, 0);
    std::size_t seen = 0;
    for_each_changed_cell(frame, [&](const Index<2>& cell, std::int8_t level) {
      ++seen;
      const float log_odds = map.grid_.value(cell);
      const double shown = level * setup.log_odds_step;
      CAPTURE(step, free_below, occupied_above, log_odds, int{level});
      REQUIRE(level != -128);
      REQUIRE((shown < setup.free_below) == (log_odds < free_below));
      REQUIRE((shown > setup.occupied_above) == (log_odds > occupied_above));
      if (std::abs(log_odds) < 127.0 * step) REQUIRE(std::abs(shown - log_odds) < step * (1.0 + 1e-5));
    });
    REQUIRE(seen > 0);
    // Nothing has changed.
    levels.note(map, true);
    levels.take(map, frame);
    REQUIRE(frame.tiles.empty());
    REQUIRE(frame.levels.empty());
  }
}

TEST_CASE("levels are rounded away from 0, so that what was touched is seen to be") {
  const std::pair made = setup_of(0.1, 0.5, -1.0F, 1.0F);
  const RecordingSetup& setup = made.first;
  const OccupancyThresholds& thresholds = made.second;
  ValueMap map;
  const float values[] = {0.0F, 0.01F, -0.01F, 0.5F, 0.51F, -1.0F, -1.01F, 1.0F, 1.01F, 1e9F, -1e9F};
  const int expected[] = {0, 1, -1, 1, 2, -2, -3, 2, 3, 127, -127};
  for (int i = 0; i < 11; ++i) map.grid_[i] = values[i];
  RecordedLevels levels(setup, thresholds);
  RecordedFrame frame;
  levels.note(map, false);
  levels.take(map, frame);
  io_test::LevelMap shown;
  shown.take(frame);
  for (int i = 0; i < 11; ++i) CHECK(shown.level(map.grid_.index_at(i)) == expected[i]);
}

TEST_CASE("levels follow a map that grows, is looked at now and then, and is replaced") {
  Random random(2);
  const double resolution_m = GENERATE(0.1, 0.23);
  const std::pair made = setup_of(resolution_m, 0.5, -1.0F, 1.0F);
  const RecordingSetup& setup = made.first;
  const OccupancyThresholds& thresholds = made.second;
  MapParams params;
  params.resolution_m = resolution_m;
  const auto walls = room::box(room::kTurned, 30.0, 4.0);
  const auto update = [&](auto& map, double along_m) {
    const Pose2 pose{along_m, random.uniform(-1.0, 1.0), random.uniform(-3.0, 3.0)};
    map.update(room::scan_of(walls, pose, 90), pose, Eigen::Matrix3d::Identity() * 1e-4);
  };
  Map<LogOdds> map(params);
  for (int scan = 0; scan < 5; ++scan) update(map, -20.0);  // before there was a recorder
  RecordedLevels levels(setup, thresholds);
  io_test::LevelMap shown;
  RecordedFrame frame;
  const auto take = [&] {
    levels.take(map, frame);
    frame.validate(0, 0);
    shown.take(frame);
    check_levels(shown, map, setup, thresholds);
  };
  levels.note(map, false);
  take();
  for (int scan = 0; scan < 60; ++scan) {
    update(map, -20.0 + 0.6 * scan);
    if (scan % 17 == 5) update(map, 0.0);  // one that is missed
    levels.note(map, false);
    if (scan % 7 == 0) take();
  }
  take();
  REQUIRE(shown.size() > 1000);

  // Drawn again elsewhere, with as many updates.
  Map<LogOdds> fresh(params);
  const auto& box = map.grid().box();
  fresh.reserve({map.lattice().center_m(box.lower), map.lattice().center_m({box.upper[0] - 1, box.upper[1] - 1})});
  while (fresh.update_count() < map.update_count()) update(fresh, 5.0);
  map = fresh;
  levels.note(map, true);
  take();
  update(map, 5.0);
  levels.note(map, false);
  take();
}

TEST_CASE("a map without cells has no levels") {
  const std::pair made = setup_of(0.1, 0.5, -1.0F, 1.0F);
  const RecordingSetup& setup = made.first;
  const OccupancyThresholds& thresholds = made.second;
  RecordedLevels levels(setup, thresholds);
  RecordedFrame frame;
  levels.note(Map<>{}, false);
  levels.take(Map<>{}, frame);
  CHECK(frame.tiles.empty());
}
