#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "incognita/map/cells/dispersion.hpp"
#include "incognita/map/overlay.hpp"
#include "reference.hpp"

using namespace incognita;

namespace {

template <class Cell>
void require_same_log_odds(const Overlay<Cell>& overlay, const Map<Cell>& map) {
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    const Index<2> index = map.grid().index_at(offset);
    REQUIRE(overlay.log_odds(index) == map.log_odds(index));
  }
}

template <class Cell>
std::vector<Index<2>> changed_cells(const Overlay<Cell>& overlay) {
  std::vector<Index<2>> changed;
  overlay.for_each_changed_cell([&](const Index<2>& index) { changed.push_back(index); });
  return changed;
}

template <class Cell>
Map<Cell> scanned_map(Random& random, const Cell& policy = Cell{}) {
  Map<Cell> map({0.2, 0.5}, policy);
  map.reserve({Point<2>::Constant(-12.0), Point<2>::Constant(12.0)});
  for (int n = 0; n < 5; ++n) {
    map.update(reference::random_scan<2>(random, 40, 4.0), reference::random_pose<2>(random),
               reference::random_covariance<2>(random));
  }
  return map;
}

/// Predicted scans on an overlay against the same scans written into a copy of the map.
template <class Cell>
void compare_with_copy(const Cell& policy, int rounds) {
  Random random(1);
  const Map<Cell> map = scanned_map<Cell>(random, policy);
  const Map<Cell> untouched = map;
  Overlay<Cell> overlay;
  overlay.look_at(map);
  for (int round = 0; round < rounds; ++round) {
    overlay.forget();
    REQUIRE(changed_cells(overlay).empty());
    Map<Cell> copy = map;
    const int scans = static_cast<int>(random.index(5));
    for (int n = 0; n < scans; ++n) {
      const Scan<2> scan = reference::random_scan<2>(random, 20, 4.0, 0.1);
      const Pose2 T_map_sensor = reference::random_pose<2>(random);
      const auto covariance = reference::random_covariance<2>(random);
      copy.update(scan, T_map_sensor, covariance);
      overlay.update(scan, T_map_sensor, covariance);
    }
    require_same_log_odds(overlay, copy);
    REQUIRE(overlay.layers().heeding.tiles().values() == copy.layers().heeding.tiles().values());
    REQUIRE(overlay.layers().blocked.tiles().values() == copy.layers().blocked.tiles().values());
    REQUIRE(&overlay.map() == &map);

    Grid<std::uint8_t, 2> changed(map.lattice(), map.grid().box(), 0);
    std::size_t states = 0;
    std::size_t cells = 0;
    overlay.for_each_changed_cell([&](const Index<2>& index) {
      REQUIRE(changed.value(index) == 0);
      changed.set(index, 1);
      ++cells;
    });
    overlay.for_each_changed_but_cleared([&](const Index<2>& index, const auto& before, const auto& after) {
      REQUIRE(changed.value(index) == 1);
      ++states;
      REQUIRE(Cell::log_odds(before) == map.log_odds(index));
      REQUIRE(Cell::log_odds(after) == copy.log_odds(index));
      if constexpr (DispersionPolicy<Cell>) {
        const auto& copied = copy.grid()[copy.grid().offset_of(index)];
        REQUIRE(policy.dispersion_log_odds(after) == policy.dispersion_log_odds(copied));
      }
    });
    REQUIRE(states + overlay.cleared_count() == cells);
    for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
      if (copy.log_odds(offset) != map.log_odds(offset)) REQUIRE(changed[offset] == 1);
    }
  }
  REQUIRE(map.stamp() == untouched.stamp());
  for (Offset offset = 0; offset < static_cast<Offset>(map.grid().size()); ++offset) {
    REQUIRE(map.log_odds(offset) == untouched.log_odds(offset));
  }
}

}  // namespace

TEST_CASE("An overlay is what a copied map would be, and leaves the map alone", "[map]") {
  compare_with_copy<TBayes>(TBayes(), 12);
  compare_with_copy<TBayes>(TBayes(TBayes::literal_params()), 4);
  compare_with_copy<LogOdds>(LogOdds(), 4);
  compare_with_copy<Dispersion>(Dispersion(), 4);
}

TEST_CASE("An overlay lists the cells it changed", "[map]") {
  Map<LogOdds> map({1.0, 0.5});
  map.reserve({{-1.0, -1.0}, {12.0, 12.0}});
  Overlay<LogOdds> overlay;
  overlay.look_at(map);
  const Scan<2> scan(planar_beams(1, 0.0, 0.0, 10.0), {3.0});
  for (int n = 0; n < 2; ++n) {
    overlay.update(scan, {0.5, 0.5, 0.0}, Eigen::Matrix3d::Zero());
    // The face at 3.5 m, pushed by half a cell to 4.0.
    REQUIRE(changed_cells(overlay) == std::vector<Index<2>>{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}});
  }
  overlay.forget();
  REQUIRE(changed_cells(overlay).empty());
}

TEST_CASE("An overlay forgets its changes however often it starts over", "[map]") {
  Random random(3);
  const Map<> map = scanned_map<TBayes>(random);
  Overlay<TBayes> overlay;
  const Scan<2> scan(planar_beams(1, 0.0, 0.0, 10.0), {3.0});
  const Index<2> cell = map.lattice().index_of({9.1, 10.1});
  float first = 0.0F;
  overlay.look_at(map);
  for (int n = 0; n < 100000; ++n) {
    overlay.forget();
    REQUIRE(overlay.log_odds(cell) == map.log_odds(cell));
    overlay.update(scan, {8.1, 10.1, 0.0}, Eigen::Matrix3d::Zero());
    if (n == 0) first = overlay.log_odds(cell);
    REQUIRE(overlay.log_odds(cell) == first);
  }
  REQUIRE(first < map.log_odds(cell));
}

TEST_CASE("An overlay follows a map that grew, and looks at another one", "[map]") {
  Random random(4);
  Map<> map = scanned_map<TBayes>(random);
  Overlay<TBayes> overlay;
  overlay.look_at(map);
  overlay.update(reference::random_scan<2>(random, 40, 4.0), {}, Eigen::Matrix3d::Zero());
  REQUIRE(overlay.log_odds({100000, 0}) == 0.0F);
  map.update(reference::random_scan<2>(random, 40, 4.0), {40.0, -30.0, 0.0}, Eigen::Matrix3d::Zero());
  overlay.look_at(map);
  require_same_log_odds(overlay, map);
  const Map<> other = scanned_map<TBayes>(random);
  overlay.look_at(other);
  require_same_log_odds(overlay, other);
}

TEST_CASE("An overlay refuses more predicted scans than there are stamps for", "[map]") {
  Map<LogOdds> map;
  const Scan<2> none(circular_beams(0, 10.0));
  Overlay<LogOdds> overlay;
  // The worst map: one at its last stamp leaves 5,535.
  while (map.stamp() < Map<LogOdds>::stamp_last) map.update(none, {}, Eigen::Matrix3d::Zero());
  overlay.look_at(map);
  for (int n = 0; n < 5535; ++n) overlay.update(none, {}, Eigen::Matrix3d::Zero());
  REQUIRE_THROWS_AS(overlay.update(none, {}, Eigen::Matrix3d::Zero()), std::length_error);
  overlay.forget();
  REQUIRE_NOTHROW(overlay.update(none, {}, Eigen::Matrix3d::Zero()));
}

TEST_CASE("An overlay refuses a predicted scan that reaches out of the map's box, and stays as it was", "[map]") {
  Random random(6);
  const Map<> map = scanned_map<TBayes>(random);
  Overlay<TBayes> overlay;
  overlay.look_at(map);
  const Box<Index<2>> box = map.grid().box();
  const Eigen::Vector2d corner = map.lattice().center_m({box.upper.x() - 3, box.upper.y() - 3});
  const Scan<2> east(planar_beams(1, 0.0, 0.0, 10.0), {1.0});
  for (const double yaw_rad : {0.0, 0.5 * std::numbers::pi}) {
    const Pose2 outward{corner.x(), corner.y(), yaw_rad};
    REQUIRE_THROWS_AS(overlay.update(east, outward, Eigen::Matrix3d::Zero()), std::length_error);
    REQUIRE_THROWS_WITH(overlay.update(east, outward, Eigen::Matrix3d::Zero()), Catch::Contains("of the map, " + box_text(box)));
  }
  REQUIRE(changed_cells(overlay).empty());
  REQUIRE_NOTHROW(overlay.update(east, {corner.x() - 1.5, corner.y(), 0.0}, Eigen::Matrix3d::Zero()));
}

TEST_CASE("An overlay refuses poses that are far away or nowhere, and one that has looked at nothing", "[map]") {
  Random random(7);
  Map<> map = scanned_map<TBayes>(random);
  Overlay<TBayes> overlay;
  REQUIRE_THROWS_AS(overlay.forget(), std::logic_error);
  overlay.look_at(map);
  const Scan<2> scan = reference::random_scan<2>(random, 8, 4.0);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double far : {1e5, 2e8, 1e9, 1e12, 1e300, infinity, nan}) {
    for (const Pose2& pose : {Pose2{far, 0.0, 0.0}, Pose2{0.0, -far, 0.0}, Pose2{far, far, 0.0}}) {
      REQUIRE_THROWS_AS(overlay.update(scan, pose, Eigen::Matrix3d::Zero()), std::length_error);
    }
  }
  REQUIRE(changed_cells(overlay).empty());
  map.reserve({Point<2>::Constant(-50.0), Point<2>::Constant(50.0)});
  REQUIRE_THROWS_AS(overlay.forget(), std::logic_error);
  overlay.look_at(map);
  REQUIRE_NOTHROW(overlay.update(scan, {30.0, 0.0, 0.0}, Eigen::Matrix3d::Zero()));
}
